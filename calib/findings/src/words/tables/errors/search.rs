//! Words of searches that cannot be made, and of what no recording by hand shows.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::AccelerometerNeeded,
        "no accelerometer: gravity is the reference that the model is checked against",
        "record an accelerometer too",
        Vec::new,
    ),
    Entry::error(
        Kind::TooFewForSearch,
        "{count:static interval}, too few to tell a missing effect from a scale factor; {requirement}",
        "{wanted}",
        Vec::new,
    ),
    Entry::error(
        Kind::NothingToCompare,
        "the base models use up all {rows} readings: nothing is left that an effect could show in; {requirement}",
        "record more placements",
        Vec::new,
    ),
    Entry::error(Kind::NothingTied, "no effects that are tied", "", Vec::new),
    Entry::error(
        Kind::NoPlacements,
        "no placements to begin with",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::OneUnitOnly,
        "one unit: units of a type show what they share from two of them on",
        "name recordings of two units or more",
        Vec::new,
    ),
    Entry::error(
        Kind::WholeRecordingNeeded,
        "the effect {effect} looks at the {quantity}, which one reading does not tell",
        "correct the whole recording",
        Vec::new,
    ),
    Entry::error(
        Kind::NoiseOfOneSensor,
        "no {sensor}: densities of both sensors are needed",
        "",
        || vec![Remedy::RestLonger],
    ),
    Entry::error(
        Kind::WalkUnbounded,
        "the random walk of the {sensor} is not bounded",
        "record longer at rest (an hour or more)",
        || {
            vec![Remedy::Omit {
                option: OptionName::Noise,
            }]
        },
    ),
    Entry::error(
        Kind::WalkImpossible,
        "a random walk of {density} per root second for the {sensor}: no inertial sensor wanders by more than {largest}",
        "correct the file",
        Vec::new,
    ),
    Entry::error(Kind::NotANoiseFile, "no noise file: {reason}", "", || {
        vec![Remedy::AnalyseNoise]
    }),
    Entry::error(
        Kind::OtherSchema,
        "schema \"{found}\" found, \"{expected}\" expected",
        "",
        Vec::new,
    ),
    Entry {
        kind: Kind::WalkOnlyBounded,
        level: Level::Remark,
        severity: 0.001,
        reason: "the random walk of the {sensor} is only bounded",
        text: "the random walk of the {sensor} is only bounded there. Its bound is used, which may hide a small effect",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::GravityNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a wrong value of local gravity",
        text: "a wrong value of local gravity: it is a common scale of the accelerometer",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ClockNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "a clock that runs fast or slow",
        text: "a clock that runs fast or slow: it is a common scale of the gyroscope",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::DistanceNeverSeen,
        level: Level::Remark,
        severity: 0.001,
        reason: "the distance between the accelerometer's axes (size effect)",
        text: "the distance between the accelerometer's axes (size effect): the device does not turn at rest",
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
        text: "isotropic g-sensitivity against the vertical part of the earth's rate, where no latitude is given",
        advice: "",
        remedies: Vec::new,
    },
];
