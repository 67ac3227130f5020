//! The vocabulary of column names.

pub(crate) mod axes_units;
mod parts;
mod stamps;
mod words;

use sensor::Sensor;

use self::parts::{LONGEST, OPENING, behind_label, last_bracket};
pub(crate) use self::parts::{compact, take_apart};
pub(crate) use self::stamps::{
    is_like_time, is_message_stamp, is_of_ticks, is_sampling_stamp, is_temperature_beside,
    per_second, says_unknown_unit, stamps_of, stated_unit,
};
use self::words::{TEMPERATURE, TIME};
pub(crate) use self::words::{is_field, sensor_of};
use crate::recording::options::Role;
use crate::units::{AccelUnit, GyroUnit, TemperatureUnit};

/// True for the name of an accelerometer's column that may be without gravity: `Linear Acceleration X`.
pub(crate) fn may_be_linear(name: &str) -> bool {
    take_apart(name).0.starts_with("lin")
}

/// True for the name of an acceleration that says it has gravity in it, as that of browsers does beside one without.
pub(crate) fn says_gravity(name: &str) -> bool {
    take_apart(name).0.contains("includinggravity")
}

/// The role of a name, or of what follows a point or slash in it: `field.angular_velocity.x`.
pub(crate) fn role_of(name: &str, only: Option<Sensor>) -> Option<Role> {
    if name.len() > LONGEST.get() {
        return None;
    }
    if let Some(own) = behind_label(name) {
        return role_of(&own, only);
    }
    let bracket = last_bracket(name).unwrap_or(name.len());
    let ends = name[..bracket]
        .match_indices(['.', '/', ':'])
        .map(|(at, _)| &name[at + 1..]);
    let is_word = |end: &&str| {
        let word = end.split(OPENING).next().unwrap_or_default();
        word.chars()
            .filter(|c| c.is_alphanumeric())
            .nth(1)
            .is_some()
    };
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
        // `T (°C)` is no time.
        let is_warm = unit.is_some_and(|unit| {
            unit.starts_with(['°', 'º', '℃']) || unit.parse::<TemperatureUnit>().is_ok()
        });
        return Some(match word == "t" && is_warm {
            true => Role::Temperature,
            false => Role::Time,
        });
    }
    if TEMPERATURE.contains(&word.as_str()) {
        return Some(Role::Temperature);
    }
    let unit = unit.unwrap_or_default();
    // `G(x)` and `gX (g)` are in units of gravity.
    let of_gravity = ["x", "y", "z"].iter().position(|axis| *axis == unit);
    if let Some(axis) = of_gravity.filter(|_| word == "g" && name.contains('(')) {
        return Some(Role::Accel(axis));
    }
    let (axis, stem) = axis_and_stem(&word, unit)?;
    let is_bare = stem.is_empty();
    let in_gravity = stem == "g" && unit.parse() == Ok(AccelUnit::G);
    let sensor = sensor_of(stem).filter(|_| !in_gravity);
    if in_gravity
        || sensor == Some(Sensor::Accelerometer)
        || (is_bare && unit.parse::<AccelUnit>().is_ok())
    {
        Some(Role::Accel(axis))
    } else if sensor == Some(Sensor::Gyroscope) || (is_bare && unit.parse::<GyroUnit>().is_ok()) {
        Some(Role::Gyro(axis))
    } else if is_field(stem) {
        only.is_none().then_some(Role::Field(axis))
    } else if stem.is_empty() {
        only.map(|sensor| Role::axis(sensor, axis))
    } else {
        None
    }
}

/// Words beside the letter of an axis: `x-axis`, `Achse X`, `x轴`.
const BESIDE_AXES: [&str; 5] = ["axis", "achse", "axe", "轴", "軸"];

/// The angles that browsers call turns about the axes by, with their axes.
const ANGLES: [(&str, usize); 3] = [("beta", 0), ("gamma", 1), ("alpha", 2)];

