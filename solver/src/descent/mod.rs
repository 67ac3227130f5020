//! Steps from a point, given a size by the search: one file per way.

mod constrained;
mod damped;
mod dogleg;
mod gauss_newton;
mod geodesic;

pub(crate) use constrained::{Constrained, ConstrainedDogleg, ConstrainedGaussNewton};
pub(crate) use damped::Damped;
pub(crate) use dogleg::Dogleg;
pub(crate) use gauss_newton::{GaussNewton, MinimumNorm};

use crate::linear::Factor;
use crate::linear::vector::dot;
use crate::minimise::point::Point;
use crate::minimise::system::System;

/// A point with what a descent may ask of it.
#[derive(Clone, Copy)]
pub struct Local<'a> {
    /// The problem.
    pub(crate) system: &'a dyn System,
    /// The point where it stands.
    pub(crate) point: &'a Point,
    /// `J D⁻¹` factored.
    pub(crate) factor: &'a dyn Factor,
    /// The diagonal of `D` (`n`).
    pub(crate) scale: &'a [f64],
    /// The relative offset there, `‖P r‖ / ‖r‖`.
    pub(crate) offset: f64,
    /// Steps from there that were not taken.
    pub(crate) refused: usize,
}

/// A proposed step.
#[derive(Clone, Debug)]
pub struct Step {
    /// Change of the free parameters (`n`).
    pub p: Vec<f64>,
    /// Fall of the cost that the linearised problem promises.
    pub predicted: f64,
}

/// A way to turn a size into a step; see [`OwnVariant`](crate::OwnVariant) for an example.
pub trait Descent {
    /// The step of the given size (a damping, a radius, a fraction); `None` where there is none,
    /// which the search answers with a smaller step.
    fn step(&self, local: &Local<'_>, size: f64) -> Option<Step>;
}

impl std::fmt::Debug for Local<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Local")
            .field("parameters", &self.point.z)
            .field("scale", &self.scale)
            .field("offset", &self.offset)
            .finish_non_exhaustive()
    }
}

impl Local<'_> {
    /// The free parameters (`n`).
    pub fn parameters(&self) -> &[f64] {
        &self.point.z
    }

    /// The residuals (`m`), rewritten for the loss.
    pub fn residuals(&self) -> &[f64] {
        &self.point.at.residuals
    }

    /// Value here of the minimised cost.
    pub fn cost(&self) -> f64 {
        self.point.at.cost
    }

    /// `Jᵀ r`, the gradient of the cost.
    pub fn gradient(&self) -> Vec<f64> {
        self.point.gradient()
    }

    /// `J p`.
    pub fn multiply(&self, p: &[f64]) -> Vec<f64> {
        self.point.at.jacobian.multiply(p)
    }

    /// The diagonal of `D` (`n`), column norms of the Jacobian: `D p` has no units.
    pub fn scale(&self) -> &[f64] {
        self.scale
    }

    /// The Jacobian factored: damped and undamped steps.
    pub fn factor(&self) -> &dyn Factor {
        self.factor
    }

    /// The relative offset, `‖P r‖ / ‖r‖`.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// `d²/dt² r(x + t·v)` at `t = 0`, where the problem offers it.
    pub fn second_derivative(&self, v: &[f64]) -> Option<Vec<f64>> {
        self.system.second_derivative(&self.point.z, v)
    }

    /// The step `p` with the fall of the cost that the linearised problem promises.
    pub fn step(&self, p: Vec<f64>) -> Step {
        let predicted = self.predicted(&p);
        Step { p, predicted }
    }

    /// `−rᵀJp − ½ ‖Jp‖²`: the fall of `½ ‖r + J p‖²`.
    pub fn predicted(&self, p: &[f64]) -> f64 {
        let change = self.point.at.jacobian.multiply(p);
        -dot(&self.point.at.residuals, &change) - 0.5 * dot(&change, &change)
    }
}
