//! A table that vibrates during some placements.

use std::f64::consts::{SQRT_2, TAU};

use nalgebra::Vector3;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::random::Random;

/// Vibration at rest: white within the sensor's bandwidth, another strength in every placement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Vibration {
    /// Largest root mean square per axis, m/s²; a placement has between 0.3 and 1 of it.
    pub rms: f64,
    /// Share of the placements that vibrate.
    pub share: f64,
    /// A machine's vibration of this frequency, Hz, instead of white noise.
    pub frequency: Option<f64>,
    /// Rocking of the table with its vibration: angular rate over acceleration, (rad/s)/(m/s²).
    pub rocking: f64,
}

impl Default for Vibration {
    fn default() -> Self {
        Self {
            rms: 0.4,
            share: 0.5,
            frequency: None,
            rocking: 0.0,
        }
    }
}

impl Vibration {
    /// Mean square per axis of one placement, (m/s²)².
    pub(crate) fn draw(&self, random: &mut Random) -> Vector3<f64> {
        let shakes = random.uniform(0.0..1.0) < self.share;
        let rms = Vector3::from_fn(|_, _| self.rms * random.uniform(0.3..1.0));
        if shakes {
            rms.component_mul(&rms)
        } else {
            Vector3::zeros()
        }
    }

    /// A sine of root mean square 1 per axis; axes and sensors differ in phase.
    pub(crate) fn machine(&self, frequency: f64, time: f64, sensor: Sensor) -> Vector3<f64> {
        let of = |axis: f64| (TAU * frequency * time + axis).sin() * SQRT_2;
        match sensor {
            Sensor::Accelerometer => Vector3::new(of(0.0), of(2.0), of(4.0)),
            Sensor::Gyroscope => Vector3::new(of(1.0), of(3.0), of(5.0)),
            Sensor::Magnetometer => Vector3::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_shakes_by_as_much_as_white_noise_would_and_at_its_own_frequency() {
        let vibration = Vibration::default();
        let at = |k: i32| vibration.machine(20.0, f64::from(k) * 0.001, Sensor::Accelerometer);
        let square: f64 = (0..1000).map(|k| at(k).norm_squared()).sum::<f64>() / 3000.0;
        assert!((square - 1.0).abs() < 1e-9);
        assert!((at(0) - at(50)).norm() < 1e-9);
    }
}
