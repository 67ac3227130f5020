//! Words of a logger of firmware before a message: `I (12345) imu: ..` of ESP-IDF, `[12345][I][main.cpp:42] loop(): ..` of
//! Arduino, `[00:00:12.345,678] <inf> imu: ..` of Zephyr; and what a terminal writes before a line.

use crate::clock::time_of_day::{TimeOfDay, seconds};
use crate::formats::texts::clock_text::split;

/// A message with what stands before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Logged<'a> {
    /// The stamp.
    pub stamp: Stamp,
    /// Part of the program that says it.
    pub tag: &'a str,
    /// The message.
    pub message: &'a str,
}

/// The stamp of a line, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stamp {
    /// Since the start of the device.
    SinceStart(f64),
    /// Since midnight.
    OfDay(f64),
}

impl Stamp {
    /// The stamp as a cell, counted on over midnight.
    pub fn written(self, clock: &mut TimeOfDay) -> String {
        match self {
            Self::SinceStart(seconds) => format!("{seconds:.6}"),
            Self::OfDay(seconds) => format!("{:.6}", clock.count_on(seconds)),
        }
    }
}

/// The stamp that a terminal writes before a line, and the line: `22:13:01.123 -> ..`, `[2026-05-01 22:13:01.123] ..`.
pub(super) fn by_terminal(line: &str) -> Option<(Stamp, &str)> {
    if let Some((stamp, rest)) = split(line).filter(|_| line.contains("->")) {
        return Some((Stamp::OfDay(seconds(stamp)?), rest));
    }
    if let Some((stamp, rest)) = line
        .trim_start()
        .strip_prefix('[')
        .and_then(|rest| rest.split_once(']'))
    {
        let time = stamp.trim().rsplit([' ', 'T']).next()?;
        return Some((Stamp::OfDay(seconds(time)?), rest.trim_start()));
    }
    behind_date(line)
}

/// The same of a date and a time of day alone: `2026-05-01 22:13:01.123 1,2,3`, `2026-05-01 22:13:01.12: IMU {AccX : 1, ..`. A row
/// of a table whose first cell is a date has no names, and no separator that its other cells lack.
fn behind_date(line: &str) -> Option<(Stamp, &str)> {
    let (date, rest) = line.trim_start().split_at_checked("2026-05-01".len())?;
    let is_of_date = |(at, byte): (usize, u8)| match at {
        4 | 7 => matches!(byte, b'-' | b'/' | b'.'),
        _ => byte.is_ascii_digit(),
    };
    let is_date = date.bytes().enumerate().all(is_of_date);
    let rest = rest.strip_prefix([' ', 'T']).filter(|_| is_date)?;
    let (time, message) = rest.split_once([' ', ','])?;
    let by_comma = rest[time.len()..].starts_with(',');
    // A zone of the earth, as `+0200`.
    let time = time.split(['+', '-']).next()?.trim_end_matches([':', 'Z']);
    let begins = |c: char| c.is_alphanumeric() || matches!(c, '-' | '.' | '{' | '$');
    let is_name = |word: &str| word.len() > 1 && word.starts_with(char::is_alphabetic);
    let has_names = || message.split([' ', ',', ':', '=', '"']).any(is_name);
    let is_message = match by_comma {
        true => has_names(),
        false => message.contains([',', ';', '\t']) || has_names(),
    };
    // Half a day and a zone of the earth belong to the time.
    let first = message.split([' ', ',', ';', '\t']).next()?;
    let of_time = ["AM", "PM", "am", "pm", "UTC", "GMT"].contains(&first);
    let may_be = is_message && message.starts_with(begins) && !of_time;
    let stamp = seconds(time).filter(|_| may_be && time.matches(':').count() == 2)?;
    Some((Stamp::OfDay(stamp), message))
}

/// A sentence of NMEA without its mark and its checksum; any other line as it is.
pub(super) fn without_checksum(line: &str) -> &str {
    match line.trim_start().strip_prefix('$') {
        Some(sentence) => sentence.split('*').next().unwrap_or(sentence),
        None => line,
    }
}

/// The message of a line that has such a beginning.
pub(super) fn logged(line: &str) -> Option<Logged<'_>> {
    let line = without_colours(line);
    esp_idf(line)
        .or_else(|| arduino(line))
        .or_else(|| zephyr(line))
        .or_else(|| dated(line))
        .or_else(|| frame(line))
}

/// A line without what tells a terminal colours and places: `ESC[0;32m`, `ESC[8D`.
fn without_colours(line: &str) -> &str {
    let mut line = line.trim();
    while let Some(rest) = line.strip_prefix("\u{1b}[") {
        let end = rest.find(|c: char| c.is_ascii_alphabetic());
        line = end.map_or(rest, |end| &rest[end + 1..]);
    }
    line.trim_end_matches("\u{1b}[0m").trim()
}

/// Milliseconds since the start, as digits.
fn since_start(text: &str) -> Option<Stamp> {
    let text = text.trim();
    let is_digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let milliseconds: f64 = text.parse().ok().filter(|_| is_digits)?;
    Some(Stamp::SinceStart(1e-3 * milliseconds))
}

