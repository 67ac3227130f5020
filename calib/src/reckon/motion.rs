//! The motion to reckon and the rests on both sides of it.

use crate::error::Error;
use crate::intervals::{Detector, Span, segment};
use crate::recording::Recording;

/// Half a second sees the start of a push; 256 is four standard deviations to the fourth power.
const DETECTOR: Detector = Detector {
    window: 0.5,
    multiplier: 256.0,
    min_dynamic: 0.5,
    min_static: 1.0,
    initial_static: None,
};

/// A rest shorter than this says too little of where up is, s.
const SHORTEST_REST: f64 = 0.5;

/// When the device moved, and when it was still before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The rest that gives the first attitude and the gyroscope's bias.
    pub before: Span,
    /// The motion.
    pub span: Span,
    /// The rest after it; `None` where the recording ends in motion.
    pub after: Option<Span>,
}

impl Motion {
    /// The longest motion in a recording that begins after a rest of at least a second.
    ///
    /// # Errors
    /// A recording without such a rest, or without motion after it.
    pub fn find(recording: &Recording) -> Result<Self, Error> {
        let segmentation = segment(recording, &DETECTOR)?;
        let rests: Vec<Span> = segmentation.statics.iter().map(|rest| rest.span).collect();
        let end = end(recording);
        let candidates = rests.iter().enumerate().map(|(k, &before)| {
            let after = rests.get(k + 1).copied();
            let to = after.map_or(end, |rest| rest.from);
            Self {
                before,
                span: Span {
                    from: before.to,
                    to,
                },
                after,
            }
        });
        candidates
            .filter(|motion| motion.span.length() >= DETECTOR.min_dynamic)
            .max_by(|a, b| a.span.length().total_cmp(&b.span.length()))
            .ok_or_else(|| {
                Error::NotEnough(format!(
                    "{}: no motion after a rest of {} s found; say when it was with --motion T0,T1",
                    recording.name, DETECTOR.min_static
                ))
            })
    }

    /// A motion given by hand; the rests are all there is before and after it.
    ///
    /// # Errors
    /// Less than half a second before the motion, or a motion that does not lie in the recording.
    pub fn given(recording: &Recording, span: Span) -> Result<Self, Error> {
        let (start, end) = (recording.start(), end(recording));
        let before = Span {
            from: start,
            to: span.from,
        };
        if !(span.length() > 0.0 && before.length() >= SHORTEST_REST && span.from < end) {
            return Err(Error::Usage(format!(
                "motion from {} to {} s: the recording runs from {start:.2} to {end:.2} s and must \
                 be at rest for at least {SHORTEST_REST} s before the motion",
                span.from, span.to
            )));
        }
        let after = Span {
            from: span.to,
            to: end,
        };
        let after = (after.length() >= SHORTEST_REST).then_some(after);
        Ok(Self {
            before,
            span,
            after,
        })
    }
}

/// The last time stamp of the accelerometer, s.
fn end(recording: &Recording) -> f64 {
    let stream = recording.accelerometer.as_ref();
    stream
        .and_then(|s| s.t.last().copied())
        .unwrap_or(f64::NEG_INFINITY)
}
