//! Names in a row before the numbers that they are of: `accel x,y,z: 1, 2, 3`, `ax/ay/az/gx/gy/gz 1 2 3 4 5 6`.

use std::collections::VecDeque;

use sensor::Sensor;

use crate::header::names::{compact, role_of, sensor_of};
use crate::units::{AccelUnit, GyroUnit};

findings::tuning! {
    /// Names that are of a number each where as many follow one another.
    FEWEST: usize = 3;
}

/// The names since the last number, and those that the numbers to come have.
#[derive(Default)]
pub(super) struct Listed<'a> {
    said: Vec<&'a str>,
    to_come: VecDeque<&'a str>,
}

impl<'a> Listed<'a> {
    /// Takes a name.
    pub fn push(&mut self, name: &'a str) {
        self.said.push(name);
    }

    /// Returns the name that was said last since the last number; empty where there is none.
    pub fn last(&self) -> &'a str {
        self.said.last().copied().unwrap_or_default()
    }

    /// Returns the sensor that the last name calls, or the last two together: `Angular rate`.
    pub fn sensor(&self) -> Option<Sensor> {
        let last = compact(self.last());
        let two = || {
            let [.., first, second] = self.said[..] else {
                return None;
            };
            sensor_of(&compact(&format!("{first}{second}")))
        };
        sensor_of(&last).or_else(two)
    }

    /// Returns the name of the number that follows: of names in a row the next, else the last one, once.
    pub fn next(&mut self) -> &'a str {
        if !self.said.is_empty() {
            self.to_come = self.in_a_row().unwrap_or_default();
        }
        let last = self.said.pop();
        self.said.clear();
        self.to_come.pop_front().or(last).unwrap_or_default()
    }

    /// The names that are of a number each: the axes at the end, or all.
    fn in_a_row(&self) -> Option<VecDeque<&'a str>> {
        let axes = &self.said[self.said.len().saturating_sub(FEWEST.get())..];
        let are_axes = axes.len() == FEWEST.get()
            && axes
                .iter()
                .zip(["x", "y", "z"])
                .all(|(a, b)| a.eq_ignore_ascii_case(b));
        let has_role = |name: &&str| role_of(name, None).is_some();
        let are_names = self.said.len() >= FEWEST.get() && self.said.iter().all(has_role);
        let found = if are_axes { axes } else { &self.said[..] };
        (are_axes || are_names).then(|| found.iter().copied().collect())
    }
}

/// Returns the names of a word with strokes between them, `ax/ay/az`; any other word as it is.
pub(super) fn between_strokes(word: &str) -> impl Iterator<Item = &str> {
    let has_role = |name: &str| role_of(name, None).is_some();
    let names = word.split('/').filter(|name| has_role(name)).count();
    let mark = (names >= FEWEST.get() && names == word.split('/').count()).then_some('/');
    word.split(move |c| Some(c) == mark)
}

/// Returns whether a word of a message stands in brackets, and what follows it.
pub(super) fn in_brackets_of<'a>(message: &'a str, word: &str) -> (bool, &'a str) {
    let begin = word.as_ptr() as usize - message.as_ptr() as usize;
    let (before, after) = (&message[..begin], &message[begin + word.len()..]);
    // `(unit mg)`
    let before = before.strip_suffix("unit ").unwrap_or(before);
    let is_between = |begin, end| before.ends_with(begin) && after.starts_with(end);
    (is_between('(', ')') || is_between('[', ']'), after)
}

/// Returns the name, the sensor and the unit of `[acc/mg]`.
pub(super) fn sensor_and_unit<'a>(
    message: &str,
    word: &'a str,
) -> Option<(&'a str, Sensor, &'a str)> {
    let (name, unit) = word.split_once('/')?;
    let sensor = sensor_of(&compact(name))?;
    let is_unit = match sensor {
        Sensor::Accelerometer => unit.parse::<AccelUnit>().is_ok(),
        Sensor::Gyroscope => unit.parse::<GyroUnit>().is_ok(),
        Sensor::Magnetometer => false,
    };
    (is_unit && in_brackets_of(message, word).0).then_some((name, sensor, unit))
}

#[cfg(test)]
mod tests {
    use super::super::labelled_numbers::numbers;
    use crate::units::{AccelUnit, GyroUnit};

    #[test]
    fn names_in_a_row_are_of_a_number_each() {
        for (line, names) in [
            ("accel x,y,z: 260, 120, 15572", "x y z"),
            ("gyro x,y,z : -24, -234, -240, ", "x y z"),
            ("ax/ay/az/gx/gy/gz\t1\t2\t3\t4\t5\t6", "ax ay az gx gy gz"),
            ("a/g:\t1\t2\t3", "a/g  "),
        ] {
            let found = numbers(line).unwrap();
            let found: Vec<&str> = found.names().collect();
            assert_eq!(found.join(" "), names, "{line}");
        }
    }

    #[test]
    fn units_stand_in_brackets_and_behind_numbers() {
        for (line, accel, gyro) in [
            ("LSM6DSL [acc/mg]:  5.42, -11.20, 1008.10", true, false),
            ("LSM6DSL [gyro/mdps]: 5.42, -11.20, 8.10", false, true),
            ("Acceleration [mg]:5.42\t-11.20\t1008.10", true, false),
            ("Angular rate [mdps]:5.42\t-11.20\t8.10", false, true),
            (
                "ACC: X=5 Y=-11 Z=1008 mg | GYR: X=5 Y=-11 Z=8 mdps",
                true,
                true,
            ),
        ] {
            let found = numbers(line).unwrap();
            let units = (
                accel.then_some(AccelUnit::MilliG),
                gyro.then(|| "mdps".parse::<GyroUnit>().unwrap()),
            );
            assert_eq!((found.accel_unit, found.gyro_unit), units, "{line}");
        }
    }
}
