//! Words of stretches that cannot be used for a track or for the noise.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::MotionMissing => error_by(
            "no motion was found after a rest of {rest}",
            vec![Remedy::set(OptionName::Motion)],
        ),
        Kind::MotionOutside => error(
            "motion from {from} to {to}: the recording runs from {start} to {end} and must be at rest for at least {rest} before the motion",
            "name a motion within it",
        ),
        Kind::SamplesTooFew => error(
            "the motion has {count} {sensor} samples, at least {least} needed",
            "choose a longer motion",
        ),
        Kind::NoSamplesAtRest => error(
            "no samples between {t0} and {t1} are in the recording, and the device must rest then, before the motion",
            "choose another motion",
        ),
        Kind::NeverAtRest => error_with(
            "the device moved, and its longest static interval lasts {length}: the analysis of noise (Allan deviation) needs a recording at rest",
            "leave the device alone for an hour",
            vec![Remedy::set(OptionName::Rest)],
        ),
        _ => return None,
    })
}
