//! Names that give the axes of one sensor different units: `ax (g)`, `ay (m/s²)`.

use std::str::FromStr;

use findings::{Finding, Kind};
use sensor::Sensor;

use super::parts::take_apart;
use crate::shown::shown;
use crate::units::{AccelUnit, GyroUnit};

/// Refuses axes of a sensor in several units.
///
/// # Errors
/// The names with their units.
pub(crate) fn refuse_several(
    names: &[String],
    accel: Option<[usize; 3]>,
    gyro: Option<[usize; 3]>,
) -> Result<(), Box<Finding>> {
    refuse::<AccelUnit>(names, Sensor::Accelerometer, accel)?;
    refuse::<GyroUnit>(names, Sensor::Gyroscope, gyro)
}

fn refuse<U: FromStr + PartialEq>(
    names: &[String],
    sensor: Sensor,
    columns: Option<[usize; 3]>,
) -> Result<(), Box<Finding>> {
    let own: Vec<&String> = columns
        .into_iter()
        .flatten()
        .filter_map(|column| names.get(column))
        .collect();
    let unit = |name: &&String| take_apart(name).1?.parse::<U>().ok();
    let mut units = own.iter().filter_map(unit);
    let first = units.next();
    match units.all(|unit| Some(unit) == first) {
        true => Ok(()),
        false => {
            let shown: Vec<String> = own
                .iter()
                .map(|name| format!("`{}`", shown(name)))
                .collect();
            let several = Finding::of(Kind::AXES_IN_UNITS).of_sensor(sensor);
            Err(several.detail("names", shown.join(", ")).into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_in_one_unit_or_say_none() {
        let of = |names: [&str; 3]| {
            let names = names.map(str::to_owned);
            refuse_several(&names, Some([0, 1, 2]), None).is_ok()
        };
        assert!(of(["ax (g)", "ay (g)", "az (g)"]) && of(["ax (g)", "ay", "az"]));
        assert!(of(["ax", "ay", "az"]) && of(["ax (m/s2)", "ay (m/s²)", "az [m/s^2]"]));
        assert!(!of(["ax (g)", "ay (m/s²)", "az (g)"]) && !of(["ax", "ay (mg)", "az (g)"]));
    }
}