/// The level of a message: error, warning, information, debugging or more.
fn is_level(text: &str) -> bool {
    matches!(text, "E" | "W" | "I" | "D" | "V")
}

fn esp_idf(line: &str) -> Option<Logged<'_>> {
    let (level, rest) = line.split_once(" (")?;
    let (stamp, rest) = rest.split_once(") ")?;
    let (tag, message) = rest.split_once(": ")?;
    let of_day = || seconds(stamp).map(Stamp::OfDay);
    let stamp = since_start(stamp).or_else(of_day)?;
    is_level(level).then_some(Logged {
        stamp,
        tag,
        message,
    })
}

fn arduino(line: &str) -> Option<Logged<'_>> {
    let (stamp, rest) = line.strip_prefix('[')?.split_once("][")?;
    let (level, rest) = rest.split_once("][")?;
    let (tag, message) = rest.split_once("] ")?;
    // The function comes before what it says.
    let message = message.split_once("(): ").map_or(message, |(_, said)| said);
    let stamp = since_start(stamp)?;
    is_level(level).then_some(Logged {
        stamp,
        tag,
        message,
    })
}

fn zephyr(line: &str) -> Option<Logged<'_>> {
    let (stamp, rest) = line.strip_prefix('[')?.split_once("] <")?;
    let (_, rest) = rest.split_once("> ")?;
    let (tag, message) = rest.split_once(": ")?;
    // Milliseconds and microseconds have a comma between them.
    let stamp = Stamp::OfDay(seconds(&stamp.replacen(',', "", 1))?);
    Some(Logged {
        stamp,
        tag,
        message,
    })
}

/// What a frame of a bus means, behind it: `(1700000000.010000)  can0  101   [2]  59 00 :: IMU(AccX: 0.1 m/s2, ..)`.
fn frame(line: &str) -> Option<Logged<'_>> {
    let (frame, message) = line.split_once(" :: ")?;
    let (stamp, _) = frame.trim_start().strip_prefix('(')?.split_once(')')?;
    let since = || stamp.parse().ok().map(Stamp::SinceStart);
    let of_day = || seconds(stamp.rsplit([' ', 'T']).next()?).map(Stamp::OfDay);
    Some(Logged {
        stamp: since().or_else(of_day)?,
        tag: "",
        message,
    })
}

/// Words for the level of a message.
const LEVELS: [&str; 5] = ["DEBUG", "INFO", "WARNING", "WARN", "ERROR"];

/// A message behind a date or a time of day and what Android, Python, a journal or Google's loggers write next:
/// `05-01 12:00:00.010  1234  5678 D IMU : ..`, `2026-05-01 12:00:00,010 - INFO - ..`, `May 1 12:00:00 pi imu[812]: ..`,
/// `I0501 12:00:00.010000 1234 imu.cc:12] ..`.
fn dated(line: &str) -> Option<Logged<'_>> {
    let mut rest = line;
    // The time of day is among the first words.
    let stamp = (0..3).find_map(|_| {
        let (word, behind) = rest.trim_start().split_once(' ')?;
        rest = behind;
        let time = word.rsplit('T').next()?.split(['+', 'Z']).next()?;
        seconds(time).filter(|_| time.matches(':').count() == 2)
    });
    let rest = rest.trim_start();
    let said = android(rest)
        .or_else(|| python(rest))
        .or_else(|| journal(rest))
        .or_else(|| glog(rest));
    let (tag, message) = said?;
    Some(Logged {
        stamp: Stamp::OfDay(stamp?),
        tag,
        message: message.trim(),
    })
}

/// `1234  5678 D IMU : ..` and `D/IMU( 1234): ..`.
fn android(rest: &str) -> Option<(&str, &str)> {
    let is_number = |c: char| c.is_ascii_digit() || c == ' ';
    let behind = rest.trim_start_matches(is_number);
    if let Some((level, message)) = behind.split_once(' ')
        && is_level(level)
        && behind.len() < rest.len()
    {
        let (tag, message) = message.split_once(": ")?;
        return Some((tag.trim(), message));
    }
    let (level, rest) = rest.split_once('/')?;
    let (tag, rest) = rest.split_once('(')?;
    let (_, message) = rest.split_once("): ")?;
    is_level(level).then_some((tag.trim(), message))
}

/// `- INFO - ..` and `INFO ..`.
fn python(rest: &str) -> Option<(&str, &str)> {
    let rest = rest.trim_start_matches(['-', ' ', '[']);
    let level = LEVELS.iter().find(|level| rest.starts_with(**level))?;
    let message = rest[level.len()..].trim_start_matches([':', '-', ' ', ']']);
    // A sign is no dash.
    let begin = rest.len() - message.len();
    let is_number = message.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let has_sign = rest[..begin].ends_with('-') && is_number;
    Some((
        "",
        if has_sign {
            &rest[begin - 1..]
        } else {
            message
        },
    ))
}

