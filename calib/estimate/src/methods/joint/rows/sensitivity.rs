//! Sensitivity of the rows to an error of the readings that no model has.

use nalgebra::{Matrix2x3, Matrix3};
use sensor::{Base, Kinematics, Sensor, inverse};

use crate::methods::joint::fit::JointFit;
use crate::methods::joint::rows::{MeanRows, Rows};
use crate::truth::unneeded;

/// A mean of a chunk: three rows.
#[derive(Clone, Debug)]
pub struct MeanSensitivity {
    /// The sensor.
    pub sensor: Sensor,
    /// Place of the chunk in the data.
    pub chunk: usize,
    /// Its first row.
    pub row: usize,
    /// The truth there, by the fit.
    pub truth: Kinematics<f64>,
    /// `∂r/∂e = T⁻¹` of an error `e` added to the true signal (3 × 3).
    pub by_error: Matrix3<f64>,
}

/// A turn: two rows.
#[derive(Clone, Debug)]
pub struct TurnSensitivity {
    /// Place of the turn in the data.
    pub turn: usize,
    /// Its first row.
    pub row: usize,
    /// Middles of the samples' windows, s.
    pub t: Vec<f64>,
    /// The truth at the samples, by the fit; without [`JointRequest::covariates`] only the rate is
    /// known where the gyroscope has no effects.
    ///
    /// [`JointRequest::covariates`]: crate::methods::joint::JointRequest::covariates
    pub truth: Vec<Kinematics<f64>>,
    /// `∂r/∂e_k` of an error `e_k` (rad/s) added to the true rate of sample `k` (2 × 3 each, s):
    /// `−Eᵀ [Rᵀ u]× ∂δ/∂ω_k`, the rate being corrected by as much.
    pub by_error: Vec<Matrix2x3<f64>>,
}

/// All rows.
#[derive(Clone, Debug)]
pub struct Sensitivities {
    /// Means of the accelerometer, then those of the gyroscope, in the order of their rows.
    pub means: Vec<MeanSensitivity>,
    /// The turns, in the order of their rows.
    pub turns: Vec<TurnSensitivity>,
}

impl Rows<'_> {
    /// The truth at `x` and what an error added to it would do to the rows.
    ///
    /// Of an effect with the derivative `s = ∂e/∂p` by its parameter, `∂r/∂p` is `by_error · s(truth)`
    /// in the rows of a mean and `Σ_k by_error_k · s(truth_k)` in those of a turn.
    pub fn sensitivities(&self, x: &[f64]) -> Sensitivities {
        let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let means = sensors.flat_map(|sensor| {
            let means = self.means(sensor);
            means.map(move |mean| self.of_mean(x, sensor, &mean))
        });
        let means = means.collect();
        let turns = self.turns().enumerate();
        let turns = turns.map(|(turn, (row, _))| self.of_turn(x, turn, row));
        Sensitivities {
            means,
            turns: turns.collect(),
        }
    }

    fn of_mean(&self, x: &[f64], sensor: Sensor, of: &MeanRows<'_>) -> MeanSensitivity {
        let base = Base::from_parameters(&self.local_at_rest(x, sensor, of.chunk.rest));
        let u = self.direction(x, of.chunk.rest);
        MeanSensitivity {
            sensor,
            chunk: of.place,
            row: of.row,
            truth: self.at_rest(of.chunk, &of.mean, u),
            by_error: inverse(&base.t).unwrap_or_else(|| Matrix3::repeat(f64::NAN)),
        }
    }

    fn of_turn(&self, x: &[f64], turn: usize, row: usize) -> TurnSensitivity {
        let samples = &self.data.turns[turn];
        let p = self.local(x, Sensor::Gyroscope, samples.from);
        let rates = self.rates(samples, &p);
        let carried = self.carried(samples, &rates);
        let slopes = self.turn_slopes(samples, &rates, &p);
        let by_rotation = self.by_rotation(x, samples, &carried.rotation);
        let truth = rates.iter().enumerate().map(|(k, rate)| {
            let known = samples.known.get(k).copied();
            let known = known.unwrap_or_else(unneeded);
            known.with_signal(Sensor::Gyroscope, *rate)
        });
        let gains = carried.gains.iter().enumerate();
        let by_error = gains.map(|(k, gain)| -(by_rotation * slopes.through(k, gain)));
        TurnSensitivity {
            turn,
            row,
            t: samples.t.clone(),
            truth: truth.collect(),
            by_error: by_error.collect(),
        }
    }
}

impl JointFit {
    /// The same at the estimate.
    pub fn sensitivities(&self) -> Sensitivities {
        self.rows().sensitivities(self.parameters.values())
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::methods::joint::{JointRequest, fit_joint};

    #[test]
    fn an_effect_outside_the_model_moves_the_rows_as_its_own_column_says() {
        let recording = Spec::hand_held(2).run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let fit = fit_joint(&JointRequest {
            covariates: true,
            disturbances: false,
            ..JointRequest::new(vec![(&recording, &segmentation)], 9.80665)
        })
        .unwrap();
        let quadratic = effects::effect_named("gyro_quadratic").unwrap();
        let model = gyroscope::model().with(quadratic);
        let rows = Rows::new(
            &fit.data,
            (&fit.models[0], &model),
            fit.gravity,
            &fit.charts,
            (fit.own_force_bias, &[]),
        );
        let mut x = fit.parameters.values().to_vec();
        x.splice(24..24, [0.0; 3]);
        let jacobian = rows.linearize(&x).jacobian;
        let all = fit.sensitivities();
        for turn in &all.turns {
            for axis in 0..3 {
                let sum: nalgebra::Vector2<f64> = turn
                    .truth
                    .iter()
                    .zip(&turn.by_error)
                    .map(|(truth, by)| by.column(axis) * truth.angular_rate[axis].powi(2))
                    .sum();
                for i in 0..2 {
                    let column = jacobian.get(turn.row + i, 24 + axis);
                    assert!((sum[i] - column).abs() < 1e-12 * (1.0 + column.abs()));
                }
            }
        }
        for mean in &all.means {
            let place = if mean.sensor == Sensor::Gyroscope {
                12
            } else {
                0
            };
            for i in 0..3 {
                // ∂r/∂s_x = −T⁻¹ e_x (T⁻¹ s)_x of the true signal s; none but the bias at rest.
                let signal = mean.truth.signal(mean.sensor);
                let expected = -mean.by_error[(i, 0)] * (mean.by_error * signal).x;
                assert!((jacobian.get(mean.row + i, place) - expected).abs() < 1e-12);
            }
        }
    }
}
