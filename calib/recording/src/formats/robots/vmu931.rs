//! Variense VMU931 as text: `[accel] t=1234 x=0.01 y=0.02 z=0.99`, a line per reading.
//!
//! Source: VMU931 User Guide, 2017, section 4.2.3: stamps are milliseconds since the sensor was plugged in; g, deg/s, µT. The
//! lines are those that the programs of the library vmu931 print.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, Stated, TimeUnit};

/// A log of a VMU931.
pub(crate) static VMU931: TextFormat = TextFormat {
    name: "vmu931",
    about: "a VMU931's readings as text: `[accel] t=1234 x=0.01 y=0.02 z=0.99`, `[gyro] ..`; ms, g, deg/s",
    parts,
};

/// The name of a line and its stamp and axes.
fn reading(line: &str) -> Option<(&str, [&str; 4])> {
    let (name, rest) = line.trim().strip_prefix('[')?.split_once(']')?;
    let separates = |c: char| c.is_whitespace() || c == ',';
    let pairs = || {
        rest.split(separates)
            .filter_map(|word| word.split_once('='))
    };
    let value = |wanted: &str| {
        let found = pairs().find(|(key, _)| *key == wanted);
        found
            .map(|(_, value)| value)
            .filter(|value| value.parse::<f64>().is_ok())
    };
    Some((name, [value("t")?, value("x")?, value("y")?, value("z")?]))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let count = |wanted: &str| {
        let named = |line: &&str| reading(line).is_some_and(|(name, _)| name == wanted);
        look.lines().filter(named).count()
    };
    let change = |wanted: &str, change: Change| (count(wanted) > 1).then_some(change);
    let changes = [
        change("accel", |text| only(text, "accel")),
        change("gyro", |text| only(text, "gyro")),
        change("mag", |text| only(text, "mag")),
    ];
    let stated = Stated {
        time: Some(TimeUnit::Milliseconds),
        accel: Some(AccelUnit::G),
        gyro: Some(GyroUnit::DegreesPerSecond),
        field: Some(FieldUnit::Microtesla),
        temperature: None,
    };
    let parts: Vec<Part> = Part::of_each(changes, ["1", "2", "3", "4"], stated).collect();
    parts.iter().any(|part| !part.is_field()).then_some(parts)
}

/// The readings of one sensor; the other lines are blank.
fn only(text: Box<dyn Read + Send>, wanted: &'static str) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        let found = std::str::from_utf8(line).ok().and_then(reading);
        if let Some((_, values)) = found.filter(|(name, _)| *name == wanted) {
            out.extend_from_slice(values.join(",").as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn each_sensor_has_its_lines() {
        let text =
            "[euler] t=1 x=0 y=0 z=0\n[accel] t=1 x=0.1 y=0.2 z=0.9\n[gyro] t=2 x=1 y=2 z=3\n"
                .repeat(2);
        let found = parts(&Look::at(text.as_bytes())).unwrap();
        assert_eq!(found.len(), 2);
        let rows = changed_by(found[1].change.unwrap(), &text);
        assert_eq!(rows.split_whitespace().collect::<Vec<_>>(), ["2,1,2,3"; 2]);
        assert!(parts(&Look::at(b"[INFO] [17.5]: acc 1 2 3\n[12.5] started\n")).is_none());
    }
}
