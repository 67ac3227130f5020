//! Noise of the rows, from the noise of the recordings.

use nalgebra::{Matrix2, Matrix2x3, Vector3};
use sensor::{Base, Sensor};

use super::exposure::{Exposure, white};
use crate::methods::joint::blocks::groups::RowGroups;
use crate::methods::joint::clock::outer;
use crate::methods::joint::data::TurnSamples;
use crate::methods::joint::rows::turn::MARGIN;
use crate::methods::joint::rows::{MeanRows, Rows};

/// The noise of all rows: white, and how they feel a walk of the biases.
#[derive(Clone, Debug)]
pub struct RowNoise {
    /// Per row: its white variance.
    pub variance: Vec<f64>,
    /// Per row: its white covariance with the row before; only the two rows of a turn share noise.
    pub with_before: Vec<f64>,
    /// Exposures of the rows to the walks of the biases of accelerometer and gyroscope.
    pub exposures: [Vec<Exposure>; 2],
    /// Per turn: the covariance that a sampling share of one adds.
    pub by_share: Vec<Matrix2<f64>>,
    /// The rows of the recordings.
    pub groups: RowGroups,
}

impl Rows<'_> {
    /// The noise of all rows at `x`.
    pub fn noise(&self, x: &[f64]) -> RowNoise {
        let m = self.count();
        let mut noise = RowNoise {
            variance: vec![0.0; m],
            with_before: vec![0.0; m],
            exposures: [Vec::new(), Vec::new()],
            by_share: Vec::with_capacity(self.data.turns.len()),
            groups: self.groups().clone(),
        };
        let mut chunks = vec![0.0; self.data.rests.len()];
        for chunk in &self.data.chunks {
            chunks[chunk.rest] += 1.0;
        }
        for (place, sensor) in [Sensor::Accelerometer, Sensor::Gyroscope]
            .into_iter()
            .enumerate()
        {
            for MeanRows {
                row, chunk, mean, ..
            } in self.means(sensor)
            {
                let recording = self.data.rests[chunk.rest].recording;
                let source = &self.data.sources[recording];
                let Some(own) = source.noise(sensor) else {
                    continue;
                };
                // What rounding makes of a mean is the same in all chunks of a rest, which count as one together.
                let rounded = own.rounding * (chunks[chunk.rest] - 1.0);
                let variance = own.variance_of(&mean) + rounded;
                noise.variance[row..row + 3].copy_from_slice(variance.as_slice());
                noise.exposures[place].push(Exposure::of_mean(
                    row..row + 3,
                    recording,
                    (mean.span.from, mean.span.to),
                    source.reference,
                    -1.0,
                ));
            }
        }
        for (row, turn) in self.turns() {
            self.turn_noise(x, turn, row, &mut noise);
        }
        noise
    }

    /// `∂r/∂W_k` of the two rows of a turn by the readings of its inner samples.
    pub(crate) fn gains(&self, x: &[f64], turn: &TurnSamples) -> Vec<Matrix2x3<f64>> {
        let p = self.local(x, Sensor::Gyroscope, turn.from);
        let base = Base::from_parameters(&p);
        let carried = self.carried(turn, &self.rates(turn, &p));
        let by_rotation = self.by_rotation(x, turn, &carried.rotation);
        carried.gains[MARGIN..turn.t.len() - MARGIN]
            .iter()
            .map(|gain| by_rotation * gain * base.t)
            .collect()
    }

    fn turn_noise(&self, x: &[f64], turn: &TurnSamples, row: usize, noise: &mut RowNoise) {
        let source = &self.data.sources[turn.recording];
        let Some(own) = source.gyroscope else {
            noise.by_share.push(Matrix2::zeros());
            return;
        };
        let inner = MARGIN..turn.t.len() - MARGIN;
        let gains = self.gains(x, turn);
        let shocks = turn.shocks.iter().zip(&gains);
        let by_share: Matrix2<f64> = shocks.map(|(e, gain)| outer(&(gain * e))).sum();
        let covariance = white(&gains, &own.variance_in_sum())
            + by_share * source.clock.sampling.value.powi(2)
            + Matrix2::identity() * source.clock.floor.powi(2)
            + if source.clock.timing > 0.0 {
                by_timing(turn, &gains) * source.clock.timing
            } else {
                Matrix2::zeros()
            };
        noise.by_share.push(by_share);
        noise.variance[row] = covariance[(0, 0)];
        noise.variance[row + 1] = covariance[(1, 1)];
        noise.with_before[row + 1] = covariance[(1, 0)];
        noise.exposures[1].push(Exposure::of_samples(
            row..row + 2,
            turn.recording,
            &turn.t[inner],
            &gains,
            source.reference,
        ));
    }
}

/// The covariance of the rows that sampling times off by a second each, independently, would have:
/// `Σ (J_k ω̇_k)(J_k ω̇_k)ᵀ`.
fn by_timing(turn: &TurnSamples, gains: &[Matrix2x3<f64>]) -> Matrix2<f64> {
    let slope = |k: usize| -> Vector3<f64> {
        (turn.readings[k + 1] - turn.readings[k - 1]) / (turn.t[k + 1] - turn.t[k - 1])
    };
    let inner = MARGIN..turn.t.len() - MARGIN;
    let steps = inner.zip(gains);
    steps.map(|(k, gain)| outer(&(gain * slope(k)))).sum()
}
