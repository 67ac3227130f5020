//! Output of microcontroller programs: `ax:-9\tay:..`, `a/g:\t-9\t..`, `22:13:01.123 -> -9,..`, blocks of words.

use std::io::Read;

use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::TextFormat;
use crate::formats::texts::clock_text::split;
use crate::header::look::{Look, cells};
use crate::header::names::role_of;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Numbers behind names or a label.
pub(crate) static SERIAL: TextFormat = TextFormat {
    name: "serial",
    about: "a serial log: `ax:-9 ay:..`, `a/g: -9 ..`, `22:13:01.123 -> -9,..`; without stamps the rate has to be given",
    parts: labelled,
};

/// Adafruit's example programs.
pub(crate) static ADAFRUIT: TextFormat = TextFormat {
    name: "adafruit",
    about: "what Adafruit's examples print: `Acceleration X: .., Y: .., Z: .. m/s^2`, `Rotation X: ..`; the rate has to be given",
    parts: blocks,
};

/// A line as the names and the numbers in it.
#[derive(Debug, PartialEq)]
struct Numbers<'a> {
    stamp: Option<&'a str>,
    pairs: Vec<(&'a str, &'a str)>,
}

impl Numbers<'_> {
    /// Returns the names of the numbers.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.pairs.iter().map(|(name, _)| *name)
    }
}

/// The numbers of a line of which at least one has a name or a label; `None` for any other line.
fn numbers(line: &str) -> Option<Numbers<'_>> {
    let (stamp, rest) = match split(line) {
        Some((stamp, rest)) if line.contains("->") => (Some(stamp), rest),
        _ => (None, line),
    };
    let separates = |c: char| matches!(c, ',' | ';' | ' ' | '\t' | ':' | '=' | '|');
    let mut pairs = Vec::new();
    let mut name = "";
    for word in rest.split(separates).filter(|word| !word.is_empty()) {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => pairs.push((std::mem::take(&mut name), word)),
            // Dates and torn numbers are no names.
            _ if word.starts_with(char::is_alphabetic) => name = word,
            _ => return None,
        }
    }
    let is_named = stamp.is_some() || pairs.iter().any(|(name, _)| !name.is_empty());
    (pairs.len() >= 3 && is_named).then_some(Numbers { stamp, pairs })
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
    let rows: Vec<Numbers> = look.lines().filter_map(numbers).collect();
    let first = rows.first()?;
    if has_header(look) && numbers(&look.first().join(",")).is_none() {
        return None;
    }
    // Rows that are called by turns differently are of several sensors.
    let alike = rows
        .iter()
        .filter(|row| row.names().eq(first.names()))
        .count();
    // Three in four lines, but for what the program says at its start.
    if 4 * alike < 3 * look.lines().count().saturating_sub(5) || alike < 2 {
        return None;
    }
    let stamped = usize::from(first.stamp.is_some());
    let named = first.pairs.iter().enumerate();
    let mut columns: Vec<(Role, String)> = Vec::new();
    for (at, (name, _)) in named {
        let role =
            role_of(name, None).filter(|role| columns.iter().all(|(other, _)| other != role));
        columns.extend(role.map(|role| (role, (at + 1 + stamped).to_string())));
    }
    let holds = |sensor: fn(usize) -> Role| columns.iter().any(|(role, _)| *role == sensor(0));
    let both = holds(Role::Accel) && holds(Role::Gyro);
    let one = holds(Role::Accel) || holds(Role::Gyro);
    let unknown = first.pairs.len() - columns.len();
    if !one || (!both && unknown >= 3) {
        // One label before all of them, or names that are not understood: which is which is told by the data.
        columns.clear();
    } else if stamped == 1 {
        columns.retain(|(role, _)| *role != Role::Time);
        columns.push((Role::Time, "1".to_owned()));
    }
    Some(vec![Part {
        columns,
        time_unit: (stamped == 1).then_some(TimeUnit::Seconds),
        change: Some(rows_of_numbers),
        ..Part::default()
    }])
}

