//! Dates without marks: `20260501120000.010`, `20260501120000010`, `260501120000010`.

use super::cells::{cells, lines, separator, with_cells};
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// A column of the digits of a date and a time of day, which would count minutes of a hundred seconds.
pub(super) static PACKED_DATE: Spelling = Spelling {
    spelling: "dates without marks",
    read_as: "dates",
    of_dates: true,
    change,
};

/// Rows that show that digits are those of dates.
const FEWEST: usize = 10;

/// Years, in four digits and in two.
const YEARS: [std::ops::Range<u32>; 2] = [2001..2100, 10..60];

/// The date that the digits of a cell are; `None` of any other number. Behind a day and a month, which may be each other, the time
/// stands apart: for the reader to refuse.
fn date(cell: &str) -> Option<String> {
    if !cell.is_ascii() {
        return None;
    }
    year_first(cell).or_else(|| {
        let (date, rest) = cell.split_at_checked(8)?;
        let (begin, year) = date.split_at(4);
        let turned = [year, &begin[2..], &begin[..2], rest].concat();
        let other = [year, begin, rest].concat();
        year_first(&turned).or_else(|| year_first(&other))?;
        Some(format!("{date} {rest}"))
    })
}

/// The date that the digits of a cell are, by ISO 8601, the year first.
fn year_first(cell: &str) -> Option<String> {
    let (digits, decimals) = cell.split_once('.').unwrap_or((cell, ""));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !are_digits(digits) || !are_digits(decimals) {
        return None;
    }
    let years = match digits.len() {
        14 | 17 | 20 => 4,
        15 | 18 => 2,
        _ => return None,
    };
    let (year, rest) = digits.split_at(years);
    let (fields, part) = rest.split_at(10);
    // Two marks for the part of a second are none.
    if !part.is_empty() && !decimals.is_empty() {
        return None;
    }
    let two = |at: usize| &fields[2 * at..2 * at + 2];
    let is_within = |text: &str, range: &std::ops::Range<u32>| {
        text.parse().is_ok_and(|number| range.contains(&number))
    };
    let limits = [1..13, 1..32, 0..24, 0..60, 0..60];
    let are_fields = (0..5).all(|at| is_within(two(at), &limits[at]));
    if !are_fields || !is_within(year, &YEARS[usize::from(years == 2)]) {
        return None;
    }
    let century = if years == 2 { "20" } else { "" };
    let [month, day, hour, minute, second] = [0, 1, 2, 3, 4].map(two);
    Some(format!(
        "{century}{year}-{month}-{day}T{hour}:{minute}:{second}.{part}{decimals:0<1}"
    ))
}

fn change(look: &Look) -> Option<Respell> {
    let lines = lines(look);
    let separator = separator(&lines).unwrap_or(' ');
    let is_row =
        |line: &&&str| line.starts_with(|c: char| c.is_ascii_digit() || "+-\"".contains(c));
    let rows = || lines.iter().filter(is_row);
    let has_date = |line: &str, column: usize| {
        let place = cells(line, separator).get(column).cloned();
        place.is_some_and(|place| date(&line[place]).is_some())
    };
    let width = cells(rows().next()?, separator).len();
    let column = (0..width).find(|column| rows().all(|row| has_date(row, *column)))?;
    (rows().count() >= FEWEST).then(|| -> Respell {
        Box::new(move |text| {
            rewritten(text, move |line, out| {
                let text = std::str::from_utf8(line).unwrap_or_default();
                let place = cells(text, separator).get(column).cloned();
                let date = place.and_then(|place| Some((place.clone(), date(&text[place])?)));
                match date {
                    Some(change) => with_cells(text, &[change], out),
                    None => out.extend_from_slice(line),
                }
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    #[test]
    fn digits_of_dates_become_dates() {
        for (stamp, expected) in [
            ("20260501120059.25", "2026-05-01T12:00:59.25"),
            ("20260501120059", "2026-05-01T12:00:59.0"),
            ("20260501120059250", "2026-05-01T12:00:59.2500"),
            ("20260501120059250000", "2026-05-01T12:00:59.2500000"),
            ("260501120059250", "2026-05-01T12:00:59.2500"),
            ("01052026120059.25", "01052026 120059.25"),
        ] {
            let text = "time,ax,ay\n".to_owned() + &format!("{stamp},1,2\n").repeat(12);
            let read = respelt(&PACKED_DATE, &text).unwrap();
            assert_eq!(
                read.lines().last(),
                Some(format!("{expected},1,2").as_str())
            );
        }
    }

    #[test]
    fn other_numbers_are_left_alone() {
        for stamp in [
            "20260501126000",
            "20261301120000",
            "19260501120000",
            "1777636800123",
            "1777636800123000000",
            "2026050112000",
            "20260501120000010.5",
        ] {
            let text = format!("{stamp},1,2\n").repeat(12);
            assert_eq!(respelt(&PACKED_DATE, &text), None, "{stamp}");
        }
    }
}
