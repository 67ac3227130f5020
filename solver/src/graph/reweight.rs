//! Rewriting of a factor's residuals and rows for its loss.

use crate::loss::Loss;
use crate::loss::robust::LEAST_CURVATURE;

/// Cost of a factor.
pub(crate) fn cost_of(loss: Option<&Loss>, residuals: &[f64]) -> f64 {
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    match loss {
        None => 0.5 * square,
        Some(loss) => loss.cost_of_square(square),
    }
}

/// Rewrites residuals and rows of a factor so that they give the gradient and the Gauss–Newton
/// Hessian of its loss.
///
/// Source: Triggs, McLauchlan, Hartley and Fitzgibbon, "Bundle adjustment: a modern synthesis", 2000,
/// section 4.3.
pub(crate) fn rewrite(loss: &Loss, residuals: &mut [f64], jacobian: &mut [f64], width: usize) {
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    let (slope, bend) = loss.slope_and_bend(square);
    let root = slope.sqrt();
    // `c = ρ′ + 2 s ρ″` along r, `ρ′` across it: `√ρ′ (I − α r rᵀ/‖r‖²)`, `(1 − α)² = c/ρ′`.
    let curvature = (slope + 2.0 * square * bend).max(LEAST_CURVATURE * slope);
    let along = if slope > 0.0 {
        (curvature / slope).sqrt()
    } else {
        1.0
    };
    let alpha = 1.0 - along;
    if alpha != 0.0 && square > 0.0 && width > 0 {
        for c in 0..width {
            let rows = || jacobian.iter().skip(c).step_by(width);
            let dot: f64 = rows().zip(&*residuals).map(|(j, r)| j * r).sum();
            let factor = alpha * dot / square;
            let rows = jacobian.iter_mut().skip(c).step_by(width);
            rows.zip(&*residuals).for_each(|(j, r)| *j -= factor * r);
        }
    }
    jacobian.iter_mut().for_each(|j| *j *= root);
    residuals.iter_mut().for_each(|r| *r *= root / along);
}
