//! Gauss–Newton steps.

use super::{Descent, Local, Step};
use crate::linear::{Jacobian, minimum_norm};

/// A fraction of the step by pivoted QR; where the rank is short, the shortest in scaled units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GaussNewton;

/// A fraction of the step of minimum `‖p‖` in the parameters' own units.
///
/// Among the minima of a problem of short rank it finds the one nearest the start. It is the one
/// variant whose result depends on the units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MinimumNorm;

impl Descent for GaussNewton {
    fn step(&self, local: &Local<'_>, fraction: f64) -> Option<Step> {
        fraction_of(
            local,
            &local.factor.undamped(&local.point.at.residuals)?,
            fraction,
        )
    }
}

impl Descent for MinimumNorm {
    fn step(&self, local: &Local<'_>, fraction: f64) -> Option<Step> {
        let Jacobian(jacobian) = &local.point.at.jacobian;
        fraction_of(
            local,
            &minimum_norm(jacobian.as_ref(), &local.point.at.residuals)?,
            fraction,
        )
    }
}

/// The given fraction of a full step.
fn fraction_of(local: &Local<'_>, full: &[f64], fraction: f64) -> Option<Step> {
    Some(local.step(full.iter().map(|v| v * fraction).collect()))
}
