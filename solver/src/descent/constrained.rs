//! Steps within bounds and linear constraints.

use super::dogleg::cut;
use super::{Damped, Descent, Local, Step};
use crate::feasible::{Model, Polytope};
use crate::linear::Jacobian;
use crate::linear::vector::scaled_norm;

/// First damping tried where the undamped step is too long, and what follows; columns are scaled.
const FIRST: f64 = 1e-6;
const RISE: f64 = 30.0;

/// Most dampings tried.
const DAMPINGS: usize = 24;

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
        let model = model(&self.polytope, local, lambda);
        let (face, velocity) = model.minimum()?;
        let factor = face.factor(model.jacobian);
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

/// The step within a trust region and the feasible set: the minimum of the model over the feasible set,
/// damped until it is inside the radius, then on the line between the last two. Both ends are
/// feasible, so the line is.
pub(crate) struct ConstrainedDogleg {
    /// The feasible set.
    pub polytope: Polytope,
}

/// A fraction of the undamped step to the minimum of the model over the feasible set.
pub(crate) struct ConstrainedGaussNewton {
    /// The feasible set.
    pub polytope: Polytope,
}

impl Descent for ConstrainedDogleg {
    fn step(&self, local: &Local<'_>, radius: f64) -> Option<Step> {
        let mut outside: Option<Vec<f64>> = None;
        let mut lambda = 0.0;
        for _ in 0..DAMPINGS {
            let p = within(&self.polytope, local, lambda);
            if let Some(p) = p {
                if scaled_norm(&p, local.scale) <= radius {
                    return Some(local.step(match outside {
                        Some(outside) => cut(&p, &outside, local.scale, radius),
                        None => p,
                    }));
                }
                outside = Some(p);
            }
            lambda = if lambda > 0.0 { RISE * lambda } else { FIRST };
        }
        let p = outside?;
        let share = radius / scaled_norm(&p, local.scale);
        Some(local.step(p.iter().map(|v| share * v).collect()))
    }
}

impl Descent for ConstrainedGaussNewton {
    fn step(&self, local: &Local<'_>, fraction: f64) -> Option<Step> {
        let full = within(&self.polytope, local, 0.0)?;
        Some(local.step(full.iter().map(|v| fraction * v).collect()))
    }
}

/// The minimum of the damped model over the feasible set, as a step.
fn within(polytope: &Polytope, local: &Local<'_>, lambda: f64) -> Option<Vec<f64>> {
    let residuals = &local.point.at.residuals;
    let free = match lambda {
        0.0 => local.factor.undamped(residuals),
        _ => local.factor.damped(residuals, lambda),
    };
    if let Some(p) = free
        && polytope.violated(&local.point.z, &p, local.scale).is_none()
    {
        return Some(p);
    }
    let minimum = model(polytope, local, lambda).minimum();
    minimum.map(|(_, p)| p)
}

/// The damped model of a step from here.
fn model<'a>(polytope: &'a Polytope, local: &Local<'a>, lambda: f64) -> Model<'a> {
    let Jacobian(jacobian) = &local.point.at.jacobian;
    Model {
        polytope,
        z: &local.point.z,
        jacobian: jacobian.as_ref(),
        residuals: &local.point.at.residuals,
        scale: local.scale,
        lambda,
    }
}
