//! Words of what changes part of the way through a recording.

use crate::remedy::Remedy;

use crate::words::entry::{Entry, UseOfResult, care};

/// Advice for a recording of two parts.
const ONE_PART: &str =
    "do not use this calibration; split the recording at this place and calibrate the longer part";

kinds! {
    /// A bias steps part of the way.
    BIAS_STEP = "bias_step" => Entry {
        reason: "the bias of the {sensor} jumps part of the way",
        text: "the bias of the {sensor} on {axis} jumps by {size} between static intervals {after} and {before} ({at}). One calibration does not hold for both parts",
        advice: ONE_PART,
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.5)
    },
    /// A scale factor changes part of the way.
    SCALE_CHANGE = "scale_change" => Entry {
        reason: "the scale of the {sensor} changes part of the way",
        text: "the scale factor of the {sensor} on {axis} changes by {size} between static intervals {after} and {before} ({at})[, as with another unit or range of the {force}][, as with another range of the {rate}, or a clock that runs at another rate]. One calibration does not hold for both parts",
        advice: ONE_PART,
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(3.0)
    },
    /// The axes turn part of the way.
    AXES_TURN_PART_WAY = "axes_turn_part_way" => Entry {
        reason: "the axes of the {sensor} turn part of the way",
        text: "the axes of the {sensor} turn by {size} between static intervals {after} and {before} ({at}), as if the sensor had moved in its case. One calibration does not hold for both parts",
        advice: ONE_PART,
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(5.0)
    },
    /// An axis changes its sign part of the way.
    SIGN_CHANGE = "sign_change" => Entry {
        reason: "an axis of the {sensor} changes its sign part of the way",
        text: "the {axis} axis of the {sensor} changes its sign between static intervals {after} and {before} ({at}). One calibration does not hold for both parts",
        advice: ONE_PART,
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(30.0)
    },
    /// Two columns change places part of the way.
    COLUMNS_SWAP_PART_WAY = "columns_swap_part_way" => Entry {
        reason: "two columns of the {sensor} change places part of the way",
        text: "the columns {axis} of the {sensor} change places between static intervals {after} and {before} ({at}). One calibration does not hold for both parts",
        advice: ONE_PART,
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(30.0)
    },
    /// A turn misses gravity where all others meet it.
    TURN_OFF = "turn_off" => Entry {
        reason: "{at} misses gravity, and the other turns do not",
        text: "{at} misses gravity by {size}: unlike the other turns, it does not lead to the direction that the accelerometer reads after it. Perhaps rows are lost, repeated or moved in it, or the clock jumped",
        advice: "do not use the gyroscope's part of this calibration",
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.3)
    },
    /// One static interval lies off the direction that the turns carry.
    INTERVAL_OFF = "interval_off" => Entry {
        reason: "{at} disagrees with the turns before and after it",
        text: "the direction of gravity in {at} is {size} off that to which the turns before and after it lead. The device may have been touched. Leaving the interval out is enough while ten others remain",
        remedies: vec![Remedy::LeaveOut, Remedy::RecordAgain],
        ..care(0.2)
    },
}
