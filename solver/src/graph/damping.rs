//! How the damping moves: as in the dense solver, but for its quick fall where steps do what is promised.

use crate::options::Damping;

/// Least and largest damping.
const LEAST: f64 = 1e-20;
const MOST: f64 = 1e20;

/// How near to 1 the gain ratio is where a step did what the linearised problem said, and by what the damping falls
/// then under Nielsen's rule, which by itself takes a third: from 1e-4 it would hold back the slow directions of a
/// long chain for as many steps as it has to fall by powers of three.
const ALIKE: f64 = 0.1;
const FALL: f64 = 0.01;

/// The damping `λ` of `H + λ D²`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lambda {
    pub value: f64,
    rule: Damping,
    rise: f64,
}

impl Lambda {
    /// Begins at `first`.
    pub fn new(rule: Damping, first: f64) -> Self {
        Self {
            value: first,
            rule,
            rise: 2.0,
        }
    }

    /// After a step taken whose fall of the cost was `ratio` of the predicted one.
    pub fn accepted(&mut self, ratio: f64) {
        let factor = match self.rule {
            Damping::Marquardt => 0.1,
            Damping::Nielsen if (ratio - 1.0).abs() <= ALIKE => FALL,
            Damping::Nielsen => (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0),
            Damping::DelayedGratification if ratio > 0.1 => 1.0 / 3.0,
            Damping::DelayedGratification => 1.0,
        };
        self.value = (self.value * factor).max(LEAST);
        self.rise = 2.0;
    }

    /// After a step not taken.
    pub fn rejected(&mut self) {
        self.value *= match self.rule {
            Damping::Marquardt => 10.0,
            Damping::Nielsen => {
                self.rise *= 2.0;
                0.5 * self.rise
            }
            Damping::DelayedGratification => 2.0,
        };
    }

    /// Whether a step is shorter than rounding.
    pub fn exhausted(&self) -> bool {
        self.value > MOST
    }
}
