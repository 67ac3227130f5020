//! Residual of the accelerometer fit over one set of static intervals.

use nalgebra::Vector3;
use sensor::{Base, Model};
use serde::Serialize;
use solver::{Options, Problem, Report, solve};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::methods::first_guess::accelerometer_unit;
use crate::residuals::{GravityNorm, StaticMean};
use crate::truth::RawUnit;

findings::tuning! {
    /// Multipliers are compared by how well a corrected reading is known after the fit, with the upper end
    /// of what the residual may be: a small residual from two spare placements does not beat one from
    /// twelve, nor a fit of half the placements one of them all. One-sided confidence.
    CONFIDENCE: f64 = 0.9;

    /// Steps that a fit may take: placements that determine the parameters need ten.
    MOST_STEPS: usize = 60;

    /// Misalignments are smaller than this, rad.
    MISALIGNMENT: f64 = 0.35;
    /// A bias is smaller than this, as a fraction of gravity.
    BIAS: f64 = 1.0;
    /// A corrected reading is known to this fraction of gravity.
    KNOWN_TO: f64 = 0.05;

    /// Norms that scatter by more than this fraction of gravity are those of a device in motion.
    STILL: f64 = 0.02;
}

/// Scale factors of a sensor lie between these, in the unit that its readings show.
const SCALES: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Result of one multiplier.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The multiplier.
    pub multiplier: f64,
    /// The detector's window, s.
    pub window: f64,
    /// The shortest static interval looked for, s.
    pub min_static: f64,
    /// Number of static intervals found.
    pub static_intervals: usize,
    /// Number of placements among them: neighbours with the same force are one that was interrupted.
    #[serde(skip)]
    pub placements: usize,
    /// True if the fit can be that of a sensor, with any uncertainty.
    #[serde(skip)]
    pub plausible: bool,
    /// Placements beyond the number of parameters; `None` where the fit is no calibration: too few
    /// placements, parameters that no sensor has, or no end within the allowed steps.
    pub spare: Option<usize>,
    /// `√(Σ r² / (n − rank))` of the norms of specific force, m/s²; `None` where they are too few.
    pub residual: Option<f64>,
    /// Standard error of a corrected norm of gravity, averaged over all orientations, at the upper
    /// 90 % confidence limit of the residual, m/s²; `None` where the fit is no calibration.
    pub expected_error: Option<f64>,
}

/// A fit of the norm of gravity.
#[derive(Clone, Debug)]
pub(super) struct NormFit {
    /// The residual per degree of freedom, m/s².
    pub residual: f64,
    /// Placements beyond the number of parameters.
    pub spare: usize,
    /// Standard error of a corrected norm for a residual of one, root mean square over orientations.
    leverage: f64,
    /// From readings to m/s².
    pub base: Base<f64>,
    /// True if the parameters are possible for a sensor and the residual for a device at rest, with any uncertainty.
    pub plausible: bool,
    /// True if the fit can be the calibration of a sensor.
    pub sound: bool,
}

impl NormFit {
    /// Fits the norm of gravity to static means with white noise `noise` each, in the unit of the readings; `None`
    /// where there is nothing to fit or nothing to check it with.
    pub fn of(means: &[StaticMean], noise: f64, gravity: f64) -> Option<Self> {
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
        let free = mask.free_indices().len();
        let spare = means.len().checked_sub(free)?;
        let options = Options {
            max_iterations: MOST_STEPS.get(),
            ..Options::default()
        };
        let report = (spare > 0).then(|| solve(&problem, &start, &mask, &options));
        let report = report?.ok()?;
        let residual = report.reduced_chi2()?.sqrt().max(noise * unit.scale);
        let near = Base::from_parameters(report.parameters.values());
        let mut fit = Self {
            residual,
            spare,
            leverage: leverage(&report, &model, gravity),
            base: in_raw_unit(&near, &unit),
            plausible: of_a_sensor(&near, gravity) && residual < STILL.get() * gravity,
            sound: report.termination.converged() && report.uncertainty.rank == free,
        };
        fit.sound &= fit.plausible
            && fit
                .error()
                .is_some_and(|error| error < KNOWN_TO.get() * gravity);
        Some(fit)
    }

    /// The leverage times the residual's upper confidence limit `r √(ν / χ²_ν(1 − confidence))`.
    fn error(&self) -> Option<f64> {
        let law = ChiSquared::new(self.spare as f64).ok()?;
        let upper = (self.spare as f64 / law.inverse_cdf(1.0 - CONFIDENCE.get())).sqrt();
        Some(self.leverage * self.residual * upper)
    }

    /// The standard error of a corrected norm at its upper limit, m/s²; `None` of a fit that is no
    /// calibration.
    pub fn expected_error(&self) -> Option<f64> {
        self.error().filter(|_| self.sound)
    }
}

/// Returns true if these parameters are possible for a sensor.
fn of_a_sensor(base: &Base<f64>, gravity: f64) -> bool {
    (0..9).all(|k| {
        let (i, j) = (k / 3, k % 3);
        let value = base.t[(i, j)];
        if i == j {
            SCALES.contains(&value)
        } else {
            value.abs() < MISALIGNMENT.get()
        }
    }) && base.bias.amax() < BIAS.get() * gravity
}

/// `T (scale (A − zero) − b) = T scale (A − (zero + b / scale))`.
fn in_raw_unit(near: &Base<f64>, unit: &RawUnit) -> Base<f64> {
    Base {
        t: near.t * unit.scale,
        bias: unit.zero + near.bias / unit.scale,
    }
}

/// `√ mean(j C jᵀ)` over faces, edges and corners, `j` the derivative of the norm there.
fn leverage(report: &Report, model: &Model, gravity: f64) -> f64 {
    let everywhere: Vec<StaticMean> = orientations()
        .map(|u| StaticMean::bare(u * gravity))
        .collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_residual_from_few_placements_does_not_beat_one_from_many() {
        let fit = |residual, spare| NormFit {
            residual,
            spare,
            leverage: 1.0,
            base: Base::identity(),
            plausible: true,
            sound: true,
        };
        let (few, many) = (fit(1.8, 2), fit(2.4, 12));
        assert!(few.expected_error().unwrap() > many.expected_error().unwrap());
    }

    #[test]
    fn placements_in_one_plane_are_no_calibration() {
        let placed = |k: usize| {
            let (sin, cos) = (0.5 * k as f64).sin_cos();
            StaticMean::bare(9.8 * Vector3::new(cos, sin, 1e-4 * (k % 3) as f64))
        };
        let means: Vec<_> = (0..14).map(placed).collect();
        let fit = NormFit::of(&means, 1e-3, 9.8);
        assert!(fit.is_none_or(|fit| !fit.sound));
    }

    #[test]
    fn noise_bounds_a_residual_that_is_small_by_chance() {
        let all: Vec<_> = orientations().map(|u| StaticMean::bare(9.8 * u)).collect();
        let fit = NormFit::of(&all, 2e-3, 9.8).unwrap();
        assert!(fit.sound && fit.residual == 2e-3);
    }
}
