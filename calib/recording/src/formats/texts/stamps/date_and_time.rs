//! Tables with the date in the first column and the time of day in the second: `2026-05-01,12:00:00.010,..`.

use std::io::Read;

use crate::clock::time_of_day::{DAY, TimeOfDay};
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::role_of;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// A table whose stamp is in two columns.
pub(crate) static DATE_AND_TIME: TextFormat = TextFormat {
    name: "date_and_time",
    about: "a table with a column of dates and one of times of day: `2026-05-01,12:00:00.010,..`",
    parts,
};

/// Names of the first column.
const DATES: [&str; 6] = ["date", "datum", "fecha", "data", "day", "dato"];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let names = look.first();
    let [date, time, ..] = &names[..] else {
        return None;
    };
    let is_date = DATES.contains(&date.to_lowercase().as_str());
    let joined = look.lines().filter(|line| joined(line).is_some()).count();
    let part = Part {
        change: Some(change),
        ..Part::default()
    };
    let is_time = role_of(time, None) == Some(Role::Time);
    (is_date && is_time && 2 * joined > look.lines().count()).then(|| vec![part])
}

/// The first two cells of a row as one, and the rest with the separator before it.
fn joined(line: &str) -> Option<(String, &str)> {
    let at = line.find([',', ';', '\t'])?;
    let (date, rest) = line.split_at(at);
    let separator = rest.chars().next()?;
    let rest = &rest[separator.len_utf8()..];
    let (time, rest) = rest.split_at(rest.find(separator)?);
    let [date, time] = [date, time].map(|cell| cell.trim().trim_matches('"').trim());
    let numbers: Vec<&str> = date.split(['-', '.', '/']).collect();
    let is_number = |text: &&str| text.parse::<u32>().is_ok();
    if numbers.len() != 3 || !numbers.iter().all(is_number) || !time.contains(':') {
        return None;
    }
    let date = match &numbers[..] {
        [year, month, day] if year.len() == 4 => format!("{year}-{month:0>2}-{day:0>2}"),
        // Day or month first: `--time-format` says.
        _ => date.to_owned(),
    };
    Some((format!("{date} {}", time.replace(',', ".")), rest))
}

/// Counts the days that a date which stands still is behind.
#[derive(Default)]
struct Days {
    date: String,
    clock: TimeOfDay,
}

impl Days {
    /// The date and time of a row on the day that it is, where the year comes first.
    fn counted(&mut self, stamp: String) -> String {
        let Some((date, time)) = stamp.split_once(' ') else {
            return stamp;
        };
        if self.date != date {
            (self.date, self.clock) = (date.to_owned(), TimeOfDay::default());
        }
        let passed = self.clock.read(time).unwrap_or_default() / DAY;
        let day = date.parse::<jiff::civil::Date>().ok();
        let day = day.filter(|_| passed >= 1.0).and_then(|day| {
            let passed = jiff::Span::new().try_days(passed as i64).ok()?;
            day.checked_add(passed).ok()
        });
        day.map_or_else(|| stamp.clone(), |day| format!("{day} {time}"))
    }
}

/// The rows with date and time in one cell, the header without the name of the date.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut begun = false;
    let mut days = Days::default();
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if let Some((stamp, rest)) = joined(text) {
            begun = true;
            out.extend_from_slice(days.counted(stamp).as_bytes());
            return out.extend_from_slice(rest.as_bytes());
        }
        let is_header = !begun
            && cells(text)
                .first()
                .is_some_and(|name| DATES.contains(&name.to_lowercase().as_str()));
        let from = match is_header {
            true => line.iter().position(|byte| b",;\t".contains(byte)),
            false => None,
        };
        out.extend_from_slice(&line[from.map_or(0, |at| at + 1)..]);
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn date_and_time_become_one_cell() {
        for (text, expected) in [
            (
                "Date,Time,ax\n2026-05-01,12:00:00.5,1\n",
                "Time,ax\n2026-05-01 12:00:00.5,1\n",
            ),
            (
                "Datum;Uhrzeit;ax\n1.5.2026;12:00:00,5;0,1\n",
                "Uhrzeit;ax\n1.5.2026 12:00:00.5;0,1\n",
            ),
            // The day on which the logger was started.
            (
                "Date,Time,ax\n2026-04-30,23:59:59.9,1\n2026-04-30,00:00:00.1,1\n",
                "Time,ax\n2026-04-30 23:59:59.9,1\n2026-05-01 00:00:00.1,1\n",
            ),
            (
                "date\ttime\tax\n5/13/2026\t12:00:00\t1\n",
                "time\tax\n5/13/2026 12:00:00\t1\n",
            ),
        ] {
            assert_eq!(changed_by(change, text), expected);
        }
        assert!(
            parts(&Look::at(
                b"Date,Time,ax\n2026-05-01,12:00:00.5,1\n2026-05-01,12:00:00.6,1\n"
            ))
            .is_some()
        );
        assert!(
            parts(&Look::at(
                b"date,time,ax\n2026-05-01,0.5,1\n2026-05-01,0.6,1\n"
            ))
            .is_none()
        );
    }
}
