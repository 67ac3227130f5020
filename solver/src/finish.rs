//! The last steps: to the precision that double precision allows.

use crate::linear::LinearSolver;
use crate::point::Point;
use crate::scaling::unit_if_zero;
use crate::system::System;
use crate::vector::{add, norm, scaled_norm};

/// Most last steps; they converge in two or three or not at all.
const MOST: usize = 60;

/// A step this short, relative to `‖D z‖`, changes nothing.
const NO_CHANGE: f64 = 2.0 * f64::EPSILON;

/// Relative rise of the cost that rounding may explain.
const ROUNDING: f64 = 1e-9;

/// What the Gauss–Newton step says of a point.
pub(crate) struct Verdict {
    /// `‖P r‖ / ‖r‖`, zero for a zero residual: the relative offset.
    pub offset: f64,
    /// `‖P r‖`, the length of the residual's part in the column space of `J`.
    pub tangential: f64,
    /// `‖D p‖ / ‖D z‖` of the undamped step.
    pub relative_step: f64,
    step: Option<Vec<f64>>,
}

impl Verdict {
    /// Solves for the undamped step by pivoted QR of the Jacobian with unit columns.
    pub fn of(point: &Point) -> Self {
        let scale: Vec<f64> = point
            .at
            .jacobian
            .column_norms()
            .into_iter()
            .map(unit_if_zero)
            .collect();
        let factor = point.at.jacobian.factor(&scale, LinearSolver::Qr);
        let residuals = &point.at.residuals;
        let tangential = factor.tangential(residuals);
        let step = factor.undamped(residuals);
        let length = step
            .as_ref()
            .map_or(f64::INFINITY, |p| scaled_norm(p, &scale));
        let size = scaled_norm(&point.z, &scale);
        Self {
            offset: if tangential > 0.0 {
                tangential / norm(residuals)
            } else {
                0.0
            },
            tangential,
            relative_step: if length > 0.0 { length / size } else { 0.0 },
            step,
        }
    }
}

/// Undamped Gauss–Newton steps while they shorten the tangential residual.
///
/// The cost changes by the square of the offset, so double precision stops resolving it at an
/// offset near 1e-8; the gradient goes on to 1e-15.
pub(crate) fn polish(system: &dyn System, point: &mut Point, evaluations: &mut usize) -> Verdict {
    let mut verdict = Verdict::of(point);
    for _ in 0..MOST {
        let Some(step) = &verdict.step else { break };
        if verdict.relative_step <= NO_CHANGE {
            break;
        }
        *evaluations += 1;
        let Ok(next) = Point::new(system, add(&point.z, 1.0, step)) else {
            break;
        };
        let after = Verdict::of(&next);
        let higher = next.at.cost > point.at.cost * (1.0 + ROUNDING);
        if higher || after.tangential >= verdict.tangential {
            break;
        }
        *point = next;
        verdict = after;
    }
    verdict
}
