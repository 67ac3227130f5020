//! The motion to reckon and the rests on both sides of it.

use findings::{Finding, Kind};
use recording::Error;
use recording::intervals::{Detector, Span, segment};
use recording::{INSTANT, Recording, Stream};

/// Half a second sees the start of a push; 256 is four standard deviations to the fourth power.
const DETECTOR: Detector = Detector {
    window: 0.5,
    multiplier: 256.0,
    min_dynamic: 0.5,
    min_static: 1.0,
    initial_static: None,
    shaken: false,
    creeping: true,
    may_shorten: false,
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
    /// The motions in a recording that begin after a rest of at least a second, in order.
    ///
    /// # Errors
    /// A recording that cannot be cut.
    pub fn all(recording: &Recording) -> Result<Vec<Self>, Error> {
        let segmentation = segment(recording, &DETECTOR)?;
        let rests: Vec<Span> = segmentation.statics.iter().map(|rest| rest.span).collect();
        let end = end(recording);
        let motions = rests.iter().enumerate().map(|(k, &before)| {
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
        Ok(motions
            .filter(|motion| motion.span.lasts(DETECTOR.min_dynamic))
            .collect())
    }

    /// The longest motion in a recording that begins after a rest of at least a second.
    ///
    /// # Errors
    /// A recording without such a rest, or without motion after it.
    pub fn find(recording: &Recording) -> Result<Self, Error> {
        Self::longest(&Self::all(recording)?, recording)
    }

    /// The longest of the motions that [`Motion::all`] finds in a recording.
    ///
    /// # Errors
    /// [`Error::NotEnough`] where there are none.
    pub fn longest(all: &[Self], recording: &Recording) -> Result<Self, Error> {
        let longest = all
            .iter()
            .max_by(|a, b| a.span.length().total_cmp(&b.span.length()));
        longest.copied().ok_or_else(|| {
            Error::not_enough(
                Finding::of(Kind::MOTION_MISSING)
                    .in_recording(&recording.name)
                    .number("rest", DETECTOR.min_static, "s"),
            )
        })
    }

    /// Returns true if a motion that was found lasts beyond the end of this one: no rest begins there.
    pub fn ends_in(&self, others: &[Self]) -> bool {
        let goes_on = |other: &Self| {
            other.span.from < self.span.to - SHORTEST_REST
                && other.span.to > self.span.to + SHORTEST_REST
        };
        others.iter().any(goes_on)
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
        if !(span.length() > 0.0 && before.lasts(SHORTEST_REST) && span.from < end) {
            return Err(Error::usage(
                Finding::of(Kind::MOTION_OUTSIDE)
                    .in_recording(&recording.name)
                    .number("from", span.from, "s")
                    .number("to", span.to, "s")
                    .number("start", start, "s")
                    .number("end", end, "s")
                    .number("rest", SHORTEST_REST, "s"),
            ));
        }
        let after = Span {
            from: span.to,
            to: end,
        };
        let after = (after.lasts(SHORTEST_REST)).then_some(after);
        Ok(Self {
            before,
            span,
            after,
        })
    }
}

/// A step longer than this many median steps is a gap.
const GAP_STEPS: f64 = 5.0;

/// The longest gap of a stream within a motion: what happened in it is a guess.
pub fn gap_in(stream: &Stream, motion: Span) -> Option<Span> {
    let limit = GAP_STEPS * stream.median_step()? + INSTANT.get();
    let steps = stream.t[stream.between(motion.from, motion.to)].windows(2);
    steps
        .map(|step| Span {
            from: step[0],
            to: step[1],
        })
        .filter(|step| step.length() > limit)
        .max_by(|a, b| a.length().total_cmp(&b.length()))
}

/// The last time stamp of the accelerometer, s.
fn end(recording: &Recording) -> f64 {
    let stream = recording.accelerometer.as_ref();
    stream
        .and_then(|s| s.t.last().copied())
        .unwrap_or(f64::NEG_INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// 10 s at 100 Hz, shaken from 4 to 6 s, with a little noise always.
    fn recording() -> Recording {
        let mut stream = Stream::default();
        for k in 0..1000 {
            let t = f64::from(k) * 0.01;
            let shaken = (4.0..6.0).contains(&t);
            let size = if shaken { 1.0 } else { 0.001 };
            stream.t.push(t);
            stream
                .values
                .push(Vector3::new(size * (f64::from(k) * 1.7).sin(), 0.0, 9.8));
        }
        Recording {
            accelerometer: Some(stream),
            ..Recording::default()
        }
    }

    #[test]
    fn the_motion_is_found_between_its_rests() {
        let motion = Motion::find(&recording()).unwrap();
        // Half a window on either side.
        assert!((motion.span.from - 3.75).abs() < 0.02, "{motion:?}");
        assert!((motion.span.to - 6.25).abs() < 0.02, "{motion:?}");
        assert!(motion.before.from < 0.01 && motion.after.unwrap().to > 9.9);
    }

    #[test]
    fn a_gap_in_the_motion_is_found_and_one_at_rest_is_not() {
        let mut stream = recording().accelerometer.unwrap();
        let motion = Span {
            from: 3.75,
            to: 6.25,
        };
        assert_eq!(gap_in(&stream, motion), None);
        for range in [800..850, 500..520] {
            stream.t.drain(range.clone());
            stream.values.drain(range);
        }
        let gap = gap_in(&stream, motion).unwrap();
        assert!((gap.from - 4.99).abs() < 1e-9 && (gap.length() - 0.21).abs() < 1e-9);
    }
}
