//! Numbers with their unit in every cell: `9.81 m/s²`, `25.1 °C`.

use std::ops::Range;

use super::cells::{cells, lines, most, separator, with_cells};
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::header::names::take_apart;
use crate::source::rewrite::rewritten;
use crate::units::is_unit;

/// The unit goes into the name of the column.
pub(super) static UNIT_CELLS: Spelling = Spelling {
    spelling: "the units behind numbers",
    read_as: "units of the columns",
    of_dates: false,
    change,
};

findings::tuning! {
    /// Rows with a unit that a column has at least.
    FEWEST: usize = 5;
    /// The same as a share of its rows.
    SHARE: f64 = 0.9;
}

/// A number and the unit behind it.
pub(crate) fn number_and_unit(cell: &str) -> Option<(&str, &str)> {
    let of_number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '\u{2212}' | '.' | ',');
    let end = cell.find(|c| !of_number(c))?;
    let (mut number, mut unit) = cell.split_at(end);
    // An exponent belongs to the number.
    if let Some(rest) = unit.strip_prefix(['e', 'E']) {
        let digits = rest.trim_start_matches(['+', '-']);
        let length = digits.bytes().take_while(u8::is_ascii_digit).count();
        if length > 0 {
            let end = cell.len() - digits.len() + length;
            (number, unit) = cell.split_at(end);
        }
    }
    let has_digit = number.bytes().any(|byte| byte.is_ascii_digit());
    let unit = unit.trim();
    (has_digit && is_unit(unit)).then_some((number, unit))
}

/// The units of a text's columns, its header and its separator.
struct Units {
    separator: char,
    width: usize,
    header: String,
    /// Column and unit.
    of: Vec<(usize, String)>,
}

impl Units {
    fn of(look: &Look) -> Option<Self> {
        let lines = lines(look);
        let separator = separator(&lines)?;
        let (width, _) = most(lines.iter().map(|line| cells(line, separator).len()))?;
        let mut rows = lines.iter().filter(|l| cells(l, separator).len() == width);
        let header = rows.next()?;
        let rows: Vec<&&str> = rows.collect();
        let names: Vec<&str> = cells(header, separator)
            .into_iter()
            .map(|at| &header[at])
            .collect();
        if names.iter().any(|name| number_and_unit(name).is_some()) {
            return None;
        }
        let mut of = Vec::new();
        for (column, name) in names.iter().enumerate() {
            let found = rows.iter().filter_map(|row| {
                let place = cells(row, separator).get(column)?.clone();
                Some(number_and_unit(&row[place])?.1)
            });
            let found: Vec<&str> = found.collect();
            let Some(unit) = found.first() else { continue };
            let alike = found.iter().filter(|other| *other == unit).count();
            // One that the name states otherwise is for the reader to refuse.
            let stated = take_apart(name).1;
            let fits = stated.is_none_or(|stated| stated == *unit);
            if fits && alike >= FEWEST.get() && alike as f64 >= SHARE.get() * rows.len() as f64 {
                of.push((column, (*unit).to_owned()));
            }
        }
        let header = (*header).to_owned();
        (!of.is_empty()).then_some(Self {
            separator,
            width,
            header,
            of,
        })
    }

    /// The name of a column with its unit.
    fn name(&self, text: &str, place: &Range<usize>, unit: &str) -> String {
        let name = &text[place.clone()];
        match take_apart(name).1 {
            Some(_) => name.to_owned(),
            None => format!("{name} [{unit}]"),
        }
    }
}

fn change(look: &Look) -> Option<Respell> {
    let units = Units::of(look)?;
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            let places = cells(text, units.separator);
            if places.len() != units.width {
                return out.extend_from_slice(line);
            }
            let is_header = text == units.header.trim_end();
            let changed = |(column, unit): &(usize, String)| {
                let place = places[*column].clone();
                if is_header {
                    return Some((place.clone(), units.name(text, &place, unit)));
                }
                let (number, own) = number_and_unit(&text[place.clone()])?;
                // Of another unit in the column the reader makes no number.
                (own == unit).then(|| (place, number.to_owned()))
            };
            let changes: Vec<_> = units.of.iter().filter_map(changed).collect();
            with_cells(text, &changes, out);
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    #[test]
    fn units_of_cells_become_units_of_columns() {
        let row = "1.5 s,0.1 m/s²,25.1 °C,-3e-2rad/s\n";
        let read = respelt(&UNIT_CELLS, &("t,ax,temp,gx\n".to_owned() + &row.repeat(6))).unwrap();
        assert_eq!(
            read.lines().next(),
            Some("t [s],ax [m/s²],temp [°C],gx [rad/s]")
        );
        assert_eq!(read.lines().last(), Some("1.5,0.1,25.1,-3e-2"));
        let row = "1,5;0,1 g;2\n";
        let read = respelt(&UNIT_CELLS, &("t;ax (g);n\n".to_owned() + &row.repeat(6))).unwrap();
        assert!(read.starts_with("t;ax (g);n\n1,5;0,1;2\n"), "{read}");
    }

    #[test]
    fn another_unit_in_a_column_or_in_its_name_stays_for_the_reader() {
        let rows = "1,0.1 g,2\n".repeat(20) + "1,100 mg,2\n";
        let read = respelt(&UNIT_CELLS, &("t,ax,n\n".to_owned() + &rows)).unwrap();
        assert!(read.ends_with("1,0.1,2\n1,100 mg,2\n"), "{read}");
        for text in [
            "t,ax [g],n\n1,0.1 m/s²,2\n",
            "t,ax,n\n1,0.1,2\n",
            "t,ax,n\n1,5x,2\n",
        ] {
            let text = text.to_owned() + &text.split_once('\n').unwrap().1.repeat(6);
            assert_eq!(respelt(&UNIT_CELLS, &text), None, "{text}");
        }
    }
}
