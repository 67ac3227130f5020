//! A point of the iteration and what is known there.

use crate::linear::Linearization;
use crate::minimise::system::System;

/// Free parameters with the problem linearised at them, all finite.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// Free parameters (`n`).
    pub z: Vec<f64>,
    /// `r`, `J` and the cost at `z`.
    pub at: Linearization,
}

/// Place at which a linearisation is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NotFinite {
    /// A residual.
    Residual { row: usize, value: f64 },
    /// A derivative.
    Derivative { row: usize, column: usize },
}

impl Point {
    /// Linearises at `z`.
    pub fn new(system: &dyn System, z: Vec<f64>) -> Result<Self, NotFinite> {
        let at = system.linearize(&z);
        if let Some(row) = at.residuals.iter().position(|v| !v.is_finite()) {
            return Err(NotFinite::Residual {
                row,
                value: at.residuals[row],
            });
        }
        if let Some((row, column)) = at.jacobian.not_finite() {
            return Err(NotFinite::Derivative { row, column });
        }
        Ok(Self { z, at })
    }

    /// `Jᵀ r`, the gradient of the cost.
    pub fn gradient(&self) -> Vec<f64> {
        self.at.jacobian.transpose_multiply(&self.at.residuals)
    }
}
