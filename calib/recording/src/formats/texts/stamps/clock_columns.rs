//! Tables with the fields of a clock in columns of their own: `hour,minute,second,..`, `min,sec,ms,..`.

use std::io::Read;
use std::ops::Range;

use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::places::{may_be_row, places, replaced, whole_rows, words};
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::{compact, role_of};
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// A table whose stamp is in a column for each field.
pub(crate) static CLOCK_COLUMNS: TextFormat = TextFormat {
    name: "clock_columns",
    about: "a table with columns of hours, minutes and seconds: `hour,minute,second,..`, `min,sec,ms,..`",
    parts,
};

/// Names of the fields and their seconds.
const FIELDS: [(&[&str], f64); 6] = [
    (&["hour", "hours", "hh", "hr", "h"], 3600.0),
    (&["minute", "minutes", "min", "mins", "mm", "m"], 60.0),
    (&["second", "seconds", "sec", "secs", "ss", "s"], 1.0),
    (
        &["millisecond", "milliseconds", "millis", "msec", "ms"],
        1e-3,
    ),
    (
        &["microsecond", "microseconds", "micros", "usec", "us"],
        1e-6,
    ),
    (
        &["nanosecond", "nanoseconds", "nanosec", "nsec", "ns", "nano"],
        1e-9,
    ),
];

/// Words before the names of fields: `UTC_Hour`.
const CLOCKS: [&str; 4] = ["utc", "gps", "local", "rtc"];

/// A field's column and its seconds.
type Field = (usize, f64);

/// The index of the minutes among them.
const MINUTE: usize = 1;

/// The fields by their columns, the minutes and the seconds among them.
fn fields(header: &str) -> Option<Vec<Field>> {
    let names = words(header);
    let field = |name: &str| {
        let word = compact(name);
        let mut clocks = CLOCKS.iter();
        let bare = clocks.find_map(|clock| word.strip_prefix(clock));
        let bare = bare.unwrap_or(&word);
        FIELDS.iter().position(|(words, _)| words.contains(&bare))
    };
    let found: Vec<Option<usize>> = names.iter().map(|name| field(name)).collect();
    let minutes = found.iter().position(|found| *found == Some(MINUTE))?;
    // They stand one after the other, each smaller than the one before.
    let mut first = minutes;
    if minutes > 0 && found[minutes - 1] == Some(MINUTE - 1) {
        first -= 1;
    }
    let mut last = minutes;
    while found.get(last + 1).is_some_and(|next| *next > found[last]) {
        last += 1;
    }
    let is_time = |at: usize| role_of(names[at], None) == Some(Role::Time);
    let others = (0..names.len()).filter(|at| !(first..=last).contains(at));
    let has_seconds = last > minutes && found[minutes + 1] == Some(MINUTE + 1);
    let is_only = has_seconds && !{ others }.any(is_time);
    // `m` alone may be a mass or a distance.
    let is_letter = names[minutes].trim().len() == 1 && first == minutes;
    let columns = (first..=last).filter_map(|at| Some((at, FIELDS[found[at]?].1)));
    (is_only && !is_letter).then(|| columns.collect())
}

/// The seconds since midnight, or since the hour, of a row; `None` where a field counts more than one of the field before it, or has
/// a part that the field behind it counts again.
fn seconds(row: &str, fields: &[Field]) -> Option<f64> {
    let places = places(row);
    let last = fields.len().saturating_sub(1);
    if let Some(counted) = counted_on(row, &places, fields) {
        return Some(counted);
    }
    let part = |(at, (column, unit)): (usize, &Field)| {
        let number = number_in(row, &places, *column)?;
        let limit = match at.checked_sub(1).and_then(|before| fields.get(before)) {
            Some((_, larger)) => (larger / unit).round(),
            None => 60.0,
        };
        let is_field = (0.0..limit).contains(&number) && (at == last || number.fract() == 0.0);
        is_field.then_some(number * unit)
    };
    fields.iter().enumerate().map(part).sum()
}

/// The seconds of a row of minutes and of seconds that count on past them: `1,60.5`.
fn counted_on(row: &str, places: &[Range<usize>], fields: &[Field]) -> Option<f64> {
    let [(minute, _), (second, _)] = fields else {
        return None;
    };
    let cell = row.get(places.get(*minute)?.clone())?;
    let minutes: f64 = cell.parse().ok()?;
    let seconds = number_in(row, places, *second)?;
    (seconds >= 60.0 && (seconds / 60.0).floor() == minutes).then_some(seconds)
}

findings::tuning! {
    /// Numbers of a part of a second that show how far it counts.
    ENOUGH: usize = 10;
}

