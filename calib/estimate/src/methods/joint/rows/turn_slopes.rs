//! What the effects of the gyroscope do to the corrected rates of a turn.

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Sensor, inverse};

use super::slopes::ModelSlopes;
use crate::methods::joint::data::TurnSamples;
use crate::methods::joint::rows::Rows;

/// The derivatives of the effects at the samples of a turn.
pub(super) struct TurnSlopes {
    /// `(I + ∂e/∂ω)⁻¹` (3 × 3) of every sample; `None` where no effect depends on the rate.
    through: Option<Vec<Matrix3<f64>>>,
    /// `∂e/∂p` by the parameters of the effects, sample by sample.
    by_parameters: Vec<Vector3<f64>>,
    /// How many parameters.
    count: usize,
}

impl TurnSlopes {
    /// `∂δ/∂(T (W − b))` of sample `k`, `gain` being that by the corrected rate.
    pub fn through(&self, k: usize, gain: &Matrix3<f64>) -> Matrix3<f64> {
        let through = self.through.as_ref();
        through.map_or(*gain, |all| gain * all[k])
    }

    /// `∂e/∂p` at sample `k`.
    pub fn by_parameters(&self, k: usize) -> &[Vector3<f64>] {
        &self.by_parameters[k * self.count..(k + 1) * self.count]
    }
}

impl Rows<'_> {
    /// The same at the corrected rates of a turn.
    pub(super) fn turn_slopes(
        &self,
        turn: &TurnSamples,
        rates: &[Vector3<f64>],
        p: &[f64],
    ) -> TurnSlopes {
        let count = p.len() - BASE_PARAMETERS;
        let model = ModelSlopes::new(self.gyroscope, p, Sensor::Gyroscope);
        let mut by_parameters = Vec::with_capacity(count * rates.len());
        if self.gyroscope.effects().is_empty() {
            return TurnSlopes {
                through: None,
                by_parameters,
                count,
            };
        }
        let samples = rates.iter().zip(&turn.known);
        let through = samples.map(|(rate, known)| {
            let truth = known.with_signal(Sensor::Gyroscope, *rate);
            model.at(&truth, &mut by_parameters).by_signal
        });
        let by_signal: Vec<Matrix3<f64>> = through.collect();
        let through = |by_signal: Matrix3<f64>| {
            inverse(&(Matrix3::identity() + by_signal)).unwrap_or_else(Matrix3::identity)
        };
        TurnSlopes {
            through: (!model.is_apart_from_signal())
                .then(|| by_signal.into_iter().map(through).collect()),
            by_parameters,
            count,
        }
    }
}
