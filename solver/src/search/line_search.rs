//! Backtracking along one direction.

use super::{Search, Trial};

/// The fraction of the full step: all of it first, then half as much until the cost falls.
#[derive(Clone, Debug)]
pub(crate) struct LineSearch {
    fraction: f64,
}

/// Fraction below which the direction leads nowhere.
const LEAST: f64 = 1e-18;

impl Default for LineSearch {
    fn default() -> Self {
        Self { fraction: 1.0 }
    }
}

impl Search for LineSearch {
    fn size(&self) -> f64 {
        self.fraction
    }

    fn accepted(&mut self, _: Trial) {
        self.fraction = 1.0;
    }

    fn rejected(&mut self, _: Trial) {
        self.fraction *= 0.5;
    }

    fn exhausted(&self) -> bool {
        self.fraction < LEAST
    }
}