/// True for parts of a second that begin again before half of it, as hundredths do that are called milliseconds.
fn counts_less(rows: &[&str], fields: &[Field]) -> bool {
    let Some((column, unit)) = fields.last().filter(|(_, unit)| *unit < 1.0) else {
        return false;
    };
    let number = |row: &&str| row[places(row).get(*column)?.clone()].parse::<f64>().ok();
    let parts: Vec<f64> = rows.iter().filter_map(number).collect();
    let begins_again = parts.windows(2).any(|pair| pair[1] < pair[0]);
    let mut all: Vec<u64> = parts.iter().map(|part| part.to_bits()).collect();
    all.sort_unstable();
    all.dedup();
    let before_half = parts.iter().all(|part| part * unit < 0.5);
    let is_of_seconds = fields.iter().any(|(_, unit)| *unit == 1.0)
        && fields.iter().filter(|(_, unit)| *unit < 1.0).count() == 1;
    is_of_seconds && begins_again && before_half && all.len() >= ENOUGH.get()
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut lines = whole_rows(look).into_iter();
    let fields = fields(lines.next()?)?;
    let lines: Vec<&str> = lines.collect();
    let all = |stamp: Stamp| lines.iter().all(|row| stamp(row, &fields).is_some());
    let change: Change = match () {
        () if all(seconds) && counts_less(&lines, &fields) => unreadable,
        () if all(seconds) => change,
        () if all(without_part) => without_its_part,
        () if goes_on(&lines, &fields) => counted,
        () => return None,
    };
    (lines.len() > 1).then(|| {
        vec![Part {
            time_unit: Some(TimeUnit::Seconds),
            change: Some(change),
            ..Part::default()
        }]
    })
}

/// The stamp that the fields of a row make, s.
type Stamp = fn(&str, &[Field]) -> Option<f64>;

/// The number in a column, with a comma or a point before its decimals.
fn number_in(row: &str, places: &[Range<usize>], column: usize) -> Option<f64> {
    let cell = row.get(places.get(column)?.clone())?;
    let number = cell.replace(',', ".").parse().ok();
    number.filter(|number: &f64| number.is_finite())
}

/// The same of seconds with decimals, of which the last field holds the part once more: `0,1.25,250`.
fn without_part(row: &str, fields: &[Field]) -> Option<f64> {
    let [before @ .., last @ (_, unit)] = fields else {
        return None;
    };
    let whole = before.last().filter(|(_, unit)| *unit == 1.0)?;
    let places = places(row);
    let number = |(column, _): &Field| number_in(row, &places, *column);
    let part = number(last)? * unit;
    let is_same = (number(whole)?.fract() - part).abs() < 2.0 * unit;
    seconds(row, before).filter(|_| is_same)
}

/// The count in the last field, s.
fn count(row: &str, fields: &[Field]) -> Option<f64> {
    let (column, unit) = fields.last()?;
    Some(number_in(row, &places(row), *column)? * unit)
}

/// True where the last field goes on past the one before it and counts as the clock of the others does: it is a clock of its own,
/// as `millis` behind the minutes and the seconds of another are.
fn goes_on(rows: &[&str], fields: &[Field]) -> bool {
    let Some(([.., larger], last)) = fields.split_last().map(|(last, before)| (before, last))
    else {
        return false;
    };
    let before = &fields[..fields.len() - 1];
    let both = |row: &&str| Some((seconds(row, before)?, count(row, fields)?));
    let Some(pairs) = rows.iter().map(both).collect::<Option<Vec<_>>>() else {
        return false;
    };
    let steps = || pairs.windows(2);
    let ascends = steps().all(|pair| pair[1].1 > pair[0].1);
    let passed = pairs.first().zip(pairs.last());
    // The clock of the others may have begun another hour or day.
    let agree = passed.is_some_and(|(first, last)| {
        let (clock, count) = (last.0 - first.0, last.1 - first.1);
        clock < 0.0 || (clock - count).abs() < 1.5 * larger.1
    });
    let is_past = pairs.iter().any(|(_, count)| *count >= larger.1);
    ascends && agree && is_past && last.1 < 1.0
}

/// The rows with the time in the column of the minutes, and the header with other names for the fields.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    stamped(text, seconds)
}

/// The same where the last field holds the part of the seconds once more.
fn without_its_part(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    stamped(text, without_part)
}

/// The rows with the count of the last field, which is a clock of its own.
fn counted(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    rewritten_by(text, count, |seconds| format!("{seconds:.9}"))
}

/// The same with stamps that are no numbers, for the reader to refuse.
fn unreadable(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    stamped(text, |_, _| None)
}

