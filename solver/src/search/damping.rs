//! Rules by which the damping `λ` moves; it multiplies a `D` of column norms and so has no unit.

use super::{Search, Trial};

/// Least damping: where a column was once huge, even `1e-40` times its square still counts.
const LEAST: f64 = 1e-150;
/// Nearness to 1 of a gain ratio for the quick fall, and that fall.
const ALIKE: f64 = 0.1;
const QUICK: f64 = 0.1;
/// Damping above which a step is shorter than rounding.
const MOST: f64 = 1e20;

/// Divide by ten on success, multiply by ten on failure.
///
/// Source: Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963.
#[derive(Clone, Debug)]
pub(crate) struct Marquardt {
    lambda: f64,
}

/// A smooth fall by the gain ratio, an accelerating rise on failure.
///
/// Source: Nielsen, "Damping parameter in Marquardt's method", 1999.
#[derive(Clone, Debug)]
pub(crate) struct Nielsen {
    lambda: f64,
    rise: f64,
}

/// A slow rise on failure, a fast fall on success: the path keeps to the middle of a canyon.
///
/// Source: Transtrum and Sethna, "Improvements to the Levenberg-Marquardt algorithm for nonlinear
/// least-squares minimization", 2012.
#[derive(Clone, Debug)]
pub(crate) struct DelayedGratification {
    lambda: f64,
    quick: bool,
}

impl Marquardt {
    /// From a first damping.
    pub fn new(lambda: f64) -> Self {
        Self { lambda }
    }
}

impl Nielsen {
    /// From a first damping.
    pub fn new(lambda: f64) -> Self {
        Self { lambda, rise: 2.0 }
    }
}

impl DelayedGratification {
    /// From a first damping.
    pub fn new(lambda: f64) -> Self {
        Self {
            lambda,
            quick: false,
        }
    }

    /// Falls by ten where the cost fell as promised: near the solution, where the small steps of the slow fall would be many.
    pub fn quick(self) -> Self {
        Self {
            quick: true,
            ..self
        }
    }
}

impl Search for Marquardt {
    fn size(&self) -> f64 {
        self.lambda
    }

    fn accepted(&mut self, _: Trial) {
        self.lambda = (self.lambda / 10.0).max(LEAST);
    }

    fn rejected(&mut self, _: Trial) {
        self.lambda *= 10.0;
    }

    fn exhausted(&self) -> bool {
        self.lambda > MOST
    }
}

impl Search for Nielsen {
    fn size(&self) -> f64 {
        self.lambda
    }

    fn accepted(&mut self, trial: Trial) {
        let fall = (1.0 - (2.0 * trial.ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
        self.lambda = (self.lambda * fall).max(LEAST);
        self.rise = 2.0;
    }

    fn rejected(&mut self, _: Trial) {
        self.lambda *= self.rise;
        self.rise *= 2.0;
    }

    fn exhausted(&self) -> bool {
        self.lambda > MOST
    }
}

impl Search for DelayedGratification {
    fn size(&self) -> f64 {
        self.lambda
    }

    fn accepted(&mut self, trial: Trial) {
        let fall = match trial.ratio {
            ratio if self.quick && (ratio - 1.0).abs() <= ALIKE => QUICK,
            ratio if ratio > 0.1 => 1.0 / 3.0,
            _ => return,
        };
        self.lambda = (self.lambda * fall).max(LEAST);
    }

    fn rejected(&mut self, _: Trial) {
        self.lambda *= 2.0;
    }

    fn exhausted(&self) -> bool {
        self.lambda > MOST
    }
}
