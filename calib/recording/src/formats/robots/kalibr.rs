//! Kalibr's IMU table: the gyroscope first, and `alpha` is the accelerometer.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// The table that `kalibr_bagcreater` takes.
pub(crate) static KALIBR: TextFormat = TextFormat {
    name: "kalibr",
    about: "Kalibr's `timestamp,omega_x,..,alpha_x,..`: ns, rad/s, and alpha is the specific force in m/s²",
    parts,
};

fn parts(look: &Look) -> Option<Vec<Part>> {
    let names = look.header(|names| {
        let has = |wanted: &str| names.iter().any(|name| name.starts_with(wanted));
        has("omega_") && has("alpha_")
    })?;
    let mut columns = vec![(Role::Time, "1".to_owned())];
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        // An axis that is missing is for the header's check to refuse.
        let rate = numbered(&names, &format!("omega_{letter}"));
        columns.extend(rate.map(|column| (Role::Gyro(axis), column)));
        let force = numbered(&names, &format!("alpha_{letter}"));
        columns.extend(force.map(|column| (Role::Accel(axis), column)));
    }
    Some(vec![Part {
        columns,
        time_unit: Some(TimeUnit::Nanoseconds),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        ..Part::default()
    }])
}
