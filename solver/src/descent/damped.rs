//! The Levenberg–Marquardt step.

use super::{Descent, Local, Step, geodesic};

/// `argmin ‖J p + r‖² + λ ‖D p‖²`, bent along the geodesic where second derivatives are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damped {
    /// Whether to add the geodesic acceleration.
    pub geodesic: bool,
}

impl Descent for Damped {
    fn step(&self, local: &Local<'_>, lambda: f64) -> Option<Step> {
        let velocity = local.factor.damped(&local.point.at.residuals, lambda)?;
        let predicted = local.predicted(&velocity);
        let p = if self.geodesic {
            geodesic::bend(local, velocity, lambda)?
        } else {
            velocity
        };
        Some(Step { p, predicted })
    }
}
