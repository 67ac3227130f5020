//! Columns that look like a sensor's and have no role.

use findings::{Finding, Kind, OptionName, Remedy};
use std::collections::HashMap;

use sensor::Sensor;

use super::suggest::{completed, entry, suggestion};
use crate::Error;
use crate::header::names::{compact, take_apart};
use crate::header::triads::triads;
use crate::recording::options::Role;
use crate::rows::table::Table;
use crate::shown::shown_list;
use crate::source::place::in_file;
use crate::units::{is_of_field, is_of_sensor};

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
const SENSORS: [&str; 13] = [
    "rollspeed",
    "pitchspeed",
    "yawspeed",
    "acc",
    "gyr",
    "rot",
    "omega",
    "angul",
    "rate",
    "turn",
    "force",
    "imu",
    "inertial",
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
    // `MOT.Q0` is called as `q0` is.
    let last = name.rsplit('.').next().map(compact).unwrap_or_default();
    let is_xyz = |word: &str| matches!(word, "x" | "y" | "z");
    let is_other = |word: &str| !is_xyz(word) && OTHER_NAMES.contains(&word);
    if DERIVED.iter().any(|part| word.contains(part)) || is_other(&word) || is_other(&last) {
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
        return refuse_others(tables);
    }
    if !accel {
        refuse_without_gravity(tables)?;
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
            if !accel && !gyro {
                return Err(in_file(
                    file,
                    Finding::of(Kind::COLUMNS_UNCLEAR)
                        .detail("columns", shown_list(unclear.iter()))
                        .only_remedies([suggestion(&tables[0].names)]),
                ));
            }
            // Parts of a text have its columns under other numbers.
            let alone = tables.len() == 1;
            let completed = completed(&tables[0].roles, &tables[0].names, &unclear, missing);
            let proposed = completed.filter(|_| alone);
            return Err(in_file(
                file,
                Finding::of(Kind::SENSOR_UNCLEAR)
                    .of_sensor(missing)
                    .detail("columns", shown_list(unclear.iter()))
                    .remedy(proposed.unwrap_or_else(|| suggestion(&tables[0].names))),
            ));
        }
    }
    Ok(())
}

/// The columns that the one table calls an accelerometer's and that are not read, beside those that are.
pub(crate) fn unread_accelerometer(tables: &[Table]) -> Option<Remedy> {
    let [table] = tables else { return None };
    let missing = Sensor::Accelerometer;
    let found = triads(&table.unused);
    let named = found
        .iter()
        .find(|triad| triad.sensor() == Some(missing) && !is_without_gravity(&triad.stem))?;
    let names = named.columns.map(|at| table.unused[at].clone());
    completed(&table.roles, &table.names, &names, missing)
}

/// Builds the finding about columns that look like a magnetometer's, if no magnetometer is read.
pub(crate) fn unread_field(tables: &[Table]) -> Option<Finding> {
    if tables.iter().any(|table| !table.magnetometer.t.is_empty()) {
        return None;
    }
    tables.iter().find_map(|table| {
        let found = triads(&table.unclear);
        let field = found.iter().find(|triad| {
            let names = triad.columns.map(|at| &table.unclear[at]);
            is_magnetic(&triad.stem)
                || names
                    .iter()
                    .all(|name| take_apart(name).1.is_some_and(is_of_field))
        })?;
        let names = field.columns.map(|at| &table.unclear[at]);
        let places = names.map(|name| table.names.iter().position(|other| other == name));
        let mut found = Finding::of(Kind::FIELD_NOT_READ)
            .in_recording(&table.name)
            .detail("columns", shown_list(names.into_iter()));
        if let ([Some(x), Some(y), Some(z)], true) = (places, table.by_names) {
            let [x, y, z] = [x, y, z].map(|at| entry(&table.names, at));
            let columns = format!("mx={x},my={y},mz={z}");
            found = found.remedy(Remedy::set_to(OptionName::Columns, columns));
        }
        Some(found)
    })
}

/// True for the stem of a magnetometer's columns: not for a magnitude, and not for what is worked out.
fn is_magnetic(stem: &str) -> bool {
    const OTHERS: [&str; 8] = [
        "magnitude",
        "bias",
        "offset",
        "cov",
        "std",
        "var",
        "head",
        "dec",
    ];
    let stem = stem.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| stem.contains(word));
    let is_called = matches!(compact(&stem).as_str(), "b" | "h") || has(&["mag", "compass"]);
    is_called && !has(&OTHERS)
}

/// Refuses tables of both sensors that hold another of a kind: a second device, or a filtered copy.
fn refuse_others(tables: &[Table]) -> Result<(), Error> {
    for table in tables.iter().filter(|table| table.by_names) {
        let found = triads(&table.unclear);
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            let Some(other) = found.iter().find(|triad| triad.is_another_of(sensor)) else {
                continue;
            };
            let others = other.columns.iter().map(|&at| &table.unclear[at]);
            let called = |name: &String| {
                let at = table.names.iter().position(|other| other == name);
                at.map_or_else(|| name.clone(), |at| entry(&table.names, at))
            };
            let is_read = |role: &Role| !matches!(role, Role::Field(_));
            let taken = table.roles.iter().filter(|(role, _)| is_read(role));
            let taken: Vec<String> = taken
                .map(|(role, name)| format!("{}={}", role.name(), called(name)))
                .collect();
            return Err(in_file(
                &table.name,
                Finding::of(Kind::SENSOR_TWICE)
                    .of_sensor(sensor)
                    .detail("columns", shown_list(others))
                    .only_remedies([Remedy::such_as(OptionName::Columns, taken.join(","))]),
            ));
        }
    }
    Ok(())
}

/// Refuses tables whose only accelerometer has lost its gravity, as phones write it beside the rate.
fn refuse_without_gravity(tables: &[Table]) -> Result<(), Error> {
    for table in tables {
        // Those of the frame of the earth have no x, y, z.
        let is_one = |name: &&String| is_without_gravity(&name.to_lowercase());
        let columns: Vec<&String> = table.unused.iter().filter(is_one).collect();
        if columns.len() < SENSOR {
            continue;
        }
        let columns = columns.into_iter();
        return Err(in_file(
            &table.name,
            Finding::of(Kind::COLUMNS_WITHOUT_GRAVITY).detail("columns", shown_list(columns)),
        ));
    }
    Ok(())
}

/// True for the stem of an accelerometer's columns of which the system has taken gravity.
fn is_without_gravity(stem: &str) -> bool {
    const WITHOUT: [&str; 8] = [
        "user", "linear", "free", "without", "ohne", "sans", "线性", "线加",
    ];
    const ACCELERATION: [&str; 3] = ["acc", "beschl", "加速度"];
    let has = |words: &[&str]| words.iter().any(|word| stem.contains(word));
    has(&ACCELERATION) && has(&WITHOUT)
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
