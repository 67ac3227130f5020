//! Words of static intervals that are given, missing or too few.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::NoSamples,
        "the accelerometer or the gyroscope has no samples",
        "look in the file which of the two has no readings and record that sensor again",
        || vec![Remedy::set(OptionName::Sensor)],
    ),
    Entry::error(
        Kind::TooShort,
        "the recording has {length} of samples, and the search for rests looks at windows of {window}",
        "record longer: hold the device still for 5 s in each of at least ten placements",
        Vec::new,
    ),
    Entry::error(
        Kind::SampledSlowly,
        "the recording has a sample every {step} ({rate}), too few to follow a turn. The search for rests needs {least} or more in {window}",
        "record at 100 Hz or more",
        Vec::new,
    ),
    Entry::error(
        Kind::SectionsColumns,
        "columns {columns} found; t0,t1 (seconds) or start,stop (sample numbers) expected",
        "correct the header",
        Vec::new,
    ),
    Entry::error(
        Kind::SectionsUnreadable,
        "this line of the file of intervals cannot be read: {reason}",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::SamplesOutside,
        "samples {from} to {to} found, within 1 to {count} expected",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::IntervalEmpty,
        "the interval {from} to {to} is empty: it ends before or where it starts",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::IntervalsOverlap,
        "this interval starts at {from} s, before the end of the one above ({end} s)",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::NoIntervals,
        "the file of intervals has no interval for {named}",
        "add one for it",
        Vec::new,
    ),
    Entry::error(
        Kind::NoIntervalThere,
        "no static interval at t = {instant} s that could be left out[; the nearest lasts from {from} to {to} s]",
        "name a time within a static interval",
        Vec::new,
    ),
];
