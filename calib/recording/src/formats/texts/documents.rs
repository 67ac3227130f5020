//! Messages as documents of keys and values, as `rostopic echo` and `ros2 topic echo` print them: one below another, a line `---`
//! behind each.

use std::io::Read;

use sensor::Sensor;

use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::{compact, sensor_of};
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Documents of both sensors.
pub(crate) static DOCUMENTS: TextFormat = TextFormat {
    name: "documents",
    about: "messages as `rostopic echo` and `ros2 topic echo` print them: keys and values, a line `---` behind each message",
    parts,
};

/// The line behind a document.
const END: &str = "---";
/// Keys of the parts of a stamp.
const SECONDS: [&str; 2] = ["sec", "secs"];
const NANOSECONDS: [&str; 3] = ["nanosec", "nsecs", "nsec"];

findings::tuning! {
    /// Keys within keys that are looked at.
    DEEPEST: usize = 8;
}

/// The readings of a document.
#[derive(Clone, Debug, Default, PartialEq)]
struct Message {
    /// The keys that the next line may be within, with their indents.
    within: Vec<(usize, String)>,
    stamp: [Option<u64>; 2],
    /// The accelerometer's and the gyroscope's numbers, as they are written.
    triads: [[Option<String>; 3]; 2],
}

impl Message {
    /// Takes the next line, and returns the document that ends with it.
    fn next(&mut self, line: &str) -> Option<Self> {
        if line.trim_end() == END {
            return Some(std::mem::take(self));
        }
        let (key, value) = line.split_once(':')?;
        let indent = key.len() - key.trim_start().len();
        let (key, value) = (key.trim(), value.trim());
        self.within.retain(|(own, _)| *own < indent);
        if value.is_empty() {
            if self.within.len() < DEEPEST.get() {
                self.within.push((indent, key.to_owned()));
            }
            return None;
        }
        let (_, parent) = self.within.last()?;
        let number = || value.parse::<u64>().ok();
        match key {
            // The first is the header's.
            _ if SECONDS.contains(&key) => self.stamp[0] = self.stamp[0].or_else(number),
            _ if NANOSECONDS.contains(&key) => self.stamp[1] = self.stamp[1].or_else(number),
            "x" | "y" | "z" => {
                let sensor = match sensor_of(&compact(parent)) {
                    Some(Sensor::Accelerometer) => 0,
                    Some(Sensor::Gyroscope) => 1,
                    _ => return None,
                };
                let axis = usize::from(key.as_bytes()[0] - b'x');
                let is_number = value.parse::<f64>().is_ok();
                self.triads[sensor][axis] = is_number.then(|| value.to_owned());
            }
            _ => {}
        }
        None
    }

    /// The stamp and the numbers of a sensor, where all are there.
    fn cells(&self) -> Option<[Option<String>; 2]> {
        let [Some(seconds), Some(nanoseconds)] = self.stamp else {
            return None;
        };
        let stamp = format!("{seconds}.{nanoseconds:09}");
        let cells = |triad: &[Option<String>; 3]| {
            let [Some(x), Some(y), Some(z)] = triad else {
                return None;
            };
            Some(format!("{stamp},{x},{y},{z}"))
        };
        Some([cells(&self.triads[0]), cells(&self.triads[1])])
    }
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut message = Message::default();
    let documents = look.far_lines().filter_map(|line| message.next(line));
    let rows: Vec<_> = documents.map(|document| document.cells()).collect();
    if rows.len() < 2 || rows.iter().any(Option::is_none) {
        return None;
    }
    let has = |sensor: usize| rows.iter().flatten().all(|row| row[sensor].is_some());
    let part = |sensor: Sensor, change| Part {
        time_unit: Some(TimeUnit::Seconds),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        change: Some(change),
        ..Part::of(sensor, ["1", "2", "3", "4"])
    };
    let parts = [
        has(0).then(|| part(Sensor::Accelerometer, |text| rows_of(text, 0))),
        has(1).then(|| part(Sensor::Gyroscope, |text| rows_of(text, 1))),
    ];
    let parts: Vec<Part> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then_some(parts)
}

/// A row for each document, of one sensor, at the line behind it; the other lines are blank.
fn rows_of(text: Box<dyn Read + Send>, sensor: usize) -> Box<dyn Read + Send> {
    let mut message = Message::default();
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some(document) = message.next(text) else {
            return;
        };
        match document.cells() {
            Some(rows) => {
                let row = rows.into_iter().nth(sensor).flatten();
                out.extend_from_slice(row.unwrap_or_default().as_bytes());
            }
            // What lacks a number is for the reader to refuse.
            None => out.extend_from_slice(line),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    const MESSAGE: &str = "header: \n  seq: 7\n  stamp: \n    secs: 12\n    nsecs:  5000000\n  frame_id: \"imu\"\norientation: \n  x: 0.5\n  y: 0\n  z: 0\n  w: 1\nangular_velocity: \n  x: 0.1\n  y: -2e-3\n  z: 3\nangular_velocity_covariance: [0.0, 0.0]\nlinear_acceleration: \n  x: 1\n  y: 2\n  z: 9.8\nlinear_acceleration_covariance:\n- 0.0\n- 0.1\n---\n";

    #[test]
    fn a_message_is_a_row_of_each_sensor() {
        for text in [
            MESSAGE.to_owned(),
            MESSAGE.replace("nsecs", "nanosec").replace("secs", "sec"),
        ] {
            let log = text.repeat(3);
            let parts = parts(&Look::at(log.as_bytes())).unwrap();
            let rows = |part: &Part| -> Vec<String> {
                let text = changed_by(part.change.unwrap(), &log);
                let rows = text.lines().filter(|line| !line.is_empty());
                rows.map(str::to_owned).collect()
            };
            assert_eq!(rows(&parts[0]), ["12.005000000,1,2,9.8"; 3]);
            assert_eq!(rows(&parts[1]), ["12.005000000,0.1,-2e-3,3"; 3]);
        }
    }

    #[test]
    fn documents_without_a_stamp_or_a_sensor_are_others() {
        for text in [
            MESSAGE.replace("secs", "x"),
            MESSAGE
                .replace("acceleration", "a")
                .replace("velocity", "b"),
            "---\n".to_owned(),
            "ax: 1\nay: 2\naz: 3\n---\n".to_owned(),
        ] {
            let read = parts(&Look::at(text.repeat(3).as_bytes()));
            assert!(read.is_none(), "{text}");
        }
    }
}
