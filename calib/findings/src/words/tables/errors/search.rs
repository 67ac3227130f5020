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
        "the models without the effect use up all {rows} readings: nothing is left that an effect could show in; {requirement}",
        "record more placements",
        Vec::new,
    ),
    Entry::error(
        Kind::NothingTied,
        "there are no effects that fit equally well, so no recording has to tell them apart",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoPlacements,
        "the plan has no placements to begin with",
        "ask for more placements",
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
        "the effect {effect} looks at the {quantity}, which one reading does not tell",
        "correct the whole recording at once",
        Vec::new,
    ),
    Entry::error(
        Kind::NoiseOfOneSensor,
        "the noise file has no {sensor}: the noise of both sensors is needed",
        "record both sensors at rest and analyse their noise again",
        || vec![Remedy::RestLonger],
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
        "the noise file gives a random walk (slow drift at random) of {density} per root second for the {sensor}: no inertial sensor wanders by more than {largest}",
        "correct the file",
        Vec::new,
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
        text: "a wrong value of local gravity: it looks like a common scale of the accelerometer",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ClockNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a clock that runs fast or slow",
        text: "a clock that runs fast or slow: it looks like a common scale of the gyroscope",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::DistanceNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "the distance between the accelerometer's axes (size effect)",
        text: "the distance between the accelerometer's axes (size effect): it shows only while the device turns, and the fit uses the device at rest",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::DelayNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a delay common to the three axes of the gyroscope",
        text: "a delay common to the three axes of the gyroscope: turns begin and end at rest",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::EarthNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "g-sensitivity alike on all axes against the vertical rate of the earth",
        text: "the same effect of acceleration on all axes of the gyroscope (isotropic g-sensitivity), against the vertical part of the earth's rate, where no latitude is given",
        advice: "",
        remedies: Vec::new,
    },
];