/// The row with other texts in the columns of some fields.
fn replaced_in(row: &str, (column, _): &Field, with: &str) -> String {
    let place = places(row).get(*column).cloned();
    place.map_or_else(|| row.to_owned(), |place| replaced(row, &place, with))
}

/// The rows with the time of a clock that begins again after an hour or a day.
fn stamped(text: Box<dyn Read + Send>, seconds: Stamp) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    rewritten_by(text, seconds, move |seconds| {
        format!("{:.9}", clock.count_on(seconds))
    })
}

fn rewritten_by(
    text: Box<dyn Read + Send>,
    seconds: Stamp,
    mut written: impl FnMut(f64) -> String + Send + 'static,
) -> Box<dyn Read + Send> {
    let mut known: Option<Vec<Field>> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some(fields) = &known else {
            known = fields(text).filter(|_| may_be_row(text));
            let columns = known.as_deref().unwrap_or_default();
            let named = columns.iter().fold(text.to_owned(), |text, field| {
                let name = if field.1 == 60.0 { "time" } else { "part" };
                replaced_in(&text, field, name)
            });
            return out.extend_from_slice(match columns.is_empty() {
                true => line,
                false => named.as_bytes(),
            });
        };
        let Some(minutes) = fields.iter().find(|(_, unit)| *unit == 60.0) else {
            return out.extend_from_slice(line);
        };
        let stamp = match seconds(text, fields) {
            Some(seconds) => written(seconds),
            // No number, for the reader to refuse.
            None => {
                let cells = places(text);
                let shown = |(column, _): &Field| cells.get(*column).map(|at| &text[at.clone()]);
                let shown: Vec<&str> = fields.iter().filter_map(shown).collect();
                shown.join(" and ")
            }
        };
        out.extend_from_slice(replaced_in(text, minutes, &stamp).as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn fields_of_a_clock_become_one_stamp() {
        for (text, expected) in [
            (
                "min,sec,ax\n59,59.5,1\n0,0.5,1\n",
                "time,part,ax\n3599.500000000,59.5,1\n3600.500000000,0.5,1\n",
            ),
            (
                "UTC_Hour,UTC_Minute,UTC_Second,UTC_Nano,ax\n1,0,2,250000000,7\n1,0,2,260000000,7\n",
                "part,time,part,part,ax\n1,3602.250000000,2,250000000,7\n1,3602.260000000,2,260000000,7\n",
            ),
            (
                "hour;minute;second;ms;ax\n1;0;2;250;7\n1;0;2;260;7\n",
                "part;time;part;part;ax\n1;3602.250000000;2;250;7\n1;3602.260000000;2;260;7\n",
            ),
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_some(), "{text}");
            assert_eq!(changed_by(change, text), expected);
        }
    }

    #[test]
    fn a_part_that_is_there_twice_or_counts_by_itself_is_told() {
        for (text, expected) in [
            (
                "min,sec,ms,ax\n0,59.990,990,3\n1,0.000,0,3\n",
                "time,part,part,ax\n59.990000000,59.990,990,3\n60.000000000,0.000,0,3\n",
            ),
            (
                "min,sec,millis,ax\n59,59,67990,3\n0,0,68000,3\n",
                "time,part,part,ax\n67.990000000,59,67990,3\n68.000000000,0,68000,3\n",
            ),
            (
                "h,m,s,ax\n1,0,2.25,7\n1,0,2.26,7\n",
                "part,time,part,ax\n1,3602.250000000,2.25,7\n1,3602.260000000,2.26,7\n",
            ),
        ] {
            let parts = parts(&Look::at(text.as_bytes())).unwrap();
            assert_eq!(changed_by(parts[0].change.unwrap(), text), expected);
        }
    }

    #[test]
    fn minutes_alone_and_fields_beside_another_time_are_left_alone() {
        for text in [
            "min,max,ax\n1,2,3\n1,2,3\n",
            "time,min,sec,ax\n1,2,3,4\n2,2,4,4\n",
            "min,sec,ax\n70,80,3\n71,80,3\n",
            // A part that is another than that of the seconds, and letters that may be anything.
            "min,sec,ms,ax\n0,1.25,750,3\n0,1.26,760,3\n",
            "m,s,ax\n1,2,3\n1,3,3\n",
            // A count that goes on otherwise than the clock.
            "min,sec,ms,ax\n0,1,5000,3\n0,2,90000,3\n",
            "hour,min,sec,ax\n0.5,30,1800,3\n0.5,30,1801,3\n",
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_none(), "{text}");
        }
    }
}
