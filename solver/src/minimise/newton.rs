//! The part of the Hessian that Gauss–Newton leaves out, for the last steps.

use faer::linalg::solvers::SolveCore;
use faer::{Conj, Mat, MatRef, Side};

use crate::descent::{Local, Step};
use crate::linear::vector::{add, dot};
use crate::linear::{Jacobian, multiply, transpose_multiply};
use crate::minimise::point::Point;
use crate::minimise::system::System;

/// Most directions; the number of second derivatives grows with the square.
const MOST_DIRECTIONS: usize = 24;

/// `Bᵀ S B` with `S = Σ rᵢ ∇²rᵢ`, for directions `B` (`n × d`).
///
/// Entries off the diagonal come from second derivatives along sums of two directions:
/// `2 S(u, v) = S(u + v) − S(u) − S(v)`.
pub(crate) fn curvature(
    system: &dyn System,
    point: &Point,
    directions: MatRef<'_, f64>,
) -> Option<Mat<f64>> {
    let d = directions.ncols();
    if d > MOST_DIRECTIONS {
        return None;
    }
    let column = |k: usize| -> Vec<f64> { directions.col(k).iter().copied().collect() };
    let along = |v: &[f64]| -> Option<f64> {
        Some(dot(
            &system.second_derivative(&point.z, v)?,
            &point.at.residuals,
        ))
    };
    let mut s = Mat::zeros(d, d);
    for i in 0..d {
        s[(i, i)] = along(&column(i))?;
        for k in 0..i {
            let both = along(&add(&column(i), 1.0, &column(k)))?;
            s[(i, k)] = 0.5 * (both - s[(i, i)] - s[(k, k)]);
            s[(k, i)] = s[(i, k)];
        }
    }
    Some(s)
}

/// `argmin ½ uᵀ (BᵀJᵀJB + S) u + rᵀJ B u`, as `B u`; `None` where the Hessian is not positive definite.
pub(crate) fn step(point: &Point, directions: MatRef<'_, f64>, s: &Mat<f64>) -> Option<Vec<f64>> {
    let Jacobian(jacobian) = &point.at.jacobian;
    let along = jacobian * directions;
    let hessian = along.transpose() * &along + s;
    let gradient = transpose_multiply(along.as_ref(), &point.at.residuals);
    let mut u = Mat::from_fn(gradient.len(), 1, |k, _| -gradient[k]);
    hessian
        .llt(Side::Lower)
        .ok()?
        .solve_in_place_with_conj(Conj::No, u.as_mut());
    let u: Vec<f64> = (0..gradient.len()).map(|k| u[(k, 0)]).collect();
    let p = multiply(directions, &u);
    p.iter().all(|v| v.is_finite()).then_some(p)
}

/// `argmin ½ pᵀ (JᵀJ + S + λ D²) p + rᵀJ p` with `S` known in scaled directions `D⁻¹`; `None` where
/// the damped Hessian is not positive definite.
pub(crate) fn damped_step(local: &Local<'_>, s: &Mat<f64>, lambda: f64) -> Option<Step> {
    let n = local.scale.len();
    let scaled = Mat::from_fn(n, n, |i, k| if i == k { 1.0 / local.scale[i] } else { 0.0 });
    let damped = Mat::from_fn(n, n, |i, k| s[(i, k)] + if i == k { lambda } else { 0.0 });
    let p = step(local.point, scaled.as_ref(), &damped)?;
    let predicted = local.predicted(&p);
    Some(Step { p, predicted })
}
