//! Damped least squares on a triangle.

use super::triangle::Triangle;
use crate::linear::vector::dot;

/// `argmin ‖R w + q‖² + λ ‖w‖²` for an upper trapezoid `R` (`rows × n`, `rows ≤ n`): rotates the
/// diagonal `√λ I` into `R` row by row, then substitutes back.
///
/// For the few columns of a usual problem this costs a fraction of a QR of the stacked matrix.
///
/// Source: Moré, "The Levenberg-Marquardt algorithm: implementation and theory", 1978 (`qrsolv`).
pub(crate) fn damped_triangle(r: &Triangle, q: &[f64], lambda: f64) -> Vec<f64> {
    let n = r.columns();
    let mut rows = Vec::with_capacity((n + 1) * n);
    rows.extend_from_slice(r.entries());
    rows.resize((n + 1) * n, 0.0);
    let (rows, damping) = rows.split_at_mut(n * n);
    let mut w: Vec<f64> = (0..n).map(|i| q.get(i).map_or(0.0, |q| -q)).collect();
    for first in 0..n {
        damping[first..].fill(0.0);
        damping[first] = lambda.sqrt();
        let mut right = 0.0;
        for k in first..n {
            let row = &mut rows[k * n + k..(k + 1) * n];
            rotate_in(row, &mut w[k], &mut damping[k..], &mut right);
        }
    }
    for i in (0..n).rev() {
        let row = &rows[i * n..(i + 1) * n];
        w[i] = (w[i] - dot(&row[i + 1..], &w[i + 1..])) / row[i];
    }
    w
}

/// Rotates two equations `row · x = left` and `damping · x = right` so that `damping[0]` vanishes.
#[inline]
fn rotate_in(row: &mut [f64], left: &mut f64, damping: &mut [f64], right: &mut f64) {
    if damping[0] == 0.0 {
        return;
    }
    let length = hypotenuse(row[0], damping[0]);
    let (cosine, sine) = (row[0] / length, damping[0] / length);
    let rotate = |a: &mut f64, b: &mut f64| {
        (*a, *b) = (cosine * *a + sine * *b, cosine * *b - sine * *a);
    };
    let damping = &mut damping[..row.len()];
    for k in 0..row.len() {
        rotate(&mut row[k], &mut damping[k]);
    }
    rotate(left, right);
}

/// `√(a² + b²)`; the plain formula, three times as fast, where nothing under- or overflows.
#[inline]
fn hypotenuse(a: f64, b: f64) -> f64 {
    let square = a * a + b * b;
    if square.is_normal() {
        square.sqrt()
    } else {
        a.hypot(b)
    }
}
