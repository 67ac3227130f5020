//! The Android app 'Sensorstream IMU+GPS': `stamp, 3, x, y, z, 4, x, y, z, 5, x, y, z`, a number before every sensor.

use std::io::Read;

use sensor::Sensor;

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, cells};
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// What the app streams or writes to its file.
pub(crate) static SENSORSTREAM: TextFormat = TextFormat {
    name: "sensorstream",
    about: "Sensorstream IMU+GPS: `stamp, 3, x, y, z, 4, x, y, z, 5, x, y, z` in s, m/s², rad/s and µT",
    parts,
};

/// The numbers of accelerometer, gyroscope and magnetometer.
const IDS: [&str; 3] = ["3", "4", "5"];

/// The stamp and the three cells behind the number of a sensor; `None` where a line has none of it or is of another kind.
fn reading(line: &str, id: &str) -> Option<[String; 4]> {
    let cells = cells(line);
    let (stamp, groups) = cells.split_first()?;
    let mut groups = groups.chunks_exact(4);
    let is_known = |group: &[String]| group.first().is_some_and(|id| KNOWN.contains(&id.as_str()));
    if !groups.clone().all(is_known) || stamp.parse::<f64>().is_err() {
        return None;
    }
    let group = groups.find(|group| group[0] == id)?;
    Some([stamp, &group[1], &group[2], &group[3]].map(Clone::clone))
}

/// Numbers of all that the app sends in threes: position, the sensors, orientation and what Android makes of them.
const KNOWN: [&str; 9] = ["1", "3", "4", "5", "81", "82", "83", "84", "85"];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let rows = |id: &str| {
        look.lines()
            .filter(|line| reading(line, id).is_some())
            .count()
    };
    let all = look.lines().count();
    if 2 * rows(IDS[0]) < all || 4 * rows(IDS[1]) < all || all == 0 {
        return None;
    }
    let columns = ["1", "2", "3", "4"];
    let part = |sensor, change: Change| Part {
        time_unit: Some(TimeUnit::Seconds),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        change: Some(change),
        ..Part::of(sensor, columns)
    };
    let mut parts = vec![
        part(Sensor::Accelerometer, |text| only(text, IDS[0])),
        part(Sensor::Gyroscope, |text| only(text, IDS[1])),
    ];
    if rows(IDS[2]) > 0 {
        parts.push(Part {
            time_unit: Some(TimeUnit::Seconds),
            change: Some(|text| only(text, IDS[2])),
            ..Part::of_field(columns, Some(FieldUnit::Microtesla))
        });
    }
    Some(parts)
}

/// The readings of one sensor; the other lines are blank.
fn only(text: Box<dyn Read + Send>, id: &'static str) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        if let Some(cells) = reading(&String::from_utf8_lossy(line), id) {
            out.extend_from_slice(cells.join(",").as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sensor_stands_behind_its_number() {
        let text = "12.50, 3, 0.1, 0.2, 9.8, 4, 0.01, 0.02, 0.03, 5, 20.1, -3.2, 40.0\n12.51, 3, 0.1, 0.2, 9.8\n";
        assert_eq!(
            reading(text.lines().next().unwrap(), "4")
                .unwrap()
                .join(","),
            "12.50,0.01,0.02,0.03"
        );
        assert_eq!(parts(&Look::at(text.as_bytes())).unwrap().len(), 3);
        assert!(parts(&Look::at(b"0.1,3,1,2,3,4,1\n0.2,3,1,2,3,4,1\n")).is_none());
        assert!(parts(&Look::at(b"t,ax,ay,az\n0.1,3,1,2\n0.2,3,1,2\n")).is_none());
    }
}
