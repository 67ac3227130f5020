//! Words of what has no group of its own.

use crate::kind::Kind;

use crate::words::entry::{Entry, care, remark};

/// The words of a finding whose text is its own.
pub(super) fn remark_of_its_own() -> Entry {
    Entry {
        reason: "{text}",
        text: "{text}",
        ..care(0.1)
    }
}

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::NotSeenWithoutGravity => Entry {
            reason: "the gyroscope's scale factors and misalignments are not known",
            text: "gyro scale factors and misalignments: no turn shows them without an accelerometer. They are those of a perfect sensor",
            ..care(0.1)
        },
        Kind::NotSeenByEarthRate => Entry {
            reason: "the gyroscope's scale factors are not known",
            text: "gyro scale factors: the earth's rate is too small to show them. They are left at one",
            ..remark(0.001)
        },
        Kind::EarthInBias => Entry {
            reason: "the earth's rotation is in the {sensor}'s bias",
            text: "at rest the {sensor} reads the earth's rotation beside its bias. What the \
               latitude of the calibration does not give is in the standard errors, up to ± {error}",
            ..remark(0.001)
        },
        Kind::Remark => remark_of_its_own(),
        _ => return None,
    })
}
