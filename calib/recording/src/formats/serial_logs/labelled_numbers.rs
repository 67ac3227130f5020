//! A line of a serial log as the names and the numbers in it: `ax:-9 ay:..`, `Accel: X=-9 Y=.. m/s^2`, `IMU {AccX : -9, ..}`.

use sensor::Sensor;

use super::listed_names::{Listed, between_strokes, in_brackets_of, sensor_and_unit};
use super::log_prefix::{Stamp, by_terminal, logged, without_checksum};
use super::words::{number, with_unit, words};
use crate::header::names::{compact, is_field, role_of, sensor_of, stated_unit};
use crate::recording::options::Role;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// A line as the names and the numbers in it.
#[derive(Debug, PartialEq)]
pub(super) struct Numbers<'a> {
    pub stamp: Option<Stamp>,
    /// Part of the program that wrote it.
    pub tag: Option<&'a str>,
    /// The word that the message begins with; empty for a number.
    pub begins_with: &'a str,
    pub pairs: Vec<(&'a str, &'a str)>,
    /// The sensor that was named last before each number; the `Accel` of `Accel: X=1 Y=2`.
    pub sensors: Vec<Option<Sensor>>,
    /// Units behind the numbers.
    pub accel_unit: Option<AccelUnit>,
    pub gyro_unit: Option<GyroUnit>,
}

impl Numbers<'_> {
    /// Returns the names of the numbers.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.pairs.iter().map(|(name, _)| *name)
    }

    /// The roles of the numbers by their names; of `acc: 1, 2, 3` all three.
    fn roles(&self) -> Vec<Option<Role>> {
        let role = |(name, sensor): (&str, &Option<Sensor>)| {
            // An axis alone is that of the sensor before it.
            let is_axis = matches!(name, "x" | "y" | "z" | "X" | "Y" | "Z");
            role_of(name, sensor.filter(|_| is_axis))
        };
        let mut roles: Vec<Option<Role>> = self.names().zip(&self.sensors).map(role).collect();
        let name = |at: usize| self.pairs.get(at).map(|(name, _)| *name);
        for at in 0..roles.len() {
            let is_triad =
                [1, 2].iter().all(|next| name(at + next) == Some("")) && name(at + 3) != Some("");
            let stem = name(at).map(compact).unwrap_or_default();
            let sensor = match is_field(&stem) {
                true => Some(Sensor::Magnetometer),
                false => sensor_of(&stem),
            };
            if let Some(sensor) = sensor.filter(|_| is_triad) {
                for axis in 0..3 {
                    roles[at + axis] = Some(Role::axis(sensor, axis));
                }
            }
        }
        roles
    }

    /// The unit of a number that is called after a time.
    fn own_time_unit(&self) -> Option<TimeUnit> {
        let is_time = |name: &&str| role_of(name, None) == Some(Role::Time);
        self.names().find(is_time).and_then(stated_unit)
    }

    /// True where the stamp is the time: the clock of a terminal is not, where the device says its own with its unit.
    pub fn goes_by_stamp(&self) -> bool {
        let has_own = self.tag.is_none() && self.own_time_unit().is_some();
        self.stamp.is_some() && !has_own
    }

    /// The unit of the stamp, or that of a number that is called after one.
    pub fn time_unit(&self) -> Option<TimeUnit> {
        match self.goes_by_stamp() {
            true => Some(TimeUnit::Seconds),
            false => self.own_time_unit(),
        }
    }

    fn names_a(&self, sensor: Sensor) -> bool {
        let wanted = [0, 1, 2].map(|axis| Some(Role::axis(sensor, axis)));
        let roles = self.roles();
        wanted.iter().all(|role| roles.contains(role))
    }

    pub fn is_of_one(&self, sensor: Sensor) -> bool {
        let other = match sensor {
            Sensor::Accelerometer => Sensor::Gyroscope,
            _ => Sensor::Accelerometer,
        };
        self.names_a(sensor) && !self.names_a(other)
    }

    /// Columns by their roles, numbered from 1, the stamp before the numbers.
    pub fn columns(&self) -> Vec<(Role, String)> {
        let stamped = usize::from(self.stamp.is_some());
        let mut columns: Vec<(Role, String)> = Vec::new();
        for (at, role) in self.roles().into_iter().enumerate() {
            let role = role.filter(|role| columns.iter().all(|(other, _)| other != role));
            columns.extend(role.map(|role| (role, (at + 1 + stamped).to_string())));
        }
        columns
    }
}

