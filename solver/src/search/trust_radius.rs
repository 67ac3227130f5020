//! A trust region.

use super::{Search, Trial};

/// Radius `Δ` of the region `‖D p‖ ≤ Δ` in which the linearised problem is believed.
///
/// The quarter and three-quarter rule: Nocedal and Wright, "Numerical Optimization", 2nd edition,
/// algorithm 4.1.
#[derive(Clone, Debug)]
pub(crate) struct TrustRadius {
    radius: f64,
    smallest: f64,
}

impl TrustRadius {
    /// The first radius, `factor` times the scaled length `‖D x‖` of the start.
    pub fn new(scaled_size: f64, factor: f64) -> Self {
        let radius = factor * if scaled_size > 0.0 { scaled_size } else { 1.0 };
        Self {
            radius,
            smallest: radius * 1e-40,
        }
    }
}

impl Search for TrustRadius {
    fn size(&self) -> f64 {
        self.radius
    }

    fn accepted(&mut self, trial: Trial) {
        if trial.ratio < 0.25 {
            self.radius = 0.25 * trial.length;
        } else if trial.ratio > 0.75 {
            self.radius = self.radius.max(2.0 * trial.length);
        }
    }

    fn rejected(&mut self, trial: Trial) {
        self.radius = 0.25
            * if trial.length > 0.0 {
                trial.length.min(self.radius)
            } else {
                self.radius
            };
    }

    fn exhausted(&self) -> bool {
        self.radius < self.smallest
    }
}
