//! Predicted errors of corrected readings and headings, from the covariance of the parameters.

use nalgebra::{DMatrix, Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Base, Kinematics, Model, PLACES, Sensor, inverse};

use crate::methods::joint::rows::slopes::ModelSlopes;
use crate::truth::supposed;

/// A calibrated sensor with the covariance of its parameters.
#[derive(Clone, Debug)]
pub struct Prediction {
    /// Base model and effects.
    pub model: Model,
    /// Its parameters.
    pub parameters: Vec<f64>,
    /// Their covariance, zero where they were held (`n × n`).
    pub covariance: DMatrix<f64>,
}

impl Prediction {
    /// Covariance (3 × 3) of the error of the corrected reading where the true signals are `truth`, in
    /// (m/s²)² or (rad/s)²; the noise of the reading itself is not in it.
    pub fn of_reading(&self, truth: &Kinematics<f64>) -> Matrix3<f64> {
        let slopes = self.slopes(truth);
        let covariance = &slopes * &self.covariance * slopes.transpose();
        Matrix3::from_fn(|i, j| covariance[(i, j)])
    }

    /// Standard deviation per axis of the corrected reading at `truth`.
    pub fn std_of_reading(&self, truth: &Kinematics<f64>) -> Vector3<f64> {
        self.of_reading(truth).diagonal().map(|v| v.max(0.0).sqrt())
    }

    /// Standard deviation, rad, of the angle that a gyroscope's corrected rate integrates to over a
    /// turn of `angle` (rad) about the unit vector `axis` in `seconds`.
    pub fn std_of_heading(&self, axis: &Vector3<f64>, angle: f64, seconds: f64) -> f64 {
        let truth = supposed(Vector3::zeros(), axis * (angle / seconds));
        let covariance = self.of_reading(&truth);
        (axis.dot(&(covariance * axis))).max(0.0).sqrt() * seconds
    }

    /// `∂ corrected/∂p` (3 × n): of `s + e(s) = T (m − b)`.
    fn slopes(&self, truth: &Kinematics<f64>) -> DMatrix<f64> {
        let p = &self.parameters;
        let sensor = self.model.sensor();
        let base = Base::from_parameters(p);
        let mut by_parameters = Vec::with_capacity(p.len() - BASE_PARAMETERS);
        let effects = ModelSlopes::new(&self.model, p, sensor).at(truth, &mut by_parameters);
        let through =
            inverse(&(Matrix3::identity() + effects.by_signal)).unwrap_or_else(Matrix3::identity);
        let unbiased = inverse(&base.t).unwrap_or_else(Matrix3::identity)
            * (truth.signal(sensor) + effects.value);
        let mut slopes = DMatrix::zeros(3, p.len());
        for (k, (i, j)) in PLACES.iter().enumerate() {
            slopes.set_column(k, &(through.column(*i) * unbiased[*j]));
        }
        for axis in 0..3 {
            slopes.set_column(9 + axis, &(-(through * base.t.column(axis))));
        }
        for (k, slope) in by_parameters.iter().enumerate() {
            slopes.set_column(BASE_PARAMETERS + k, &(-(through * slope)));
        }
        slopes
    }
}

/// The sensor of a prediction.
impl Prediction {
    /// Returns the sensor.
    pub fn sensor(&self) -> Sensor {
        self.model.sensor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_error_of_a_permille_turns_a_full_circle_by_a_third_of_a_degree() {
        let mut covariance = DMatrix::zeros(12, 12);
        covariance[(2, 2)] = 1e-6;
        let prediction = Prediction {
            model: Model::base(Sensor::Gyroscope),
            parameters: Base::identity().parameters().to_vec(),
            covariance,
        };
        let circle = std::f64::consts::TAU;
        let std = prediction
            .std_of_heading(&Vector3::z(), circle, 3.0)
            .to_degrees();
        assert!((std - 0.36).abs() < 1e-12);
        assert_eq!(prediction.std_of_heading(&Vector3::x(), circle, 3.0), 0.0);
    }
}
