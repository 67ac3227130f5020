//! Rules by which the damping `λ` moves; it multiplies a `D` of column norms and so has no unit.

use serde::{Deserialize, Serialize};

use super::{Search, Trial};

/// Least damping: where a column was once huge, even `1e-40` times its square still counts.
const LEAST: f64 = 1e-150;
/// Nearness to 1 of a gain ratio for the quick fall, and that fall.
const ALIKE: f64 = 0.1;
const QUICK: f64 = 0.1;
/// Damping above which a step is shorter than rounding.
const MOST: f64 = 1e20;

/// Rule by which `λ` moves in Levenberg–Marquardt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Damping {
    /// A tenth on success, ten times on failure.
    ///
    /// Source: Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963.
    Marquardt,
    /// By the gain ratio, accelerating on failure.
    ///
    /// Source: Nielsen, "Damping parameter in Marquardt's method", 1999.
    Nielsen,
    /// A third on success, twice on failure: the path keeps to the middle of a canyon.
    ///
    /// Source: Transtrum and Sethna, "Improvements to the Levenberg-Marquardt algorithm for nonlinear
    /// least-squares minimization", 2012.
    DelayedGratification,
}

/// The damping under a rule.
#[derive(Clone, Debug)]
pub(crate) struct Lambda {
    value: f64,
    rule: Damping,
    rise: f64,
    quick: bool,
}

impl Lambda {
    /// From a first damping.
    pub fn new(rule: Damping, first: f64) -> Self {
        Self {
            value: first,
            rule,
            rise: 2.0,
            quick: false,
        }
    }

    /// The same, but under delayed gratification it falls by ten where the cost fell as promised: near the solution the slow fall
    /// would take many small steps.
    pub fn quick(self) -> Self {
        Self {
            quick: true,
            ..self
        }
    }
}

impl Search for Lambda {
    fn size(&self) -> f64 {
        self.value
    }

    fn accepted(&mut self, Trial { ratio, .. }: Trial) {
        let fallen = match self.rule {
            Damping::Marquardt => self.value / 10.0,
            Damping::Nielsen => {
                self.value * (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0)
            }
            Damping::DelayedGratification if self.quick && (ratio - 1.0).abs() <= ALIKE => {
                self.value * QUICK
            }
            Damping::DelayedGratification if ratio > 0.1 => self.value * (1.0 / 3.0),
            Damping::DelayedGratification => return,
        };
        self.value = fallen.max(LEAST);
        self.rise = 2.0;
    }

    fn rejected(&mut self, _: Trial) {
        match self.rule {
            Damping::Marquardt => self.value *= 10.0,
            Damping::Nielsen => {
                self.value *= self.rise;
                self.rise *= 2.0;
            }
            Damping::DelayedGratification => self.value *= 2.0,
        }
    }

    fn exhausted(&self) -> bool {
        self.value > MOST
    }
}
