//! Profile likelihood intervals.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::feasible::Polytope;
use crate::linear::vector::norm;
use crate::loss::robust::Losses;
use crate::options::Options;
use crate::parameters::{Mask, Parameters};
use crate::report::{Report, Termination};
use crate::residual::Problem;
use crate::solve::solve;

/// Refits per side.
const REFITS: usize = 80;

/// Farthest end that is looked for, in standard errors: beyond, rounding bounds the parameter and
/// not the data.
const FARTHEST: f64 = 1e12;

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
    /// Upper end, likewise.
    pub upper: Option<f64>,
}

/// The values of parameter `name` at which the refitted cost has risen by `½ z² s²` above the
/// minimum, `s²` being [`Report::variance`] (1 without spare residuals). For a linear problem it is
/// `value ± z · standard error`; elsewhere it needs no linearisation and need not be symmetric.
///
/// For Gaussian noise `z = 1.96` gives 95 % where residuals are many; with few to spare `z` is the
/// quantile of Student's t with `m − rank` degrees of freedom (2.45 for six). An interval that
/// meets a constraint ends there. The scale of a robust loss stays as it was found.
///
/// `report` is the fit of `problem` under `mask` and `options`.
///
/// Source: Bates and Watts, "Nonlinear Regression Analysis and Its Applications", 1988, section 6.1.
///
/// # Errors
/// A name that no free parameter has, a `z` that is not positive, a refit stopped by the options'
/// limits, and what [`solve`] says of a refit.
///
/// # Examples
/// ```
/// use stillpoint_solver::{DualNum, Jet, Mask, Options, Parameters, from_fn, profile_interval, solve};
///
/// let data = [(0.0, 2.1), (1.0, 1.2), (2.0, 0.8), (3.0, 0.4), (4.0, 0.3)];
/// let decay = from_fn(|x: &[Jet], r: &mut Vec<Jet>| {
///     r.extend(data.iter().map(|&(t, y)| x[0] * (-x[1] * t).exp() - y));
/// });
/// let (start, mask, options) = (Parameters::unnamed(&[1.0, 1.0]), Mask::all(2), Options::default());
/// let report = solve(&decay, &start, &mask, &options)?;
/// let rate = profile_interval(&decay, &report, &mask, &options, "x1", 3.18)?; // 95 % with three to spare
/// assert!(rate.lower.is_some_and(|lower| lower < rate.value) && rate.upper.is_some_and(|upper| upper > rate.value));
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn profile_interval(
    problem: &dyn Problem,
    report: &Report,
    mask: &Mask,
    options: &Options,
    name: &str,
    z: f64,
) -> Result<ProfileInterval, Error> {
    if !(z > 0.0 && z.is_finite()) {
        return Err(Error::ProfileLevel { z });
    }
    let unknown = || Error::UnknownParameter {
        name: name.to_owned(),
    };
    let index = report.parameters.index(name).ok_or_else(unknown)?;
    let names = &report.uncertainty.names;
    let column = names.iter().position(|n| n == name).ok_or_else(unknown)?;
    let profile = Profile {
        problem,
        report,
        mask: mask.without(index),
        options: with_known_scale(options, report),
        index,
        sigma: report.variance.unwrap_or(1.0).sqrt(),
        z,
    };
    let unit = profile.unit(column);
    let value = report.parameters.values()[index];
    let mut deviance = |offset: f64| profile.root_deviance(offset);
    Ok(ProfileInterval {
        name: name.to_owned(),
        value,
        lower: crossing(value, -unit, z, &mut deviance)?,
        upper: crossing(value, unit, z, &mut deviance)?,
    })
}

/// Costs under different scales of a loss cannot be compared.
fn with_known_scale(options: &Options, report: &Report) -> Options {
    let loss = report
        .loss_scale
        .map_or(options.loss, |scale| options.loss.with_scale(scale));
    let mut row_losses = options.row_losses.clone();
    for (group, scale) in row_losses.iter_mut().zip(&report.row_loss_scales) {
        group.loss = scale.map_or(group.loss, |scale| group.loss.with_scale(scale));
    }
    Options {
        loss,
        row_losses,
        graduated: false,
        ..options.clone()
    }
}

struct Profile<'a> {
    problem: &'a dyn Problem,
    report: &'a Report,
    mask: Mask,
    options: Options,
    index: usize,
    sigma: f64,
    z: f64,
}

