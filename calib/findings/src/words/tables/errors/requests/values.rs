//! Words of values that a request, a specification or a limit cannot have.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::OutOfRange => error(
            "[{key}: ]is {value}, expected {expected}",
            "correct the value",
        ),
        Kind::GravityNotOnEarth => error(
            "gravity is given as {gravity} m/s², and on the earth it lies between {least} and {most} m/s². An error of 0.01 m/s² changes every scale factor by 0.1 %",
            "correct the value",
        ),
        Kind::GravityNotOfLatitude => error(
            "gravity is given as {gravity} m/s² and the latitude as {latitude}°, and there gravity is {normal} m/s²",
            "correct one of them, or give the latitude alone",
        ),
        Kind::Backwards => error(
            "[{key}: ]from {from} to {to}: the smaller first expected",
            "exchange the two",
        ),
        Kind::NotOfThisMethod => error(
            "{setting} means nothing to the {method} method",
            "leave it out",
        ),
        Kind::MethodNeedsForce => error_by(
            "the joint method needs recordings with an accelerometer",
            vec![Remedy::set_to(OptionName::Method, "stepwise")],
        ),
        Kind::RecordingsMissing => error("no recording is given", "give one or more"),
        Kind::SectionsDoNotFit => error(
            "there are {count:list} of static intervals for {recordings:recording}",
            "give one for all or one for each",
        ),
        Kind::InstantOutside => error(
            "the program cannot leave out t = {time} s of recording {recording}. There are recordings 1 to {recordings}, and the time must be a number",
            "correct the time or the number of the recording",
        ),
        Kind::CountOther => error(
            "[{key}: ]{found} found, {expected} expected",
            "correct the number",
        ),
        Kind::DirectionZero => error("[{key}: ]is zero, expected a direction", "give a direction"),
        Kind::StepMissing => error(
            "[{key}: ]raw whole numbers (counts) need a `step`, the size of one count",
            "add it, as in step = 0.01",
        ),
        Kind::FilterTooHigh => error(
            "[{key}: ]is above half the sampling rate: the noise would not change",
            "lower it, or leave it out",
        ),
        Kind::PlaceMissing => error(
            "[{key}: ]is {place}, but there are {count} {things}, 0 the first",
            "choose one that is there",
        ),
        Kind::EffectSilent => error(
            "[{key}: ]has no effect without a `{section}` section",
            "add one",
        ),
        Kind::GivenTwice => error(
            "[{key}: ]is given twice: `{other}` switches it on too",
            "leave one out",
        ),
        Kind::TooLongForMemory => error(
            "the simulated {sensor} has {samples} samples, more than the memory holds",
            "write the recording to a file, or simulate a shorter one",
        ),
        Kind::NotToml => error(
            "the program cannot read this place of the file: {reason}",
            "correct this line",
        ),
        Kind::ValidationSeen => error(
            "validation has the data of {other}, which the fit has seen: what it shows there is no proof",
            "give another recording of the device",
        ),
        _ => return None,
    })
}
