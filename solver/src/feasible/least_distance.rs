//! The active constraints of the damped step as a least-distance problem.

use faer::{Mat, MatRef};

use super::multipliers::nonnegative;
use super::quadratic_program::{OneSided, one_sided};
use super::{Active, Model, Side};
use crate::linear::QrFactor;
use crate::linear::vector::{dot, norm};

/// The constraints that hold with equality at the minimum of a model, to rounding even where many
/// depend on each other; `None` where the damped normal matrix is singular.
///
/// With `RᵀR = D⁻¹JᵀJD⁻¹ + λ` and `u = R (D p − D p₀)`, `p₀` the minimum without constraints, it is
/// the least `‖u‖` with `Gᵀu ≥ h`, whose multipliers solve `min ‖(G; hᵀ) μ − (0; 1)‖`, `μ ≥ 0`.
///
/// Source: Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23 (LSI, LDP).
pub(super) fn least_distance(model: &Model<'_>) -> Option<Vec<Active>> {
    let unit = norm(model.residuals);
    let factor = QrFactor::new(model.jacobian, model.scale);
    let free: Vec<f64> = model
        .solved(&factor, model.residuals)?
        .iter()
        .zip(model.scale)
        .map(|(p, s)| p * s / unit)
        .collect();
    let sides = one_sided(model.polytope, model.z, model.scale, unit);
    let root = root(model);
    let rows: Option<Vec<Row>> = sides
        .iter()
        .map(|side| Row::new(side, &free, root.as_ref()))
        .collect();
    Some(pressed(&sides, &rows?))
}

/// `R` of the damped Jacobian (`n × n`).
fn root(model: &Model<'_>) -> Mat<f64> {
    let ((m, n), damping) = (model.jacobian.shape(), model.lambda.sqrt());
    let stacked = Mat::from_fn(m + n, n, |i, k| match i < m {
        true => model.jacobian[(i, k)] / model.scale[k],
        false if i == m + k => damping,
        false => 0.0,
    });
    stacked.qr().thin_R().to_owned()
}

/// `normal · u ≥ distance`, of unit normal.
struct Row {
    normal: Vec<f64>,
    distance: f64,
}

impl Row {
    fn new(side: &OneSided, free: &[f64], root: MatRef<'_, f64>) -> Option<Self> {
        let outward = transposed_solve(root, &side.a);
        let size = norm(&outward);
        let distance = (dot(&side.a, free) - side.room) / size;
        (size > 0.0 && distance.is_finite()).then(|| Self {
            normal: outward.iter().map(|v| -v / size).collect(),
            distance,
        })
    }
}

/// `R⁻ᵀ a`.
fn transposed_solve(r: MatRef<'_, f64>, a: &[f64]) -> Vec<f64> {
    let mut w = a.to_vec();
    for i in 0..w.len() {
        let known: f64 = (0..i).map(|k| r[(k, i)] * w[k]).sum();
        w[i] = (w[i] - known) / r[(i, i)];
    }
    w
}

/// The sides whose multiplier is not zero, and equalities.
fn pressed(sides: &[OneSided], rows: &[Row]) -> Vec<Active> {
    let equality = |i: usize| sides[i].active.side == Side::Both;
    // In units of the way to the farthest, which makes the last row comparable to the others.
    let far = (0..rows.len()).map(|i| match equality(i) {
        true => rows[i].distance.abs(),
        false => rows[i].distance,
    });
    let far = far.fold(f64::MIN_POSITIVE, f64::max);
    let n = rows.first().map_or(0, |row| row.normal.len());
    let last: Vec<f64> = rows.iter().map(|row| row.distance / far).collect();
    let columns = Mat::from_fn(n + 1, rows.len(), |i, k| {
        let entry = if i < n { rows[k].normal[i] } else { last[k] };
        entry / last[k].hypot(1.0)
    });
    let target: Vec<f64> = (0..=n).map(|i| if i < n { 0.0 } else { 1.0 }).collect();
    let free: Vec<bool> = (0..rows.len()).map(equality).collect();
    let multipliers = nonnegative(columns.as_ref(), &target, &free);
    (0..rows.len())
        .filter(|&i| equality(i) || multipliers[i] != 0.0)
        .map(|i| sides[i].active)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A side at least `distance` away along `normal`, the `row`-th.
    fn side(row: usize, normal: [f64; 2], distance: f64) -> (OneSided, Row) {
        let active = Active {
            row,
            side: Side::Lower,
        };
        let (a, normal) = (normal.map(|v| -v).to_vec(), normal.to_vec());
        let room = -distance;
        (OneSided { a, room, active }, Row { normal, distance })
    }

    #[test]
    fn sides_press_that_the_nearest_point_touches_at_any_distance() {
        for unit in [1e-9, 1.0, 1e9] {
            // The nearest point with x ≥ 1, y ≥ 2 and x + y ≥ 2 touches the first two.
            let slanted = 0.5_f64.sqrt();
            let all = [
                side(0, [1.0, 0.0], unit),
                side(1, [0.0, 1.0], 2.0 * unit),
                side(2, [slanted, slanted], 2.0 * slanted * unit),
            ];
            let (sides, rows): (Vec<OneSided>, Vec<Row>) = all.into_iter().unzip();
            let pressed = pressed(&sides, &rows);
            let touched: Vec<usize> = pressed.iter().map(|active| active.row).collect();
            assert_eq!(touched, [0, 1], "{unit}");
        }
    }
}
