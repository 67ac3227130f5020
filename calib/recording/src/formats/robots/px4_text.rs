//! PX4 topics as `ulog2csv` writes them.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};
use findings::{Finding, Kind};

/// `sensor_combined`: both sensors, already corrected.
pub(crate) static SENSOR_COMBINED: TextFormat = TextFormat {
    name: "px4_csv",
    about: "PX4's sensor_combined as ulog2csv writes it: `gyro_rad[0]`, `accelerometer_m_s2[0]`",
    parts,
};

fn parts(look: &Look) -> Option<Vec<Part>> {
    let names = look.header(|names| names.iter().any(|name| name == "gyro_rad[0]"))?;
    let mut columns = vec![(Role::Time, numbered(&names, "timestamp")?)];
    for axis in 0..3 {
        columns.push((
            Role::Gyro(axis),
            numbered(&names, &format!("gyro_rad[{axis}]"))?,
        ));
        columns.push((
            Role::Accel(axis),
            numbered(&names, &format!("accelerometer_m_s2[{axis}]"))?,
        ));
    }
    Some(vec![Part {
        columns,
        time_unit: Some(TimeUnit::Microseconds),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        remark: Some(
            Finding::of(Kind::CORRECTED_BY_SYSTEM)
                .detail("system", "PX4")
                .detail("columns", "sensor_combined")
                .detail("raw", "sensor_accel and sensor_gyro"),
        ),
        corrected_by: Some("px4"),
        ..Part::default()
    }])
}
