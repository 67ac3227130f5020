//! Output of microcontroller programs: `ax:-9\tay:..`, `a/g:\t-9\t..`, `22:13:01.123 -> -9,..`, `I (12345) imu: ax:-9 ..`,
//! `[2026-05-01 22:13:01.123] ax:-9 ..`.

use std::io::Read;

use sensor::Sensor;

use super::log_prefix::{Stamp, by_terminal, logged};
use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{compact, is_field, role_of, sensor_of, stated_unit};
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Numbers behind names or a label.
pub(crate) static SERIAL: TextFormat = TextFormat {
    name: "serial",
    about: "a serial log: `ax:-9 ay:..`, `[0] Accel: X=-9 Y=.. m/s^2`, `a/g: -9 ..`, `22:13:01.123 -> -9,..`, `I (12345) imu: ax:-9 ..`; without stamps the rate has to be given",
    parts: labelled,
};

/// Lines looked at from the first row on.
const LINES: usize = 60;

/// A line as the names and the numbers in it.
#[derive(Debug, PartialEq)]
struct Numbers<'a> {
    stamp: Option<Stamp>,
    /// Part of the program that wrote it.
    tag: Option<&'a str>,
    pairs: Vec<(&'a str, &'a str)>,
    /// The sensor that was named last before each number; the `Accel` of `Accel: X=1 Y=2`.
    sensors: Vec<Option<Sensor>>,
    /// Units behind the numbers.
    accel_unit: Option<AccelUnit>,
    gyro_unit: Option<GyroUnit>,
}

impl Numbers<'_> {
    /// Returns the names of the numbers.
    fn names(&self) -> impl Iterator<Item = &str> {
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

    /// The unit of the stamp, or that of a number that is called after one.
    fn time_unit(&self) -> Option<TimeUnit> {
        let is_time = |name: &&str| role_of(name, None) == Some(Role::Time);
        match self.stamp {
            Some(_) => Some(TimeUnit::Seconds),
            None => self.names().find(is_time).and_then(stated_unit),
        }
    }

    fn names_a(&self, sensor: Sensor) -> bool {
        let wanted = [0, 1, 2].map(|axis| Some(Role::axis(sensor, axis)));
        let roles = self.roles();
        wanted.iter().all(|role| roles.contains(role))
    }

    fn is_of_one(&self, sensor: Sensor) -> bool {
        let other = match sensor {
            Sensor::Accelerometer => Sensor::Gyroscope,
            _ => Sensor::Accelerometer,
        };
        self.names_a(sensor) && !self.names_a(other)
    }

    /// Columns by their roles, numbered from 1, the stamp before the numbers.
    fn columns(&self) -> Vec<(Role, String)> {
        let stamped = usize::from(self.stamp.is_some());
        let mut columns: Vec<(Role, String)> = Vec::new();
        for (at, role) in self.roles().into_iter().enumerate() {
            let role = role.filter(|role| columns.iter().all(|(other, _)| other != role));
            columns.extend(role.map(|role| (role, (at + 1 + stamped).to_string())));
        }
        columns
    }
}

/// True for what may be the first row: the table of partitions that a device starts with is none.
fn begins(row: &Numbers<'_>) -> bool {
    !row.tag.is_some_and(|tag| tag.starts_with("boot"))
}

