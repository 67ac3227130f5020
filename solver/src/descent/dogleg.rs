//! Powell's dogleg.

use super::{Descent, Local, Step};
use crate::linear::vector::{add, dot, scaled_norm};

/// The path from the steepest descent to the Gauss–Newton step, cut at radius `‖D p‖ = Δ`.
///
/// Source: Powell, "A hybrid method for nonlinear equations", 1970.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dogleg;

impl Descent for Dogleg {
    fn step(&self, local: &Local<'_>, radius: f64) -> Option<Step> {
        let newton = local.factor.undamped(&local.point.at.residuals);
        let p = match newton {
            Some(newton) if scaled_norm(&newton, local.scale) <= radius => newton,
            newton => {
                let cauchy = cauchy(local)?;
                let length = scaled_norm(&cauchy, local.scale);
                match newton {
                    Some(newton) if length < radius => cut(&cauchy, &newton, local.scale, radius),
                    _ => cauchy
                        .iter()
                        .map(|v| v * (radius / length).min(1.0))
                        .collect(),
                }
            }
        };
        Some(local.step(p))
    }
}

/// The minimum of the linearised cost along the scaled steepest descent, `p = −t D⁻² Jᵀr`.
fn cauchy(local: &Local<'_>) -> Option<Vec<f64>> {
    let gradient = local.point.gradient();
    let direction: Vec<f64> = gradient
        .iter()
        .zip(local.scale)
        .map(|(g, s)| -g / (s * s))
        .collect();
    let change = local.point.at.jacobian.multiply(&direction);
    let t = -dot(&gradient, &direction) / dot(&change, &change);
    t.is_finite()
        .then(|| direction.iter().map(|d| t * d).collect())
}

/// The point at distance `radius` between `from` (inside) and `to` (outside).
pub(super) fn cut(from: &[f64], to: &[f64], scale: &[f64], radius: f64) -> Vec<f64> {
    let leg = add(to, -1.0, from);
    let a = scaled_norm(&leg, scale).powi(2);
    let b: f64 = from
        .iter()
        .zip(&leg)
        .zip(scale)
        .map(|((f, l), s)| f * l * s * s)
        .sum();
    let c = radius * radius - scaled_norm(from, scale).powi(2);
    // The root of a t² + 2 b t = c between 0 and 1, without cancellation.
    let root = (b * b + a * c).sqrt();
    let t = if b > 0.0 {
        c / (b + root)
    } else {
        (root - b) / a
    };
    add(from, t, &leg)
}
