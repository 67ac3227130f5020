//! Words of values that a request, a specification or a limit cannot have.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by};

kinds! {
    /// A value is outside of its range.
    OUT_OF_RANGE = "out_of_range" => error(
        "[{key}: ]is {value}, expected {expected}",
        "correct the value",
    ),
    /// A local gravity is that of no place on the earth.
    GRAVITY_NOT_ON_EARTH = "gravity_not_on_earth" => error(
        "gravity is given as {gravity} m/s², and on the earth it lies between {least} and {most} m/s². An error of 0.01 m/s² changes every scale factor by 0.1 %",
        "correct the value",
    ),
    /// A local gravity is that of no height at the latitude that is given.
    GRAVITY_NOT_OF_LATITUDE = "gravity_not_of_latitude" => error(
        "gravity is given as {gravity} m/s² and the latitude as {latitude}°, and there gravity is {normal} m/s²",
        "correct one of them, or give the latitude alone",
    ),
    /// An end comes before its begin, or a largest value before the least.
    BACKWARDS = "backwards" => error(
        "[{key}: ]from {from} to {to}: the smaller first expected",
        "exchange the two",
    ),
    /// A setting means nothing to the method that was asked for.
    NOT_OF_THIS_METHOD = "not_of_this_method" => error(
        "{setting} means nothing to the {method} method",
        "leave it out",
    ),
    /// The joint method is asked for without an accelerometer.
    METHOD_NEEDS_FORCE = "method_needs_force" => error_by(
        "the joint method needs recordings with an accelerometer",
        vec![Remedy::set_to(OptionName::Method, "stepwise")],
    ),
    /// No recording is given.
    RECORDINGS_MISSING = "recordings_missing" => error("no recording is given", "give one or more"),
    /// There are as many lists of sections as neither one nor recordings.
    SECTIONS_DO_NOT_FIT = "sections_do_not_fit" => error(
        "there are {count:list} of static intervals for {recordings:recording}",
        "give one for all or one for each",
    ),
    /// An instant to leave out is in no recording.
    INSTANT_OUTSIDE = "instant_outside" => error(
        "the program cannot leave out t = {time} s of recording {recording}. There are recordings 1 to {recordings}, and the time must be a number",
        "correct the time or the number of the recording",
    ),
    /// There are more or fewer of something than of its partner.
    COUNT_OTHER = "count_other" => error(
        "[{key}: ]{found} found, {expected} expected",
        "correct the number",
    ),
    /// A direction is zero.
    DIRECTION_ZERO = "direction_zero" => error("[{key}: ]is zero, expected a direction", "give a direction"),
    /// Counts are asked for without their unit.
    STEP_MISSING = "step_missing" => error(
        "[{key}: ]raw whole numbers (counts) need a `step`, the size of one count",
        "add it, as in step = 0.01",
    ),
    /// A filter leaves the noise as it is.
    FILTER_TOO_HIGH = "filter_too_high" => error(
        "[{key}: ]is above half the sampling rate: the noise would not change",
        "lower it, or leave it out",
    ),
    /// A fault happens in a placement or a turn that there is not.
    PLACE_MISSING = "place_missing" => error(
        "[{key}: ]is {place}, but there are {count} {things}, 0 the first",
        "choose one that is there",
    ),
    /// An effect has nothing in a simulation that it shows in.
    EFFECT_SILENT = "effect_silent" => error(
        "[{key}: ]has no effect without a `{section}` section",
        "add one",
    ),
    /// One thing is given in two ways.
    GIVEN_TWICE = "given_twice" => error(
        "[{key}: ]is given twice: `{other}` switches it on too",
        "leave one out",
    ),
    /// A simulation has more samples than the memory takes.
    TOO_LONG_FOR_MEMORY = "too_long_for_memory" => error(
        "the simulated {sensor} has {samples} samples, more than the memory holds",
        "write the recording to a file, or simulate a shorter one",
    ),
    /// A text is not TOML, or has keys that nobody knows.
    NOT_TOML = "not_toml" => error(
        "the program cannot read this place of the file: {reason}",
        "correct this line",
    ),
    /// A validation recording was in the fit.
    VALIDATION_SEEN = "validation_seen" => error(
        "validation has the data of {other}, which the fit has seen: what it shows there is no proof",
        "give another recording of the device",
    ),
}
