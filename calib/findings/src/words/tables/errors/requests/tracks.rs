//! Words of stretches that cannot be used for a track or for the noise.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::MotionMissing,
        "no motion was found after a rest of {rest}",
        "",
        || vec![Remedy::set(OptionName::Motion)],
    ),
    Entry::error(
        Kind::MotionOutside,
        "motion from {from} to {to}: the recording runs from {start} to {end} and must be at rest for at least {rest} before the motion",
        "name a motion within it",
        Vec::new,
    ),
    Entry::error(
        Kind::SamplesTooFew,
        "the motion has {count} {sensor} samples, at least {least} needed",
        "choose a longer motion",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSamplesAtRest,
        "no samples between {t0} and {t1} are in the recording, and the device must rest then, before the motion",
        "choose another motion",
        Vec::new,
    ),
    Entry::error(
        Kind::NeverAtRest,
        "the device moved, and its longest static interval lasts {length}: the analysis of noise (Allan deviation) needs a recording at rest",
        "leave the device alone for an hour",
        || vec![Remedy::set(OptionName::Rest)],
    ),
];
