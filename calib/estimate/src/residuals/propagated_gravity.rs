//! Gravity carried through a turn by the gyroscope.

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{Kinematics, Model, ModelScalar};
use solver::{Residual, lit};

use super::integrator::{Integrator, attitude_of};
use crate::truth::unneeded;

/// The samples of one turn and the directions of gravity at its ends.
#[derive(Clone, Debug)]
pub struct TurnData {
    /// Time stamps of the samples, s.
    pub t: Vec<f64>,
    /// Readings of the gyroscope less the bias that is known already, raw unit.
    pub readings: Vec<Vector3<f64>>,
    /// Corrected specific force, time and temperature at the samples; empty where no effect asks.
    pub rest: Vec<Kinematics<f64>>,
    /// Unit vector of specific force before the turn, body frame.
    pub before: Vector3<f64>,
    /// Unit vector of specific force after the turn, body frame.
    pub after: Vector3<f64>,
}

impl TurnData {
    /// The direction after the turn as the gyroscope predicts it from the one before.
    pub fn propagated<D: ModelScalar>(
        &self,
        model: &Model,
        integrator: Integrator,
        x: &[D],
    ) -> Vector3<D> {
        let attitude = self.attitude(model, integrator, x);
        attitude.into_body(&self.before.map(lit::<D>))
    }

    /// The attitude after the turn against the one before.
    pub fn attitude<D: ModelScalar>(
        &self,
        model: &Model,
        integrator: Integrator,
        x: &[D],
    ) -> Attitude<D> {
        let still = unneeded();
        attitude_of(integrator, &self.t, |k| {
            let rest = self.rest.get(k).unwrap_or(&still);
            model.correct(&self.readings[k].map(lit::<D>), &rest.lift(), x)
        })
    }
}

/// `r_k = (u_g,k − u_a,k) / σ` per turn, three rows each: the direction of specific force carried
/// through the turn by the corrected rate, less the one the accelerometer then shows
/// (Liu et al. 2021, section 2.2).
///
/// Parameters: those of the model.
#[derive(Clone, Copy, Debug)]
pub struct PropagatedGravity<'a> {
    /// The gyroscope's model.
    pub model: &'a Model,
    /// The turns.
    pub turns: &'a [TurnData],
    /// Integration method of the rate.
    pub integrator: Integrator,
    /// Standard deviation of a row, rad.
    pub sigma: f64,
}

impl<D: ModelScalar> Residual<D> for PropagatedGravity<'_> {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let weight = lit::<D>(self.sigma.recip());
        for turn in self.turns {
            let propagated = turn.propagated(self.model, self.integrator, x);
            let difference = (propagated - turn.after.map(lit::<D>)) * weight;
            out.extend(difference.iter().copied());
        }
    }
}
