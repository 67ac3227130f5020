//! A line with the name of one axis and its number, or of the time.

use sensor::Sensor;

use super::words::axis_of_letter;
use crate::header::names::{compact, is_field, role_of, sensor_of, stated_unit};
use crate::recording::options::Role;
use crate::spelling::number_with_unit;
use crate::units::TimeUnit;

/// The content of such a line.
#[derive(Debug, PartialEq)]
pub(super) struct Said<'a> {
    /// The sensor and the axis; `None` for the time.
    pub axis: Option<(Sensor, usize)>,
    /// All words before the number.
    pub names: Vec<&'a str>,
    /// Its numbers, as they are written.
    pub numbers: Vec<&'a str>,
    /// The unit behind the last of them, empty where there is none.
    pub unit: &'a str,
    /// The unit of the time that one of them has, or the name of the time.
    pub time_unit: Option<TimeUnit>,
}

/// True for a line of an axis that is no known sensor's: it has a number and the letter of an axis, and nothing says what it is of.
pub(super) fn is_of_unknown_axis(line: &str) -> bool {
    let words = words_of(line);
    let is_known = || {
        let all = words.names.concat().to_lowercase();
        OTHERS.iter().any(|part| all.contains(part))
    };
    words.axis().is_none() && words.has_letter() && !words.numbers.is_empty() && !is_known()
}

/// Parts of the names of what has axes and is no sensor.
const OTHERS: [&str; 10] = [
    "quat",
    "euler",
    "angle",
    "orient",
    "gravit",
    "linear",
    "user",
    "pos",
    "accel_xyz",
    "gyro_xyz",
];

/// The words of a line.
fn words_of(line: &str) -> Words<'_> {
    let separates = |c: char| c.is_whitespace() || ",;:=|()[]{}<>\"'§".contains(c);
    let mut words = Words::default();
    line.split(separates)
        .filter(|word| !word.is_empty())
        .for_each(|word| words.take(word));
    words
}

/// Returns what a line says; `None` where it names no axis, or several.
pub(super) fn said(line: &str) -> Option<Said<'_>> {
    let words = words_of(line);
    let axis = words.axis();
    let time = || match words.names[..] {
        [name] if role_of(name, None) == Some(Role::Time) => stated_unit(name).or(words.time_unit),
        _ => None,
    };
    let is_time = matches!(words.names[..], [name] if role_of(name, None) == Some(Role::Time));
    let is_one = words.numbers.len() == 1;
    let names_none = axis.is_none() && !(is_time && is_one);
    if names_none || words.axes() > 1 {
        return None;
    }
    Some(Said {
        axis,
        time_unit: time().or(words.time_unit),
        names: words.names,
        numbers: words.numbers,
        unit: words.unit,
    })
}

/// The words of a line by what they are.
#[derive(Default)]
struct Words<'a> {
    names: Vec<&'a str>,
    numbers: Vec<&'a str>,
    unit: &'a str,
    time_unit: Option<TimeUnit>,
}

impl<'a> Words<'a> {
    fn take(&mut self, word: &'a str) {
        let is_number = word.parse::<f64>().is_ok_and(f64::is_finite);
        if is_number {
            self.numbers.push(word);
            self.unit = "";
        } else if let Some((number, unit)) = stamp(word) {
            self.numbers.push(number);
            self.time_unit = Some(unit);
        } else if let Some((number, unit)) = number_with_unit(word) {
            self.numbers.push(number);
            self.unit = unit;
        } else if self.numbers.is_empty() || self.axis().is_none() || axis_of(word).is_some() {
            // `Velocity-X`
            let is_joined = !word.contains(|c: char| c.is_ascii_digit());
            let parts = word.split(|c| c == '-' && is_joined);
            self.names.extend(parts.filter(|part| !part.is_empty()));
        } else if self.unit.is_empty() {
            self.unit = word;
        }
    }

    /// True if a word is the letter of an axis, or ends with one behind a mark.
    fn has_letter(&self) -> bool {
        let ends = |name: &&str| {
            let last = name.rsplit(|c: char| !c.is_alphanumeric()).next();
            last.is_some_and(|last| axis_of_letter(last).is_some())
        };
        self.names.iter().any(ends)
    }

    /// Number of words that call an axis by themselves.
    fn axes(&self) -> usize {
        self.names
            .iter()
            .filter(|name| axis_of(name).is_some())
            .count()
    }

    /// The axis by one name, or by that of a sensor, in a word or two, and its letter.
    fn axis(&self) -> Option<(Sensor, usize)> {
        if let Some(axis) = self.names.iter().find_map(|name| axis_of(name)) {
            return Some(axis);
        }
        let mut letters = self.names.iter().filter_map(|name| axis_of_letter(name));
        let axis = letters.next().filter(|_| letters.next().is_none())?;
        let one = || self.names.iter().find_map(|name| called(name));
        let two = || {
            self.names
                .windows(2)
                .find_map(|pair| called(&pair.concat()))
        };
        Some((one().or_else(two)?, axis))
    }
}

/// Digits with a unit of time behind them.
fn stamp(word: &str) -> Option<(&str, TimeUnit)> {
    let end = word.find(|c: char| !c.is_ascii_digit())?;
    let (digits, unit) = word.split_at(end);
    let unit = unit.parse().ok().filter(|_| !digits.is_empty())?;
    Some((digits, unit))
}

/// The sensor that a word of more than a letter or two calls.
fn called(name: &str) -> Option<Sensor> {
    let word = compact(name);
    match is_field(&word) {
        true => Some(Sensor::Magnetometer),
        false => sensor_of(&word).filter(|_| word.len() > 2),
    }
}

fn axis_of(name: &str) -> Option<(Sensor, usize)> {
    match role_of(name, None)? {
        Role::Accel(axis) => Some((Sensor::Accelerometer, axis)),
        Role::Gyro(axis) => Some((Sensor::Gyroscope, axis)),
        Role::Field(axis) => Some((Sensor::Magnetometer, axis)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_called_in_one_word_or_several() {
        let (accel, gyro) = (Sensor::Accelerometer, Sensor::Gyroscope);
        for (line, axis, numbers, unit) in [
            (
                ">ax:1234:0.05§m/s²",
                (accel, 0),
                &["1234", "0.05"][..],
                "m/s²",
            ),
            (
                "Angular Velocity [Y]: -5.25 °/s",
                (gyro, 1),
                &["-5.25"],
                "°/s",
            ),
            ("imu/gz 0.1", (gyro, 2), &["0.1"], ""),
            (
                "imu_acceleration{axis=\"z\"} 9.8 1700",
                (accel, 2),
                &["9.8", "1700"],
                "",
            ),
        ] {
            let said = said(line).unwrap();
            assert_eq!(
                (said.axis, &said.numbers[..], said.unit),
                (Some(axis), numbers, unit),
                "{line}"
            );
        }
        let time = said("t_ms=1234").unwrap();
        assert_eq!(
            (time.axis, time.time_unit),
            (None, Some(TimeUnit::Milliseconds))
        );
        for line in [
            "",
            "ax:1 ay:2",
            "Temperature: 25.1",
            "Accelerometer:",
            "x: 1",
        ] {
            assert_eq!(said(line), None, "{line}");
        }
    }
}
