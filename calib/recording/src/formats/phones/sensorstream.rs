//! Sensorstream IMU+GPS and Wireless IMU for Android: a stamp, then groups of a sensor's number and its values.
//!
//! Source: J. Denker, receiver of the app's messages, its table of sensors; the numbers are the app's own. A group that is not
//! known ends the row.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, Stated};

/// Rows of the app.
pub(crate) static SENSORSTREAM: TextFormat = TextFormat {
    name: "sensorstream",
    about: "rows of the Android app Sensorstream IMU+GPS: `57.12, 3, x,y,z, 4, x,y,z, 5, x,y,z`",
    parts,
};

/// Numbers of the sensors.
const ACCEL: u8 = 3;
const GYRO: u8 = 4;
const FIELD: u8 = 5;

/// Returns the number of values after the number of a sensor; `None` for an unknown sensor.
fn values(id: u8) -> Option<usize> {
    match id {
        1 | ACCEL..=7 | 81..=84 => Some(3),
        8 | 85 | 86 => Some(1),
        _ => None,
    }
}

/// The stamp of a row, and the groups behind it.
type Row<'a> = (&'a str, Vec<(u8, Vec<&'a str>)>);

/// The stamp of a row and its groups; `None` for any other line.
fn groups(line: &str) -> Option<Row<'_>> {
    let mut cells = line.split([',', ';']).map(str::trim);
    let stamp = cells.next()?;
    stamp.parse::<f64>().ok()?;
    let mut found: Vec<(u8, Vec<&str>)> = Vec::new();
    while let Some(id) = cells.next().filter(|cell| !cell.is_empty()) {
        let id: u8 = id.parse().ok()?;
        let count = values(id).filter(|_| found.iter().all(|(other, _)| *other != id))?;
        let values: Vec<&str> = cells.by_ref().take(count).collect();
        let whole = values.len() == count && values.iter().all(|cell| cell.parse::<f64>().is_ok());
        if !whole {
            return None;
        }
        found.push((id, values));
    }
    (!found.is_empty()).then_some((stamp, found))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let rows: Vec<_> = look.lines().map(groups).collect();
    let known: Vec<_> = rows.iter().flatten().collect();
    let holds = |id: u8| {
        let has =
            |row: &&&(&str, Vec<(u8, Vec<&str>)>)| row.1.iter().any(|(other, _)| *other == id);
        2 * known.iter().filter(has).count() > rows.len()
    };
    // The last line may be cut.
    if known.len() < 3 || known.len() + 1 < rows.len() || !holds(ACCEL) {
        return None;
    }
    let change = |id: u8, change: Change| holds(id).then_some(change);
    let changes = [
        change(ACCEL, |text| only(text, ACCEL)),
        change(GYRO, |text| only(text, GYRO)),
        change(FIELD, |text| only(text, FIELD)),
    ];
    let stated = Stated {
        accel: Some(AccelUnit::MetresPerSecondSquared),
        gyro: Some(GyroUnit::RadiansPerSecond),
        field: Some(FieldUnit::Microtesla),
        ..Stated::default()
    };
    Some(Part::of_each(changes, ["1", "2", "3", "4"], stated).collect())
}

/// The stamp and the values of one sensor; rows without it are blank.
fn only(text: Box<dyn Read + Send>, id: u8) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some((stamp, groups)) = groups(text) else {
            return;
        };
        if let Some((_, values)) = groups.iter().find(|(other, _)| *other == id) {
            out.extend_from_slice(format!("{stamp},{}", values.join(",")).as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn rows_are_taken_apart_by_the_numbers_of_the_sensors() {
        let row = "57.12, 3,   0.1, 0.2,9.8, 4, 0.01,0.02,0.03, 5, 20,-3,40, 86, 31\n";
        let found = parts(&Look::at(row.repeat(4).as_bytes())).unwrap();
        assert_eq!(found.len(), 3);
        let rows = changed_by(found[1].change.unwrap(), row);
        assert_eq!(rows, "57.12,0.01,0.02,0.03\n");
        // A row may hold the position of the satellites as well.
        let row = "57.12, 1, 48.1,11.5,500, 3, 0.1,0.2,9.8\n";
        assert_eq!(parts(&Look::at(row.repeat(4).as_bytes())).unwrap().len(), 1);
    }

    #[test]
    fn rows_of_numbers_are_not_taken_for_it() {
        for row in [
            "0.01,0.1,0.2,9.8,0.01,0.02,0.03\n",
            "1,3,4,5,6\n2,3,4,5,7\n3,3,4,5\n4,5,6,7,8\n",
            "t,3,1,2,3\n",
        ] {
            assert!(
                parts(&Look::at(row.repeat(4).as_bytes())).is_none(),
                "{row}"
            );
        }
    }
}
