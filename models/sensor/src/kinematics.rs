//! The true motion that a sensor model sees at one instant.

use nalgebra::Vector3;
use solver::{Scalar, lit};

/// Which sensor a model or an effect belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sensor {
    /// Measures specific force.
    Accelerometer,
    /// Measures angular rate.
    Gyroscope,
}

impl Sensor {
    /// `accel` or `gyro`: the prefix of parameter names.
    pub fn prefix(self) -> &'static str {
        match self {
            Self::Accelerometer => "accel",
            Self::Gyroscope => "gyro",
        }
    }
}

/// The truth at one instant, in the body frame.
///
/// What an effect needs beyond the two signals (time, temperature, history) is a field here, filled
/// in by whoever knows the whole recording; an effect itself has no memory.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<D> {
    /// Specific force `f`, m/s² (at rest: `+g` on the axis that points up).
    pub specific_force: Vector3<D>,
    /// Angular rate `ω`, rad/s.
    pub angular_rate: Vector3<D>,
    /// Time since the start of the recording, s.
    pub time: f64,
    /// Temperature, °C.
    pub temperature: f64,
}

/// The temperature assumed where none was recorded, °C.
pub const REFERENCE_TEMPERATURE: f64 = 25.0;

impl<D: Scalar> Kinematics<D> {
    /// Specific force and angular rate at the start of a recording at reference temperature.
    pub fn new(specific_force: Vector3<D>, angular_rate: Vector3<D>) -> Self {
        Self {
            specific_force,
            angular_rate,
            time: 0.0,
            temperature: REFERENCE_TEMPERATURE,
        }
    }

    /// No rotation.
    pub fn at_rest(specific_force: Vector3<D>) -> Self {
        Self::new(specific_force, Vector3::from_element(lit(0.0)))
    }

    /// The signal that `sensor` measures.
    pub fn signal(&self, sensor: Sensor) -> Vector3<D> {
        match sensor {
            Sensor::Accelerometer => self.specific_force,
            Sensor::Gyroscope => self.angular_rate,
        }
    }

    /// The same instant with another value of the signal that `sensor` measures.
    pub fn with_signal(&self, sensor: Sensor, signal: Vector3<D>) -> Self {
        match sensor {
            Sensor::Accelerometer => Self { specific_force: signal, ..*self },
            Sensor::Gyroscope => Self { angular_rate: signal, ..*self },
        }
    }
}

impl Kinematics<f64> {
    /// The same instant as constants of another scalar.
    pub fn lift<D: Scalar>(&self) -> Kinematics<D> {
        Kinematics {
            specific_force: self.specific_force.map(lit),
            angular_rate: self.angular_rate.map(lit),
            time: self.time,
            temperature: self.temperature,
        }
    }
}
