//! The device under test: its sensor models and their true parameters.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Base, Kinematics, Model, Nature, Sensor, inverse};
use serde::{Deserialize, Serialize};
use solver::Parameters;

use super::noise::Noise;
use super::random::{Purpose, Random};

/// Quality of a device: standard deviations of its errors, and its white noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Grade {
    /// No errors, no noise.
    Perfect,
    /// Bias 0.3 m/s² and 0.02 rad/s, scale 1.5 %, misalignment 1 %, noise 2e-3 m/s²/√Hz and
    /// 1e-4 rad/s/√Hz; of a magnetometer 30 µT, 5 %, 3 % and 0.05 µT/√Hz.
    #[default]
    Consumer,
    /// A tenth of consumer grade.
    Tactical,
}

impl Grade {
    /// Errors and noise as a multiple of consumer grade.
    pub fn factor(self) -> f64 {
        match self {
            Self::Perfect => 0.0,
            Self::Consumer => 1.0,
            Self::Tactical => 0.1,
        }
    }

    /// White noise density, u/√Hz.
    pub fn white(self, sensor: Sensor) -> f64 {
        self.factor()
            * match sensor {
                Sensor::Accelerometer => 2e-3,
                Sensor::Gyroscope => 1e-4,
                Sensor::Magnetometer => 0.05,
            }
    }

    /// The noise of this grade: white only.
    pub fn noise(self, sensor: Sensor) -> Noise {
        Noise {
            white: self.white(sensor),
            ..Noise::default()
        }
    }

    /// A base model with random errors; that of an accelerometer is upper triangular.
    pub(crate) fn draw(self, sensor: Sensor, seed: u64) -> Base<f64> {
        let mut random = Random::new(seed, Purpose::Errors(sensor));
        let bias = match sensor {
            Sensor::Accelerometer => 0.3,
            Sensor::Gyroscope => 0.02,
            Sensor::Magnetometer => 30.0,
        };
        let [scale, misalignment] = match sensor {
            Sensor::Accelerometer | Sensor::Gyroscope => [0.015, 0.01],
            Sensor::Magnetometer => [0.05, 0.03],
        };
        let size = |i, j| if i == j { scale } else { misalignment };
        let errors = Matrix3::from_fn(|i, j| random.normal() * size(i, j));
        let errors = match sensor {
            Sensor::Accelerometer => errors.upper_triangle(),
            Sensor::Gyroscope | Sensor::Magnetometer => errors,
        };
        Base {
            t: Matrix3::identity() + errors * self.factor(),
            bias: random.normal3() * (bias * self.factor()),
        }
    }
}

/// One sensor of the device.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// Model of the sensor, from the true motion to the reading.
    pub model: Model,
    /// The true parameters of `model`, in SI units.
    pub parameters: Parameters,
    /// The same without the delays, which the simulation makes by reading earlier.
    acting: Vec<f64>,
}

impl Device {
    /// A sensor with these true parameters of its model.
    pub fn new(model: Model, parameters: Parameters) -> Self {
        let mut acting = parameters.values().to_vec();
        for place in delay_of(&model) {
            acting[place] = 0.0;
        }
        Self {
            model,
            parameters,
            acting,
        }
    }

    /// The raw reading; `parameters` must have a regular `T` (see [`Device::is_regular`]).
    pub fn read(&self, truth: &Kinematics<f64>) -> Vector3<f64> {
        let raw = self.model.distort(truth, &self.acting);
        raw.unwrap_or_else(|| Vector3::repeat(f64::NAN))
    }

    /// False where `T` has no inverse.
    pub fn is_regular(&self) -> bool {
        inverse(&Base::from_parameters(self.parameters.values()).t).is_some()
    }

    /// By how much its samples are older than their stamps, s, if the model has such an effect.
    pub fn delay(&self) -> Option<&[f64]> {
        let own = &self.parameters.values()[delay_of(&self.model)];
        (!own.is_empty()).then_some(own)
    }
}

/// Returns the range of the delay's parameters in the parameters of a model; empty without a delay. The catalogue has the delay to
/// first order, the simulation in full.
fn delay_of(model: &Model) -> Range<usize> {
    let mut from = BASE_PARAMETERS;
    for effect in model.effects() {
        let own = from..from + effect.params().len();
        if effect.nature() == Nature::Delay {
            return own;
        }
        from = own.end;
    }
    from..from
}
