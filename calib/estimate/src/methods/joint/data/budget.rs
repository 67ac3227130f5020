//! Limits of the joint problem: number of static intervals, with the choice among more, and steps of the solver.

use findings::{Finding, Kind};
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

use nalgebra::{Matrix3, Vector3};
use recording::Recording;
use recording::intervals::StaticInterval;

use crate::methods::Choice;

/// Most static intervals of a recording. Every one has a direction of its own among the parameters, and noise
/// joins all rows of a recording: time grows with the third power of their number and memory with the second: 0.4 s at 100, 1.4 s at 200, 4 s at 320. With the
/// number of recordings, which share no noise, both grow evenly.
pub const MOST_STATIC_INTERVALS: usize = 140;

/// The same where many models are fitted one after the other.
pub const MOST_IN_A_SEARCH: usize = 60;

/// Largest total cost of the solver's steps on the way to a fit, in samples of turns.
const MOST_WORK: usize = 4_000_000;

/// Steps of the solver in one run near the minimum: readings of which nothing is left to fit, as of a dead zone, would take
/// thousands and converge no better. A fit that converges takes ten.
const MOST_STEPS: usize = 500;
/// Fewest of the last fit, and of one on the way when the budget is spent.
const LAST_STEPS: usize = 40;
const FEWEST_STEPS: usize = 3;

/// The steps of one fit, in all its runs. What it is spent for are points on the way, which
/// need not be exact; the last fit says by itself where it did not converge.
#[derive(Clone, Debug, Default)]
pub struct Steps(Arc<AtomicUsize>);

impl Steps {
    /// Most steps of the next run on the way, each of this cost.
    pub fn on_the_way(&self, cost: usize) -> usize {
        let left = (MOST_WORK / cost.max(1)).saturating_sub(self.0.load(Relaxed));
        left.clamp(FEWEST_STEPS, MOST_STEPS)
    }

    /// Returns true if the runs on the way have used up their budget, each step of this cost.
    pub fn are_spent(&self, cost: usize) -> bool {
        self.0.load(Relaxed) >= MOST_WORK / cost.max(1)
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
        (MOST_WORK / cost.max(1)).clamp(LAST_STEPS, MOST_STEPS)
    }
}

/// Cuts every recording down to `most` static intervals, to the stretch whose orientations are spread best, and says from
/// where to where. Several recordings are taken whole each: whoever records many of them wants them all.
pub fn within_budget(
    recordings: &[&Recording],
    choices: &mut [Choice],
    most: usize,
) -> Vec<Finding> {
    let mut said = Vec::new();
    for (recording, choice) in recordings.iter().zip(choices) {
        let statics = &choice.segmentation.statics;
        let Some(stretch) = spread_best(statics, most) else {
            continue;
        };
        let (first, last) = (&statics[stretch.start], &statics[stretch.end - 1]);
        said.push(
            Finding::of(Kind::IntervalsLeftOut)
                .in_recording(&recording.name)
                .count("most", most)
                .count("all", statics.len())
                .count("first", stretch.start + 1)
                .count("last", stretch.end)
                .detail(
                    "where",
                    format!("t = {:.2} to {:.2} s", first.span.from, last.span.to),
                ),
        );
        choice.segmentation = choice.segmentation.stretch(stretch);
    }
    said
}

/// The `count` consecutive intervals whose directions of specific force leave the least known axis best known: largest
/// smallest eigenvalue of `Σ u uᵀ`. `None` where all are to be kept.
fn spread_best(statics: &[StaticInterval], count: usize) -> Option<Range<usize>> {
    if statics.len() <= count {
        return None;
    }
    let of = |rest: &StaticInterval| {
        let u = rest.accelerometer.map(|m| m.mean.normalize());
        let u = u.filter(|u| u.norm().is_finite());
        u.map_or_else(Matrix3::zeros, |u: Vector3<f64>| u * u.transpose())
    };
    let mut before = vec![Matrix3::zeros()];
    for rest in statics {
        let sum = before[before.len() - 1] + of(rest);
        before.push(sum);
    }
    let least = |from: &usize| {
        let scatter: Matrix3<f64> = before[from + count] - before[*from];
        scatter.symmetric_eigenvalues().min()
    };
    // The first of equals.
    let starts = (0..=statics.len() - count).rev();
    let from = starts.max_by(|a, b| least(a).total_cmp(&least(b)))?;
    Some(from..from + count)
}

#[cfg(test)]
mod tests {
    use recording::Stream;
    use recording::intervals::{Segmentation, Span};

    use super::*;

    /// Rests of one second with turns of one second between, flat but for those in `tilted`.
    fn session(rests: usize, tilted: Range<usize>) -> (Recording, Choice) {
        let up = |k: usize| match (tilted.contains(&(k / 20)), (k / 20) % 3) {
            (true, 1) => Vector3::x(),
            (true, 2) => Vector3::y(),
            _ => Vector3::z(),
        };
        let t: Vec<f64> = (0..20 * rests).map(|k| 0.1 * k as f64).collect();
        let values = (0..t.len()).map(|k| 9.8 * up(k)).collect();
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
        let choice = Choice {
            segmentation: Segmentation::from_spans(&recording, &spans, 10.0),
            trials: Vec::new(),
            shortened: None,
        };
        (recording, choice)
    }

    #[test]
    fn the_stretch_with_all_orientations_is_kept_and_said() {
        let (recording, choice) = session(400, 220..260);
        let mut cut = [choice];
        let said = within_budget(&[&recording], &mut cut, 150);
        let kept = &cut[0].segmentation;
        assert_eq!(kept.statics.len(), 150);
        assert_eq!(kept.turns.len(), 149);
        let (from, to) = (kept.statics[0].span.from, kept.statics[149].span.to);
        assert!(from <= 440.0 && to >= 510.0, "{from} {to}");
        let turn = &kept.turns[7];
        assert_eq!((turn.from, turn.span.from), (7, kept.statics[7].span.to));
        assert_eq!(said[0].kind, Kind::IntervalsLeftOut);
        assert_eq!(
            (said[0].value("most"), said[0].value("all")),
            (Some(150.0), Some(400.0))
        );
    }

    #[test]
    fn recordings_within_the_budget_stay_as_they_are() {
        let (recording, choice) = session(140, 0..140);
        let mut cut = [choice.clone(), choice.clone()];
        assert!(within_budget(&[&recording, &recording], &mut cut, 150).is_empty());
        assert_eq!(cut[1].segmentation, choice.segmentation);
    }
}
