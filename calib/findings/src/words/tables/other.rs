//! Words of what has no group of its own.

use crate::words::entry::{Entry, care, remark};

/// The words of a finding whose text is its own.
pub(super) fn remark_of_its_own() -> Entry {
    Entry {
        reason: "{text}",
        text: "{text}",
        ..care(0.1)
    }
}

kinds! {
    /// The gyroscope turned without gravity to see its scale factors and misalignments by.
    NOT_SEEN_WITHOUT_GRAVITY = "not_seen_without_gravity" => Entry {
        reason: "the gyroscope's scale factors and misalignments are not known",
        text: "gyro scale factors and misalignments: no turn shows them without an accelerometer. They are those of a perfect sensor",
        ..care(0.1)
    },
    /// The earth's rate is too small to show the gyroscope's scale factors.
    NOT_SEEN_BY_EARTH_RATE = "not_seen_by_earth_rate" => Entry {
        reason: "the gyroscope's scale factors are not known",
        text: "gyro scale factors: the earth's rate is too small to show them. They are left at one",
        ..remark(0.001)
    },
    /// The earth's rotation is in a bias that is estimated again.
    EARTH_IN_BIAS = "earth_in_bias" => Entry {
        reason: "the earth's rotation is in the {sensor}'s bias",
        text: "at rest the {sensor} reads the earth's rotation beside its bias. What the \
           latitude of the calibration does not give is in the standard errors, up to ± {error}",
        ..remark(0.001)
    },
    /// A finding of another version, or one with a text of its own.
    REMARK = "remark" => remark_of_its_own(),
}
