//! Words of what has no group of its own.

use crate::kind::Kind;
use crate::level::Level;

use crate::words::entry::Entry;

/// A finding whose text is its own.
pub(super) const REMARK: Entry = Entry {
    kind: Kind::Remark,
    level: Level::Care,
    severity: 0.1,
    reason: "{text}",
    text: "{text}",
    advice: "",
    remedies: Vec::new,
};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::NotSeenWithoutGravity,
        level: Level::Remark,
        severity: 0.001,
        reason: "the gyroscope's scale factors and misalignments are not known",
        text: "gyro scale factors and misalignments: no turn shows them without an accelerometer. They are those of a perfect sensor",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NotSeenByEarthRate,
        level: Level::Remark,
        severity: 0.001,
        reason: "the gyroscope's scale factors are not known",
        text: "gyro scale factors: the earth's rate is too small to show them. They are left at one",
        advice: "",
        remedies: Vec::new,
    },
    REMARK,
];