/// `pi imu[812]: ..`.
fn journal(rest: &str) -> Option<(&str, &str)> {
    let (who, message) = rest.split_once("]: ")?;
    let (who, number) = who.rsplit_once('[')?;
    let is_number = number.bytes().all(|byte| byte.is_ascii_digit());
    let (_, tag) = who.rsplit_once(' ')?;
    is_number.then_some((tag, message))
}

/// `1234 imu.cc:12] ..`.
fn glog(rest: &str) -> Option<(&str, &str)> {
    let (place, message) = rest.split_once("] ")?;
    let (_, place) = place.split_once(' ')?;
    let (file, line) = place.rsplit_once(':')?;
    let is_number = !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then_some((file, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_date_before_a_message_is_its_stamp_and_that_of_a_row_is_not() {
        let stamp = Stamp::OfDay(79_981.123);
        for (line, message) in [
            ("2026-05-01 22:13:01.123 1,2,3", "1,2,3"),
            ("2026/05/01 22:13:01.123 -1\t2\t3", "-1\t2\t3"),
            ("2026-05-01T22:13:01.123Z {\"ax\": 1}", "{\"ax\": 1}"),
            ("2026-05-01 22:13:01.123: IMU {AccX : 1}", "IMU {AccX : 1}"),
            ("2026-05-01T22:13:01.123,FE,xacc,1", "FE,xacc,1"),
            (
                "2026-05-01T22:13:01.123+0200 a/b {\"ax\": 1}",
                "a/b {\"ax\": 1}",
            ),
        ] {
            assert_eq!(by_terminal(line), Some((stamp, message)), "{line}");
        }
        for row in [
            "2026-05-01 22:13:01.123,1,2,3",
            "2026-05-01 22:13:01.123 1 2 3",
            "2026-05-01 22:13:01.123 PM,1,2,3",
            "2026-05-01 22:13:01.123 +0100,1,2,3",
            "2026-05-01 22:13 1,2,3",
            "2026-05-01ä22:13:01.123 1,2,3",
        ] {
            assert_eq!(by_terminal(row), None, "{row}");
        }
        assert_eq!(without_checksum("$PIMU,1,2*5A"), "PIMU,1,2");
    }

    #[test]
    fn loggers_are_known_by_what_they_write_before_a_message() {
        let of = |line| logged(line).map(|logged| (logged.stamp, logged.tag, logged.message));
        let since = Stamp::SinceStart;
        let (imu, said) = ("imu", "ax:1 ay:2");
        assert_eq!(
            of("I (12345) imu: ax:1 ay:2"),
            Some((since(12.345), imu, said))
        );
        assert_eq!(
            of("\u{1b}[0;32mI (12) imu: ax:1 ay:2\u{1b}[0m"),
            Some((since(0.012), imu, said))
        );
        assert_eq!(
            of("I (00:01:00.500) imu: ax:1 ay:2"),
            Some((Stamp::OfDay(60.5), imu, said))
        );
        assert_eq!(
            of("[  1234][I][main.cpp:42] loop(): ax:1 ay:2"),
            Some((since(1.234), "main.cpp:42", said))
        );
        assert_eq!(
            of("[00:00:12.345,678] <inf> imu: ax:1 ay:2"),
            Some((Stamp::OfDay(12.345678), imu, said))
        );
        assert_eq!(
            of("\u{1b}[8D\u{1b}[J[00:00:12.345,678] <inf> imu: ax:1 ay:2\u{1b}[0m"),
            Some((Stamp::OfDay(12.345678), imu, said))
        );
        assert_eq!(
            of("(170.5)  can0  101   [2]  59 00 :: ax:1 ay:2"),
            Some((since(170.5), "", said))
        );
        let noon = Stamp::OfDay(43_200.01);
        for (line, tag) in [
            (
                "05-01 12:00:00.010  1234  5678 D imu     : ax:1 ay:2",
                "imu",
            ),
            ("05-01 12:00:00.010 D/imu( 1234): ax:1 ay:2", "imu"),
            ("2026-05-01T12:00:00.010+0200 pi imu[812]: ax:1 ay:2", "imu"),
            ("May  1 12:00:00.010 pi imu[812]: ax:1 ay:2", "imu"),
            ("2026-05-01 12:00:00,010 - INFO - ax:1 ay:2", ""),
            ("2026-05-01 12:00:00,010 INFO ax:1 ay:2", ""),
            ("I0501 12:00:00.010000 1234 imu.cc:12] ax:1 ay:2", "imu.cc"),
        ] {
            assert_eq!(of(line), Some((noon, tag, said)), "{line}");
        }
        for line in [
            "12:00:00.010 1 2 3",
            "2026-05-01 12:00:00.010 1 2 3",
            "I (x) imu: 1",
            "A (12) b: 1",
            "[12.5] 1 2 3",
            "ax:1 ay:2",
            "[1][2] 3",
        ] {
            assert_eq!(of(line), None, "{line}");
        }
    }
}
