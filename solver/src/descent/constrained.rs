//! The Levenberg–Marquardt step within bounds and linear constraints.

use super::{Damped, Descent, Local, Step};
use crate::feasible::{Active, Face, Polytope, active_at_minimum};
use crate::linear::{Factor, Jacobian};
use crate::vector::add;

/// Most constraints added one by one after the quadratic program.
const REPAIRS: usize = 20;

/// The damped step where it stays inside; otherwise the minimum of the damped model over the
/// feasible set, by a quadratic program for the active constraints and QR on their face.
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
        let (z, r) = (&local.point.z, &local.point.at.residuals);
        let active =
            active_at_minimum(&self.polytope, z, jacobian.as_ref(), r, local.scale, lambda)?;
        self.on_face(local, active, lambda)
    }
}

impl Constrained {
    /// The step on the face of `active`, with what it violates added until it violates nothing.
    fn on_face(&self, local: &Local<'_>, mut active: Vec<Active>, lambda: f64) -> Option<Step> {
        for _ in 0..REPAIRS {
            let face = Face::new(&self.polytope, active.clone(), local.scale);
            let step = self.along(local, &face, lambda)?;
            match self.polytope.violated(&local.point.z, &step.p) {
                None => return Some(step),
                Some(more) if active.contains(&more) => return None,
                Some(more) => active.push(more),
            }
        }
        None
    }

    /// Onto the face by the shortest step, then the damped minimum along it, bent where that stays
    /// inside.
    fn along(&self, local: &Local<'_>, face: &Face, lambda: f64) -> Option<Step> {
        let Jacobian::Dense(jacobian) = &local.point.at.jacobian else {
            return None;
        };
        let factor = face.factor(jacobian.as_ref());
        let onto = face.onto(&self.polytope, &local.point.z);
        let shifted = add(
            &local.point.at.residuals,
            1.0,
            &local.point.at.jacobian.multiply(&onto),
        );
        let velocity = add(&onto, 1.0, &factor.damped(&shifted, lambda)?);
        self.bent_inside(
            &Local {
                factor: &factor,
                ..*local
            },
            velocity,
            lambda,
        )
    }

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
        self.polytope.violated(&local.point.z, p).is_none()
    }
}
