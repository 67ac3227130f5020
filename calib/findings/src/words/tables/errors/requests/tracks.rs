//! Words of stretches that cannot be used for a track or for the noise.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::MotionMissing,
        "no motion after a rest of {rest} found",
        "",
        || vec![Remedy::set(OptionName::Motion)],
    ),
    Entry::error(
        Kind::MotionOutside,
        "motion from {from} to {to}: the recording runs from {start} to {end} and must be at rest for at least {rest} before the motion",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SamplesTooFew,
        "{count} {sensor} samples in the motion, at least {least} needed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSamplesAtRest,
        "no samples between {t0} and {t1}, at rest before the motion",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NeverAtRest,
        "the device moved, and its longest static interval lasts {length}: an Allan deviation needs a recording at rest",
        "leave the device alone for an hour",
        || vec![Remedy::set(OptionName::Rest)],
    ),
];
