//! Words of what an imported calibration lacks.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::ErrorsNotStated,
        level: Level::Remark,
        severity: 0.001,
        reason: "the imported calibration states no errors",
        text: "imported from {tool}: it states no errors",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::BiasNotStated,
        level: Level::Care,
        severity: 1.0,
        reason: "the imported calibration has no bias",
        text: "imported from {tool}: its {sensors} have no bias, which is taken as 0",
        advice: "",
        remedies: || vec![Remedy::UpdateBias],
    },
    Entry {
        kind: Kind::FirstImuTaken,
        level: Level::Remark,
        severity: 0.001,
        reason: "of several units the first was read",
        text: "of {units} the first is read",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::EntryUnknown,
        level: Level::Remark,
        severity: 0.001,
        reason: "an entry of the file is not known",
        text: "{entry} is not read: {tool} has no such entry",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::PlacesNotRead,
        level: Level::Remark,
        severity: 0.001,
        reason: "the places of the accelerometer's axes are not read",
        text: "the places of the accelerometer's axes ({entries}) are not read: they matter in turns only",
        advice: "",
        remedies: Vec::new,
    },
];
