//! AndroSensor: one row for all sensors, slower ones held, gravity and linear acceleration beside the sensor.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// A table of the app AndroSensor.
pub(crate) static ANDROSENSOR: TextFormat = TextFormat {
    name: "androsensor",
    about: "a table of the Android app AndroSensor: `ACCELEROMETER X (m/s²);..;GYROSCOPE X (rad/s);..`",
    parts,
};

const AXES: [&str; 3] = ["X", "Y", "Z"];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_header = |names: &[String]| {
        let has = |start: &str| names.iter().any(|name| name.starts_with(start));
        has("Time since start") && (has("ACCELEROMETER X") || has("GYROSCOPE X"))
    };
    let names = look.header(is_header)?;
    let starting = |start: &str| {
        let name = names.iter().find(|name| name.starts_with(start))?;
        numbered(&names, name)
    };
    let mut columns = vec![(Role::Time, starting("Time since start")?)];
    for (axis, letter) in AXES.into_iter().enumerate() {
        let accel = starting(&format!("ACCELEROMETER {letter}"));
        columns.extend(accel.map(|column| (Role::Accel(axis), column)));
        let gyro = starting(&format!("GYROSCOPE {letter}"));
        columns.extend(gyro.map(|column| (Role::Gyro(axis), column)));
    }
    Some(vec![Part {
        columns,
        time_unit: Some(TimeUnit::Milliseconds),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        ..Part::default()
    }])
}
