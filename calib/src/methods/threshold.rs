//! The detector's multiplier, chosen by what the accelerometer fit leaves (Liu et al. 2021,
//! section 3.2), per degree of freedom.

use serde::Serialize;
use solver::{Options, solve};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::first_guess::accelerometer_unit;
use super::static_means;
use crate::error::Error;
use crate::intervals::{Detector, Segmentation, segment_each};
use crate::recording::Recording;
use crate::residuals::{GravityNorm, StaticMean};

/// The multipliers tried.
pub const MULTIPLIERS: [f64; 12] = [3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];

/// Multipliers are compared by the upper end of what their residual may be, so that a small one from
/// two spare placements does not beat one from twelve: one-sided confidence.
const CONFIDENCE: f64 = 0.9;

/// Fits within this factor of the best are as good.
const AS_GOOD: f64 = 1.1;

/// Spare residuals below which a fit says nothing about a multiplier.
const MIN_SPARE: usize = 2;

/// What one multiplier gives.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The multiplier.
    pub multiplier: f64,
    /// Number of static intervals found.
    pub static_intervals: usize,
    /// `√(Σ r² / (n − rank))` of the moduli of gravity, m/s²; `None` where they are too few.
    pub residual: Option<f64>,
    /// Upper 90 % confidence limit of the residual, m/s².
    pub upper: Option<f64>,
}

/// A segmentation and how its multiplier was chosen.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The recording cut at the chosen multiplier.
    pub segmentation: Segmentation,
    /// All multipliers tried; empty where one was given.
    pub trials: Vec<Trial>,
}

/// Cuts a recording at the multiplier that the accelerometer fit likes best: of those as good as
/// the best, the middle of the longest run that finds the same number of intervals. Where no fit is
/// possible, at the detector's own multiplier.
///
/// # Errors
/// As [`crate::intervals::segment`].
pub fn choose_multiplier(
    recording: &Recording,
    detector: &Detector,
    gravity: f64,
) -> Result<Choice, Error> {
    let mut tried = segment_each(recording, detector, &MULTIPLIERS)?;
    let trials: Vec<Trial> = tried.iter().map(|s| trial(recording, s, gravity)).collect();
    let chosen = match plateau(&trials) {
        Some(k) => tried.swap_remove(k),
        None => crate::intervals::segment(recording, detector)?,
    };
    Ok(Choice {
        segmentation: chosen,
        trials,
    })
}

fn trial(recording: &Recording, segmentation: &Segmentation, gravity: f64) -> Trial {
    let scatter = residual(&static_means(recording, segmentation), gravity);
    Trial {
        multiplier: segmentation.multiplier,
        static_intervals: segmentation.statics.len(),
        residual: scatter.map(|s| s.residual),
        upper: scatter.and_then(|s| s.upper()),
    }
}

/// A residual per degree of freedom.
#[derive(Clone, Copy)]
struct Scatter {
    residual: f64,
    spare: usize,
}

impl Scatter {
    /// Upper confidence limit: `r √(ν / χ²_ν(1 − confidence))`.
    fn upper(&self) -> Option<f64> {
        let law = ChiSquared::new(self.spare as f64).ok()?;
        Some(self.residual * (self.spare as f64 / law.inverse_cdf(1.0 - CONFIDENCE)).sqrt())
    }
}

/// The scatter of gravity's modulus around the nine-parameter fit.
fn residual(means: &[StaticMean], gravity: f64) -> Option<Scatter> {
    let raw: Vec<_> = means.iter().map(|m| m.raw).collect();
    let unit = accelerometer_unit(&raw, gravity)?;
    let near_si: Vec<StaticMean> = means
        .iter()
        .map(|m| StaticMean {
            raw: unit.to_si(&m.raw),
            ..*m
        })
        .collect();
    let model = accelerometer::model();
    let problem = GravityNorm {
        model: &model,
        means: &near_si,
        gravity,
    };
    let start = model.parameters();
    let mask = start.free_where(accelerometer::is_free_in_triangular_frame);
    let spare = means.len().checked_sub(mask.free_indices().len())?;
    let report = (spare >= MIN_SPARE).then(|| solve(&problem, &start, &mask, &Options::default()));
    let residual = report?.ok()?.reduced_chi2()?.sqrt();
    Some(Scatter { residual, spare })
}

/// The middle of the longest run of good trials with one number of intervals.
fn plateau(trials: &[Trial]) -> Option<usize> {
    let best = trials
        .iter()
        .filter_map(|t| t.upper)
        .min_by(f64::total_cmp)?;
    let good = |t: &Trial| t.upper.is_some_and(|r| r <= AS_GOOD * best);
    let mut longest = 0..0;
    let mut from = 0;
    for k in 0..trials.len() {
        let joins = k > from
            && trials[k].static_intervals == trials[from].static_intervals
            && good(&trials[from]);
        if !(joins && good(&trials[k])) {
            from = k;
        }
        if good(&trials[k]) && k + 1 - from > longest.len() {
            longest = from..k + 1;
        }
    }
    (!longest.is_empty()).then(|| longest.start + (longest.len() - 1) / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trials(rows: &[(usize, f64)]) -> Vec<Trial> {
        rows.iter()
            .map(|&(static_intervals, r)| Trial {
                multiplier: 1.0,
                static_intervals,
                residual: (r > 0.0).then_some(r),
                upper: (r > 0.0).then_some(r),
            })
            .collect()
    }

    #[test]
    fn the_middle_of_the_longest_good_run_is_chosen() {
        let rows = [
            (9, 0.0),
            (12, 5.0),
            (14, 1.0),
            (14, 1.02),
            (14, 1.05),
            (15, 1.0),
            (13, 9.0),
        ];
        assert_eq!(plateau(&trials(&rows)), Some(3));
    }

    #[test]
    fn a_small_residual_from_few_placements_does_not_beat_one_from_many() {
        let few = Scatter {
            residual: 1.8,
            spare: 2,
        };
        let many = Scatter {
            residual: 2.4,
            spare: 12,
        };
        assert!(few.upper().unwrap() > many.upper().unwrap());
    }

    #[test]
    fn without_a_fit_nothing_is_chosen() {
        assert_eq!(plateau(&trials(&[(2, 0.0), (3, 0.0)])), None);
    }
}
