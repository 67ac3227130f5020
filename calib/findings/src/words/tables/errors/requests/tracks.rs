//! Words of stretches that cannot be used for a track or for the noise.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A recording has no motion after a rest.
    MOTION_MISSING = "motion_missing" => error_by(
        "no motion was found after a rest of {rest}",
        vec![Remedy::set(OptionName::Motion)],
    ),
    /// A motion lies outside of its recording, or has no rest before it.
    MOTION_OUTSIDE = "motion_outside" => error(
        "motion from {from} to {to}: the recording runs from {start} to {end} and must be at rest for at least {rest} before the motion",
        "name a motion within it",
    ),
    /// A stretch has too few samples.
    SAMPLES_TOO_FEW = "samples_too_few" => error(
        "the motion has {count} {sensor} samples, at least {least} needed",
        "choose a longer motion",
    ),
    /// A rest has no samples.
    NO_SAMPLES_AT_REST = "no_samples_at_rest" => error(
        "no samples between {t0} and {t1} are in the recording, and the device must rest then, before the motion",
        "choose another motion",
    ),
    /// The device was never at rest for long enough to see its noise.
    NEVER_AT_REST = "never_at_rest" => error_with(
        "the device moved, and its longest static interval lasts {length}: the analysis of noise (Allan deviation) needs a recording at rest",
        "leave the device alone for an hour",
        vec![Remedy::set(OptionName::Rest)],
    ),
}
