//! Physics Toolbox Sensor Suite: `gFx` is the accelerometer in g, `wx` the gyroscope, times of day with a third colon.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit};

/// A table of the app Physics Toolbox.
pub(crate) static PHYSICS_TOOLBOX: TextFormat = TextFormat {
    name: "physics_toolbox",
    about: "a table of the app Physics Toolbox: `time,gFx,gFy,gFz,..,wx,wy,wz,..`",
    parts,
};

const ACCEL: [&str; 3] = ["gFx", "gFy", "gFz"];
const GYRO: [&str; 3] = ["wx", "wy", "wz"];
const FIELD: [&str; 3] = ["Bx", "By", "Bz"];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_header = |names: &[String]| {
        let has = |wanted: &str| names.iter().any(|name| name == wanted);
        // `time,wx,wy,wz` alone is what any program may write, and is read by its names.
        ACCEL.iter().any(|name| has(name))
    };
    let names = look.header(is_header)?;
    let column = |name: &str| numbered(&names, name);
    let mut columns = vec![(Role::Time, column("time").or_else(|| column("Time"))?)];
    for axis in 0..3 {
        columns.extend(column(ACCEL[axis]).map(|column| (Role::Accel(axis), column)));
        columns.extend(column(GYRO[axis]).map(|column| (Role::Gyro(axis), column)));
        columns.extend(column(FIELD[axis]).map(|column| (Role::Field(axis), column)));
    }
    Some(vec![Part {
        columns,
        accel_unit: Some(AccelUnit::G),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        field_unit: Some(FieldUnit::Microtesla),
        change: Some(crate::formats::texts::clock_text::change),
        ..Part::default()
    }])
}
