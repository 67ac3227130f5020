//! Words of static intervals that are given, missing or too few.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(Kind::NoSamples, "a sensor has no samples", "", Vec::new),
    Entry::error(
        Kind::TooShort,
        "{length} of samples: the detector looks at windows of {window}",
        "record longer",
        Vec::new,
    ),
    Entry::error(
        Kind::SampledSlowly,
        "a sample every {step} ({rate}): too few to follow a turn, and the detector's window of {window} holds fewer than {least}",
        "",
        || vec![Remedy::SampleFaster],
    ),
    Entry::error(
        Kind::SectionsColumns,
        "columns {columns} found; t0,t1 (seconds) or start,stop (sample numbers) expected",
        "",
        Vec::new,
    ),
    Entry::error(Kind::SectionsUnreadable, "{reason}", "", Vec::new),
    Entry::error(
        Kind::SamplesOutside,
        "samples {from} to {to} found, within 1 to {count} expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::IntervalEmpty,
        "the interval {from} to {to} is empty",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::IntervalsOverlap,
        "starts at {from} s, before the end of the one above ({end} s)",
        "",
        Vec::new,
    ),
    Entry::error(Kind::NoIntervals, "no interval for {named}", "", Vec::new),
    Entry::error(
        Kind::NoIntervalThere,
        "no static interval at t = {instant} s that could be left out[; the nearest lasts from {from} to {to} s]",
        "",
        Vec::new,
    ),
];
