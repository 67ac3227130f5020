//! The Levenberg–Marquardt step.

use super::{Descent, Local, Step, geodesic};

/// Relative offset below which the rest of the way is so short that bending it changes nothing worth
/// a second derivative.
const STRAIGHT: f64 = 3e-3;

/// `argmin ‖J p + r‖² + λ ‖D p‖²`, bent along the geodesic where second derivatives are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damped {
    /// Whether to add the geodesic acceleration.
    pub geodesic: bool,
}

impl Descent for Damped {
    fn step(&self, local: &Local<'_>, lambda: f64) -> Option<Step> {
        let velocity = local.factor.damped(&local.point.at.residuals, lambda)?;
        self.bent(local, velocity, lambda)
    }
}

impl Damped {
    /// The step of a velocity.
    pub fn bent(&self, local: &Local<'_>, velocity: Vec<f64>, lambda: f64) -> Option<Step> {
        if self.geodesic && local.offset > STRAIGHT {
            return geodesic::bend(local, velocity, lambda);
        }
        Some(Step {
            predicted: local.predicted(&velocity),
            p: velocity,
        })
    }
}
