//! The vocabulary of column names.

use sensor::Sensor;

use crate::recording::options::Role;
use crate::units::{self, AccelUnit, GyroUnit};

/// Names that mean the time, without unit and punctuation.
const TIME: &[&str] = &[
    "t",
    "time",
    "timestamp",
    "stamp",
    "timestamps",
    "ts",
    "secondselapsed",
    "elapsed",
    "elapsedtime",
    "timeelapsed",
    "seconds",
    "sec",
    "datetime",
    "timems",
    "timeus",
    "timens",
    "times",
    "tms",
    "tus",
    "tns",
    "ts",
    "timestampms",
    "timestampus",
    "timestampns",
    "timestamps",
    "millis",
    "micros",
    "nanos",
    "sampletimefine",
    "timeusec",
    "timeinseconds",
    "timemsec",
    "timensec",
    "loggingtime",
];
/// Names of accelerometer columns without their axis.
const ACCEL: &[&str] = &[
    "a",
    "acc",
    "accel",
    "accelerometer",
    "acceleration",
    "linearacceleration",
    "arss",
    "accelero",
    "specificforce",
    "f",
    "imuacc",
    "imuaccel",
    "rawacc",
    "rawaccel",
    "accraw",
    "accelraw",
    "accelerationg",
    "totalacceleration",
    "accelerometeruncalibrated",
    "abs",
];
/// Names of gyroscope columns without their axis.
const GYRO: &[&str] = &[
    "g",
    "w",
    "gyr",
    "gyro",
    "gyroscope",
    "omega",
    "angularvelocity",
    "angularrate",
    "wrss",
    "rate",
    "rotationrate",
    "angularspeed",
    "imugyr",
    "imugyro",
    "rawgyr",
    "rawgyro",
    "gyrraw",
    "gyroraw",
    "ω",
    "gyroscopeuncalibrated",
];
/// Names of magnetometer columns without their axis.
const FIELD: &[&str] = &[
    "m",
    "mag",
    "magn",
    "magneto",
    "magnetometer",
    "magneticfield",
    "magneticfieldstrength",
    "imumag",
    "rawmag",
    "magraw",
    "magnetometeruncalibrated",
];
/// Names of temperature columns.
const TEMPERATURE: &[&str] = &[
    "temp",
    "temperature",
    "tempc",
    "temperaturec",
    "tempdegc",
    "imutemp",
    "imutemperature",
    "tc",
    "celsius",
    "tempk",
    "tempf",
];

/// Bytes of the longest name that may have a role: paths of topics take some tens.
const LONGEST: usize = 200;

/// A column name taken apart: what it calls, and the unit in brackets or behind an underscore.
pub(crate) fn take_apart(name: &str) -> (String, Option<&str>) {
    let (word, unit) = match name.find(['(', '[', '{']) {
        Some(at) => {
            let unit = name[at + 1..].trim_end().trim_end_matches([')', ']', '}']);
            (&name[..at], Some(unit))
        }
        None => behind_underscores(name.trim()).map_or((name, None), |(w, unit)| (w, Some(unit))),
    };
    (compact(word), unit)
}

/// A name and the unit behind an underscore; one of a sensor may have underscores itself: `gyro_x_deg_per_sec`.
fn behind_underscores(name: &str) -> Option<(&str, &str)> {
    let splits: Vec<(&str, &str)> = name
        .rmatch_indices('_')
        .take(3)
        .map(|(at, _)| (&name[..at], &name[at + 1..]))
        .collect();
    let long = splits.iter().skip(1).rev();
    let of_sensor = long.copied().find(|(_, unit)| units::is_of_sensor(unit));
    let last = splits.first().copied();
    of_sensor.or_else(|| last.filter(|(_, unit)| units::is_unit(unit)))
}

fn compact(word: &str) -> String {
    word.chars()
        .filter(|c| c.is_alphanumeric())
        .flat_map(char::to_lowercase)
        .collect()
}

/// The role of a name, or of what follows a point or slash in it: `field.angular_velocity.x`.
pub(crate) fn role_of(name: &str, only: Option<Sensor>) -> Option<Role> {
    if name.len() > LONGEST {
        return None;
    }
    let bracket = name.find(['(', '[', '{']).unwrap_or(name.len());
    let ends = name[..bracket]
        .match_indices(['.', '/'])
        .map(|(at, _)| &name[at + 1..]);
    let is_word = |end: &&str| end.chars().filter(|c| c.is_alphanumeric()).nth(1).is_some();
    let qualified = std::iter::once(name).chain(ends.filter(is_word));
    qualified
        .into_iter()
        .find_map(|name| role_of_word(name, only))
}

/// The role that a name has by itself; `only` is what the file is known to hold, so that `x` means
/// something.
fn role_of_word(name: &str, only: Option<Sensor>) -> Option<Role> {
    let (word, unit) = take_apart(name);
    if TIME.contains(&word.as_str()) {
        return Some(Role::Time);
    }
    if TEMPERATURE.contains(&word.as_str()) {
        return Some(Role::Temperature);
    }
    let axis = match word.chars().next_back()? {
        'x' => 0,
        'y' => 1,
        'z' => 2,
        _ => return None,
    };
    let stem = &word[..word.len() - 1];
    let unit = unit.unwrap_or_default();
    if ACCEL.contains(&stem) || (stem.is_empty() && unit.parse::<AccelUnit>().is_ok()) {
        Some(Role::Accel(axis))
    } else if GYRO.contains(&stem) || (stem.is_empty() && unit.parse::<GyroUnit>().is_ok()) {
        Some(Role::Gyro(axis))
    } else if FIELD.contains(&stem) {
        only.is_none().then_some(Role::Field(axis))
    } else if stem.is_empty() {
        only.map(|sensor| Role::axis(sensor, axis))
    } else {
        None
    }
}
