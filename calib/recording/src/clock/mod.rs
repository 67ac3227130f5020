//! Time stamps as they are written: numbers, large epochs, dates, counters that wrap.

pub(crate) mod digits_of_the_day;
pub(crate) mod drift;
pub(crate) mod even;
pub(crate) mod held;
mod nominal;
pub(crate) mod offset;
pub(crate) mod patterns;
pub(crate) mod restarts;
mod robust_line;
pub(crate) mod time;
pub(crate) mod time_of_day;
pub(crate) mod twelve_hours;
pub(crate) mod wraps;

use crate::clock::time_of_day::TimeOfDay;
use crate::recording::options::ReadOptions;
use crate::rows::number::{self, Dialects, Fault, LATEST};

/// Stamps from here on are epochs: the first is subtracted as an integer, because a double holds
/// nanoseconds since 1970 only to 256 ns.
const EPOCH: i64 = 1_000_000_000;

/// Format of the stamps in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stamps {
    /// Not at all: rows are counted.
    Counted,
    /// Numbers.
    Numbers,
    /// Numbers, from which this origin is subtracted.
    Since(i64),
}

/// Reads the stamps of one file, in the file's unit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clock {
    /// Origin subtracted from every stamp; the files of one recording share it.
    pub origin: Option<i64>,
    /// Stamps are dates, counted in nanoseconds.
    pub dates: bool,
    /// Lines at which the counter started again.
    pub wraps: Vec<u64>,
    pattern: Option<String>,
    time_of_day: TimeOfDay,
    /// The date before, where a pattern reads it, ns.
    before: Option<(String, i128)>,
    /// A stamp has been read.
    begun: bool,
}

impl Clock {
    /// A clock that counts from `origin`, or finds its own.
    pub fn new(origin: Option<i64>, options: &ReadOptions) -> Self {
        Self {
            origin,
            pattern: options.time_format.clone(),
            ..Self::default()
        }
    }

    /// The stamp in `cell`, from the origin on.
    pub fn read(&mut self, cell: &[u8], decimal_comma: bool) -> Result<f64, Fault> {
        let stamp = if self.dates || self.pattern.is_some() {
            self.date(cell)?
        } else {
            match self.number(cell, decimal_comma) {
                Err(Fault::Text) if !self.begun => self.date(cell)?,
                other => other?,
            }
        };
        self.begun = true;
        Ok(stamp)
    }

    fn number(&mut self, cell: &[u8], decimal_comma: bool) -> Result<f64, Fault> {
        let parse = |cell| {
            let stamp = number::parse(cell, decimal_comma, &mut Dialects::default())?;
            let possible = stamp.abs() < LATEST.get();
            possible.then_some(stamp).ok_or(Fault::Absurd)
        };
        if let Some(whole) = hexadecimal(cell) {
            return self.number(whole.to_string().as_bytes(), decimal_comma);
        }
        if self.origin == Some(0) {
            return parse(cell);
        }
        let Some((whole, fraction)) = split(cell, decimal_comma) else {
            let stamp = parse(cell)?;
            let origin = *self.origin.get_or_insert(large(stamp as i64));
            return Ok(stamp - origin as f64);
        };
        let origin = *self.origin.get_or_insert(large(whole));
        if origin == 0 {
            return parse(cell);
        }
        Ok(elapsed(origin, whole, fraction))
    }

    /// Returns the format of the following stamps; `None` if it is not settled, or not a plain number.
    pub fn form(&self) -> Option<Stamps> {
        let numbers = self.begun && !self.dates && self.pattern.is_none();
        match self.origin? {
            _ if !numbers => None,
            0 => Some(Stamps::Numbers),
            origin => Some(Stamps::Since(origin)),
        }
    }

    fn date(&mut self, cell: &[u8]) -> Result<f64, Fault> {
        let text = std::str::from_utf8(cell).map_err(|_| Fault::Text)?;
        let nanoseconds = match &self.pattern {
            Some(pattern) => {
                let read = by_pattern(pattern, text, &mut self.time_of_day);
                let read = read.ok_or(Fault::OtherDate)?;
                if is_other_order(pattern, self.before.as_ref(), text, read) {
                    return Err(Fault::OtherOrder);
                }
                self.before = Some((text.to_owned(), read));
                read
            }
            None => iso(text)
                .map(jiff::Timestamp::as_nanosecond)
                .or_else(|| Some(whole(self.time_of_day.read(text)?)))
                .ok_or(Fault::Date)?,
        };
        let nanoseconds = i64::try_from(nanoseconds).map_err(|_| Fault::Date)?;
        self.dates = true;
        let origin = *self.origin.get_or_insert(nanoseconds);
        Ok(nanoseconds.saturating_sub(origin) as f64)
    }
}

