//! Steps where a column of the Jacobian vanishes though the cost bends along its parameter.

use faer::Mat;

use crate::linear::vector::{add, dot};
use crate::minimise::ending::is_below_rounding;
use crate::minimise::newton;
use crate::minimise::point::Point;
use crate::minimise::scaling::unit_if_zero;
use crate::minimise::system::System;

/// Most steps.
const MOST: usize = 40;

/// Most halvings of a step.
const HALVINGS: usize = 10;

/// A lower point by steps that know how the residuals bend along every parameter:
/// `(JᵀJ + C) p = −Jᵀr`, `C = diag(max(0, r · r″ₖ))`; `None` where none leads lower, or where the
/// problem offers no second derivatives.
///
/// Where `Jₖ` goes to zero, as that of `x²` does at zero, a step of the linear model leaps along `k`
/// whatever the damping, which is relative to `‖Jₖ‖`: it hides the way down along the others.
pub(crate) fn lower(system: &dyn System, point: &Point) -> Option<Point> {
    let mut best: Option<Point> = None;
    for _ in 0..MOST {
        let here = best.as_ref().unwrap_or(point);
        let Some(next) = step(system, here) else {
            break;
        };
        best = Some(next);
    }
    best
}

/// One step that lowers the cost by more than rounding.
fn step(system: &dyn System, point: &Point) -> Option<Point> {
    let norms = point.at.jacobian.column_norms();
    let n = norms.len();
    let mut bends = Vec::with_capacity(n);
    for k in 0..n {
        let mut axis = vec![0.0; n];
        axis[k] = 1.0;
        let second = system.second_derivative(&point.z, &axis)?;
        bends.push(dot(&point.at.residuals, &second).max(0.0));
    }
    let scale: Vec<f64> = (norms.iter().zip(&bends))
        .map(|(norm, bend)| unit_if_zero(norm.hypot(bend.sqrt())))
        .collect();
    let diagonal = |k: usize, i: usize, value: f64| if i == k { value } else { 0.0 };
    let directions = Mat::from_fn(n, n, |i, k| diagonal(k, i, 1.0 / scale[k]));
    let curvature = Mat::from_fn(n, n, |i, k| {
        diagonal(k, i, bends[k] / (scale[k] * scale[k]))
    });
    let p = newton::step(point, directions.as_ref(), &curvature)?;
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let z = add(&point.z, length, &p);
        let fall = point.at.cost - system.cost(&z);
        if fall > 0.0 && !is_below_rounding(point, fall) {
            return Point::new(system, z).ok();
        }
        length *= 0.5;
    }
    None
}
