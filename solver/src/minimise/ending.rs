//! Judgement of the last point: a minimum, a zero, a saddle, or none of these.

use crate::linear::Factor;
use crate::linear::vector::{add, dot, norm, scaled_norm};
use crate::minimise::finish::Verdict;
use crate::minimise::point::{NotFinite, Point};
use crate::minimise::stop::Stop;
use crate::minimise::system::System;
use crate::options::Options;
use crate::report::Termination;

/// Relative Gauss–Newton step below which a point is as good as a minimum where rounding keeps the
/// offset from falling (residuals near zero).
const SMALL_STEP: f64 = 1e-8;

/// The same where a limit cut the run short, so that a shorter step may only be a matter of time.
const ROUNDING_STEP: f64 = 1e-14;

/// Multiples of the rounding of one operation that a sum of squares is trusted to.
const ROUNDING: f64 = 16.0;

/// Relative Gauss–Newton step beyond which a flat point may be a plateau on the way to infinity.
const FAR: f64 = 1e3;

/// Curvature along a direction, relative to its parts, that counts as negative.
const NEGATIVE: f64 = 1e-6;

/// Most lengths tried on the way off a saddle.
const LENGTHS: usize = 30;

/// The reason in the user's terms: what the point is, before how the loop was left.
pub(crate) fn termination(
    stop: Stop,
    point: &Point,
    verdict: &Verdict,
    options: &Options,
) -> Termination {
    if stop == Stop::Cancelled {
        return Termination::Cancelled;
    }
    if stop == Stop::Zero || is_zero(point) {
        return Termination::Zero;
    }
    if verdict.offset <= options.gradient_tolerance {
        return Termination::Gradient;
    }
    let limited = matches!(stop, Stop::IterationLimit | Stop::TimeLimit);
    if verdict.relative_step <= if limited { ROUNDING_STEP } else { SMALL_STEP } {
        return Termination::Step;
    }
    match stop {
        Stop::IterationLimit => Termination::IterationLimit,
        Stop::TimeLimit => Termination::TimeLimit,
        Stop::NotFinite(NotFinite::Residual { row, .. }) => Termination::NotFinite {
            row,
            parameter: None,
        },
        Stop::NotFinite(NotFinite::Derivative { row, column }) => Termination::NotFinite {
            row,
            parameter: Some(column),
        },
        _ if promises_nothing(point, verdict) => Termination::Cost,
        _ => Termination::Stalled,
    }
}

/// Rounding of the residual vector: `ε (‖r‖ + ‖D z‖)` with the column norms `D`, whatever the units.
fn rounding(point: &Point) -> (f64, f64) {
    let size = norm(&point.at.residuals);
    let from_parameters = scaled_norm(&point.z, &point.at.jacobian.column_norms());
    (f64::EPSILON * from_parameters, size)
}

/// True where the residuals are no larger than what rounding of the parameters makes of them.
pub(crate) fn is_zero(point: &Point) -> bool {
    let (rounding, size) = rounding(point);
    size <= rounding
}

/// True where the fall of the cost that the linear model promises, `½ ‖P r‖²`, is below the rounding
/// of the cost.
fn promises_nothing(point: &Point, verdict: &Verdict) -> bool {
    is_below_rounding(point, 0.5 * verdict.tangential * verdict.tangential)
}

/// True where a fall of the cost is below what rounding of residuals and parameters makes of it.
pub(crate) fn is_below_rounding(point: &Point, fall: f64) -> bool {
    let (rounding, size) = rounding(point);
    let of_cost = size * (f64::EPSILON * size + rounding) + rounding * rounding;
    fall <= ROUNDING * of_cost
}

/// True where no damped step and no step along one parameter leads lower, and the parabola along each, with the gradient's slope here and
/// the cost found after it, promises less than rounding: `(g·p)² / 4 (rise − g·p)`. Where a column of
/// the Jacobian vanishes at a minimum, the linear model promises much and these nothing.
pub(crate) fn is_flat_all_around(system: &dyn System, point: &Point, verdict: &Verdict) -> bool {
    let Some(factor) = verdict
        .factor
        .as_ref()
        .filter(|_| verdict.relative_step <= FAR)
    else {
        return false;
    };
    let residuals = &point.at.residuals;
    let along = |p: &[f64]| {
        let slope = dot(residuals, &point.at.jacobian.multiply(p));
        let rise = system.cost(&add(&point.z, 1.0, p)) - point.at.cost;
        if rise < 0.0 {
            return -rise;
        }
        if !rise.is_finite() {
            // A step to where nothing can be computed is no evidence: the slope counts.
            return -slope;
        }
        slope * slope / (4.0 * (rise - slope)).max(f64::MIN_POSITIVE)
    };
    let flat = |p: Option<Vec<f64>>| p.is_none_or(|p| is_below_rounding(point, along(&p)));
    let norms = point.at.jacobian.column_norms();
    // Damped steps may all leap along one parameter whose column nearly vanishes.
    let alone = |k: usize| {
        let mut axis = vec![0.0; norms.len()];
        axis[k] = 1.0;
        let slope = dot(residuals, &point.at.jacobian.multiply(&axis));
        axis[k] = -slope / (norms[k] * norms[k]);
        axis[k].is_finite().then_some(axis)
    };
    (-6..=20).all(|power| flat(factor.damped(residuals, 10f64.powi(power))))
        && (0..norms.len()).all(|k| flat(alone(k)))
}

/// A lower point near a stationary one that is no minimum: along the direction that the Jacobian
/// sees least, where the curvature `‖J v‖² + r · r″(v)` is negative. `None` where it is not, or where the
/// problem offers no second derivatives.
pub(crate) fn escape(
    system: &dyn System,
    point: &Point,
    verdict: &Verdict,
    options: &Options,
) -> Option<Point> {
    if !options.variant.uses_second_derivatives() {
        return None;
    }
    let v = verdict.factor.as_ref()?.least_seen()?;
    let along = point.at.jacobian.multiply(&v);
    let second = system.second_derivative(&point.z, &v)?;
    let (straight, bent) = (dot(&along, &along), dot(&point.at.residuals, &second));
    let parts = straight + norm(&point.at.residuals) * norm(&second);
    if straight + bent >= -NEGATIVE * parts {
        return None;
    }
    let mut t = (2.0 * point.at.cost / -(straight + bent)).sqrt();
    for _ in 0..LENGTHS {
        for side in [t, -t] {
            let z = add(&point.z, side, &v);
            // Half of what the curvature promises.
            let promised = -0.5 * (straight + bent) * t * t;
            if system.cost(&z) < point.at.cost - 0.5 * promised {
                return Point::new(system, z).ok();
            }
        }
        t *= 0.5;
    }
    None
}
