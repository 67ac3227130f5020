//! A row of units under the header: `s,m/s^2,m/s^2,m/s^2,rad/s,rad/s,rad/s`.

use std::str::FromStr;

use findings::{Finding, Kind, OptionName, Remedy};

use crate::header::Layout;
use crate::recording::options::ReadOptions;
use crate::shown::shown;
use crate::units::{Stated, is_unit};

/// A cell without the brackets that units are written in.
fn bare(cell: &str) -> &str {
    let brackets = |c| matches!(c, '(' | ')' | '[' | ']' | '{' | '}' | ' ');
    cell.trim_matches(brackets)
}

/// A cell as units are spelled: a time since 1970 is in seconds where no unit follows it.
fn spelled(cell: &str) -> &str {
    match bare(cell) {
        since if since.eq_ignore_ascii_case("unix time") => "s",
        cell => cell,
    }
}

/// True for what stands in place of the unit of a column without one.
fn is_blank(cell: &str) -> bool {
    matches!(bare(cell), "" | "-" | "--" | "1") || is_unitless(cell)
}

/// True for words that stand for the unit of what has none.
fn is_unitless(cell: &str) -> bool {
    matches!(
        bare(cell).to_lowercase().as_str(),
        "no_units" | "no units" | "unitless" | "local_flux" | "n/a" | "na" | "none" | "ts" | "rn"
    )
}

/// True for the pattern that dates are written by: `yyyy/mm/dd hh:mm:ss.000`.
fn is_pattern_of_dates(cell: &str) -> bool {
    let cell = bare(cell).to_lowercase();
    ["yy", "mm", "dd", "hh"]
        .iter()
        .all(|part| cell.contains(part))
}

/// True if half or more of what the cells hold is a unit, of any quantity.
pub(crate) fn holds_units(cells: &[String]) -> bool {
    let filled = cells.iter().filter(|cell| !is_blank(cell)).count();
    let units = cells.iter().filter(|cell| is_unit(bare(cell))).count();
    let unitless = cells.iter().filter(|cell| is_unitless(cell)).count();
    units + unitless >= 1 && 2 * units >= filled
}

/// Units that `layout` states, with those of `cells` below its names; an option says more than either.
///
/// # Errors
/// A unit that is not known, or not that of the other axes or of the header.
pub(crate) fn stated(
    layout: &Layout,
    cells: &[String],
    options: &ReadOptions,
) -> Result<Stated, Box<Finding>> {
    let row = Row { layout, cells };
    let by_names = layout.stated;
    let axes = |triad: Option<[usize; 3]>| triad.into_iter().flatten().collect::<Vec<_>>();
    let one = |column: Option<usize>| column.into_iter().collect::<Vec<_>>();
    Ok(Stated {
        time: row.unit(
            &one(layout.time),
            by_names.time,
            options.time_unit,
            Some((OptionName::TimeUnit, "ms")),
        )?,
        accel: row.unit(
            &axes(layout.accel),
            by_names.accel,
            options.accel_unit,
            Some((OptionName::AccelUnit, "g")),
        )?,
        gyro: row.unit(
            &axes(layout.gyro),
            by_names.gyro,
            options.gyro_unit,
            Some((OptionName::GyroUnit, "deg/s")),
        )?,
        temperature: row.unit(&one(layout.temperature), by_names.temperature, None, None)?,
        // A magnetometer is kept whatever its unit is called.
        field: by_names.field.or_else(|| {
            let [x, ..] = layout.field?;
            bare(cells.get(x)?).parse().ok()
        }),
    })
}

struct Row<'a> {
    layout: &'a Layout,
    cells: &'a [String],
}

impl Row<'_> {
    /// The one unit of `columns`; `given` by an option it need not be understood.
    fn unit<U: FromStr<Err = Box<Finding>> + PartialEq + Copy>(
        &self,
        columns: &[usize],
        by_name: Option<U>,
        given: Option<U>,
        option: Option<(OptionName, &str)>,
    ) -> Result<Option<U>, Box<Finding>> {
        let mut unit = by_name;
        for &column in columns {
            let says = |cell: &&String| !is_blank(cell) && !is_pattern_of_dates(cell);
            let Some(cell) = self.cells.get(column).filter(says) else {
                continue;
            };
            let found = spelled(cell).parse::<U>();
            match (found, unit) {
                (Ok(found), None) => unit = Some(found),
                (Ok(found), Some(unit)) if found == unit => {}
                _ if given.is_some() => return Ok(unit),
                (found, _) => return Err(self.refusal(column, found.err(), option).into()),
            }
        }
        Ok(unit)
    }

    fn refusal(
        &self,
        column: usize,
        unknown: Option<Box<Finding>>,
        option: Option<(OptionName, &str)>,
    ) -> Finding {
        let found = match unknown {
            Some(unknown) => Finding::of(Kind::UNIT_ROW_UNKNOWN)
                .detail("known", unknown.word("known").unwrap_or_default()),
            None => Finding::of(Kind::UNIT_ROW_CONTRADICTS),
        };
        let found = found
            .detail("cell", shown(self.cells[column].trim()))
            .detail("column", self.layout.column(column));
        match option {
            Some((option, value)) => found.remedy(Remedy::such_as(option, value)),
            None => found,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_for_a_unit_is_read_as_one_or_passed() {
        let names = ["timestamp", "ax", "ay", "az"].map(str::to_owned).to_vec();
        let layout = Layout::of_names(names, &Default::default(), None).unwrap();
        let time = |cell: &str| {
            let cells = [cell, "G", "G", "G"].map(str::to_owned);
            let stated = stated(&layout, &cells, &ReadOptions::default());
            stated.ok().map(|stated| stated.time)
        };
        use crate::units::TimeUnit;
        assert_eq!(time("unix time"), Some(Some(TimeUnit::Seconds)));
        assert_eq!(time("yyyy/mm/dd hh:mm:ss.000"), Some(None));
        assert_eq!(time("(na)"), Some(None));
        // A stamp, and the number of a record.
        assert_eq!((time("TS"), time("RN")), (Some(None), Some(None)));
        assert_eq!(time("furlong"), None);
    }
}
