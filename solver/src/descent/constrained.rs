//! The Levenberg–Marquardt step within bounds and linear constraints.

use super::{Damped, Descent, Local, Step, geodesic};
use crate::feasible::{Active, Face, Polytope, active_at_minimum};
use crate::linear::Jacobian;
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
        let free = self.damped.step(local, lambda)?;
        if self.polytope.contains(&add(&local.point.z, 1.0, &free.p)) {
            return Some(free);
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
            match self.polytope.violated(&add(&local.point.z, 1.0, &step.p)) {
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
        let velocity = add(
            &onto,
            1.0,
            &crate::linear::Factor::damped(&factor, &shifted, lambda)?,
        );
        let predicted = local.predicted(&velocity);
        if self.damped.geodesic {
            let on_face = Local {
                factor: &factor,
                ..*local
            };
            let bent = geodesic::bend(&on_face, velocity.clone(), lambda)?;
            if self.polytope.contains(&add(&local.point.z, 1.0, &bent)) {
                return Some(Step { p: bent, predicted });
            }
        }
        Some(Step {
            p: velocity,
            predicted,
        })
    }
}
