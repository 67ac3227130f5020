//! Quantities of an instant that an effect can depend on.

use std::fmt;

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::covariate::Covariate;
use crate::kinematics::{Kinematics, Sensor, Since};

/// A field of [`Kinematics`]: what an effect can need.
///
/// ```
/// use stillpoint_sensor::Quantity;
///
/// assert_eq!(Quantity::AngularAcceleration.to_string(), "angular acceleration");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Specific force, m/s².
    SpecificForce,
    /// Angular rate, rad/s.
    AngularRate,
    /// Magnetic field, in the unit of the magnetometer's readings.
    MagneticField,
    /// Time since the start of the recording, s.
    Time,
    /// Temperature, °C.
    Temperature,
    /// Derivative of the angular rate, rad/s².
    AngularAcceleration,
    /// Derivative of the specific force, m/s³.
    SpecificForceRate,
    /// Sign of the last change of specific force, per axis.
    LastChange,
    /// Mean square of the vibration, per axis, (m/s²)².
    Vibration,
    /// Derivative of the temperature, K/s.
    TemperatureRate,
    /// Sign of the last temperature change: warming up or cooling down.
    Warming,
    /// Rotation vector of the last turn, rad.
    LastTurn,
    /// Time since the end of the last turn, s.
    SinceTurn,
    /// Attitude against a level frame with a heading that stays.
    Attitude,
}

impl Quantity {
    /// Every one of them.
    pub const ALL: [Self; 14] = [
        Self::SpecificForce,
        Self::AngularRate,
        Self::MagneticField,
        Self::Time,
        Self::Temperature,
        Self::AngularAcceleration,
        Self::SpecificForceRate,
        Self::LastChange,
        Self::Vibration,
        Self::TemperatureRate,
        Self::Warming,
        Self::LastTurn,
        Self::SinceTurn,
        Self::Attitude,
    ];

    /// Returns the quantity that a sensor measures.
    pub fn signal_of(sensor: Sensor) -> Self {
        match sensor {
            Sensor::Accelerometer => Self::SpecificForce,
            Sensor::Gyroscope => Self::AngularRate,
            Sensor::Magnetometer => Self::MagneticField,
        }
    }

    /// The quantity that a covariate of an expression is a component of.
    pub fn of(covariate: Covariate) -> Self {
        match covariate {
            Covariate::SpecificForce(_) | Covariate::ForceSize(_) => Self::SpecificForce,
            Covariate::AngularRate(_) | Covariate::RateSize(_) => Self::AngularRate,
            Covariate::AngularAcceleration(_) => Self::AngularAcceleration,
            Covariate::Vibration(_) => Self::Vibration,
            Covariate::LastChange(_) => Self::LastChange,
            Covariate::Time => Self::Time,
            Covariate::Temperature | Covariate::TemperatureChange => Self::Temperature,
            Covariate::TemperatureRate => Self::TemperatureRate,
            Covariate::Warming => Self::Warming,
            Covariate::LastTurn(_) => Self::LastTurn,
            Covariate::SinceTurn => Self::SinceTurn,
        }
    }

    /// Returns true if the quantity is zero whenever the device is static.
    pub fn vanishes_at_rest(self) -> bool {
        matches!(
            self,
            Self::AngularRate | Self::AngularAcceleration | Self::SpecificForceRate
        )
    }

    /// Returns true if the quantity is the temperature or one of its changes.
    pub fn is_thermal(self) -> bool {
        matches!(
            self,
            Self::Temperature | Self::TemperatureRate | Self::Warming
        )
    }

    /// Returns true if the quantity is known only from static intervals.
    pub fn is_told_by_intervals(self) -> bool {
        matches!(
            self,
            Self::LastChange | Self::Vibration | Self::LastTurn | Self::SinceTurn | Self::Attitude
        )
    }

    /// `truth` with this quantity, and nothing else, changed by about `size` of what is common.
    pub fn changed(self, truth: &Kinematics<f64>, size: f64) -> Kinematics<f64> {
        let step = |a: f64, b: f64, c: f64| Vector3::new(a, b, c) * size;
        let mut other = *truth;
        match self {
            Self::SpecificForce => other.specific_force += step(1.3, -2.1, 1.7),
            Self::AngularRate => other.angular_rate += step(0.7, 1.1, -0.9),
            Self::MagneticField => other.magnetic_field += step(13.0, -21.0, 17.0),
            Self::Time => other.time += 70.0 * size,
            Self::Temperature => other.temperature += 9.0 * size,
            Self::AngularAcceleration => other.angular_acceleration += step(2.3, -1.9, 3.1),
            Self::SpecificForceRate => other.specific_force_rate += step(11.0, 13.0, -17.0),
            Self::LastChange => other.last_change = -other.last_change,
            Self::Vibration => other.vibration += step(0.11, 0.13, 0.17),
            Self::TemperatureRate => other.temperature_rate += 0.03 * size,
            Self::Warming => other.warming = -other.warming,
            Self::LastTurn => other.last_turn = -other.last_turn + step(0.3, -0.2, 0.4),
            Self::SinceTurn => {
                let later = 2.0 * size.abs();
                other.since_turn = Since {
                    from: other.since_turn.from + later,
                    to: other.since_turn.to + later,
                };
            }
            Self::Attitude => {
                let turn = Attitude::exp(&step(0.4, -0.3, 0.5));
                other.attitude = other.attitude.then(&turn).normalized();
            }
        }
        other
    }

    /// Adds nothing: sets this quantity to that of a device at rest where it vanishes there.
    pub fn at_rest(self, truth: &Kinematics<f64>) -> Kinematics<f64> {
        let mut other = *truth;
        match self {
            Self::AngularRate => other.angular_rate = Vector3::zeros(),
            Self::AngularAcceleration => other.angular_acceleration = Vector3::zeros(),
            Self::SpecificForceRate => other.specific_force_rate = Vector3::zeros(),
            _ => {}
        }
        other
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::SpecificForce => "specific force",
            Self::AngularRate => "angular rate",
            Self::MagneticField => "magnetic field",
            Self::Time => "time",
            Self::Temperature => "temperature",
            Self::AngularAcceleration => "angular acceleration",
            Self::SpecificForceRate => "derivative of the specific force",
            Self::LastChange => "sign of the last change of specific force",
            Self::Vibration => "vibration",
            Self::TemperatureRate => "derivative of the temperature",
            Self::Warming => "sign of the last change of temperature",
            Self::LastTurn => "rotation of the last turn",
            Self::SinceTurn => "time since the last turn",
            Self::Attitude => "attitude",
        })
    }
}