/// The numbers of a line of which at least one has a name or a label; `None` for any other line.
pub(super) fn numbers(line: &str) -> Option<Numbers<'_>> {
    let logged = logged(line);
    let (stamp, rest) = match (logged, by_terminal(line)) {
        (Some(logged), _) => (Some(logged.stamp), logged.message),
        (None, Some((stamp, rest))) => (Some(stamp), rest),
        _ => (None, line),
    };
    let in_brackets = in_brackets(without_checksum(rest)).filter(|_| stamp.is_none());
    let (counted, rest) = match in_brackets {
        Some((number, rest)) => (Some(number), rest),
        None => (None, without_checksum(rest)),
    };
    let mut found = Numbers {
        stamp,
        tag: logged.map(|logged| logged.tag),
        begins_with: "",
        pairs: counted.map(|number| ("time", number)).into_iter().collect(),
        sensors: counted.map(|_| None).into_iter().collect(),
        accel_unit: None,
        gyro_unit: None,
    };
    let rest = rest.trim_start();
    found.read(without_topic(rest.strip_prefix('>').unwrap_or(rest)))?;
    // A stamp in brackets alone names no numbers.
    let names = found.names().skip(usize::from(counted.is_some()));
    let has_name = { names }.any(|name| !name.is_empty());
    let is_bracketed = logged.is_none() && line.trim_start().starts_with('[');
    let is_named = has_name || (stamp.is_some() && !is_bracketed);
    (found.pairs.len() >= 3 && is_named).then_some(found)
}

/// A message without its topic: `imu/data {"ax": ..}`.
fn without_topic(message: &str) -> &str {
    let is_topic = |text: &str| {
        text.trim().starts_with(char::is_alphabetic) && !text.trim().contains([' ', ',', '\t'])
    };
    let record = message.find("{\"").filter(|at| is_topic(&message[..*at]));
    record.map_or(message, |at| &message[at..])
}

/// Digits of a stamp since 1970 in seconds.
const OF_EPOCH: usize = 10;

impl<'a> Numbers<'a> {
    /// Adds what a message says; `None` where a word is neither a name nor a number nor a unit.
    fn read(&mut self, message: &'a str) -> Option<()> {
        let (mut names, mut sensor) = (Listed::default(), None);
        let first = words(message).find(|word| number(word).is_none());
        self.begins_with = first
            .filter(|word| message.trim_start().starts_with(word))
            .unwrap_or_default();
        for word in words(message) {
            if let Some(number) = number(word) {
                self.pairs.push((names.next(), number));
                self.sensors.push(sensor);
            } else if let Some((number, unit)) = with_unit(word) {
                let name = names.next();
                let own = role_of(name, None).and_then(|role| role.sensor());
                self.pairs.push((name, number));
                self.sensors.push(sensor);
                if let Some(own) = own.or(sensor) {
                    self.set_unit(unit, own);
                }
            } else if let Some((name, own, unit)) = sensor_and_unit(message, word) {
                names.push(name);
                sensor = Some(own);
                self.set_unit(unit, own);
            } else if !self.take_unit(message, word, names.last(), sensor) {
                // Dates and torn numbers are no names.
                word.starts_with(char::is_alphabetic).then_some(())?;
                between_strokes(word).for_each(|name| names.push(name));
                // The axes behind `AccX` are the accelerometer's too.
                let of_axis = || role_of(names.last(), None)?.sensor();
                sensor = names.sensor().or_else(of_axis).or(sensor);
            }
        }
        let name = names.last();
        // A unit that ends the line is that of its numbers.
        if !name.is_empty() && message.trim_end().ends_with(name) {
            if self.accel_unit.is_none() && self.is_of_one(Sensor::Accelerometer) {
                self.accel_unit = name.parse().ok();
            } else if self.gyro_unit.is_none() && self.is_of_one(Sensor::Gyroscope) {
                self.gyro_unit = name.parse().ok();
            }
        }
        self.name_the_stamp();
        Some(())
    }

    /// Takes a word that is the unit of the numbers before it, or, in brackets, of those that follow: `Acc (mg) [ 1, 2, 3 ]`.
    fn take_unit(&mut self, message: &str, word: &str, name: &str, sensor: Option<Sensor>) -> bool {
        if !self.pairs.is_empty() && word.contains('/') {
            let (accel, gyro) = (word.parse::<AccelUnit>(), word.parse::<GyroUnit>());
            if let Ok(unit) = accel {
                self.accel_unit = Some(unit);
                return true;
            }
            if let Ok(unit) = gyro {
                self.gyro_unit = Some(unit);
                return true;
            }
        }
        let (is_in_brackets, after) = in_brackets_of(message, word);
        // Behind a number: `X=1 Y=2 Z=3 mg`.
        let is_behind = name.is_empty() && !self.pairs.is_empty() && word.len() > 1;
        match sensor {
            Some(own) if is_behind && !after.starts_with([':', '=']) => self.set_unit(word, own),
            Some(own) if is_in_brackets && !name.is_empty() => {
                self.set_unit(word, own);
                true
            }
            _ => is_in_brackets && !name.is_empty(),
        }
    }

