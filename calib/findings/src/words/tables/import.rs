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
        reason: "the imported calibration gives no uncertainties",
        text: "the calibration is imported from {tool} and gives no uncertainties",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::BiasNotStated,
        level: Level::Care,
        severity: 1.0,
        reason: "the imported calibration has no bias",
        text: "the calibration is imported from {tool}: its {sensors} have no bias (reading at rest). The program \
               takes the bias as 0",
        advice: "",
        remedies: || vec![Remedy::UpdateBias],
    },
    Entry {
        kind: Kind::BiasUnknown,
        level: Level::Remark,
        severity: 0.05,
        reason: "the bias of the {sensors} is not known",
        text: "the bias (the reading at rest) of the {sensors} is not known: the file corrects by none, or leaves its entries out",
        advice: "",
        remedies: || vec![Remedy::UpdateBias],
    },
    Entry {
        kind: Kind::FirstImuTaken,
        level: Level::Remark,
        severity: 0.001,
        reason: "of several units the first was read",
        text: "the file holds several devices: of {units} the program reads the first",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::EntryUnknown,
        level: Level::Remark,
        severity: 0.001,
        reason: "an entry of the file is not known",
        text: "{entry} is not read, because {tool} has no such entry",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::PlacesNotRead,
        level: Level::Remark,
        severity: 0.001,
        reason: "the positions of the accelerometer's axes are not read",
        text: "the program does not read where the axes of the accelerometer lie in the device ({entries}). This \
               matters only while the device turns",
        advice: "",
        remedies: Vec::new,
    },
];