/// The number of a count in sixteens, `0x1234abcd`.
fn hexadecimal(cell: &[u8]) -> Option<u64> {
    let digits = cell
        .strip_prefix(b"0x")
        .or_else(|| cell.strip_prefix(b"0X"))?;
    let is_digit = |byte: &u8| byte.is_ascii_hexdigit();
    let digits = std::str::from_utf8(digits).ok()?;
    let is_whole = digits.as_bytes().iter().all(is_digit);
    u64::from_str_radix(digits, 16).ok().filter(|_| is_whole)
}

/// Seconds as nanoseconds.
fn whole(seconds: f64) -> i128 {
    (seconds * 1e9).round() as i128
}

/// A day, ns.
const DAY: i128 = 86_400_000_000_000;

/// True for a date a month or more behind the one before, which is at most a day behind it by the other order of day and month.
fn is_other_order(pattern: &str, before: Option<&(String, i128)>, text: &str, read: i128) -> bool {
    let Some((before, _)) = before.filter(|(_, last)| read - last > 27 * DAY) else {
        return false;
    };
    let pattern = other_order(pattern);
    let other = |text| by_pattern(&pattern, text, &mut TimeOfDay::default());
    let step = other(text).zip(other(before));
    step.is_some_and(|(now, last)| (0..=DAY).contains(&(now - last)))
}

/// A format with the day and the month in each other's place.
pub(crate) fn other_order(pattern: &str) -> String {
    let parts = pattern.split("%d").map(|part| part.replace("%m", "%d"));
    parts.collect::<Vec<_>>().join("%m")
}

/// The instant that `text` is by `pattern`, ns; a pattern without a date counts from midnight, and on over it.
fn by_pattern(pattern: &str, text: &str, clock: &mut TimeOfDay) -> Option<i128> {
    let parsed = jiff::fmt::strtime::parse(pattern, text).ok()?;
    let stamp = parsed
        .to_timestamp()
        .or_else(|_| utc(parsed.to_datetime()?));
    if let Ok(stamp) = stamp {
        return Some(stamp.as_nanosecond());
    }
    let time = parsed.to_time().ok()?;
    let seconds = f64::from(time.hour()) * 3600.0
        + f64::from(time.minute()) * 60.0
        + f64::from(time.second())
        + f64::from(time.subsec_nanosecond()) * 1e-9;
    Some(whole(clock.count_on(seconds)))
}

/// The time from `origin` to the stamp in `cell`, both whole numbers but for decimals behind a mark;
/// `None` for any other spelling.
pub(crate) fn since(origin: i64, cell: &[u8], decimal_comma: bool) -> Option<f64> {
    let (whole, fraction) = split(cell, decimal_comma)?;
    Some(elapsed(origin, whole, fraction))
}

fn elapsed(origin: i64, whole: i64, fraction: f64) -> f64 {
    whole.saturating_sub(origin) as f64 + fraction
}

/// The digits before the decimal mark, and the value of the mark and those behind it, both with the sign.
fn split(cell: &[u8], decimal_comma: bool) -> Option<(i64, f64)> {
    let digits = cell.strip_prefix(b"-").unwrap_or(cell);
    let end = digits
        .iter()
        .position(|b| !b.is_ascii_digit())
        .unwrap_or(digits.len());
    let (whole, rest) = cell.split_at(cell.len() - digits.len() + end);
    let fraction = match rest {
        [] => 0.0,
        [b'.' | b',', decimals @ ..] if decimals.iter().all(u8::is_ascii_digit) => {
            number::parse(rest, decimal_comma, &mut Dialects::default()).ok()?
        }
        _ => return split(&without_exponent(cell)?, decimal_comma),
    };
    let whole = std::str::from_utf8(whole).ok()?.parse().ok()?;
    let sign = if digits.len() < cell.len() { -1.0 } else { 1.0 };
    Some((whole, sign * fraction))
}

