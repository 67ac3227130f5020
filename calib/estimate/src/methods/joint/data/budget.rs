//! Limits of the joint problem: number of static intervals that are fitted together, and steps of the solver.

use std::sync::Arc;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

use crate::methods::Choice;

/// Most static intervals of a recording that is fitted whole, and about how many of a part of a longer one. Every one has a direction of
/// its own among the parameters, and noise joins all rows of a recording: time grows with the third power of their number. With the number
/// of recordings or parts, which share no noise, it grows evenly.
pub const STATIC_INTERVALS: [usize; 2] = [140, 70];

/// The same where many models are fitted one after the other.
pub const IN_A_SEARCH: [usize; 2] = [60, 60];

findings::tuning! {
    /// Largest total cost of the solver's steps on the way to a fit, in samples of turns.
    MOST_WORK: usize = 4_000_000;

    /// Steps of the solver in one run near the minimum: readings of which nothing is left to fit, as of a dead zone, would take
    /// thousands and converge no better. A fit that converges takes ten.
    MOST_STEPS: usize = 500;
    /// Fewest steps of the last fit.
    LAST_STEPS: usize = 40;
    /// Fewest steps of a fit on the way when the budget is spent.
    FEWEST_STEPS: usize = 3;
}

/// The steps of one fit, in all its runs. What it is spent for are points on the way, which
/// need not be exact; the last fit says by itself where it did not converge.
#[derive(Clone, Debug, Default)]
pub struct Steps(Arc<AtomicUsize>);

impl Steps {
    /// Most steps of the next run on the way, each of this cost.
    pub fn on_the_way(&self, cost: usize) -> usize {
        let left = (MOST_WORK.get() / cost.max(1)).saturating_sub(self.0.load(Relaxed));
        left.clamp(FEWEST_STEPS.get(), MOST_STEPS.get())
    }

    /// Returns true if the runs on the way have used up their budget, each step of this cost.
    pub fn are_spent(&self, cost: usize) -> bool {
        self.0.load(Relaxed) >= MOST_WORK.get() / cost.max(1)
    }

    /// Returns the cost of all steps, in samples of turns.
    pub fn work(&self, cost: usize) -> usize {
        self.0.load(Relaxed) * cost
    }

    /// Counts the steps of a run.
    pub fn took(&self, steps: usize) {
        self.0.fetch_add(steps, Relaxed);
    }

    /// Most steps of the last run.
    pub fn at_the_end(cost: usize) -> usize {
        (MOST_WORK.get() / cost.max(1)).clamp(LAST_STEPS.get(), MOST_STEPS.get())
    }
}

impl Choice {
    /// The recording in one part, or one with more static intervals than `most` in parts of about so many as are given: noise joins all rows
    /// of a recording, and parts have biases of their own as recordings of one device do. The turns between two parts are not used.
    pub fn in_parts(&self, [most, part]: [usize; 2]) -> Vec<Self> {
        let count = self.segmentation.statics.len();
        if count <= most {
            return vec![self.clone()];
        }
        let parts = count.div_ceil(part);
        let of = |number: usize| Self {
            segmentation: self.segmentation.part(number, parts),
            ..self.clone()
        };
        (1..=parts).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use recording::intervals::{Segmentation, Span};
    use recording::{Recording, Stream};

    use super::*;

    /// Rests of one second with turns of one second between.
    fn session(rests: usize) -> Choice {
        let t: Vec<f64> = (0..20 * rests).map(|k| 0.1 * k as f64).collect();
        let values = vec![9.8 * Vector3::z(); t.len()];
        let stream = Some(Stream { t, values });
        let recording = Recording {
            name: "r".into(),
            accelerometer: stream.clone(),
            gyroscope: stream,
            ..Recording::default()
        };
        let span = |k: usize| Span {
            from: 2.0 * k as f64,
            to: 2.0 * k as f64 + 1.0,
        };
        let spans: Vec<Span> = (0..rests).map(span).collect();
        Choice::given(Segmentation::from_spans(&recording, &spans, 10.0))
    }

    #[test]
    fn a_long_recording_is_in_parts_with_all_its_static_intervals() {
        let choice = session(400);
        let parts = choice.in_parts([150, 100]);
        let cuts: Vec<&Segmentation> = parts.iter().map(|own| &own.segmentation).collect();
        let counts: Vec<usize> = cuts.iter().map(|cut| cut.statics.len()).collect();
        assert_eq!(counts, [100; 4]);
        assert!(cuts.iter().all(|cut| cut.turns.len() == 99));
        let whole = cuts.iter().flat_map(|cut| &cut.statics);
        assert!(whole.eq(&choice.segmentation.statics));
        assert_eq!((cuts[2].before(), cuts[2].turns[7].from), (200, 7));
        assert_eq!(cuts[2].name_in("r"), "r (part 3 of 4)");
    }

    #[test]
    fn recordings_within_the_budget_stay_as_they_are() {
        let choice = session(140);
        let parts = choice.in_parts([150, 100]);
        assert_eq!(parts.len(), 1);
        assert_eq!(parts[0].segmentation, choice.segmentation);
    }
}
