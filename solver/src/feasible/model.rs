//! The damped model of a step.

use faer::MatRef;

use super::Polytope;

/// `½ ‖J p + r‖² + ½ λ ‖D p‖²` over `lower ≤ A (z + p) ≤ upper`.
pub(crate) struct Model<'a> {
    /// The feasible set.
    pub polytope: &'a Polytope,
    /// Start of the step (`n`).
    pub z: &'a [f64],
    /// `J` (`m × n`).
    pub jacobian: MatRef<'a, f64>,
    /// `r` (`m`).
    pub residuals: &'a [f64],
    /// The diagonal of `D` (`n`).
    pub scale: &'a [f64],
    /// `λ`.
    pub lambda: f64,
}