impl Profile<'_> {
    /// A standard error, to step by. Where the covariance has none (on a constraint, or without
    /// noise) the one with all other parameters held.
    fn unit(&self, column: usize) -> f64 {
        let usable = |unit: &f64| *unit > 0.0 && unit.is_finite();
        let spread = self.report.uncertainty.standard_error(column, self.sigma);
        let x = self.report.parameters.values();
        let alone = || {
            let slope = self.problem.linearize(x, &[self.index], &mut Vec::new());
            let entries: Vec<f64> = slope.col_iter().flat_map(|c| c.iter().copied()).collect();
            self.sigma / norm(&entries)
        };
        Some(spread)
            .filter(usable)
            .or_else(|| Some(alone()).filter(usable))
            .or_else(|| Some(x[self.index].abs()).filter(usable))
            .unwrap_or(1.0)
    }

    /// `√(2 (cost − minimum)) / s` with the parameter held at `value + offset`; infinite where
    /// that is not possible.
    fn root_deviance(&self, offset: f64) -> Result<f64, Error> {
        let mut start = self.report.parameters.clone();
        start.values_mut()[self.index] += offset;
        let cost = match self.refitted(&mut start) {
            Ok(cost) => cost,
            Err(
                Error::NotFinite { .. }
                | Error::DerivativeNotFinite { .. }
                | Error::StartInfeasible { .. },
            ) => f64::INFINITY,
            Err(error) => return Err(error),
        };
        Ok(self.root_rise(cost))
    }

    fn root_rise(&self, cost: f64) -> f64 {
        let rise = cost - self.report.cost;
        if rise > 0.0 {
            (2.0 * rise).sqrt() / self.sigma
        } else {
            0.0
        }
    }

    /// The least cost with the parameter held.
    fn refitted(&self, start: &mut Parameters) -> Result<f64, Error> {
        let constraints = &self.options.constraints;
        if self.mask.free_indices().is_empty() {
            if let Some(polytope) = Polytope::new(constraints, start, &self.mask)? {
                polytope.check(&[])?;
            }
            let mut residuals = Vec::new();
            self.problem.values(start.values(), &mut residuals);
            let losses = Losses::new(self.options.loss, &self.options.row_losses);
            return Ok(losses.cost(&residuals));
        }
        constraints.project(start, &self.mask)?;
        let refit = solve(self.problem, start, &self.mask, &self.options)?;
        let stopped = matches!(
            refit.termination,
            Termination::Cancelled | Termination::TimeLimit | Termination::IterationLimit
        );
        // A cost below the level is below it, wherever the refit would have ended.
        if stopped && self.root_rise(refit.cost) >= self.z {
            return Err(Error::Refit {
                termination: refit.termination,
            });
        }
        Ok(refit.cost)
    }
}

/// Offset at which the root deviance, asked for by offset, reaches `z` in the direction of `unit`, one standard error
/// long.
pub(crate) fn crossing(
    value: f64,
    unit: f64,
    z: f64,
    root_deviance: &mut dyn FnMut(f64) -> Result<f64, Error>,
) -> Result<Option<f64>, Error> {
    let (mut inside, mut at_inside) = (0.0, 0.0);
    let mut trial = z;
    let mut outside: Option<(f64, f64)> = None;
    for _ in 0..REFITS {
        let deviance = root_deviance(trial * unit)?;
        if deviance < z {
            (inside, at_inside) = (trial, deviance);
        } else {
            outside = Some((trial, deviance));
        }
        trial = match outside {
            None if trial > FARTHEST * z => return Ok(None),
            None => 2.0 * trial,
            Some((end, _)) if end - inside <= PRECISION * z => break,
            Some((end, at_end)) => between(inside, at_inside, end, at_end, z),
        };
    }
    // Next to a wall the last value before it.
    Ok(outside.map(|(end, at_end)| {
        let end = if at_end.is_finite() { end } else { inside };
        value + end * unit
    }))
}

/// A point of the bracket by linear interpolation, kept off its ends; the middle next to a wall.
fn between(inside: f64, at_inside: f64, end: f64, at_end: f64, z: f64) -> f64 {
    if at_end.is_infinite() {
        return 0.5 * (inside + end);
    }
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
