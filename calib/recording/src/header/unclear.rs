//! Columns that look like a sensor's and have no role.

use std::collections::HashMap;

use sensor::Sensor;

use super::names::take_apart;
use super::suggest::{completed, suggestion};
use crate::Error;
use crate::rows::table::Table;
use crate::shown::shown_list;
use crate::source::place::in_file;
use crate::units::is_of_sensor;

/// Words in the names of columns that are no accelerometer and no gyroscope.
const OTHERS: [&str; 62] = [
    "mag", "gravity", "linear", "user", "free", "orient", "quat", "euler", "roll", "pitch", "yaw",
    "azimuth", "heading", "course", "lat", "lon", "alt", "speed", "pressure", "press", "baro",
    "light", "lux", "sound", "decibel", "prox", "batt", "humid", "temp", "date", "time", "stamp",
    "utc", "sec", "count", "index", "seq", "frame", "cov", "status", "flag", "valid", "clip",
    "error", "samples", "integral", "relative", "counter", "serial", "device", "label", "class",
    "activity", "step", "abs", "norm", "total", "tgf", "accuracy", "health", "motion", "heart",
];
/// Whole names of such columns, in small letters.
const OTHER_NAMES: [&str; 34] = [
    "bx", "by", "bz", "mx", "my", "mz", "qw", "qx", "qy", "qz", "q0", "q1", "q2", "q3", "id", "i",
    "n", "dt", "eg", "ea", "gh", "ah", "ghz", "ahz", "no", "nr", "x", "y", "z", "vx", "vy", "vz",
    "hz", "rate",
];
/// Three columns make a sensor.
const SENSOR: usize = 3;

/// Parts of names that an accelerometer's or a gyroscope's columns have.
const SENSORS: [&str; 10] = [
    "acc", "gyr", "rot", "omega", "angul", "rate", "turn", "force", "imu", "inertial",
];
/// Parts of names of what is worked out from such columns or said about them.
const DERIVED: [&str; 26] = [
    "gravit", "linear", "user", "free", "ohne", "without", "sans", "cov", "clip", "calib",
    "integral", "relative", "valid", "status", "flag", "accuracy", "heart", "quat", "euler",
    "orient", "mag", "norm", "bias", "offset", "step", "error",
];

/// True for a name that says what a column holds, and that it is no accelerometer and no gyroscope.
fn is_of_another(name: &str) -> bool {
    let (word, unit) = take_apart(name);
    let is_xyz = matches!(word.as_str(), "x" | "y" | "z");
    if DERIVED.iter().any(|part| word.contains(part))
        || (!is_xyz && OTHER_NAMES.contains(&word.as_str()))
    {
        return true;
    }
    // `gyro_counts_x` counts, and is a gyroscope's all the same.
    let may_be = SENSORS.iter().any(|part| word.contains(part)) || unit.is_some_and(is_of_sensor);
    !may_be && OTHERS.iter().any(|part| word.contains(part))
}

/// Refuses tables of which a sensor is missing and three columns may be it.
///
/// # Errors
/// The columns, with the option that says which is which.
pub(crate) fn refuse(tables: &[Table]) -> Result<(), Error> {
    let accel = tables.iter().any(|table| !table.accel.t.is_empty());
    let gyro = tables.iter().any(|table| !table.gyro.t.is_empty());
    if accel && gyro {
        return Ok(());
    }
    let mut files: HashMap<&str, Vec<&Table>> = HashMap::new();
    for table in tables {
        files.entry(&table.name).or_default().push(table);
    }
    for (file, tables) in files {
        let unused = |name: &&String| tables.iter().all(|table| table.unclear.contains(name));
        let first = tables[0].unclear.iter();
        let unclear: Vec<String> = first
            .filter(unused)
            .filter(|name| !is_of_another(name))
            .cloned()
            .collect();
        if unclear.len() >= SENSOR {
            let missing = match accel {
                true => Sensor::Gyroscope,
                false => Sensor::Accelerometer,
            };
            // Parts of a text have its columns under other numbers.
            let alone = tables.len() == 1;
            let completed = completed(&tables[0].roles, &tables[0].names, &unclear, missing);
            let proposed = completed.filter(|_| alone);
            return Err(in_file(
                file,
                format!(
                    "no {} by name, but the columns {} change and are not used: one of them may be it; {}, or name only those of the sensor there is to go on without",
                    missing.name(),
                    shown_list(unclear.iter()),
                    proposed.unwrap_or_else(|| suggestion(&tables[0].names))
                ),
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::is_of_another;

    #[test]
    fn what_may_be_a_sensor_is_told_from_what_is_another() {
        for name in [
            "foo1",
            "rot_x",
            "Rotation Y (deg/s)",
            "p",
            "u",
            "x",
            "gyro_counts_x",
            "rotation speed z (rad/sec)",
            "yaw_rate",
            "body_frame_acc_y",
            "device rotation x",
        ] {
            assert!(!is_of_another(name), "{name}");
        }
        for name in [
            "Bx",
            "mag_x",
            "GRAVITY X (m/s²)",
            "field.orientation.x",
            "TgF",
            "YYYY-MO-DD time",
            "gyro_bias_x",
            "accel_calibration_count",
            "accelerometer accuracy",
            "count",
            "yaw",
            "MagX (G)",
        ] {
            assert!(is_of_another(name), "{name}");
        }
    }
}