    /// Takes a word that is a unit of a sensor.
    fn set_unit(&mut self, word: &str, sensor: Sensor) -> bool {
        let (accel, gyro) = match sensor {
            Sensor::Accelerometer => (word.parse().ok(), None),
            Sensor::Gyroscope => (None, word.parse().ok()),
            Sensor::Magnetometer => (None, None),
        };
        self.accel_unit = accel.or(self.accel_unit);
        self.gyro_unit = gyro.or(self.gyro_unit);
        accel.is_some() || gyro.is_some()
    }

    /// Calls a count since 1970 behind numbers that all have names the time: `imu ax=1,ay=2,az=3 1700000000000000000`.
    fn name_the_stamp(&mut self) {
        let Some(((name, number), before)) = self.pairs.split_last_mut() else {
            return;
        };
        let is_epoch = number.len() >= OF_EPOCH && number.bytes().all(|b| b.is_ascii_digit());
        if is_epoch && name.is_empty() && before.iter().all(|(name, _)| !name.is_empty()) {
            *name = "time";
        }
    }
}

/// The number in brackets that a line begins with, `[12] ..`, and what follows.
fn in_brackets(line: &str) -> Option<(&str, &str)> {
    let (stamp, rest) = line.trim_start().strip_prefix('[')?.split_once(']')?;
    let is_number = stamp.trim().parse::<f64>().is_ok_and(f64::is_finite);
    is_number.then_some((stamp.trim(), rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_brackets_belong_to_the_name_before_them_and_its_unit() {
        for line in [
            "Scaled. Acc (mg) [ -00018.99, -00032.07,  00982.16 ], Gyr (DPS) [ -1.4,  0.1,  1.5 ], Mag (uT) [ 2.7, -4.4, -3.0 ], Tmp (C) [ 24.0 ]",
            "Acc = (-18.99, -32.07, 982.16) m/s^2  Gyr = (-1.4, 0.1, 1.5) deg/s",
        ] {
            let found = numbers(line).unwrap();
            let roles: Vec<Role> = found.roles().into_iter().flatten().collect();
            let axes = [0, 1, 2]
                .map(Role::Accel)
                .into_iter()
                .chain([0, 1, 2].map(Role::Gyro));
            assert!(
                roles
                    .iter()
                    .copied()
                    .zip(axes)
                    .all(|(own, axis)| own == axis),
                "{line}"
            );
            assert_eq!(found.gyro_unit, Some(GyroUnit::DegreesPerSecond), "{line}");
        }
        let found = numbers("Acc (mg) [ -18.99, -32.07, 982.16 ]").unwrap();
        assert_eq!(found.accel_unit, "mg".parse().ok());
    }

    #[test]
    fn units_and_marks_may_stand_beside_a_number() {
        let line = "[ACCEL] X:+0.01g Y:-0.02g Z:+1.0g | [GYRO] X:+0.4°/s Y:-0.7°/s Z:+0.3°/s | [ANGLE] R:+1.5°";
        let found = numbers(line).unwrap();
        assert_eq!(found.pairs[2], ("Z", "+1.0"));
        assert_eq!(
            (found.accel_unit, found.gyro_unit),
            (Some(AccelUnit::G), Some(GyroUnit::DegreesPerSecond))
        );
        for line in [
            "Acceleration => AX: 0.1 | AY: 0.2 | AZ: 9.8",
            "Accelerometer - x: 0.1 y: 0.2 z: 9.8",
            ">ax:0.1,ay:0.2,az:9.8",
            "AccX=0.1,Y=0.2,Z=9.8",
        ] {
            assert!(
                numbers(line).unwrap().is_of_one(Sensor::Accelerometer),
                "{line}"
            );
        }
        let found = numbers("acc analog: (unit mg) x: 0.1 y: 0.2 z: 998").unwrap();
        assert_eq!(found.accel_unit, Some(AccelUnit::MilliG));
        // What is torn is no number.
        assert_eq!(numbers("ax:0.1gy:0.2 az:3 ax:1"), None);
    }

    #[test]
    fn braces_checksums_and_units_at_the_end_are_no_part_of_the_numbers() {
        let line =
            "2026-05-01 22:13:01.12: IMU {TimeUS : 5000, I : 0, AccX : 1, AccY : 2, AccZ : 3}";
        let found = numbers(line).unwrap();
        assert!(!found.goes_by_stamp());
        assert_eq!(found.time_unit(), Some(TimeUnit::Microseconds));
        let names: Vec<&str> = found.names().collect();
        assert_eq!(names, ["TimeUS", "I", "AccX", "AccY", "AccZ"]);
        let found = numbers("$PIMU,10,1,2,3,4,5,6*5A").unwrap();
        assert_eq!(found.pairs[0], ("PIMU", "10"));
        assert_eq!(found.pairs[6], ("", "6"));
        let found =
            numbers("12.5 Accel: {'x': 0.1, 'y': 0.2, 'z': 1.0} Gyro: {'x': 1, 'y': 2, 'z': 3}");
        let roles = found.unwrap().roles();
        assert_eq!(
            (roles[1], roles[6]),
            (Some(Role::Accel(0)), Some(Role::Gyro(2)))
        );
        for (line, units) in [
            (
                "ax = 14.0 ay = -23.1 az = 1036 mg",
                (Some(AccelUnit::MilliG), None),
            ),
            (
                "G: 0.1, 0.2, 0.3 dps",
                (None, Some(GyroUnit::DegreesPerSecond)),
            ),
            ("G: 0.1, 0.2, 0.3", (None, None)),
        ] {
            let found = numbers(line).unwrap();
            assert_eq!((found.accel_unit, found.gyro_unit), units, "{line}");
        }
    }

    #[test]
    fn lines_of_influxdb_end_with_their_stamp() {
        let line = "imu,device=esp,room=lab ax=0.1,ay=2i,az=9.8 1700000000000000000";
        let found = numbers(line).unwrap();
        let names: Vec<&str> = found.names().collect();
        assert_eq!(names, ["ax", "ay", "az", "time"]);
        assert_eq!(found.pairs[1], ("ay", "2"));
        let found = numbers("gyro,device=esp x=1,y=2,z=3 1700000000000000000").unwrap();
        let columns = found.columns();
        assert_eq!(columns[3], (Role::Time, "4".to_owned()));
        assert!(found.is_of_one(Sensor::Gyroscope));
        // A fourth number of a list is none.
        let found = numbers("acc: 1, 2, 3, 1700000000").unwrap();
        assert_eq!(found.pairs[3], ("", "1700000000"));
    }

    #[test]
    fn bars_and_equals_signs_separate() {
        let found =
            numbers("AcX = -500 | AcY = 280 | AcZ = 16000 | Tmp = 25.35 | GyX = 3").unwrap();
        let names: Vec<&str> = found.names().collect();
        assert_eq!(names, ["AcX", "AcY", "AcZ", "Tmp", "GyX"]);
    }

    #[test]
    fn numbers_are_found_behind_names_labels_and_times() {
        let found = |line| numbers(line).map(|n| (n.stamp, n.pairs));
        let pairs = vec![("ax", "-9"), ("ay", "1.5"), ("az", "3")];
        assert_eq!(found("ax:-9\tay:1.5\taz:3"), Some((None, pairs)));
        let (stamp, pairs) = found("22:13:01.234 -> -9,-65,16346").unwrap();
        assert_eq!((stamp, pairs.len()), (Some(Stamp::OfDay(79_981.234)), 3));
        assert_eq!(found("a/g:\t1\t2\t3").unwrap().1[0], ("a/g", "1"));
        let (stamp, pairs) = found("[2026-05-01 22:13:01.234] ax:-9 ay:1.5 az:3").unwrap();
        assert_eq!(
            (stamp, pairs[0]),
            (Some(Stamp::OfDay(79_981.234)), ("ax", "-9"))
        );
        let (_, pairs) = found("22:13:01.234 -> {\"acc\": [1, 2, 3], \"gyr\": [4, 5, 6]}").unwrap();
        assert_eq!((pairs[0], pairs[3]), (("acc", "1"), ("gyr", "4")));
        assert_eq!(found("1,2,3,4"), None);
        assert_eq!(found("[12.5] 1 2 3"), None);
        assert_eq!(found("[2026-05-01 22:13:01.234] 1 2 3"), None);
        assert_eq!(found("MPU6050 connection successful"), None);
    }
}
