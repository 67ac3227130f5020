//! Words of the magnetometer and its field.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::FieldDisturbed,
        level: Level::Remark,
        severity: 0.5,
        reason: "the magnetic field is disturbed in a static interval",
        text: "in {at} the magnetic field is off by {size} from that of the others, as near iron, a magnet or a current. The magnetometer's reading there is not used",
        advice: "",
        remedies: || vec![Remedy::AwayFromIron],
    },
    Entry {
        kind: Kind::FieldUneven,
        level: Level::Care,
        severity: 0.5,
        reason: "the magnetic field is uneven",
        text: "the magnetic field differs by {size} per axis from one static interval to the next ({share} of it; the magnetometer's noise makes {noise}), as near iron or currents. The magnetometer's errors are enlarged to it",
        advice: "",
        remedies: || vec![Remedy::AwayFromIron],
    },
    Entry {
        kind: Kind::MagneticEffect,
        level: Level::Care,
        severity: 0.3,
        reason: "the model of the magnetometer lacks {effect}",
        text: "the readings of the magnetometer go with {effect} (p = {p}), which its model lacks. Its errors do not cover that",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Effects)],
    },
    Entry {
        kind: Kind::HeadingDisagrees,
        level: Level::Care,
        severity: 0.3,
        reason: "magnetometer and gyroscope disagree about the heading",
        text: "magnetometer and gyroscope disagree about the heading after turns by more than noise (p = {p}). The gyroscope is left as its turns alone show it",
        advice: "",
        remedies: || vec![Remedy::AwayFromIron],
    },
    Entry {
        kind: Kind::MagnetometerNotCalibrated,
        level: Level::Care,
        severity: 0.1,
        reason: "the magnetometer is not calibrated",
        text: "the magnetometer is not calibrated: {why}",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FieldTurned,
        level: Level::Care,
        severity: 30.0,
        reason: "the axes of the magnetometer are turned or mirrored",
        text: "the magnetometer's axes are turned against the accelerometer's: {axes}; T turns them back, and the corrected field points {angle} {side} the horizontal[, as it does {half} of the magnetic equator. Elsewhere the readings are mirrored and the corrected field points backwards]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FieldSignsWrong,
        level: Level::Care,
        severity: 30.0,
        reason: "signs of the magnetometer's axes are wrong",
        text: "the magnetic field points {angle} {side} the horizontal, at a latitude of {latitude}: the signs of an odd number of the magnetometer's axes, or of all of the accelerometer's, are wrong, and headings by the corrected field may be turned",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::UnitUnclear,
        level: Level::Care,
        severity: 0.1,
        reason: "the unit of the magnetometer is not known",
        text: "the unit of the magnetometer is known in this recording or in those of the calibration, and not in both. It is corrected as if it were the same",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::MagUnit)],
    },
];
