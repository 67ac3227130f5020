//! Dates without marks: `20260501120000.010`, `20260501120000010`, `260501120000010`, `010526120000010`.

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

findings::tuning! {
    /// Rows that show that digits are those of dates.
    FEWEST: usize = 10;
}

/// Years, in four digits and in two.
const YEARS: [std::ops::Range<u32>; 2] = [2001..2100, 10..60];

/// Orders of the digits of a date and a time of day.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    /// Both: the year is first.
    YearFirst,
    /// The time of day: the day and the month, which may be each other, or a year of two digits are first, and nobody says which.
    Other,
}

/// The digits of the year, of the four others of the date, of the time of day, and behind it.
fn fields(cell: &str, order: Order) -> Option<[&str; 4]> {
    let (digits, decimals) = cell.split_once('.').unwrap_or((cell, ""));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !are_digits(digits) || !are_digits(decimals) {
        return None;
    }
    let years = match digits.len() {
        14 | 17 | 20 => 4,
        15 | 18 => 2,
        // Twelve digits alone may be any number.
        12 if !decimals.is_empty() => 2,
        _ => return None,
    };
    let (date, rest) = digits.split_at(years + 4);
    let (time, part) = rest.split_at(6);
    // Two marks for the part of a second are none.
    if !part.is_empty() && !decimals.is_empty() {
        return None;
    }
    let (year, days) = match order {
        Order::YearFirst => date.split_at(years),
        Order::Other => {
            let (days, year) = date.split_at(4);
            (year, days)
        }
    };
    let two = |text: &str, at: usize, range: std::ops::Range<u32>| {
        let number = text[2 * at..2 * at + 2].parse();
        number.is_ok_and(|number| range.contains(&number))
    };
    let is_date = |month: usize| two(days, month, 1..13) && two(days, 1 - month, 1..32);
    let are_days = is_date(0) || (order == Order::Other && is_date(1));
    let is_time = two(time, 0, 0..24) && two(time, 1, 0..60) && two(time, 2, 0..60);
    let in_years = YEARS[usize::from(years == 2)].contains(&year.parse().ok()?);
    let part = if part.is_empty() { decimals } else { part };
    (are_days && is_time && in_years).then_some([year, days, time, part])
}

/// The date that the digits of a cell are, by ISO 8601, or the time of day.
fn date(cell: &str, order: Order) -> Option<String> {
    let [year, days, time, part] = fields(cell, order)?;
    let two = |text: &str, mark: &str| {
        let pairs = text.as_bytes().chunks(2).map(String::from_utf8_lossy);
        pairs.collect::<Vec<_>>().join(mark)
    };
    let time = format!("{}.{part:0<1}", two(time, ":"));
    let century = if year.len() == 2 { "20" } else { "" };
    Some(match order {
        Order::YearFirst => format!("{century}{year}-{}T{time}", two(days, "-")),
        Order::Other => time,
    })
}

fn change(look: &Look) -> Option<Respell> {
    let lines = lines(look);
    let separator = separator(&lines).unwrap_or(' ');
    let is_row =
        |line: &&&str| line.starts_with(|c: char| c.is_ascii_digit() || "+-\"".contains(c));
    let rows = || lines.iter().filter(is_row);
    let has_date = |line: &str, column: usize, order: Order| {
        let place = cells(line, separator).get(column).cloned();
        place.is_some_and(|place| fields(&line[place], order).is_some())
    };
    let width = cells(rows().next()?, separator).len();
    let are_of = |column: usize, order: Order| rows().all(|row| has_date(row, column, order));
    // Where either order is one the time of day is the same.
    let column_of = |order: Order| Some(((0..width).find(|column| are_of(*column, order))?, order));
    let (column, order) = column_of(Order::Other).or_else(|| column_of(Order::YearFirst))?;
    (rows().count() >= FEWEST.get()).then(|| -> Respell {
        Box::new(move |text| {
            rewritten(text, move |line, out| {
                let text = std::str::from_utf8(line).unwrap_or_default();
                let place = cells(text, separator).get(column).cloned();
                let date =
                    place.and_then(|place| Some((place.clone(), date(&text[place], order)?)));
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
            ("20260501120059250", "2026-05-01T12:00:59.250"),
            ("20260501120059250000", "2026-05-01T12:00:59.250000"),
            ("260501120059250", "2026-05-01T12:00:59.250"),
            // The day or the month first, or it may be: the time of day is the same.
            ("01052026120059.25", "12:00:59.25"),
            ("05312026120059.25", "12:00:59.25"),
            ("010524120059250", "12:00:59.250"),
            ("250524120059250", "12:00:59.250"),
            ("010524120059.25", "12:00:59.25"),
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
            "010524120059",
            "354524120059250",
        ] {
            let text = format!("{stamp},1,2\n").repeat(12);
            assert_eq!(respelt(&PACKED_DATE, &text), None, "{stamp}");
        }
    }
}
