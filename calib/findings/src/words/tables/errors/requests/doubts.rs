//! Words of calibrations that seem to be of another device, and of what was corrected before.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, UseOfResult, doubt};

kinds! {
    /// Corrected by a calibration the rate at rest is not zero.
    RATE_AT_REST_OFF = "rate_at_rest_off" => doubt(
        "corrected by this calibration the rate at rest is {rate}, where it should be zero. The calibration may be of another device, or for another unit of the gyroscope",
        "check device and unit first; if both are right, the bias has moved",
        vec![Remedy::UpdateBias],
    ),
    /// Corrected by a calibration the gyroscope misses gravity through turns.
    DIRECTION_OFF = "direction_off" => doubt(
        "after {count:turn} the corrected gyroscope misses the direction of gravity by {rms} (rms)[, and in the calibration's own recordings by {usual}]. The calibration may be of another device, or for another unit, sign or order of the axes",
        "correct unit, sign or order of the columns if they are not those of the calibration's recordings",
        vec![Remedy::OwnCalibration],
    ),
    /// Corrected by a calibration the specific force at rest is not gravity.
    NORM_OFF = "norm_off" => Entry {
        use_of_result: UseOfResult::Conditional,
        ..doubt(
            "at rest the corrected reading of the accelerometer differs from gravity by {rms} (rms)[, and in the calibration's own recordings by {usual}]. The calibration may be of another device",
            "use this calibration only if device and unit are those of its recordings",
            vec![Remedy::OwnCalibration],
        )
    },
    /// The norm of corrected readings is off by more than in the calibration's recordings.
    NORM_GROWN = "norm_grown" => doubt(
        "at rest the corrected reading of the accelerometer differs from gravity by {rms} (rms), and in the calibration's own recordings by {usual}. The sensor has changed since, as by temperature or age, or gravity is another here",
        "",
        vec![Remedy::CalibrateAgain],
    ),
    /// A recording misses gravity by more than the errors of a calibration allow.
    BEYOND_ERRORS = "beyond_errors" => doubt(
        "corrected by this calibration the {sensor} misses gravity by {rms} (rms), in a pattern {ratio} times as large as the calibration's standard errors and the noise make it. Its parameters have changed since by more than their errors, or gravity is another here",
        "",
        vec![Remedy::CalibrateAgain],
    ),
    /// The corrected magnetic field differs from rest to rest.
    FIELD_OFF = "field_off" => doubt(
        "the corrected magnetic field differs from one static interval to the next by {share} in strength and by {angle} in its angle to the vertical[, and in the calibration's own recordings by {usual}]. The magnetometer's bias has moved, its unit, signs or order of axes are others, the calibration is of another device, or iron was near",
        "calibrate the magnetometer again if unit, signs and order of the columns are those of the calibration's recordings",
        vec![Remedy::OwnCalibration],
    ),
    /// Readings were corrected before otherwise than those of the calibration.
    CORRECTED_OTHERWISE = "corrected_otherwise" => Entry {
        use_of_result: UseOfResult::Forbidden,
        ..doubt(
            "{by} had corrected the readings of the {sensor} in this recording before, and {own} those behind the calibration. So the calibration does not hold for this recording",
            "do not use the corrected readings; calibrate from recordings that were corrected as this one",
            vec![],
        )
    },
    /// Readings of some recordings were corrected before.
    CORRECTED_IN_PART = "corrected_in_part" => doubt(
        "{by} had corrected the readings of the {sensor} before, and not those of {others}: one calibration does not hold for both",
        "calibrate these recordings apart",
        vec![],
    ),
    /// Gravity, a sensor or an effect of a calibration was edited.
    NUMBERS_EDITED = "numbers_edited" => doubt(
        "the calibration was edited since it was written: gravity, a sensor or an effect is not what was found (its numbers_sha256 differs)",
        "nothing has to be done if you edited it on purpose; else calibrate again",
        vec![],
    ),
    /// An entry beside the parameters of a calibration was edited: method, covariance, limits or inputs.
    BASIS_EDITED = "basis_edited" => doubt(
        "the calibration was edited since it was written: method, covariance, limits, inputs or another entry beside the parameters is not what was written (its basis_sha256 differs)",
        "nothing has to be done if you edited it on purpose; else calibrate again",
        vec![],
    ),
    /// An effect counts the time from the start of another recording.
    EFFECT_FROM_START = "effect_from_start" => doubt(
        "the calibration corrects {effect} by the time since the start of a recording that is not this one",
        "use it if the device was in the same state when this recording began, such as just switched on; else calibrate without {effect}",
        vec![],
    ),
    /// An effect holds in the recordings of a calibration only, and these are not known.
    EFFECT_OF_RECORDINGS = "effect_of_recordings" => doubt(
        "the calibration corrects {effect} ({parameter} = {value}). Only the recordings that it was made from had this error, and the file does not name them",
        "correct only those with it; for any other recording calibrate again without {effect}",
        vec![],
    ),
    /// Only the longest static interval is analysed.
    ONLY_REST_ANALYSED = "only_rest_analysed" => Entry {
        use_of_result: UseOfResult::Conditional,
        ..doubt(
            "the device moved during the recording. The program analyses only the longest rest, {at}",
            "use these values if this rest is the one you meant; else leave the device alone and record again",
            vec![Remedy::such_as(OptionName::Rest, "60,3600")],
        )
    },
}