/// `1.7000000005e9` as `1700000000.5`: the same digits, the mark moved to the right; `None` for any
/// other spelling.
fn without_exponent(cell: &[u8]) -> Option<Vec<u8>> {
    let at = cell.iter().position(|byte| matches!(byte, b'e' | b'E'))?;
    let exponent = std::str::from_utf8(&cell[at + 1..]).ok()?;
    let exponent: usize = exponent.parse().ok().filter(|places| *places < 19)?;
    let mark = |byte: &u8| matches!(byte, b'.' | b',');
    let (whole, decimals) = match cell[..at].iter().position(mark) {
        Some(mark) => (&cell[..mark], &cell[mark + 1..at]),
        None => (&cell[..at], &[][..]),
    };
    whole.last().filter(|byte| byte.is_ascii_digit())?;
    let (moved, left) = decimals.split_at(exponent.min(decimals.len()));
    let mut plain = [whole, moved].concat();
    plain.resize(whole.len() + exponent, b'0');
    if let Some(mark) = cell.get(whole.len()).filter(|_| !left.is_empty()) {
        plain.push(*mark);
        plain.extend_from_slice(left);
    }
    Some(plain)
}

fn large(stamp: i64) -> i64 {
    if stamp.unsigned_abs() >= EPOCH.unsigned_abs() {
        stamp
    } else {
        0
    }
}

/// Marks between the groups of digits of a date with a time of day.
const MARKS: usize = 6;

fn utc(date: jiff::civil::DateTime) -> Result<jiff::Timestamp, jiff::Error> {
    jiff::tz::TimeZone::UTC.to_timestamp(date)
}

fn iso(text: &str) -> Option<jiff::Timestamp> {
    let zoned = text.parse::<jiff::Timestamp>();
    zoned
        .or_else(|_| utc(text.parse::<jiff::civil::DateTime>()?))
        .ok()
        .or_else(|| unmistakable(text))
}

/// Dates that are not ISO 8601 and can be read in one way only: the year first, or months in letters.
fn unmistakable(text: &str) -> Option<jiff::Timestamp> {
    let of_the_day = twelve_hours::of_the_day(text.trim());
    let text = of_the_day.as_ref();
    let text = text.strip_suffix(" UTC").unwrap_or(text);
    const PATTERNS: [&str; 8] = [
        "%d-%b-%Y %H:%M:%S%.f",
        "%d %b %Y %H:%M:%S%.f",
        "%b %d, %Y %H:%M:%S%.f",
        "%b %d %Y %H:%M:%S%.f",
        "%a %b %d %H:%M:%S%.f %Y",
        "%Y-%m-%dT%H:%M:%S%.f%z",
        "%Y-%m-%d %H:%M:%S%.f %z",
        "%Y-%m-%d %H:%M:%S%.f %:z",
    ];
    let by_pattern = |pattern: &&str| {
        let parsed = jiff::fmt::strtime::parse(pattern, text).ok()?;
        parsed
            .to_timestamp()
            .or_else(|_| utc(parsed.to_datetime()?))
            .ok()
    };
    year_first(text).or_else(|| PATTERNS.iter().find_map(by_pattern))
}

