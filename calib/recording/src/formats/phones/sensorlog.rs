//! SensorLog for iOS: per-sensor stamps since the last start of the phone, g, -1 g up.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::header::names::take_apart;
use crate::rows::parts::Part;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit};

/// A table of the app SensorLog.
pub(crate) static SENSORLOG: TextFormat = TextFormat {
    name: "sensorlog",
    about: "a table of the iOS app SensorLog: `accelerometerAccelerationX(G)`, `gyroRotationX(rad/s)`",
    parts,
};

/// Stems of a sensor's columns, with its stamps.
struct Columns {
    sensor: Sensor,
    stamps: &'static [&'static str],
    axes: &'static str,
}

const ACCEL: Columns = Columns {
    sensor: Sensor::Accelerometer,
    stamps: &[
        "accelerometertimestampsincereboot",
        "accelerometertimestamp",
    ],
    axes: "accelerometeracceleration",
};
const GYRO: Columns = Columns {
    sensor: Sensor::Gyroscope,
    stamps: &["gyrotimestampsincereboot", "gyrotimestamp"],
    axes: "gyrorotation",
};
/// The gyroscope after the system has taken its bias off, with the stamps that such rows have.
const PROCESSED: Columns = Columns {
    sensor: Sensor::Gyroscope,
    stamps: &[
        "motiontimestampsincereboot",
        "motiontimestamp",
        "devicemotiontimestampsincereboot",
    ],
    axes: "motionrotationrate",
};
/// Stamps of the row, for a sensor without its own.
const ROW: &[&str] = &["loggingtime", "accelerometertimestampsincereboot"];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_header = |names: &[String]| {
        let has = |start: &str| names.iter().any(|name| name.starts_with(start));
        has("accelerometerAcceleration") || has("gyroRotation")
    };
    let names = look.header(is_header)?;
    let accel = ACCEL.part(&names).map(|part| Part {
        accel_unit: Some(AccelUnit::G),
        negated: true,
        remark: Some(Finding::of(Kind::SIGN_TURNED).detail("system", "SensorLog")),
        ..part
    });
    let gyro = GYRO.part(&names).or_else(|| {
        let part = PROCESSED.part(&names)?;
        let corrected = Finding::of(Kind::CORRECTED_BY_SYSTEM)
            .detail("system", "iOS")
            .detail("columns", "motionRotationRate")
            .detail("raw", "gyroRotation");
        Some(Part {
            remark: Some(corrected),
            corrected_by: Some("ios"),
            ..part
        })
    });
    let gyro = gyro.map(|part| Part {
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        ..part
    });
    let field = field(&names);
    let parts: Vec<Part> = accel.into_iter().chain(gyro).chain(field).collect();
    (parts.iter().any(|part| !part.is_field())).then_some(parts)
}

/// The magnetometer, by its own stamps or the row's.
fn field(names: &[String]) -> Option<Part> {
    let find = |wanted: &str| column(names, wanted);
    let stamps = ["magnetometertimestampsincereboot", "magnetometertimestamp"];
    let stamps = stamps.iter().chain(ROW).find_map(|name| find(name))?;
    let axis = |axis: &str| find(&format!("magnetometer{axis}"));
    let [x, y, z] = [axis("x")?, axis("y")?, axis("z")?];
    Some(Part {
        field_unit: Some(FieldUnit::Microtesla),
        ..Part::of(Sensor::Magnetometer, [&stamps, &x, &y, &z])
    })
}

/// The column whose name is `wanted` but for marks and unit.
fn column(names: &[String], wanted: &str) -> Option<String> {
    let name = names.iter().find(|name| take_apart(name).0 == wanted)?;
    numbered(names, name)
}

impl Columns {
    fn part(&self, names: &[String]) -> Option<Part> {
        let find = |wanted: &str| column(names, wanted);
        let axis = |axis: &str| find(&format!("{}{axis}", self.axes));
        let stamps = self.stamps.iter().chain(ROW).find_map(|name| find(name))?;
        let [x, y, z] = [axis("x")?, axis("y")?, axis("z")?];
        Some(Part::of(self.sensor, [&stamps, &x, &y, &z]))
    }
}
