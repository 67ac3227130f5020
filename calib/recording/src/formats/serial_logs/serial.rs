//! Output of microcontroller programs: `ax:-9\tay:..`, `a/g:\t-9\t..`, `22:13:01.123 -> -9,..`, `I (12345) imu: ax:-9 ..`,
//! `[2026-05-01 22:13:01.123] ax:-9 ..`.

use std::io::Read;

use sensor::Sensor;

use super::labelled_numbers::{Numbers, numbers};
use super::log_prefix::logged;
use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::TextFormat;
use crate::header::look::{Look, cells};
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;

/// Numbers behind names or a label.
pub(crate) static SERIAL: TextFormat = TextFormat {
    name: "serial",
    about: "a serial log: `ax:-9 ay:..`, `[0] Accel: X=-9 Y=.. m/s^2`, `a/g: -9 ..`, `22:13:01.123 -> -9,..`, `I (12345) imu: ax:-9 ..`; without stamps the rate has to be given",
    parts: labelled,
};

findings::tuning! {
    /// Lines looked at from the first row on.
    LINES: usize = 60;
}

/// True for what may be the first row: the table of partitions that a device starts with is none.
fn begins(row: &Numbers<'_>) -> bool {
    !row.tag.is_some_and(|tag| tag.starts_with("boot"))
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
    let lines: Vec<&str> = look
        .far_lines()
        .skip_while(is_before)
        .take(LINES.get())
        .collect();
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
        // Where as many are of the one as of the other, lines of other sensors and rules between the blocks may be more.
        let are_blocks = accel.abs_diff(gyro) <= 1 && 8 * (accel + gyro) >= lines.len();
        let are_most = 4 * (accel + gyro) >= 3 * lines.len().saturating_sub(5);
        // Two chips, each of which says its name first.
        let begin = |sensor| of(sensor).map(|row| row.begins_with);
        let are_of_one = |sensor| begin(sensor).all(|word| begin(sensor).next() == Some(word));
        let of_others = !are_of_one(Sensor::Accelerometer) || !are_of_one(Sensor::Gyroscope);
        if accel.min(gyro) < 2 || of_others || !(are_blocks || are_most) {
            return None;
        }
        return Some(vec![
            of_one(force.clone().next()?, Sensor::Accelerometer, |text| {
                rows_by_turns(text, |row| row.is_of_one(Sensor::Accelerometer))
            }),
            of_one(rate.clone().next()?, Sensor::Gyroscope, |text| {
                rows_by_turns(text, |row| row.is_of_one(Sensor::Gyroscope))
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
    } else if first.goes_by_stamp() {
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
    if row.goes_by_stamp() {
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
    rows_but(text, takes, |_, _| false)
}

/// The same where lines that have none of the names stand between the rows.
fn rows_by_turns(
    text: Box<dyn Read + Send>,
    takes: fn(&Numbers<'_>) -> bool,
) -> Box<dyn Read + Send> {
    rows_but(text, takes, |line, names| {
        let mut named = names.iter().filter(|name| name.len() > 1);
        !named.any(|name| line.contains(name.as_str()))
    })
}

fn rows_but(
    text: Box<dyn Read + Send>,
    takes: fn(&Numbers<'_>) -> bool,
    passes: fn(&str, &[String]) -> bool,
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
            None if passes(text, names) => {}
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
    use crate::units::{AccelUnit, GyroUnit};

    #[test]
    fn a_table_with_a_word_in_its_rows_is_no_serial_log() {
        let table = "device,t,ax,ay,az\ndev1,0.00,1,2,3\ndev1,0.01,1,2,3\ndev1,0.02,1,2,3\n";
        assert!(labelled(&Look::at(table.as_bytes())).is_none());
        let log = "ax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\n";
        assert!(labelled(&Look::at(log.as_bytes())).is_some());
    }

    #[test]
    fn blocks_with_rules_and_other_sensors_between_are_rows_of_both() {
        let block = "temp : 25.1\naccX : 0.1\taccY : 0.2\taccZ : 1.0\ngyroX : 1\tgyroY : 2\tgyroZ : 3\n=====\n";
        let log = block.repeat(20);
        let parts = labelled(&Look::at(log.as_bytes())).unwrap();
        let [accel, gyro] = &parts[..] else {
            panic!("{parts:?}")
        };
        let rows = |part: &Part| -> Vec<String> {
            let text = changed_by(part.change.unwrap(), &log);
            let rows = text.lines().filter(|line| !line.is_empty());
            rows.map(str::to_owned).collect()
        };
        assert_eq!(rows(accel), ["0.1,0.2,1.0"; 20]);
        assert_eq!(rows(gyro), ["1,2,3"; 20]);
    }

    #[test]
    fn lines_of_two_chips_are_no_sensor() {
        let block = |other: &str| {
            format!(
                "{other} [acc/mg]: 1, 2, 1003\nLSM6 [gyro/mdps]: 1, 2, 3\nLSM6 [acc/mg]: 1, 2, 1000\n"
            )
        };
        let is_read = |block: String| labelled(&Look::at(block.repeat(20).as_bytes())).is_some();
        assert!(is_read(block("LSM6")));
        assert!(!is_read(block("LSM3")));
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
}
