//! Static intervals of several recordings of one device, none of which makes a calibration by itself.

use recording::Error;
use recording::intervals::Detector;

use super::{Choice, MANY_MORE, SHORTER};

findings::tuning! {
    /// Static intervals of all recordings from which on none has to be shorter.
    ENOUGH: usize = 12;
}

/// Cuts `count` recordings of one device, the k-th by `cut`. Where none of them makes a calibration and all have few static
/// intervals, shorter ones are looked for in all, as they are in one: a device that was switched off in between.
///
/// # Errors
/// The first of `cut`, with the detector that was asked for.
pub fn cut_several(
    count: usize,
    detector: &Detector,
    cut: impl Fn(usize, &Detector) -> Result<Choice, Error>,
) -> Result<Vec<Choice>, Error> {
    let all = |detector: &Detector| {
        (0..count)
            .map(|k| cut(k, detector))
            .collect::<Result<Vec<_>, _>>()
    };
    let mut best = all(detector)?;
    let makes_one = |choice: &Choice| {
        choice.trials.is_empty()
            || choice
                .trials
                .iter()
                .any(|trial| trial.expected_error.is_some())
    };
    if count < 2 || !detector.may_shorten || best.iter().any(makes_one) {
        return Ok(best);
    }
    for (window, min_dynamic, min_static) in SHORTER {
        if found(&best) >= ENOUGH.get() || min_static >= detector.min_static {
            break;
        }
        let shorter = Detector {
            window,
            min_dynamic,
            min_static,
            may_shorten: false,
            ..*detector
        };
        // A stream too slow for the shorter window has nothing more to tell.
        let Ok(mut other) = all(&shorter) else { break };
        if found(&other) as f64 >= MANY_MORE.get() * found(&best) as f64 {
            other
                .iter_mut()
                .for_each(|choice| choice.shortened = Some(min_static));
            best = other;
        }
    }
    Ok(best)
}

/// Static intervals in all.
fn found(choices: &[Choice]) -> usize {
    choices
        .iter()
        .map(|choice| choice.segmentation.statics.len())
        .sum()
}
