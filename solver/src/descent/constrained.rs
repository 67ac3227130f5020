//! The Levenberg–Marquardt step within bounds and linear constraints.

use super::{Damped, Descent, Local, Step};
use crate::feasible::{Model, Polytope};
use crate::linear::Jacobian;

/// The damped step where it stays inside; otherwise the minimum of the damped model over the
/// feasible set.
pub(crate) struct Constrained {
    /// The feasible set.
    pub polytope: Polytope,
    /// The step without constraints.
    pub damped: Damped,
}

impl Descent for Constrained {
    fn step(&self, local: &Local<'_>, lambda: f64) -> Option<Step> {
        let velocity = local.factor.damped(&local.point.at.residuals, lambda)?;
        if self.stays_inside(local, &velocity) {
            return self.bent_inside(local, velocity, lambda);
        }
        let Jacobian::Dense(jacobian) = &local.point.at.jacobian else {
            return None;
        };
        let model = Model {
            polytope: &self.polytope,
            z: &local.point.z,
            jacobian: jacobian.as_ref(),
            residuals: &local.point.at.residuals,
            scale: local.scale,
            lambda,
        };
        let (face, velocity) = model.minimum()?;
        let factor = face.factor(jacobian.as_ref());
        let along = Local {
            factor: &factor,
            ..*local
        };
        self.bent_inside(&along, velocity, lambda)
    }
}

impl Constrained {
    /// The bent step where it stays inside, the straight one otherwise.
    fn bent_inside(&self, local: &Local<'_>, velocity: Vec<f64>, lambda: f64) -> Option<Step> {
        let bent = self.damped.bent(local, velocity.clone(), lambda)?;
        if self.stays_inside(local, &bent.p) {
            return Some(bent);
        }
        Some(Step {
            p: velocity,
            ..bent
        })
    }

    fn stays_inside(&self, local: &Local<'_>, p: &[f64]) -> bool {
        self.polytope
            .violated(&local.point.z, p, local.scale)
            .is_none()
    }
}
