//! The detector's multiplier, chosen by what the accelerometer fit leaves (Liu et al. 2021,
//! section 3.2), per degree of freedom.

use nalgebra::Vector3;
use rayon::prelude::*;
use sensor::{Kinematics, Model};
use serde::Serialize;
use solver::{Options, Problem, Report, solve};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::first_guess::accelerometer_unit;
use crate::error::Error;
use crate::intervals::{Detector, Segmentation, Span, Survey};
use crate::recording::Recording;
use crate::residuals::{GravityNorm, StaticMean};

/// The multipliers tried.
pub const MULTIPLIERS: [f64; 12] = [3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];

/// Multipliers are compared by how well a corrected reading is known after the fit, with the upper end
/// of what the residual may be: a small residual from two spare placements does not beat one from
/// twelve, nor a fit of half the placements one of them all. One-sided confidence.
const CONFIDENCE: f64 = 0.9;

/// Fits within this factor of the best are as good: what many multipliers agree on counts for more.
const AS_GOOD: f64 = 1.3;

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
    /// Standard error of a corrected modulus of gravity, averaged over all orientations, at the upper
    /// 90 % confidence limit of the residual, m/s².
    pub expected_error: Option<f64>,
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
    let survey = Survey::of(recording, detector)?;
    let rests: Vec<Vec<Span>> = MULTIPLIERS.iter().map(|&m| survey.rests(m)).collect();
    let trials = trials(&survey, &rests, gravity);
    let chosen = plateau(&trials).map_or(detector.multiplier, |k| MULTIPLIERS[k]);
    Ok(Choice {
        segmentation: survey.segment(chosen),
        trials,
    })
}

/// Cuts a recording by [`choose_multiplier`], or at the detector's own multiplier.
///
/// # Errors
/// As [`crate::intervals::segment`].
pub fn cut(
    recording: &Recording,
    detector: &Detector,
    choose: bool,
    gravity: f64,
) -> Result<Choice, Error> {
    if choose {
        return choose_multiplier(recording, detector, gravity);
    }
    Ok(Choice {
        segmentation: crate::intervals::segment(recording, detector)?,
        trials: Vec::new(),
    })
}

/// The trials at all multipliers; those that find the same rests share a fit.
fn trials(survey: &Survey<'_>, rests: &[Vec<Span>], gravity: f64) -> Vec<Trial> {
    let runs: Vec<&[Vec<Span>]> = rests.chunk_by(|a, b| a == b).collect();
    let tried = runs.par_iter().map(|run| trial(survey, &run[0], gravity));
    let tried: Vec<Trial> = tried.collect();
    let each = runs.iter().zip(tried);
    let repeated = each.flat_map(|(run, trial)| std::iter::repeat_n(trial, run.len()));
    repeated
        .zip(MULTIPLIERS)
        .map(|(trial, multiplier)| Trial {
            multiplier,
            ..trial
        })
        .collect()
}

/// A fit to given rests, whatever the multiplier.
fn trial(survey: &Survey<'_>, rests: &[Span], gravity: f64) -> Trial {
    let means = rests.iter().filter_map(|&rest| survey.mean_force(rest));
    let means: Vec<StaticMean> = means.map(bare_mean).collect();
    let scatter = residual(&means, gravity);
    Trial {
        multiplier: f64::NAN,
        static_intervals: rests.len(),
        residual: scatter.map(|s| s.residual),
        expected_error: scatter.and_then(|s| s.expected_error()),
    }
}

/// A mean of which nothing else is known: the base model asks for no more.
fn bare_mean(raw: Vector3<f64>) -> StaticMean {
    StaticMean {
        raw,
        rest: Kinematics::at_rest(Vector3::zeros()),
        white: 0.0,
    }
}

/// A residual per degree of freedom.
#[derive(Clone, Copy)]
struct Scatter {
    residual: f64,
    spare: usize,
    /// Standard error of a corrected modulus for a residual of one, root mean square over
    /// orientations.
    leverage: f64,
}

impl Scatter {
    /// The leverage times the residual's upper confidence limit `r √(ν / χ²_ν(1 − confidence))`.
    fn expected_error(&self) -> Option<f64> {
        let law = ChiSquared::new(self.spare as f64).ok()?;
        let upper = (self.spare as f64 / law.inverse_cdf(1.0 - CONFIDENCE)).sqrt();
        Some(self.leverage * self.residual * upper)
    }
}

/// The scatter of gravity's modulus around the nine-parameter fit.
fn residual(means: &[StaticMean], gravity: f64) -> Option<Scatter> {
    let raw: Vec<_> = means.iter().map(|m| m.raw).collect();
    let unit = accelerometer_unit(&raw, gravity)?;
    let near_si: Vec<StaticMean> = unit.means_to_si(means);
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
    let report = report?.ok()?;
    Some(Scatter {
        residual: report.reduced_chi2()?.sqrt(),
        spare,
        leverage: leverage(&report, &model, gravity),
    })
}

/// `√ mean(j C jᵀ)` over faces, edges and corners, `j` the derivative of the modulus there.
fn leverage(report: &Report, model: &Model, gravity: f64) -> f64 {
    let everywhere: Vec<StaticMean> = orientations().map(|u| bare_mean(u * gravity)).collect();
    let problem = GravityNorm {
        model,
        means: &everywhere,
        gravity,
    };
    let x = report.parameters.values();
    let names = &report.uncertainty.names;
    let free: Vec<usize> = names
        .iter()
        .filter_map(|n| report.parameters.index(n))
        .collect();
    let jacobian = problem.linearize(x, &free, &mut Vec::new());
    let covariance = &report.uncertainty.covariance;
    let variance = |row: usize| -> f64 {
        let of = |i: usize| -> f64 {
            (0..free.len())
                .map(|j| covariance[i][j] * jacobian[(row, j)])
                .sum()
        };
        (0..free.len()).map(|i| jacobian[(row, i)] * of(i)).sum()
    };
    let sum: f64 = (0..everywhere.len()).map(variance).sum();
    (sum / everywhere.len() as f64).sqrt()
}

/// The 26 directions of faces, edges and corners.
fn orientations() -> impl Iterator<Item = Vector3<f64>> {
    let steps = [-1.0, 0.0, 1.0];
    steps
        .into_iter()
        .flat_map(move |x| steps.into_iter().map(move |y| (x, y)))
        .flat_map(move |(x, y)| steps.into_iter().map(move |z| Vector3::new(x, y, z)))
        .filter(|u| u.norm() > 0.5)
        .map(|u| u.normalize())
}

/// The middle of the longest run of good trials with one number of intervals.
fn plateau(trials: &[Trial]) -> Option<usize> {
    let best = trials
        .iter()
        .filter_map(|t| t.expected_error)
        .min_by(f64::total_cmp)?;
    let good = |t: &Trial| t.expected_error.is_some_and(|r| r <= AS_GOOD * best);
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
                expected_error: (r > 0.0).then_some(r),
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
            leverage: 1.0,
        };
        let many = Scatter {
            residual: 2.4,
            spare: 12,
            leverage: 1.0,
        };
        assert!(few.expected_error().unwrap() > many.expected_error().unwrap());
    }

    #[test]
    fn without_a_fit_nothing_is_chosen() {
        assert_eq!(plateau(&trials(&[(2, 0.0), (3, 0.0)])), None);
    }
}
