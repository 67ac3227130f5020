//! The vocabulary of column names.

use sensor::Sensor;

use crate::recording::options::Role;
use crate::units::field::FieldUnit;
use crate::units::{self, AccelUnit, GyroUnit, TimeUnit};

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
    "ms",
    "us",
    "zeit",
    "tick",
    "ticks",
    "relativetime",
    "unixtime",
    "systemtime",
    "tow",
    "gpstow",
    "zeitstempel",
    "uhrzeit",
    "temps",
    "tiempo",
    "tempo",
    "tijd",
    "tid",
    "czas",
    "время",
    "时间",
    "時間",
    "時刻",
    "datenum",
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
    "ac",
    "accl",
    "linacc",
    "linaccel",
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
    "gy",
    "angvel",
    "angularvel",
    "gyros",
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
    "magnetic",
    "magnet",
    "magfield",
    "bfield",
    "geomagneticfield",
    "magneticfluxdensity",
    "magneticinduction",
    "compass",
    "magadc",
    "imumagneticfield",
    "maguncalibrated",
    "uncalmag",
    "magnetfeld",
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
    "tmp",
];

/// Parts of the names of stamps that are called otherwise.
const LIKE_TIME: [&str; 6] = ["time", "stamp", "tick", "millis", "micros", "clock"];
/// Parts of names that hold such a part and are no stamps.
const NO_TIME: [&str; 22] = [
    "zone", "valid", "status", "sync", "flag", "out", "diff", "delta", "relative", "latency",
    "period", "interval", "duration", "delay", "age", "speed", "vel", "wind", "exec", "loop",
    "jitter", "dt",
];
/// Endings of the names of time columns, with their units.
const UNITS_OF_TIME: [(&str, TimeUnit); 16] = [
    ("millis", TimeUnit::Milliseconds),
    ("millisec", TimeUnit::Milliseconds),
    ("milliseconds", TimeUnit::Milliseconds),
    ("msec", TimeUnit::Milliseconds),
    ("ms", TimeUnit::Milliseconds),
    ("micros", TimeUnit::Microseconds),
    ("microsec", TimeUnit::Microseconds),
    ("microseconds", TimeUnit::Microseconds),
    ("usec", TimeUnit::Microseconds),
    ("us", TimeUnit::Microseconds),
    ("nanos", TimeUnit::Nanoseconds),
    ("nanosec", TimeUnit::Nanoseconds),
    ("nanoseconds", TimeUnit::Nanoseconds),
    ("nsec", TimeUnit::Nanoseconds),
    ("ns", TimeUnit::Nanoseconds),
    ("seconds", TimeUnit::Seconds),
];

/// True for a name that has no role and holds a word of the time, or a unit of it: `Time Startup`, `recv_stamp`,
/// `now[ms]`.
pub(crate) fn is_like_time(name: &str) -> bool {
    let (word, unit) = take_apart(name);
    let has = |parts: &[&str]| parts.iter().any(|part| word.contains(part));
    let in_time = || {
        let unit = unit.and_then(|unit| unit.parse::<TimeUnit>().ok());
        // `gyro_s` may be anything.
        unit.is_some_and(|unit| unit.per_second() > 1.0)
            || (unit == Some(TimeUnit::Seconds) && name.contains(['(', '[', '{']))
    };
    word.len() <= LONGEST && (has(&LIKE_TIME) || in_time()) && !has(&NO_TIME)
}

/// The unit of the time that a name says without brackets: `millis`, `timeMs`.
pub(crate) fn unit_of_time(name: &str) -> Option<TimeUnit> {
    let (word, _) = take_apart(name);
    let says = |(end, _): &&(&str, TimeUnit)| {
        let stem = word.strip_suffix(end);
        // The `ms` of `items` is none.
        stem.is_some_and(|stem| {
            end.len() > 2 || stem.is_empty() || TIME.contains(&stem) || is_like_time(stem)
        })
    };
    UNITS_OF_TIME.iter().find(says).map(|(_, unit)| *unit)
}

/// The sensor whose stamps a column holds by its name: `accel_ts`, `gyroTimestamp`, `t_acc`.
pub(crate) fn stamps_of(name: &str) -> Option<Sensor> {
    let (word, _) = take_apart(name);
    let of_one = match (word.contains("acc"), word.contains("gyr")) {
        _ if word == "ta" => Some(Sensor::Accelerometer),
        _ if word == "tg" => Some(Sensor::Gyroscope),
        (true, false) => Some(Sensor::Accelerometer),
        (false, true) => Some(Sensor::Gyroscope),
        _ => None,
    };
    let words = || name.split(|c: char| !c.is_alphanumeric());
    let is = |wanted: &[&str]| words().any(|word| wanted.contains(&word.to_lowercase().as_str()));
    // `gyro_x_deg_per_sec` is a reading.
    of_one
        .filter(|_| !is(&["x", "y", "z"]))
        .filter(|_| matches!(word.as_str(), "ta" | "tg") || is_like_time(name) || is(TIME))
}

/// True for the name of an accelerometer's column that may be without gravity: `Linear Acceleration X`.
pub(crate) fn may_be_linear(name: &str) -> bool {
    take_apart(name).0.starts_with("lin")
}

/// True for a stem, without its axis and in small letters, that a magnetometer is called by.
pub(crate) fn is_field(stem: &str) -> bool {
    FIELD.contains(&stem)
}

/// The sensor that a stem, without its axis and in small letters, is called after.
pub(crate) fn sensor_of(stem: &str) -> Option<Sensor> {
    match stem {
        _ if ACCEL.contains(&stem) => Some(Sensor::Accelerometer),
        _ if GYRO.contains(&stem) => Some(Sensor::Gyroscope),
        _ => None,
    }
}