/// The axis in a name, and what is left of it: `accx`, `xacc`, `accxaxis`, and `acc` of `acc[0]`.
fn axis_and_stem<'a>(word: &'a str, unit: &str) -> Option<(usize, &'a str)> {
    let axis = |c: char| "xyz".find(c);
    let mut ends = BESIDE_AXES.iter().map(|beside| word.strip_suffix(beside));
    let ends = ends.find_map(|rest| rest.filter(|rest| rest.ends_with(['x', 'y', 'z'])));
    let word = ends.unwrap_or(word);
    let about = |(angle, axis): &(&str, usize)| Some((*axis, word.strip_suffix(angle)?));
    if let Some((axis, stem)) = ANGLES.iter().find_map(about)
        && sensor_of(stem) == Some(Sensor::Gyroscope)
    {
        return Some((axis, stem));
    }
    if let Some((at, last)) = word.char_indices().next_back()
        && let Some(axis) = axis(last)
    {
        let stem = &word[..at];
        let mut bare = BESIDE_AXES.iter().map(|beside| stem.strip_suffix(beside));
        return Some((axis, bare.find_map(|bare| bare).unwrap_or(stem)));
    }
    if let Some(index) = ["0", "1", "2"].iter().position(|index| *index == unit)
        && (sensor_of(word).is_some() || is_field(word))
    {
        return Some((index, word));
    }
    // Of `x` before a letter or two nobody knows what it means.
    let first = word.chars().next().and_then(axis)?;
    let stem = &word[1..];
    let mut bare = BESIDE_AXES.iter().map(|beside| stem.strip_prefix(beside));
    let stem = bare.find_map(|bare| bare).unwrap_or(stem);
    let is_known = sensor_of(stem).is_some() || is_field(stem);
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
    fn words_of_several_languages_have_roles() {
        let roles = [
            ("加速度x(m/s²)", Some(Role::Accel(0))),
            ("Y轴角速度（°/s）", Some(Role::Gyro(1))),
            ("加速度z轴", Some(Role::Accel(2))),
            ("陀螺仪X", Some(Role::Gyro(0))),
            ("Beschleunigung x-Achse", Some(Role::Accel(0))),
            ("Accélération axe Y (m/s²)", Some(Role::Accel(1))),
            ("Vitesse angulaire z", Some(Role::Gyro(2))),
            ("imu6.ArrayGyro.y", Some(Role::Gyro(1))),
            ("时间戳(ms)", Some(Role::Time)),
            ("温度(°C)", Some(Role::Temperature)),
            ("T (°C)", Some(Role::Temperature)),
            ("T [degC]", Some(Role::Temperature)),
            ("T (°)", Some(Role::Temperature)),
            ("T [ms]", Some(Role::Time)),
            ("6251.12345:scaledAccelX", Some(Role::Accel(0))),
            ("IMU_ATTI(0):gyroY", Some(Role::Gyro(1))),
            ("uncompGyro2", None),
            ("ZGYRO_OUT (deg/s)", Some(Role::Gyro(2))),
            ("CorrectedAccelY", Some(Role::Accel(1))),
            ("acce_x", Some(Role::Accel(0))),
            ("GForceZ", Some(Role::Accel(2))),
            ("gFx", None),
            ("pqr[1]", Some(Role::Gyro(1))),
            ("Avanti sensor 2: GYRO.Y 2 (deg/s)", Some(Role::Gyro(1))),
            ("IM sensor 12: ACC.Z 12", Some(Role::Accel(2))),
            ("sensor 1: ACC.Z 2", None),
            ("Run 1: X-axis acceleration (m/s²)", Some(Role::Accel(0))),
            ("Latest: Y-axis gyro (rad/s)", Some(Role::Gyro(1))),
            ("Data Set 2:Z-Accel(m/s^2)", Some(Role::Accel(2))),
            ("Acceleration - x (m/s²) Run #1", Some(Role::Accel(0))),
            ("Angular Velocity Y (°/s) Run 12", Some(Role::Gyro(1))),
            ("Time (s) Run 1", Some(Role::Time)),
            (
                "Beschleunigung – x (m/s²) Messreihe #1",
                Some(Role::Accel(0)),
            ),
            ("Time of Run: x (g)", None),
            ("Beschleunigung_x in m/s²", Some(Role::Accel(0))),
            ("Gyro_z in °/s", Some(Role::Gyro(2))),
            ("acc_x m/s^2", Some(Role::Accel(0))),
            ("Zeit in ms", Some(Role::Time)),
            ("Z rate of rotation (deg/s)", Some(Role::Gyro(2))),
            ("linear_accel_x", Some(Role::Accel(0))),
            ("accelerationIncludingGravity.z", Some(Role::Accel(2))),
            ("rotationRate.alpha", Some(Role::Gyro(2))),
            ("rotationRate.beta", Some(Role::Gyro(0))),
            ("orientation.alpha", None),
            ("G(x)", Some(Role::Accel(0))),
            ("gY (g)", Some(Role::Accel(1))),
            ("gY (deg/s)", Some(Role::Gyro(1))),
            ("imu_ax", Some(Role::Accel(0))),
            ("gyro_body_z", Some(Role::Gyro(2))),
            ("Ускорение X (м/с²)", Some(Role::Accel(0))),
            ("각속도 Y(deg/s)", Some(Role::Gyro(1))),
            ("tv_sec", Some(Role::Time)),
            // Forces, moments and gravity.
            ("f_body_x", None),
            ("m_body_x", None),
            ("g_body_x", None),
            // An angle, and what gravity is taken off.
            ("角度X(°)", None),
            ("线性加速度x", None),
        ];
        for (name, role) in roles {
            assert_eq!(role_of(name, None), role, "{name}");
        }
    }
}
