//! Words of searches that cannot be made, and of what no recording by hand shows.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, error, error_by, error_with, remark};

kinds! {
    /// The recording lacks an accelerometer.
    ACCELEROMETER_NEEDED = "accelerometer_needed" => error(
        "the recording has no accelerometer: gravity is the reference that the model is checked against",
        "record an accelerometer too",
    ),
    /// Static intervals are too few for a search.
    TOO_FEW_FOR_SEARCH = "too_few_for_search" => error(
        "the recordings have {count:static interval}, too few to tell a missing effect from a scale factor; {requirement}",
        "{wanted}",
    ),
    /// The base models use up all readings.
    NOTHING_TO_COMPARE = "nothing_to_compare" => error(
        "the model has as many unknowns as the recordings have values to fit ({rows}), so that no further error can show; {requirement}",
        "record more placements",
    ),
    /// No effects are tied.
    NOTHING_TIED = "nothing_tied" => error(
        "the findings name no errors that fit equally well, so no recording is needed to tell such errors apart",
        "plan a recording without these findings, or use them as they are",
    ),
    /// There are no placements to plan with.
    NO_PLACEMENTS = "no_placements" => error(
        "no recording of so few placements tells the errors apart that the findings leave open",
        "plan with a larger number of placements",
    ),
    /// One unit was given where several are needed.
    ONE_UNIT_ONLY = "one_unit_only" => error(
        "recordings of one device only are given: what devices of a type share shows from two of them on",
        "name recordings of two devices or more",
    ),
    /// An effect looks at more than one reading tells.
    WHOLE_RECORDING_NEEDED = "whole_recording_needed" => error(
        "the calibration corrects the error {effect}, which depends on the {quantity}, and a single reading does not tell that",
        "correct the whole recording at once instead of reading by reading",
    ),
    /// The noise file lacks a sensor.
    NOISE_OF_ONE_SENSOR = "noise_of_one_sensor" => error(
        "the noise file has no {sensor}: the noise of both sensors is needed",
        "record both sensors at rest and analyse their noise again",
    ),
    /// The noise file does not bound a random walk.
    WALK_UNBOUNDED = "walk_unbounded" => error_with(
        "the random walk (slow drift at random) of the {sensor} is not bounded by the noise file",
        "record longer at rest (an hour or more)",
        vec![Remedy::Omit {
            option: OptionName::Noise,
        }],
    ),
    /// The noise file has a random walk that no sensor has.
    WALK_IMPOSSIBLE = "walk_impossible" => error_with(
        "the noise file gives a random walk (slow drift at random) of {density} per root second for the {sensor}: no such sensor wanders by more than {largest}",
        "check the unit of the recording that was analysed",
        vec![Remedy::AnalyseNoise],
    ),
    /// The file is no noise file.
    NOT_A_NOISE_FILE = "not_a_noise_file" => error_by(
        "this is no noise file: {reason}",
        vec![Remedy::AnalyseNoise],
    ),
    /// The file has another schema than is expected.
    OTHER_SCHEMA = "other_schema" => error(
        "the file is of another kind: schema \"{found}\" found, \"{expected}\" expected",
        "name the file that the noise analysis wrote",
    ),
    /// The noise file only bounds a random walk.
    WALK_ONLY_BOUNDED = "walk_only_bounded" => Entry {
        reason: "the random walk of the {sensor} is only bounded",
        text: "the rest behind the noise file was too short to measure the random walk of the {sensor} (slow drift at random). The program uses its upper bound, which may hide a small effect",
        ..remark(0.001)
    },
    /// Local gravity cannot be told from a common scale.
    GRAVITY_NEVER_SEEN = "gravity_never_seen" => Entry {
        reason: "a wrong value of local gravity",
        text: "a wrong value of local gravity: calibration cannot notice it, for it looks like a common scale factor of the accelerometer",
        ..remark(0.001)
    },
    /// The rate of a clock cannot be told from a common scale.
    CLOCK_NEVER_SEEN = "clock_never_seen" => Entry {
        reason: "a clock that runs fast or slow",
        text: "a clock that runs fast or slow: calibration cannot notice it, for it looks like a common scale factor of the gyroscope",
        ..remark(0.001)
    },
    /// The distance between the accelerometer's axes never shows.
    DISTANCE_NEVER_SEEN = "distance_never_seen" => Entry {
        reason: "the distance between the accelerometer's axes (size effect)",
        text: "the distance between the accelerometer's axes (size effect): it shows only while the device turns, and calibration uses the accelerometer at rest",
        ..remark(0.001)
    },
    /// A delay common to the gyroscope's axes never shows.
    DELAY_NEVER_SEEN = "delay_never_seen" => Entry {
        reason: "a delay common to the three axes of the gyroscope",
        text: "a delay common to the three axes of the gyroscope: calibration cannot notice it, for every turn begins and ends at rest",
        ..remark(0.001)
    },
    /// Isotropic g-sensitivity cannot be told from the earth's rate.
    EARTH_NEVER_SEEN = "earth_never_seen" => Entry {
        reason: "a gyroscope error in proportion to acceleration, alike on all axes",
        text: "a gyroscope error in proportion to acceleration, alike on all axes: without the latitude it looks like the vertical part of the earth's rotation",
        ..remark(0.001)
    },
}