/// A date and a time of day as groups of digits, the year first, with any marks between them: `2026.05.01 12:00:00.5`,
/// `2026-05-01_12-00-00-500`, `20260501_120000.5`.
fn year_first(text: &str) -> Option<jiff::Timestamp> {
    let marks: Vec<char> = text.chars().filter(|c| !c.is_ascii_digit()).collect();
    if marks.len() > MARKS || !marks.iter().all(|mark| "-/._:, T".contains(*mark)) {
        return None;
    }
    let mut groups = text.split(|c: char| !c.is_ascii_digit());
    let date = groups.next()?;
    let [year, month, day] = match date.len() {
        4 => [date, groups.next()?, groups.next()?],
        8 => [&date[..4], &date[4..6], &date[6..]],
        _ => return None,
    };
    let time = groups.next()?;
    let [hour, minute, second] = match time.len() {
        1 | 2 => [time, groups.next()?, groups.next()?],
        6 => [&time[..2], &time[2..4], &time[4..]],
        _ => return None,
    };
    let decimals = groups.next().unwrap_or("0");
    // Behind another mark than a decimal one a number of milliseconds would be no decimals, and `-0200` behind colons is a zone.
    let last = marks.last().copied().unwrap_or('.');
    let between = marks.iter().rev().nth(1).copied();
    let is_part = decimals.len() >= 3 && (last == ':' || Some(last) == between);
    let is_decimal = ".,".contains(last) || is_part;
    if groups.next().is_some() || !is_decimal && decimals != "0" {
        return None;
    }
    let [month, day, hour, minute, second] =
        [month, day, hour, minute, second].map(|two| format!("{two:0>2}"));
    let iso = format!("{year}-{month}-{day}T{hour}:{minute}:{second}.{decimals}");
    utc(iso.parse().ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamps(cells: &[&str]) -> Vec<f64> {
        let mut clock = Clock::default();
        cells
            .iter()
            .map(|c| clock.read(c.as_bytes(), false).unwrap())
            .collect()
    }

    #[test]
    fn nanosecond_epochs_keep_every_nanosecond() {
        let read = stamps(&["1700000000000000001", "1700000000005000003"]);
        assert_eq!(read, [0.0, 5_000_002.0]);
    }

    #[test]
    fn epochs_in_seconds_keep_their_fraction() {
        assert_eq!(
            stamps(&["1700000000.25", "1700000001.123456789"]),
            [0.25, 1.123456789]
        );
    }

    #[test]
    fn epochs_with_an_exponent_are_those_without() {
        let plain = ["1700000000.25", "1700000001.123456789", "1700000002"];
        let exponents = [
            "1.70000000025e9",
            "1.700000001123456789E+09",
            "1700000002e0",
        ];
        assert_eq!(stamps(&exponents), stamps(&plain));
        let read = stamps(&["1.700000000000000001e18", "1.700000000005000003e+18"]);
        assert_eq!(read, [0.0, 5_000_002.0]);
        assert_eq!(stamps(&["1.5e3", "1.6e3"]), [1500.0, 1600.0]);
        assert_eq!(split(b"e9", false).or(split(b"-.e9", false)), None);
    }

    #[test]
    fn small_stamps_are_the_nearest_double() {
        assert_eq!(stamps(&["25.975", "-0.5", "1e-3"]), [25.975, -0.5, 1e-3]);
        assert_eq!(stamps(&["0xFF", "0X100"]), [255.0, 256.0]);
        assert!(hexadecimal(b"0x1p3").is_none() && hexadecimal(b"0x+1").is_none());
    }

    #[test]
    fn iso_dates_count_nanoseconds() {
        let read = stamps(&["2026-11-21T03:04:05.123Z", "2026-11-21T03:04:05.133Z"]);
        assert_eq!(read, [0.0, 1e7]);
    }

    #[test]
    fn dates_that_can_be_read_in_one_way_are_read() {
        let expected = iso("2026-05-01T12:00:00.25Z");
        for text in [
            "2026/05/01 12:00:00.250",
            "2026.5.1 12:00:00,25",
            "2026-05-01_12-00-00-250",
            "2026-05-01 12:00:00:250",
            "2026-05-01 12.00.00.250",
            "20260501_120000.25",
            "01-May-2026 12:00:00.25",
            "May 01, 2026 12:00:00.25",
            "Fri May 01 12:00:00.25 2026",
            "2026-05-01 12:00:00.25 UTC",
            "2026-05-01 14:00:00.25 +0200",
            "2026-05-01 13:00:00.25 +01:00",
        ] {
            assert_eq!(iso(text), expected, "{text}");
        }
        for text in [
            "01.05.2026 12:00:00",
            "05/01/2026 12:00:00",
            "2026-05-01_12-00-00-25",
            "2026.05.01 12:00:00-0200",
            "10102026 120000",
            "2026-13-01 12.00.00",
            "20260501120000",
        ] {
            assert_eq!(iso(text), None, "{text}");
        }
    }

    #[test]
    fn a_day_that_would_be_a_month_is_of_the_other_order() {
        let mut clock = Clock {
            pattern: Some("%m/%d/%Y %H:%M:%S".to_owned()),
            ..Clock::default()
        };
        let mut read = |cell: &str| clock.read(cell.as_bytes(), false);
        assert!(read("01/05/2026 23:59:59").is_ok());
        assert_eq!(read("02/05/2026 00:00:00").err(), Some(Fault::OtherOrder));
        assert!(read("01/06/2026 00:00:00").is_ok());
        let other = other_order("%m/%d/%Y %H:%M:%S");
        assert_eq!(other, "%d/%m/%Y %H:%M:%S");
    }

    #[test]
    fn times_of_day_go_on_after_midnight() {
        assert_eq!(stamps(&["23:59:59.500", "00:00:00.500"]), [0.0, 1e9]);
        let mut clock = Clock {
            pattern: Some("%H:%M:%S%.f".to_owned()),
            ..Clock::default()
        };
        let read =
            ["10:22:00.000", "10:22:00.020"].map(|c| clock.read(c.as_bytes(), false).unwrap());
        assert_eq!(read, [0.0, 2e7]);
    }
}