/// Bytes of the longest name that may have a role: paths of topics take some tens.
const LONGEST: usize = 200;

/// A column name taken apart: what it calls, and the unit in brackets or behind an underscore.
pub(crate) fn take_apart(name: &str) -> (String, Option<&str>) {
    if let Some((word, unit)) = before_axis(name.trim()) {
        return (word, Some(unit));
    }
    let (word, unit) = match last_bracket(name) {
        Some(at) => {
            let unit = name[at + 1..].trim_end().trim_end_matches([')', ']', '}']);
            (&name[..at], Some(unit))
        }
        None => behind_underscores(name.trim()).map_or((name, None), |(w, unit)| (w, Some(unit))),
    };
    (compact(word), unit)
}

/// Returns the index of the brackets at the end of a name, as in `accel(0):X[g]`; `None` if more of the name follows them.
fn last_bracket(name: &str) -> Option<usize> {
    let (mut depth, mut begin, mut end) = (0_usize, None, None);
    for (at, c) in name.char_indices() {
        match c {
            '(' | '[' | '{' => {
                if depth == 0 {
                    (begin, end) = (Some(at), None);
                }
                depth += 1;
            }
            ')' | ']' | '}' => {
                depth = depth.saturating_sub(1);
                end = (depth == 0).then_some(at).or(end);
            }
            _ => {}
        }
    }
    let behind = end.map_or("", |at| &name[at..]);
    begin.filter(|_| !behind.contains(char::is_alphanumeric))
}

/// A name whose unit stands before its axis: `accel_g.x`, `gyro_dps_y`.
fn before_axis(name: &str) -> Option<(String, &str)> {
    let (rest, axis) = name.rsplit_once(['.', '_'])?;
    let is_axis = matches!(axis, "x" | "y" | "z" | "X" | "Y" | "Z");
    let (word, unit) = behind_underscores(rest).filter(|_| is_axis)?;
    let word = compact(word);
    // `gyro_raw_x` says nothing of its unit.
    let is_unit = unit
        .parse()
        .is_ok_and(|unit: AccelUnit| unit != AccelUnit::Counts)
        || unit
            .parse()
            .is_ok_and(|unit: GyroUnit| unit != GyroUnit::Counts);
    let is_sensor = sensor_of(&word).is_some() && is_unit;
    let is_field = FIELD.contains(&word.as_str()) && unit.parse::<FieldUnit>().is_ok();
    (is_sensor || is_field).then(|| (word + &axis.to_lowercase(), unit))
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
    // `mag_x_T` has a unit, `acc_t` has none.
    let of_field = |(word, unit): &(&str, &str)| {
        let word = compact(word);
        let stem = word.strip_suffix(['x', 'y', 'z']).unwrap_or(&word);
        is_field(stem) && unit.parse::<FieldUnit>().is_ok()
    };
    of_sensor.or_else(|| last.filter(|split| units::is_unit(split.1) || of_field(split)))
}

/// A name without punctuation, in small letters.
pub(crate) fn compact(word: &str) -> String {
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
    let unit = unit.unwrap_or_default();
    let (axis, stem) = axis_and_stem(&word, unit)?;
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

/// The axis in a name, and what is left of it: `accx`, `xacc`, and `acc` of `acc[0]`.
fn axis_and_stem<'a>(word: &'a str, unit: &str) -> Option<(usize, &'a str)> {
    let axis = |c: char| "xyz".find(c);
    if let Some((at, last)) = word.char_indices().next_back()
        && let Some(axis) = axis(last)
    {
        return Some((axis, &word[..at]));
    }
    if let Some(index) = ["0", "1", "2"].iter().position(|index| *index == unit)
        && (sensor_of(word).is_some() || FIELD.contains(&word))
    {
        return Some((index, word));
    }
    // Of `x` before a letter or two nobody knows what it means.
    let first = word.chars().next().and_then(axis)?;
    let stem = &word[1..];
    let is_known = sensor_of(stem).is_some() || FIELD.contains(&stem);
    (stem.len() > 2 && is_known).then_some((first, stem))
}

/// The sensor that a file is named after, so that columns called x, y, z mean something.
pub(crate) fn sensor_of_file(name: &str) -> Option<Sensor> {
    let stem = name.rsplit(['/', '\\']).next()?.to_lowercase();
    match (stem.starts_with("acc"), stem.starts_with("gyr")) {
        (true, false) => Some(Sensor::Accelerometer),
        (false, true) => Some(Sensor::Gyroscope),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_stamps_say_their_unit_and_their_sensor() {
        for (name, unit) in [
            ("millis", Some(TimeUnit::Milliseconds)),
            ("micros", Some(TimeUnit::Microseconds)),
            ("timeMs", Some(TimeUnit::Milliseconds)),
            ("uptimeMillis", Some(TimeUnit::Milliseconds)),
            ("seconds", Some(TimeUnit::Seconds)),
            ("timestamps", None),
            ("t", None),
            ("items", None),
        ] {
            assert_eq!(unit_of_time(name), unit, "{name}");
        }
        assert!(is_like_time("now[ms]") && is_like_time("uptime_us") && is_like_time("clk (s)"));
        assert!(
            !is_like_time("dt[ms]") && !is_like_time("loop time (us)") && !is_like_time("speed_ms")
        );
        for name in ["accel_ts", "t_acc", "accTimestamp", "acc time (ms)", "ta"] {
            assert_eq!(stamps_of(name), Some(Sensor::Accelerometer), "{name}");
        }
        assert_eq!(stamps_of("gyro_t"), Some(Sensor::Gyroscope));
        assert_eq!(
            stamps_of("gyro_x")
                .or(stamps_of("acc_count"))
                .or(stamps_of("time")),
            None
        );
    }
}
