//! Words of values that a request, a specification or a limit cannot have.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::OutOfRange,
        "[{key}: ]is {value}, expected {expected}",
        "correct the value",
        Vec::new,
    ),
    Entry::error(
        Kind::GravityNotOnEarth,
        "gravity is given as {gravity} m/s², and on the earth it lies between {least} and {most} m/s². An error of 0.01 m/s² changes every scale factor by 0.1 %",
        "correct the value",
        Vec::new,
    ),
    Entry::error(
        Kind::Backwards,
        "[{key}: ]from {from} to {to}: the smaller first expected",
        "exchange the two",
        Vec::new,
    ),
    Entry::error(
        Kind::NotOfThisMethod,
        "{setting} means nothing to the {method} method",
        "leave it out",
        Vec::new,
    ),
    Entry::error(
        Kind::MethodNeedsForce,
        "the joint method needs recordings with an accelerometer",
        "",
        || vec![Remedy::set_to(OptionName::Method, "stepwise")],
    ),
    Entry::error(
        Kind::RecordingsMissing,
        "no recording is given",
        "give one or more",
        Vec::new,
    ),
    Entry::error(
        Kind::SectionsDoNotFit,
        "there are {count:list} of static intervals for {recordings:recording}",
        "give one for all or one for each",
        Vec::new,
    ),
    Entry::error(
        Kind::InstantOutside,
        "the program cannot leave out t = {time} s of recording {recording}. There are recordings 1 to {recordings}, and the time must be a number",
        "correct the time or the number of the recording",
        Vec::new,
    ),
    Entry::error(
        Kind::CountOther,
        "[{key}: ]{found} found, {expected} expected",
        "correct the number",
        Vec::new,
    ),
    Entry::error(
        Kind::DirectionZero,
        "[{key}: ]is zero, expected a direction",
        "give a direction",
        Vec::new,
    ),
    Entry::error(
        Kind::StepMissing,
        "[{key}: ]raw whole numbers (counts) need a `step`, the size of one count",
        "add it, as in step = 0.01",
        Vec::new,
    ),
    Entry::error(
        Kind::FilterTooHigh,
        "[{key}: ]is above half the sampling rate: the noise would not change",
        "lower it, or leave it out",
        Vec::new,
    ),
    Entry::error(
        Kind::PlaceMissing,
        "[{key}: ]is {place}, but there are {count} {things}, 0 the first",
        "choose one that is there",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectSilent,
        "[{key}: ]has no effect without a `{section}` section",
        "add one",
        Vec::new,
    ),
    Entry::error(
        Kind::GivenTwice,
        "[{key}: ]is given twice: `{other}` switches it on too",
        "leave one out",
        Vec::new,
    ),
    Entry::error(
        Kind::TooLongForMemory,
        "the simulated {sensor} has {samples} samples, more than the memory holds",
        "write the recording to a file, or simulate a shorter one",
        Vec::new,
    ),
    Entry::error(
        Kind::NotToml,
        "the program cannot read this place of the file: {reason}",
        "correct this line",
        Vec::new,
    ),
    Entry::error(
        Kind::ValidationSeen,
        "validation has the data of {other}, which the fit has seen: what it shows there is no proof",
        "give another recording of the device",
        Vec::new,
    ),
];
