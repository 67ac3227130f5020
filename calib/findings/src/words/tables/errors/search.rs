//! Words of searches that cannot be made, and of what no recording by hand shows.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::AccelerometerNeeded,
        "the recording has no accelerometer: gravity is the reference that the model is checked against",
        "record an accelerometer too",
        Vec::new,
    ),
    Entry::error(
        Kind::TooFewForSearch,
        "the recordings have {count:static interval}, too few to tell a missing effect from a scale factor; {requirement}",
        "{wanted}",
        Vec::new,
    ),
    Entry::error(
        Kind::NothingToCompare,
        "the model has as many unknowns as the recordings have values to fit ({rows}), so that no further error can show; {requirement}",
        "record more placements",
        Vec::new,
    ),
    Entry::error(
        Kind::NothingTied,
        "the findings name no errors that fit equally well, so no recording is needed to tell such errors apart",
        "plan a recording without these findings, or use them as they are",
        Vec::new,
    ),
    Entry::error(
        Kind::NoPlacements,
        "no recording of so few placements tells the errors apart that the findings leave open",
        "plan with a larger number of placements",
        Vec::new,
    ),
    Entry::error(
        Kind::OneUnitOnly,
        "recordings of one device only are given: what devices of a type share shows from two of them on",
        "name recordings of two devices or more",
        Vec::new,
    ),
    Entry::error(
        Kind::WholeRecordingNeeded,
        "the calibration corrects the error {effect}, which depends on the {quantity}, and a single reading does not tell that",
        "correct the whole recording at once instead of reading by reading",
        Vec::new,
    ),
    Entry::error(
        Kind::NoiseOfOneSensor,
        "the noise file has no {sensor}: the noise of both sensors is needed",
        "record both sensors at rest and analyse their noise again",
        Vec::new,
    ),
    Entry::error(
        Kind::WalkUnbounded,
        "the random walk (slow drift at random) of the {sensor} is not bounded by the noise file",
        "record longer at rest (an hour or more)",
        || {
            vec![Remedy::Omit {
                option: OptionName::Noise,
            }]
        },
    ),
    Entry::error(
        Kind::WalkImpossible,
        "the noise file gives a random walk (slow drift at random) of {density} per root second for the {sensor}: no such sensor wanders by more than {largest}",
        "check the unit of the recording that was analysed",
        || vec![Remedy::AnalyseNoise],
    ),
    Entry::error(
        Kind::NotANoiseFile,
        "this is no noise file: {reason}",
        "",
        || vec![Remedy::AnalyseNoise],
    ),
    Entry::error(
        Kind::OtherSchema,
        "the file is of another kind: schema \"{found}\" found, \"{expected}\" expected",
        "name the file that the noise analysis wrote",
        Vec::new,
    ),
    Entry {
        kind: Kind::WalkOnlyBounded,
        level: Level::Remark,
        severity: 0.001,
        reason: "the random walk of the {sensor} is only bounded",
        text: "the rest behind the noise file was too short to measure the random walk of the {sensor} (slow drift at random). The program uses its upper bound, which may hide a small effect",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::GravityNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a wrong value of local gravity",
        text: "a wrong value of local gravity: calibration cannot notice it, for it looks like a common scale factor of the accelerometer",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ClockNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a clock that runs fast or slow",
        text: "a clock that runs fast or slow: calibration cannot notice it, for it looks like a common scale factor of the gyroscope",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::DistanceNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "the distance between the accelerometer's axes (size effect)",
        text: "the distance between the accelerometer's axes (size effect): it shows only while the device turns, and calibration uses the accelerometer at rest",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::DelayNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a delay common to the three axes of the gyroscope",
        text: "a delay common to the three axes of the gyroscope: calibration cannot notice it, for every turn begins and ends at rest",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::EarthNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a gyroscope error in proportion to acceleration, alike on all axes",
        text: "a gyroscope error in proportion to acceleration, alike on all axes: without the latitude it looks like the vertical part of the earth's rotation",
        advice: "",
        remedies: Vec::new,
    },
];
