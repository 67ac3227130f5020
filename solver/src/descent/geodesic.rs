//! Geodesic acceleration.

use super::{Local, Step};
use crate::linear::vector::{add, scaled_norm};

/// Longest acceleration, `2 ‖D a‖ ≤ limit · ‖D v‖`; longer means that the step leaves the region
/// where the expansion holds.
const LIMIT: f64 = 0.75;

/// `v + ½ a` with `a = argmin ‖J a + r″(v)‖² + λ ‖D a‖²`, where `r″(v)` is the exact second
/// derivative of the residual along the velocity `v`; `v` itself where the problem offers none,
/// `None` where the acceleration is too long.
///
/// Source: Transtrum and Sethna, "Improvements to the Levenberg-Marquardt algorithm for nonlinear
/// least-squares minimization", 2012.
pub(crate) fn bend(local: &Local<'_>, velocity: Vec<f64>, lambda: f64) -> Option<Step> {
    let Some(curvature) = local.system.second_derivative(&local.point.z, &velocity) else {
        return Some(local.step(velocity));
    };
    let acceleration = local.factor.damped(&curvature, lambda)?;
    let ratio = 2.0 * scaled_norm(&acceleration, local.scale) / scaled_norm(&velocity, local.scale);
    (ratio <= LIMIT).then(|| Step {
        p: add(&velocity, 0.5, &acceleration),
        predicted: local.predicted(&velocity),
    })
}