/// The numbers of a line of which at least one has a name or a label; `None` for any other line.
fn numbers(line: &str) -> Option<Numbers<'_>> {
    let logged = logged(line);
    let (stamp, rest) = match (logged, by_terminal(line)) {
        (Some(logged), _) => (Some(logged.stamp), logged.message),
        (None, Some((stamp, rest))) => (Some(stamp), rest),
        _ => (None, line),
    };
    let mut pairs = Vec::new();
    let mut sensors = Vec::new();
    let in_brackets = in_brackets(rest).filter(|_| stamp.is_none());
    let is_in_brackets = in_brackets.is_some();
    let rest = in_brackets.map_or(rest, |(number, rest)| {
        pairs.push(("time", number));
        sensors.push(None);
        rest
    });
    // The topic of a message may stand before it: `imu/data {"ax": ..}`.
    let is_topic = |text: &str| {
        text.trim().starts_with(char::is_alphabetic) && !text.trim().contains([' ', ',', '\t'])
    };
    let record = rest.find("{\"").filter(|at| is_topic(&rest[..*at]));
    let rest = record.map_or(rest, |at| &rest[at..]);
    let is_json = rest.trim_start().starts_with('{');
    let separates = |c: char| {
        matches!(
            c,
            ',' | ';' | ' ' | '\t' | ':' | '=' | '|' | '(' | ')' | '[' | ']'
        ) || (is_json && matches!(c, '{' | '}' | '"'))
    };
    // The unit of the numbers that follow, as in `Acc (mg) [ 1, 2, 3 ]`.
    let stands_in_parentheses = |word: &str| {
        let begin = word.as_ptr() as usize - rest.as_ptr() as usize;
        rest[..begin].ends_with('(') && rest[begin + word.len()..].starts_with(')')
    };
    let (mut name, mut sensor) = ("", None);
    let (mut accel_unit, mut gyro_unit) = (None, None);
    for word in rest.split(separates).filter(|word| !word.is_empty()) {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => {
                pairs.push((std::mem::take(&mut name), word));
                sensors.push(sensor);
            }
            _ if !pairs.is_empty() && word.contains('/') && word.parse::<AccelUnit>().is_ok() => {
                accel_unit = word.parse().ok();
            }
            _ if !pairs.is_empty() && word.contains('/') && word.parse::<GyroUnit>().is_ok() => {
                gyro_unit = word.parse().ok();
            }
            _ if stands_in_parentheses(word) && !name.is_empty() => match sensor {
                Some(Sensor::Accelerometer) => accel_unit = word.parse().ok().or(accel_unit),
                Some(Sensor::Gyroscope) => gyro_unit = word.parse().ok().or(gyro_unit),
                _ => {}
            },
            // Dates and torn numbers are no names.
            _ if word.starts_with(char::is_alphabetic) => {
                name = word;
                sensor = sensor_of(&compact(word)).or(sensor);
            }
            _ => return None,
        }
    }
    // A stamp in brackets alone names no numbers.
    let mut named = pairs.iter().skip(usize::from(is_in_brackets));
    let is_bracketed = logged.is_none() && line.trim_start().starts_with('[');
    let is_stamped = stamp.is_some() && !is_bracketed;
    let is_named = is_stamped || named.any(|(name, _)| !name.is_empty());
    let tag = logged.map(|logged| logged.tag);
    (pairs.len() >= 3 && is_named).then_some(Numbers {
        stamp,
        tag,
        pairs,
        sensors,
        accel_unit,
        gyro_unit,
    })
}

/// The number in brackets that a line begins with, `[12] ..`, and what follows.
fn in_brackets(line: &str) -> Option<(&str, &str)> {
    let (stamp, rest) = line.trim_start().strip_prefix('[')?.split_once(']')?;
    let is_number = stamp.trim().parse::<f64>().is_ok_and(f64::is_finite);
    is_number.then_some((stamp.trim(), rest))
}

/// True for a table with names above its rows, one of whose cells is a word.
fn has_header(look: &Look) -> bool {
    let names = look.first();
    let is_word = |name: &String| name.starts_with(char::is_alphabetic);
    let as_wide = |line: &&str| cells(line).len() == names.len() && numbers(line).is_some();
    names.len() > 3
        && names.iter().all(is_word)
        && 2 * look.lines().filter(as_wide).count() > look.lines().count()
}

fn labelled(look: &Look) -> Option<Vec<Part>> {
    if has_header(look) && numbers(&look.first().join(",")).is_none() {
        return None;
    }
    // What a device says when it starts may be long.
    let is_before = |line: &&str| !numbers(line).is_some_and(|row| begins(&row));
    let lines: Vec<&str> = look.far_lines().skip_while(is_before).take(LINES).collect();
    let first = numbers(lines.first()?)?;
    let is_of_another = |line: &&&str| logged(line).is_some_and(|l| Some(l.tag) != first.tag);
    let others = lines.iter().filter(is_of_another).count();
    let rows: Vec<Numbers> = lines.iter().filter_map(|line| numbers(line)).collect();
    let count = |is: &dyn Fn(&&Numbers<'_>) -> bool| rows.iter().filter(is).count();
    // Three in four lines, but for what the program says at its start.
    let enough = |count: usize| 4 * count >= 3 * (lines.len() - others).saturating_sub(5);
    let is_like = |row: &&Numbers<'_>| {
        row.tag == first.tag && row.names().eq(first.names()) && row.sensors == first.sensors
    };
    let alike = count(&is_like);
    if !enough(alike) || alike < 2 {
        // Rows that are called by turns differently are of several sensors.
        let of = |sensor: Sensor| rows.iter().filter(move |row| row.is_of_one(sensor));
        let (force, rate) = (of(Sensor::Accelerometer), of(Sensor::Gyroscope));
        let [accel, gyro] = [force.clone().count(), rate.clone().count()];
        if accel.min(gyro) < 2 || 4 * (accel + gyro) < 3 * lines.len().saturating_sub(5) {
            return None;
        }
        return Some(vec![
            of_one(force.clone().next()?, Sensor::Accelerometer, |text| {
                rows_of_numbers(text, |row| row.is_of_one(Sensor::Accelerometer))
            }),
            of_one(rate.clone().next()?, Sensor::Gyroscope, |text| {
                rows_of_numbers(text, |row| row.is_of_one(Sensor::Gyroscope))
            }),
        ]);
    }
    let mut columns = first.columns();
    let holds = |sensor: fn(usize) -> Role| columns.iter().any(|(role, _)| *role == sensor(0));
    let both = holds(Role::Accel) && holds(Role::Gyro);
    let one = holds(Role::Accel) || holds(Role::Gyro);
    let unknown = first.pairs.len() - columns.len();
    if !one || (!both && unknown >= 3) {
        // One label before all of them, or names that are not understood: which is which is told by the data.
        columns.clear();
    } else if first.stamp.is_some() {
        columns.retain(|(role, _)| *role != Role::Time);
        columns.push((Role::Time, "1".to_owned()));
    }
    Some(vec![Part {
        columns,
        time_unit: first.time_unit(),
        accel_unit: first.accel_unit,
        gyro_unit: first.gyro_unit,
        change: Some(|text| rows_of_numbers(text, begins)),
        ..Part::default()
    }])
}

