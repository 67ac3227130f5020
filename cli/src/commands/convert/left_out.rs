//! Columns of the file that its plain form has not.

use calib::Recording;
use calib::recording::Stream;
use calib::recording::shown::shown;

/// Names of columns in one message.
const NAMED: usize = 8;

/// Says which columns were not read, so that no form of output has them.
pub(super) fn columns(recording: &Recording) -> Option<String> {
    let mut columns: Vec<&String> = Vec::new();
    let sensors = recording.description.sensors.iter();
    for column in sensors.flat_map(|described| &described.unused) {
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    let named = columns.iter().take(NAMED);
    let mut listed: Vec<String> = named.map(|name| format!("`{}`", shown(name))).collect();
    if columns.len() > NAMED {
        listed.push(format!("{} more", columns.len() - NAMED));
    }
    (!columns.is_empty()).then(|| {
        format!(
            "not written: {}; the plain form has time, specific force, angular rate, magnetic field and temperature",
            listed.join(", ")
        )
    })
}

/// Says how many samples one table has no row for, because another sensor was not on.
pub(super) fn samples(recording: &Recording) -> Option<String> {
    let both = [&recording.accelerometer, &recording.gyroscope];
    let spans = both.into_iter().flatten().filter_map(Stream::span);
    let (from, to) = spans.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)))?;
    let field = recording.magnetometer.as_ref().map(|field| &field.stream);
    let streams = both.into_iter().flatten().chain(field);
    let stamps = streams.flat_map(|stream| &stream.t);
    let outside = stamps.filter(|&&t| t < from || t > to).count();
    let plural = if outside == 1 { "" } else { "s" };
    (outside > 0).then(|| {
        format!(
            "{outside} sample{plural} from when not every sensor was on: not written; a folder keeps all (-o FOLDER)"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use calib::recording::{Described, UnitBy};

    #[test]
    fn columns_are_named_once_and_not_all_of_many() {
        let with = |count: usize| {
            let mut recording = Recording::default();
            for sensor in [sensor::Sensor::Accelerometer, sensor::Sensor::Gyroscope] {
                recording.description.sensors.push(Described {
                    sensor,
                    source: String::new(),
                    columns: Vec::new(),
                    unused: (0..count).map(|k| format!("c{k}")).collect(),
                    unit: "",
                    unit_by: UnitBy::File,
                    turned: false,
                    flipped: Vec::new(),
                });
            }
            columns(&recording)
        };
        assert_eq!(with(0), None);
        assert!(with(2).unwrap().starts_with("not written: `c0`, `c1`; "));
        assert!(with(30).unwrap().contains("`c7`, 22 more; "));
    }

    #[test]
    fn samples_are_counted_that_lie_outside_the_time_of_all() {
        let stream = |from: u8, to: u8| Stream {
            t: (from..to).map(f64::from).collect(),
            values: vec![nalgebra::Vector3::zeros(); usize::from(to - from)],
        };
        let mut recording = Recording {
            accelerometer: Some(stream(0, 10)),
            gyroscope: Some(stream(0, 10)),
            ..Recording::default()
        };
        assert_eq!(samples(&recording), None);
        recording.gyroscope = Some(stream(3, 12));
        assert!(samples(&recording).unwrap().starts_with("5 samples "));
        recording.accelerometer = None;
        assert_eq!(samples(&recording), None);
    }
}
