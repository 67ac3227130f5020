//! The Levenberg–Marquardt step.

use super::{Descent, Local, Step, geodesic};
use crate::linear::vector::add;

/// Relative offset below which the rest of the way is so short that bending it changes nothing worth
/// a second derivative.
const STRAIGHT: f64 = 3e-3;

/// Share of the promised fall from which on a straight step is taken without a look at second derivatives, and the relative
/// offset up to which: farther away a step that does what it promises may still lead out of a canyon (MGH17).
const GOOD: f64 = 0.95;
const KNOWN: f64 = 0.9;

/// Share of the promised fall that is a fair one, and the number of steps refused at a point after which it is enough.
const FAIR: f64 = 0.25;
const PATIENCE: usize = 4;

/// `argmin ‖J p + r‖² + λ ‖D p‖²`, bent along the geodesic where second derivatives are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damped {
    /// True to add the geodesic acceleration.
    pub geodesic: bool,
    /// True to look first at what the straight step does, see [`sparing`](Self::sparing).
    pub sparing: bool,
}

impl Descent for Damped {
    fn step(&self, local: &Local<'_>, lambda: f64) -> Option<Step> {
        let velocity = local.factor.damped(&local.point.at.residuals, lambda)?;
        self.bent(local, velocity, lambda)
    }
}

impl Damped {
    /// The step of a velocity.
    pub fn bent(&self, local: &Local<'_>, velocity: Vec<f64>, lambda: f64) -> Option<Step> {
        if !self.geodesic || local.offset <= STRAIGHT {
            return Some(local.step(velocity));
        }
        match self.sparing && local.system.offers_second_derivatives() {
            true => Self::sparing(local, velocity, lambda),
            false => geodesic::bend(local, velocity, lambda),
        }
    }

    /// The straight step where the cost falls nearly as the linear model promises: no second derivative would pay. Elsewhere the
    /// bent one, or the straight one where it leads lower and some steps have been refused.
    ///
    /// The acceleration is refused where it is long, which a plain that goes on to infinity makes it although the straight step
    /// leads far down (YATP2: a dozen steps, without this none that ends).
    fn sparing(local: &Local<'_>, velocity: Vec<f64>, lambda: f64) -> Option<Step> {
        let cost = |p: &[f64]| local.system.cost(&add(&local.point.z, 1.0, p));
        let straight = local.step(velocity);
        let there = cost(&straight.p);
        let ratio = (local.cost() - there) / straight.predicted;
        if ratio >= GOOD && local.offset <= KNOWN {
            return Some(straight);
        }
        let fair = ratio >= FAIR && local.refused >= PATIENCE;
        match geodesic::bend(local, straight.p.clone(), lambda) {
            Some(bent) if !fair || cost(&bent.p) <= there => Some(bent),
            _ => fair.then_some(straight),
        }
    }
}
