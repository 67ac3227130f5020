//! The damped step as a quadratic program.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{NonnegativeConeT, SupportedConeT, ZeroConeT};
use faer::Mat;

use super::{Active, Model, Polytope, Side};
use crate::ConeProgram;
use crate::linear::transpose_multiply;
use crate::linear::vector::{dot, norm, unscaled};

/// The constraints that hold with equality at the minimum of `½ ‖J p + r‖² + ½ λ ‖D p‖²` over
/// `lower ≤ A (z + p) ≤ upper`; `None` where the interior point fails.
///
/// The interior point stops some 1e-10 off its constraints. It is asked for the active ones only;
/// the step itself is solved again on their face.
pub(super) fn active_at_minimum(model: &Model<'_>) -> Option<Vec<Active>> {
    let Model {
        polytope,
        z,
        jacobian,
        residuals,
        scale,
        lambda,
    } = *model;
    let n = z.len();
    // In units of D for the step and of ‖r‖ for the cost.
    let unit = norm(residuals);
    let scaled = Mat::from_fn(jacobian.nrows(), n, |i, k| jacobian[(i, k)] / scale[k]);
    let normal = scaled.transpose() * &scaled;
    let quadratic = upper_triangle(n, |i, k| normal[(i, k)] + if i == k { lambda } else { 0.0 });
    let linear: Vec<f64> = transpose_multiply(scaled.as_ref(), residuals)
        .iter()
        .map(|g| g / unit)
        .collect();
    let sides = one_sided(polytope, z, scale, unit);
    let equalities = sides.iter().filter(|s| s.active.side == Side::Both).count();
    let cones: [SupportedConeT<f64>; 2] = [
        ZeroConeT(equalities),
        NonnegativeConeT(sides.len() - equalities),
    ];
    let matrix = columns(sides.len(), n, |i, k| sides[i].a[k]);
    let limits: Vec<f64> = sides.iter().map(|s| s.room).collect();
    let program = ConeProgram {
        curvature: &quadratic,
        slope: &linear,
        matrix: &matrix,
        limits: &limits,
        cones: &cones,
    };
    let found = program.solve()?;
    if found.x.iter().any(|v| !v.is_finite()) {
        return None;
    }
    let held = |i: &usize| sides[*i].active.side == Side::Both || found.dual[*i] > found.slack[*i];
    Some(
        (0..sides.len())
            .filter(held)
            .map(|i| sides[i].active)
            .collect(),
    )
}

/// `a · y ≤ room`.
pub(super) struct OneSided {
    /// Unit row of `A D⁻¹`, outward (`n`).
    pub a: Vec<f64>,
    /// Way to the limit; not negative at a feasible point.
    pub room: f64,
    /// The constraint and its limit.
    pub active: Active,
}

/// The constraints with unit rows, equalities first, `y` in units of `unit`.
pub(super) fn one_sided(polytope: &Polytope, z: &[f64], scale: &[f64], unit: f64) -> Vec<OneSided> {
    let mut sides = Vec::new();
    for (row, constraint) in polytope.rows().iter().enumerate() {
        let a = unscaled(&constraint.a, scale);
        let size = norm(&a);
        if size == 0.0 {
            continue;
        }
        let value = dot(&constraint.a, z);
        let mut push = |sign: f64, room: f64, side: Side| {
            if room.is_finite() {
                let a = a.iter().map(|a| sign * a / size).collect();
                sides.push(OneSided {
                    a,
                    room: room / size / unit,
                    active: Active { row, side },
                });
            }
        };
        if constraint.lower == constraint.upper {
            push(1.0, constraint.upper - value, Side::Both);
        } else {
            push(1.0, constraint.upper - value, Side::Upper);
            push(-1.0, value - constraint.lower, Side::Lower);
        }
    }
    sides.sort_by_key(|side| side.active.side != Side::Both);
    sides
}

fn columns(m: usize, n: usize, entry: impl Fn(usize, usize) -> f64) -> CscMatrix<f64> {
    sparse(m, n, |_, _| true, entry)
}

fn upper_triangle(n: usize, entry: impl Fn(usize, usize) -> f64) -> CscMatrix<f64> {
    sparse(n, n, |i, k| i <= k, entry)
}

/// A column-compressed matrix of the entries that are wanted and not zero.
fn sparse(
    m: usize,
    n: usize,
    wanted: impl Fn(usize, usize) -> bool,
    entry: impl Fn(usize, usize) -> f64,
) -> CscMatrix<f64> {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for k in 0..n {
        for i in (0..m).filter(|&i| wanted(i, k)) {
            let value = entry(i, k);
            if value != 0.0 {
                rows.push(i);
                values.push(value);
            }
        }
        starts.push(rows.len());
    }
    CscMatrix::new(m, n, starts, rows, values)
}
