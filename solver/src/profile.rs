//! Profile likelihood intervals.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::options::Options;
use crate::parameters::Mask;
use crate::report::Report;
use crate::residual::Problem;
use crate::solve::solve;

/// Refits per side.
const REFITS: usize = 60;

/// Relative precision of an end of the interval, in standard errors.
const PRECISION: f64 = 1e-6;

/// An interval for one parameter with all others refitted at every value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProfileInterval {
    /// Name of the parameter.
    pub name: String,
    /// The fitted value.
    pub value: f64,
    /// Lower end; `None` where the cost never rises enough: the data do not bound the parameter.
    pub lower: Option<f64>,
    /// Upper end.
    pub upper: Option<f64>,
}

/// The values of parameter `name` at which the refitted cost has risen by `½ z² s²` above the
/// minimum, `s²` being the reduced chi² (1 without spare residuals): for Gaussian noise `z = 1.96`
/// gives 95 %. For a linear problem it is `value ± z · standard error`; elsewhere it needs no
/// linearisation and need not be symmetric.
///
/// `report` is the fit of `problem` under `mask` and `options`.
///
/// Source: Bates and Watts, "Nonlinear Regression Analysis and Its Applications", 1988, section 6.1.
///
/// # Errors
/// A name that no free parameter has, and what [`solve`] says of a refit.
pub fn profile_interval(
    problem: &dyn Problem,
    report: &Report,
    mask: &Mask,
    options: &Options,
    name: &str,
    z: f64,
) -> Result<ProfileInterval, Error> {
    let unknown = || Error::UnknownParameter {
        name: name.to_owned(),
    };
    let index = report.parameters.index(name).ok_or_else(unknown)?;
    let column = report
        .uncertainty
        .names
        .iter()
        .position(|n| n == name)
        .ok_or_else(unknown)?;
    let sigma = report.reduced_chi2().unwrap_or(1.0).sqrt();
    let spread = report.uncertainty.standard_error(column, sigma);
    let value = report.parameters.values()[index];
    let profile = Profile {
        problem,
        report,
        mask: mask.without(index),
        options,
        index,
        sigma,
    };
    let end = |side: f64| profile.crossing(side * spread, z);
    let (lower, upper) = if spread > 0.0 && spread.is_finite() {
        (end(-1.0)?, end(1.0)?)
    } else {
        (None, None)
    };
    Ok(ProfileInterval {
        name: name.to_owned(),
        value,
        lower,
        upper,
    })
}

struct Profile<'a> {
    problem: &'a dyn Problem,
    report: &'a Report,
    mask: Mask,
    options: &'a Options,
    index: usize,
    sigma: f64,
}

impl Profile<'_> {
    /// `√(2 (cost − minimum)) / s` with the parameter held at `value + offset`.
    fn root_deviance(&self, offset: f64) -> Result<f64, Error> {
        let mut start = self.report.parameters.clone();
        start.values_mut()[self.index] += offset;
        let cost = if self.mask.free_indices().is_empty() {
            let mut residuals = Vec::new();
            self.problem.values(start.values(), &mut residuals);
            crate::vector::half_square(&residuals)
        } else {
            solve(self.problem, &start, &self.mask, self.options)?.cost
        };
        Ok((2.0 * (cost - self.report.cost)).max(0.0).sqrt() / self.sigma)
    }

    /// Where the root deviance reaches `z` in the direction of `unit`, one standard error long.
    fn crossing(&self, unit: f64, z: f64) -> Result<Option<f64>, Error> {
        let value = self.report.parameters.values()[self.index];
        let (mut inside, mut at_inside) = (0.0, 0.0);
        let mut trial = z;
        let mut outside: Option<(f64, f64)> = None;
        for _ in 0..REFITS {
            let deviance = match self.root_deviance(trial * unit) {
                Ok(deviance) => deviance,
                // The refit cannot even start there: outside.
                Err(Error::NotFinite { .. } | Error::DerivativeNotFinite { .. }) => f64::INFINITY,
                Err(error) => return Err(error),
            };
            if deviance < z {
                (inside, at_inside) = (trial, deviance);
            } else {
                outside = Some((trial, deviance));
            }
            trial = match outside {
                None => 2.0 * trial,
                Some((end, _)) if end - inside <= PRECISION * z => {
                    return Ok(Some(value + end * unit));
                }
                Some((end, at_end)) => between(inside, at_inside, end, at_end, z),
            };
        }
        Ok(outside.map(|(end, _)| value + end * unit))
    }
}

/// A point of the bracket by linear interpolation, kept off its ends.
fn between(inside: f64, at_inside: f64, end: f64, at_end: f64, z: f64) -> f64 {
    let share = (z - at_inside) / (at_end - at_inside);
    let share = if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.5
    };
    // Overshoot a little to both sides in turn, so that the bracket shrinks from both.
    let nudge = if at_end - z > z - at_inside {
        1.02
    } else {
        0.98
    };
    inside + (end - inside) * (share * nudge).clamp(0.01, 0.99)
}