fn rows_of_numbers(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    // What the numbers of the first row are called.
    let mut names: Vec<String> = Vec::new();
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some(found) = numbers(text) else {
            // What a program says before its rows is no row; a broken row later is for the reader to refuse.
            if !names.is_empty() {
                out.extend_from_slice(line);
            }
            return;
        };
        if names.is_empty() {
            names = found.names().map(str::to_owned).collect();
        }
        // Of another sensor, and no row of this table.
        if found.pairs.len() == names.len() && !found.names().eq(names.iter().map(String::as_str)) {
            out.extend_from_slice(line);
            return;
        }
        let stamp = found
            .stamp
            .and_then(|stamp| clock.read(stamp))
            .map(|stamp| format!("{stamp:.6}"));
        let cells: Vec<&str> = stamp
            .as_deref()
            .into_iter()
            .chain(found.pairs.iter().map(|(_, value)| *value))
            .collect();
        out.extend_from_slice(cells.join(",").as_bytes());
    })
}

/// The three numbers of `Acceleration X: 1, Y: 2, Z: 3 m/s^2`, called one of `quantity`.
fn triad<'a>(line: &'a str, quantity: [&str; 2]) -> Option<[&'a str; 3]> {
    let line = line.trim();
    let mut numbers = quantity
        .iter()
        .find_map(|quantity| line.strip_prefix(quantity))?
        .split([' ', ',', ':'])
        .filter(|word| word.parse::<f64>().is_ok_and(f64::is_finite));
    Some([numbers.next()?, numbers.next()?, numbers.next()?])
}

const ACCELERATION: [&str; 2] = ["Acceleration X:", "Accel X:"];
const ROTATION: [&str; 2] = ["Rotation X:", "Gyro X:"];

fn blocks(look: &Look) -> Option<Vec<Part>> {
    let has = |quantity| look.lines().any(|line| triad(line, quantity).is_some());
    (has(ACCELERATION) && has(ROTATION)).then(|| {
        let axes = |axis: usize| {
            [
                (Role::Accel(axis), (axis + 1).to_string()),
                (Role::Gyro(axis), (axis + 4).to_string()),
            ]
        };
        vec![Part {
            columns: (0..3).flat_map(axes).collect(),
            accel_unit: Some(AccelUnit::MetresPerSecondSquared),
            gyro_unit: Some(GyroUnit::RadiansPerSecond),
            change: Some(rows_of_blocks),
            ..Part::default()
        }]
    })
}

fn rows_of_blocks(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut force: Option<String> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if let Some(numbers) = triad(text, ACCELERATION) {
            force = Some(numbers.join(","));
        } else if let (Some(rate), Some(force)) = (triad(text, ROTATION), force.take()) {
            out.extend_from_slice(format!("{force},{}", rate.join(",")).as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_both_kinds_of_words_are_one_row() {
        for block in [
            "Acceleration X: 1.00, Y: 2.00, Z: 3.00 m/s^2\nRotation X: 4.00, Y: 5.00, Z: 6.00 rad/s\n",
            "\t\tAccel X: 1.00 \tY: 2.00 \tZ: 3.00 m/s^2 \n\t\tGyro X: 4.00 \tY: 5.00 \tZ: 6.00 radians/s \n",
        ] {
            assert!(blocks(&Look::at(block.as_bytes())).is_some(), "{block}");
            let mut rows = String::new();
            let text = Box::new(std::io::Cursor::new(block.to_owned()));
            rows_of_blocks(text).read_to_string(&mut rows).unwrap();
            assert_eq!(rows.trim(), "1.00,2.00,3.00,4.00,5.00,6.00");
        }
    }

    #[test]
    fn a_table_with_a_word_in_its_rows_is_no_serial_log() {
        let table = "device,t,ax,ay,az\ndev1,0.00,1,2,3\ndev1,0.01,1,2,3\ndev1,0.02,1,2,3\n";
        assert!(labelled(&Look::at(table.as_bytes())).is_none());
        let log = "ax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\nax:1,ay:2,az:3,gx:4\n";
        assert!(labelled(&Look::at(log.as_bytes())).is_some());
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
        assert_eq!((stamp, pairs.len()), (Some("22:13:01.234"), 3));
        assert_eq!(found("a/g:\t1\t2\t3").unwrap().1[0], ("a/g", "1"));
        assert_eq!(found("1,2,3,4"), None);
        assert_eq!(found("MPU6050 connection successful"), None);
    }
}
