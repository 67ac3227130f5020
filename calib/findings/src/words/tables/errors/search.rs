//! Words of searches that cannot be made, and of what no recording by hand shows.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, error, error_by, error_with, remark};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::AccelerometerNeeded => error(
            "the recording has no accelerometer: gravity is the reference that the model is checked against",
            "record an accelerometer too",
        ),
        Kind::TooFewForSearch => error(
            "the recordings have {count:static interval}, too few to tell a missing effect from a scale factor; {requirement}",
            "{wanted}",
        ),
        Kind::NothingToCompare => error(
            "the model has as many unknowns as the recordings have values to fit ({rows}), so that no further error can show; {requirement}",
            "record more placements",
        ),
        Kind::NothingTied => error(
            "the findings name no errors that fit equally well, so no recording is needed to tell such errors apart",
            "plan a recording without these findings, or use them as they are",
        ),
        Kind::NoPlacements => error(
            "no recording of so few placements tells the errors apart that the findings leave open",
            "plan with a larger number of placements",
        ),
        Kind::OneUnitOnly => error(
            "recordings of one device only are given: what devices of a type share shows from two of them on",
            "name recordings of two devices or more",
        ),
        Kind::WholeRecordingNeeded => error(
            "the calibration corrects the error {effect}, which depends on the {quantity}, and a single reading does not tell that",
            "correct the whole recording at once instead of reading by reading",
        ),
        Kind::NoiseOfOneSensor => error(
            "the noise file has no {sensor}: the noise of both sensors is needed",
            "record both sensors at rest and analyse their noise again",
        ),
        Kind::WalkUnbounded => error_with(
            "the random walk (slow drift at random) of the {sensor} is not bounded by the noise file",
            "record longer at rest (an hour or more)",
            vec![Remedy::Omit {
                option: OptionName::Noise,
            }],
        ),
        Kind::WalkImpossible => error_with(
            "the noise file gives a random walk (slow drift at random) of {density} per root second for the {sensor}: no such sensor wanders by more than {largest}",
            "check the unit of the recording that was analysed",
            vec![Remedy::AnalyseNoise],
        ),
        Kind::NotANoiseFile => error_by(
            "this is no noise file: {reason}",
            vec![Remedy::AnalyseNoise],
        ),
        Kind::OtherSchema => error(
            "the file is of another kind: schema \"{found}\" found, \"{expected}\" expected",
            "name the file that the noise analysis wrote",
        ),
        Kind::WalkOnlyBounded => Entry {
            reason: "the random walk of the {sensor} is only bounded",
            text: "the rest behind the noise file was too short to measure the random walk of the {sensor} (slow drift at random). The program uses its upper bound, which may hide a small effect",
            ..remark(0.001)
        },
        Kind::GravityNeverSeen => Entry {
            reason: "a wrong value of local gravity",
            text: "a wrong value of local gravity: calibration cannot notice it, for it looks like a common scale factor of the accelerometer",
            ..remark(0.001)
        },
        Kind::ClockNeverSeen => Entry {
            reason: "a clock that runs fast or slow",
            text: "a clock that runs fast or slow: calibration cannot notice it, for it looks like a common scale factor of the gyroscope",
            ..remark(0.001)
        },
        Kind::DistanceNeverSeen => Entry {
            reason: "the distance between the accelerometer's axes (size effect)",
            text: "the distance between the accelerometer's axes (size effect): it shows only while the device turns, and calibration uses the accelerometer at rest",
            ..remark(0.001)
        },
        Kind::DelayNeverSeen => Entry {
            reason: "a delay common to the three axes of the gyroscope",
            text: "a delay common to the three axes of the gyroscope: calibration cannot notice it, for every turn begins and ends at rest",
            ..remark(0.001)
        },
        Kind::EarthNeverSeen => Entry {
            reason: "a gyroscope error in proportion to acceleration, alike on all axes",
            text: "a gyroscope error in proportion to acceleration, alike on all axes: without the latitude it looks like the vertical part of the earth's rotation",
            ..remark(0.001)
        },
        _ => return None,
    })
}
