//! Where to step from a point, given a size by the search: one file per way.

mod constrained;
mod damped;
mod dogleg;
mod gauss_newton;
mod geodesic;

pub(crate) use constrained::Constrained;
pub(crate) use damped::Damped;
pub(crate) use dogleg::Dogleg;
pub(crate) use gauss_newton::{GaussNewton, MinimumNorm};

use crate::linear::Factor;
use crate::point::Point;
use crate::system::System;
use crate::vector::dot;

/// A point with what a descent may ask of it.
#[derive(Clone, Copy)]
pub(crate) struct Local<'a> {
    /// The problem.
    pub system: &'a dyn System,
    /// Where it stands.
    pub point: &'a Point,
    /// `J D⁻¹` factored.
    pub factor: &'a dyn Factor,
    /// The diagonal of `D` (`n`).
    pub scale: &'a [f64],
    /// The relative offset there, `‖P r‖ / ‖r‖`.
    pub offset: f64,
}

/// A proposed step.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// Change of the free parameters (`n`).
    pub p: Vec<f64>,
    /// Fall of the cost that the linearised problem promises.
    pub predicted: f64,
}

/// A way to turn a size into a step.
pub(crate) trait Descent {
    /// The step of the given size (a damping, a radius, a fraction); `None` where there is none,
    /// which the search answers with a smaller step.
    fn step(&self, local: &Local<'_>, size: f64) -> Option<Step>;
}

impl Local<'_> {
    /// `−rᵀJp − ½ ‖Jp‖²`: the fall of `½ ‖r + J p‖²`.
    pub fn predicted(&self, p: &[f64]) -> f64 {
        let change = self.point.at.jacobian.multiply(p);
        -dot(&self.point.at.residuals, &change) - 0.5 * dot(&change, &change)
    }
}
