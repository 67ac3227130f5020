//! Words of static intervals that are given, missing or too few.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::NoSamples => error_with(
            "the accelerometer or the gyroscope has no samples",
            "look in the file which of the two has no readings and record that sensor again",
            vec![Remedy::set(OptionName::Sensor)],
        ),
        Kind::TooShort => error(
            "the recording has {length} of samples, and the search for rests looks at windows of {window}",
            "record longer: hold the device still for 5 s in each of at least ten placements",
        ),
        Kind::SampledSlowly => error(
            "the recording has a sample every {step} ({rate}), too few to follow a turn. The search for rests needs {least} or more in {window}",
            "record at 100 Hz or more",
        ),
        Kind::SectionsColumns => error(
            "columns {columns} found; t0,t1 (seconds) or start,stop (sample numbers) expected",
            "correct the header",
        ),
        Kind::SectionsUnreadable => error(
            "this line of the file of intervals cannot be read: {reason}",
            "correct the line",
        ),
        Kind::SamplesOutside => error(
            "samples {from} to {to} found, within 1 to {count} expected",
            "correct the line",
        ),
        Kind::IntervalEmpty => error(
            "the interval {from} to {to} is empty: it ends before or where it starts",
            "correct the line",
        ),
        Kind::IntervalsOverlap => error(
            "this interval starts at {from} s, before the end of the one above ({end} s)",
            "correct the line",
        ),
        Kind::NoIntervals => error(
            "the file of intervals has no interval for {named}",
            "add one for it",
        ),
        Kind::NoIntervalThere => error(
            "no static interval at t = {instant} s that could be left out[; the nearest lasts from {from} to {to} s]",
            "name a time within a static interval",
        ),
        _ => return None,
    })
}
