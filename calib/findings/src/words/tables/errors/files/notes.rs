//! Words of remarks on calibrations for other tools.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    note(
        Kind::FrameTurned,
        "Kalibr's frame is turned by {angle} against that of the calibration: its M is lower triangular",
        "",
        Vec::new,
    ),
    note(
        Kind::TopicToAdd,
        "the file names no topic of the IMU",
        "add `rostopic` with it",
        Vec::new,
    ),
    note(
        Kind::DensitiesUnknown,
        "not known: {listed}. Kalibr wants a number of each",
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
        "imu_calib takes the gyroscope's bias from its first samples (calibrate_gyros)",
        "keep still then",
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
        "PX4 uses them where {ids} are the sensors' own",
        "let it calibrate once, then load these",
        Vec::new,
    ),
    note(
        Kind::OnTopOf,
        "{system} had corrected the readings of the {sensors} before: these parameters are on top of that",
        "use them on readings that are corrected in the same way, not on those of the sensor, and \
         calibrate again when that correction changes",
        Vec::new,
    ),
    note(
        Kind::NotApplied,
        "the functions do not apply {loss}: its parameters are in the file",
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
