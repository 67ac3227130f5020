//! Counts written in sixteens without a mark: `FF42,0090,4090`.

use super::cells::{cells, lines, most, separator, with_cells};
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// Four digits are a count of 16 bits with its sign, and eight a stamp.
pub(super) static SIXTEENS: Spelling = Spelling {
    spelling: "numbers in sixteens",
    read_as: "counts with their sign",
    of_dates: false,
    change,
};

/// Digits of a count and of a stamp.
const OF_COUNT: usize = 4;
const OF_STAMP: usize = 8;

findings::tuning! {
    /// Rows that show columns of such numbers.
    FEWEST: usize = 10;
    /// Columns of them that a text has at least: a sensor's.
    COLUMNS: usize = 3;
}

fn is_of(cell: &str, digits: usize) -> bool {
    cell.len() == digits && cell.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// The number of a cell, in tens.
fn number(cell: &str) -> Option<String> {
    let number = u32::from_str_radix(cell, 16).ok()?;
    match cell.len() {
        OF_COUNT => Some((u16::try_from(number).ok()? as i16).to_string()),
        _ => Some(number.to_string()),
    }
}

/// The columns of a text that are spelt so, and its separator.
struct Columns {
    separator: char,
    width: usize,
    of: Vec<usize>,
}

impl Columns {
    fn of(look: &Look) -> Option<Self> {
        let lines = lines(look);
        let separator = separator(&lines).unwrap_or(' ');
        let (width, _) = most(lines.iter().map(|line| cells(line, separator).len()))?;
        let rows = lines.iter().filter(|l| cells(l, separator).len() == width);
        let rows: Vec<Vec<&str>> = rows
            .map(|line| {
                cells(line, separator)
                    .into_iter()
                    .map(|at| &line[at])
                    .collect()
            })
            .collect();
        // The first may be a header.
        let rows = rows.get(1..).filter(|rows| rows.len() >= FEWEST.get())?;
        let all = |column: usize, digits: usize| rows.iter().all(|row| is_of(row[column], digits));
        let has_letter = |column: usize| {
            let is_letter = |c: char| c.is_ascii_alphabetic();
            // `1E05` is a number of either kind.
            let is_sure = |cell: &str| cell.contains(is_letter) && cell.parse::<f64>().is_err();
            rows.iter().any(|row| is_sure(row[column]))
        };
        let counts: Vec<usize> = (0..width).filter(|at| all(*at, OF_COUNT)).collect();
        let sure = counts.iter().filter(|at| has_letter(**at)).count();
        if sure < COLUMNS.get() {
            return None;
        }
        let is_stamp = |at: &usize| all(*at, OF_STAMP) && has_letter(*at);
        let stamps: Vec<usize> = (0..width).filter(is_stamp).collect();
        // Digits alone in front may be a stamp in tens.
        let is_count = |at: &usize| *at > 0 || has_letter(*at);
        let mut of: Vec<usize> = counts.into_iter().filter(is_count).chain(stamps).collect();
        of.sort_unstable();
        Some(Self {
            separator,
            width,
            of,
        })
    }
}

fn change(look: &Look) -> Option<Respell> {
    let columns = Columns::of(look)?;
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            let places = cells(text, columns.separator);
            let has_own = |at: &usize| {
                let cell = places.get(*at).map(|place| &text[place.clone()]);
                cell.is_some_and(|cell| is_of(cell, OF_COUNT) || is_of(cell, OF_STAMP))
            };
            if places.len() != columns.width || !columns.of.iter().all(has_own) {
                return out.extend_from_slice(line);
            }
            let changed = |at: &usize| {
                let place = places[*at].clone();
                number(&text[place.clone()]).map(|number| (place, number))
            };
            let changes: Vec<_> = columns.of.iter().filter_map(changed).collect();
            with_cells(text, &changes, out);
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    #[test]
    fn four_digits_are_a_count_with_its_sign() {
        let of = |text: &str| respelt(&SIXTEENS, text);
        let rows = |row: &dyn Fn(usize) -> String| (10..30).map(row).collect::<String>();
        let text = rows(&|k| format!("{k},FF{k},00A{},40{k},000B\n", k % 10));
        let read = of(&("ms,ax,ay,az,gx\n".to_owned() + &text)).unwrap();
        assert_eq!(read.lines().next(), Some("ms,ax,ay,az,gx"));
        assert_eq!(read.lines().nth(1), Some("10,-240,160,16400,11"));
        let stamps = of(&rows(&|k| {
            format!("0000A{k}0 FF{k} 00A{} 4FF{}\n", k % 10, k % 10)
        }));
        assert_eq!(stamps.unwrap().lines().next(), Some("41216 -240 160 20464"));
        // Numbers in tens, words and powers of ten.
        for row in [
            "10,1023,1024,1025\n",
            "FACE,1023,1024,1025\n",
            "1E05,2E05,3E05\n",
        ] {
            assert_eq!(of(&row.repeat(20)), None, "{row}");
        }
    }
}
