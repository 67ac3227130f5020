//! Rows that begin with a time of day, as `22:13:01:123,..`, `10:13:01.123 PM,..` and `22:13:01.123 -> ..`.

use std::io::Read;

use crate::clock::time_of_day::{TimeOfDay, seconds};
use crate::clock::twelve_hours::length_of_half;
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::{role_of, stated_unit};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// A table whose first column is a time of day.
pub(crate) static TIME_OF_DAY: TextFormat = TextFormat {
    name: "time_of_day",
    about: "rows that begin with a time of day, `22:13:01:123,..`",
    parts,
};

fn parts(look: &Look) -> Option<Vec<Part>> {
    let rows = look.lines().filter(|line| split(line).is_some()).count();
    (2 * rows > look.lines().count() && !has_finer(look)).then(|| {
        vec![Part {
            time_unit: Some(TimeUnit::Seconds),
            change: Some(change),
            ..Part::default()
        }]
    })
}

/// True for times of whole seconds beside a column that says it is a finer time: `time,millis,..`.
fn has_finer(look: &Look) -> bool {
    let mut clocks = look.lines().filter_map(split).map(|(time, _)| time);
    let is_whole = |time: &str| time.matches(':').count() == 2 && !time.contains(['.', ',']);
    let is_finer = |name: &String| {
        let unit = stated_unit(name).filter(|_| role_of(name, None) == Some(Role::Time));
        unit.is_some_and(|unit| unit.per_second() > 1.0)
    };
    clocks.all(is_whole) && look.first().iter().skip(1).any(is_finer)
}

/// A time of day at the beginning of a line, and what follows it and its separator.
pub(crate) fn split(line: &str) -> Option<(&str, &str)> {
    let is_clock = |c: char| c.is_ascii_digit() || matches!(c, ':' | '.');
    let line = line.trim_start();
    let end = line.find(|c| !is_clock(c))?;
    let end = end + length_of_decimals(&line[end..]);
    let (time, rest) = line.split_at(end + length_of_half(&line[end..]));
    seconds(time)?;
    let rest = rest.trim_start().trim_start_matches("->");
    Some((time, rest.trim_start_matches([',', ';', '\t', ' '])))
}

/// Returns the length of a comma and the digits behind it, where another separator follows them.
fn length_of_decimals(text: &str) -> usize {
    let Some(rest) = text.strip_prefix(',') else {
        return 0;
    };
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(0);
    match end > 0 && rest[end..].starts_with([';', '\t', ' ']) {
        true => end + 1,
        false => 0,
    }
}

/// The rows with seconds in place of times of day.
pub(crate) fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    rewritten(text, move |line, out| {
        let Ok(text) = std::str::from_utf8(line) else {
            return out.extend_from_slice(line);
        };
        let stamp = split(text).and_then(|(time, rest)| Some((clock.read(time)?, rest)));
        let Some((stamp, rest)) = stamp else {
            return out.extend_from_slice(line);
        };
        // Numbers between blanks may have decimal commas.
        let blanks =
            rest.matches(' ').count() > rest.matches(',').count() + rest.matches(", ").count();
        let separator = if rest.contains(';') {
            ';'
        } else if rest.contains('\t') && (blanks || !rest.contains(',')) {
            '\t'
        } else if blanks {
            ' '
        } else {
            ','
        };
        out.extend_from_slice(format!("{stamp:.6}{separator}{rest}").as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_ends_before_the_separator() {
        for (line, time, rest) in [
            ("13:05:10,250;0,1;2", "13:05:10,250", "0,1;2"),
            ("13:05:10.250,0.1,2", "13:05:10.250", "0.1,2"),
            ("13:05:10,250,0.1", "13:05:10", "250,0.1"),
            ("01:05:10.5 PM 0.1 2", "01:05:10.5 PM", "0.1 2"),
            ("13:05:10.250 -> 1 2", "13:05:10.250", "1 2"),
        ] {
            assert_eq!(split(line), Some((time, rest)), "{line}");
        }
        assert_eq!(split("0.1,2"), None);
    }
}
