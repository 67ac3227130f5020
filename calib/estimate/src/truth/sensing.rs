//! A sensor's model with its parameters, as far as a fit has come.

use nalgebra::{Matrix3, Vector3};
use sensor::{Base, EffectRef, Kinematics, Model, Sensor};

use super::raw_unit::RawUnit;
use crate::calibration::Calibration;

/// One sensor's model.
#[derive(Clone, Debug)]
pub struct Sensing {
    /// Base model and effects.
    pub model: Model,
    /// Its parameters, for readings near SI units.
    pub parameters: Vec<f64>,
    /// Scale and zero that bring readings near SI units; [`RawUnit::SI`] where the parameters do.
    pub unit: RawUnit,
}

impl Sensing {
    /// For readings as they are.
    pub fn new(model: Model, parameters: Vec<f64>) -> Self {
        Self {
            model,
            parameters,
            unit: RawUnit::SI,
        }
    }

    /// A model at its first values: a perfect sensor whose readings are in `unit`.
    pub fn first(model: Model, unit: RawUnit) -> Self {
        let parameters = model.parameters().values().to_vec();
        Self {
            model,
            parameters,
            unit,
        }
    }

    /// The signal behind a reading near SI units by the base model alone.
    pub fn base(&self, reading: &Vector3<f64>) -> Vector3<f64> {
        Base::from_parameters(&self.parameters).correct(reading)
    }

    /// The derivative of the signal from that of the raw reading, by the base model alone.
    pub fn slope(&self, raw: &Vector3<f64>) -> Vector3<f64> {
        Base::from_parameters(&self.parameters).t * raw * self.unit.scale
    }

    /// The variance of the signal per axis from the covariance of the raw reading, by the base model alone.
    pub fn spread(&self, raw: &Matrix3<f64>) -> Vector3<f64> {
        let t = Base::from_parameters(&self.parameters).t * self.unit.scale;
        (t * raw * t.transpose()).diagonal()
    }

    /// The signal behind a reading near SI units.
    pub fn correct(&self, reading: &Vector3<f64>, known: &Kinematics<f64>) -> Vector3<f64> {
        self.model.correct(reading, known, &self.parameters)
    }
}

/// The models so far; without one where nothing is known of a sensor.
#[derive(Clone, Debug, Default)]
pub struct Models {
    /// Model of the accelerometer.
    pub accelerometer: Option<Sensing>,
    /// Model of the gyroscope.
    pub gyroscope: Option<Sensing>,
    /// Model of the magnetometer.
    pub magnetometer: Option<Sensing>,
}

impl Models {
    /// Those of a calibration.
    pub fn of(calibration: &Calibration) -> Self {
        let of = |sensor| calibration.model(sensor).map(|(m, p)| Sensing::new(m, p));
        Self {
            accelerometer: of(Sensor::Accelerometer),
            gyroscope: of(Sensor::Gyroscope),
            magnetometer: of(Sensor::Magnetometer),
        }
    }

    /// Those of a calibration, with the biases that a recording has where each has its own.
    pub fn of_recording(calibration: &Calibration, recording: &str) -> Self {
        let mut models = Self::of(calibration);
        for (sensing, triad) in [
            (&mut models.accelerometer, &calibration.accelerometer),
            (&mut models.gyroscope, &calibration.gyroscope),
        ] {
            let (Some(sensing), Some(triad)) = (sensing, triad) else {
                continue;
            };
            if let Some(own) = triad.bias_in(recording) {
                sensing.parameters[9..12].copy_from_slice(&own.bias);
            }
        }
        models
    }

    /// The model of one sensor.
    pub fn get(&self, sensor: Sensor) -> Option<&Sensing> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => self.magnetometer.as_ref(),
        }
    }

    /// The effects of all.
    pub fn effects(&self) -> impl Iterator<Item = &EffectRef> {
        [&self.accelerometer, &self.gyroscope, &self.magnetometer]
            .into_iter()
            .flatten()
            .flat_map(|sensing| sensing.model.effects())
    }
}