/// The rows of one sensor among those of several, as its `row` is.
fn of_one(row: &Numbers<'_>, sensor: Sensor, change: Change) -> Part {
    let mut columns = row.columns();
    if row.stamp.is_some() {
        columns.retain(|(role, _)| *role != Role::Time);
        columns.push((Role::Time, "1".to_owned()));
    }
    Part {
        only: Some(sensor),
        columns,
        time_unit: row.time_unit(),
        accel_unit: row.accel_unit,
        gyro_unit: row.gyro_unit,
        change: Some(change),
        ..Part::default()
    }
}

/// The numbers of the rows that `takes` holds for and of those called like the first of them.
fn rows_of_numbers(
    text: Box<dyn Read + Send>,
    takes: fn(&Numbers<'_>) -> bool,
) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    // Who wrote the first row, and what its numbers are called.
    let mut first: Option<(Option<String>, Vec<String>)> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let found = numbers(text);
        let Some((tag, names)) = &first else {
            // What a program says before its rows is no row.
            if let Some(found) = found.filter(takes) {
                let names = found.names().map(str::to_owned).collect();
                first = Some((found.tag.map(str::to_owned), names));
                row(&found, &mut clock, out);
            }
            return;
        };
        let is_said = logged(text).is_some_and(|logged| {
            let name = names.iter().find(|name| !name.is_empty());
            Some(logged.tag) != tag.as_deref()
                || (found.is_none() && name.is_some_and(|name| !logged.message.contains(name)))
        });
        match found {
            // A message among the rows.
            _ if is_said => {}
            // A broken row is for the reader to refuse.
            None => out.extend_from_slice(line),
            Some(found) if !takes(&found) => {}
            Some(found) => {
                let as_many = found.pairs.len() == names.len();
                let alike = found.names().eq(names.iter().map(String::as_str));
                match alike || !as_many {
                    true => row(&found, &mut clock, out),
                    // Of another sensor, and no row of this table.
                    false => out.extend_from_slice(line),
                }
            }
        }
    })
}

/// Writes the stamp of a row, if it has one, and its numbers.
fn row(found: &Numbers<'_>, clock: &mut TimeOfDay, out: &mut Vec<u8>) {
    let stamp = found.stamp.map(|stamp| stamp.written(clock));
    let values = found.pairs.iter().map(|(_, value)| *value);
    let cells: Vec<&str> = stamp.as_deref().into_iter().chain(values).collect();
    out.extend_from_slice(cells.join(",").as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn a_table_with_a_word_in_its_rows_is_no_serial_log() {
        let table = "device,t,ax,ay,az\ndev1,0.00,1,2,3\ndev1,0.01,1,2,3\ndev1,0.02,1,2,3\n";
        assert!(labelled(&Look::at(table.as_bytes())).is_none());
        let log = "ax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\n";
        assert!(labelled(&Look::at(log.as_bytes())).is_some());
    }

    #[test]
    fn axes_behind_the_name_of_their_sensor_are_its_own() {
        let line = "[10] Accel: X=-0.070 Y=0.124 Z=9.883 m/s^2  Gyro: X=0.0111 Y=-0.0001 Z=0.0060 rad/s  Temp: 25.3 C";
        let log = [line; 4].join("\n") + "\n";
        let parts = labelled(&Look::at(log.as_bytes())).unwrap();
        let roles: Vec<Role> = parts[0].columns.iter().map(|(role, _)| *role).collect();
        let axes = |role: fn(usize) -> Role| [0, 1, 2].map(role);
        let expected = [
            &[Role::Time][..],
            &axes(Role::Accel),
            &axes(Role::Gyro),
            &[Role::Temperature],
        ];
        assert_eq!(roles, expected.concat());
        assert_eq!(parts[0].accel_unit, Some(AccelUnit::MetresPerSecondSquared));
        assert_eq!(parts[0].gyro_unit, Some(GyroUnit::RadiansPerSecond));
        assert_eq!(parts[0].time_unit, None);
        let rows = changed_by(|text| rows_of_numbers(text, begins), &log);
        let first = "10,-0.070,0.124,9.883,0.0111,-0.0001,0.0060,25.3";
        assert_eq!(rows.lines().next(), Some(first));
    }

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
