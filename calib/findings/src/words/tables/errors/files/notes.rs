//! Words of remarks on calibrations for other tools.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    note(
        Kind::FrameTurned,
        "Kalibr's axes are turned by {angle} against those of the calibration: its matrix M is lower triangular, and the program has turned the parameters to it",
        "",
        Vec::new,
    ),
    note(
        Kind::TopicToAdd,
        "the file that was written names no topic of the IMU, which Kalibr needs",
        "add a line `rostopic` with the topic to the file",
        Vec::new,
    ),
    note(
        Kind::DensitiesUnknown,
        "the calibration does not tell {listed}, of which Kalibr wants a number each",
        "",
        || vec![Remedy::AnalyseNoise],
    ),
    note(
        Kind::OffsetsMeasuredAgain,
        "{system} measures the gyroscope's offsets again at every start unless {parameter} is 0",
        "",
        Vec::new,
    ),
    note(
        Kind::BiasFromStart,
        "imu_calib takes the gyroscope's bias (its reading at rest) from its first samples (calibrate_gyros)",
        "keep the device still while imu_calib starts",
        Vec::new,
    ),
    note(
        Kind::MaybeCorrected,
        "the parameters are for what the sensors read. If the recording is of {stream}, {system} had \
         corrected it by the parameters that were in force",
        "",
        || vec![Remedy::set(OptionName::LoggedWith)],
    ),
    note(
        Kind::SensorsByIds,
        "PX4 uses these parameters only where {ids} are the ids of the vehicle's own sensors",
        "let PX4 calibrate once, then load these parameters",
        Vec::new,
    ),
    note(
        Kind::OnTopOf,
        "{system} had corrected the readings of the {sensors} before: these parameters are on top of that correction",
        "use them on readings that are corrected in the same way, not on those of the sensor, and calibrate again when that correction changes",
        Vec::new,
    ),
    note(
        Kind::NotApplied,
        "the functions that were written do not apply {loss}. Its parameters are in the file",
        "",
        Vec::new,
    ),
    note(
        Kind::LostInExport,
        "{what}[: up to {size} at {signal}]",
        "",
        Vec::new,
    ),
];

/// A remark that no verdict counts.
const fn note(
    kind: Kind,
    text: &'static str,
    advice: &'static str,
    remedies: fn() -> Vec<Remedy>,
) -> Entry {
    Entry {
        kind,
        level: Level::Remark,
        severity: 0.0,
        reason: "",
        text,
        advice,
        remedies,
    }
}
