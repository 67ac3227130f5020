//! The true motion that a sensor model sees at one instant.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use solver::{Scalar, lit};

use crate::attitude::Attitude;

/// Kind of sensor that a model or an effect belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sensor {
    /// Measures specific force.
    Accelerometer,
    /// Measures angular rate.
    Gyroscope,
    /// Measures the magnetic field.
    Magnetometer,
}

impl Sensor {
    /// Every kind of sensor, in the order in which results list them.
    pub const ALL: [Self; 3] = [Self::Accelerometer, Self::Gyroscope, Self::Magnetometer];

    /// `accelerometer`, `gyroscope` or `magnetometer`: the sensor in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accelerometer => "accelerometer",
            Self::Gyroscope => "gyroscope",
            Self::Magnetometer => "magnetometer",
        }
    }

    /// `A`, `W` or `M`: its readings in equations.
    pub fn letter(self) -> &'static str {
        match self {
            Self::Accelerometer => "A",
            Self::Gyroscope => "W",
            Self::Magnetometer => "M",
        }
    }

    /// `f`, `w` or `m`: its true signal in equations.
    pub fn signal_letter(self) -> &'static str {
        match self {
            Self::Accelerometer => "f",
            Self::Gyroscope => "w",
            Self::Magnetometer => "m",
        }
    }

    /// `accel`, `gyro` or `mag`: the prefix of parameter names.
    pub fn prefix(self) -> &'static str {
        match self {
            Self::Accelerometer => "accel",
            Self::Gyroscope => "gyro",
            Self::Magnetometer => "mag",
        }
    }

    /// Unit of the signal. Of a magnetic field it is that of the readings, microtesla where that is known.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Accelerometer => "m/s^2",
            Self::Gyroscope => "rad/s",
            Self::Magnetometer => "uT",
        }
    }

    /// The name of a misalignment: the letter before its two axes.
    pub fn misalignment(self) -> &'static str {
        match self {
            Self::Accelerometer => "alpha",
            Self::Gyroscope => "beta",
            Self::Magnetometer => "gamma",
        }
    }

    /// The equation of the base model, small letters corrected, capital ones read.
    pub fn equation(self) -> &'static str {
        match self {
            Self::Accelerometer => "a = T (A - b)",
            Self::Gyroscope => "w = T (W - b)",
            Self::Magnetometer => "m = T (M - b)",
        }
    }
}

/// The truth at one instant, in the body frame.
///
/// What an effect needs beyond the two signals (time, temperature, history) is a field here, filled
/// in by whoever knows the whole recording; an effect itself has no memory. These covariates are plain
/// numbers, not `D`: they are measured, and what they owe to the parameters being estimated changes
/// an effect only in second order (a small coefficient times a small error).
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<D> {
    /// Specific force `f`, m/s² (at rest: `+g` on the axis that points up).
    pub specific_force: Vector3<D>,
    /// Angular rate `ω`, rad/s.
    pub angular_rate: Vector3<D>,
    /// Magnetic field `m`, in the unit of the magnetometer's readings; zero where nobody knows it.
    pub magnetic_field: Vector3<D>,
    /// Time since the start of the recording, s.
    pub time: f64,
    /// Temperature, °C.
    pub temperature: f64,
    /// Derivative of the angular rate, rad/s².
    pub angular_acceleration: Vector3<f64>,
    /// Derivative of the specific force, m/s³.
    pub specific_force_rate: Vector3<f64>,
    /// Sign of the last change of specific force, per axis: −1, 1, or 0 before the first.
    pub last_change: Vector3<f64>,
    /// Mean square of the vibration, per axis, (m/s²)².
    pub vibration: Vector3<f64>,
    /// Derivative of the temperature, K/s.
    pub temperature_rate: f64,
    /// Sign of the last temperature change: 1 warming up, −1 cooling down, 0 if unknown.
    pub warming: f64,
    /// Rotation vector of the last turn that is over, rad; zero before the first.
    pub last_turn: Vector3<f64>,
    /// Time since the end of the last turn, s; an interval where a mean over time is taken.
    pub since_turn: Since,
    /// Body to the level reference frame (z up).
    pub attitude: Attitude<f64>,
}

/// A stretch of time since something ended, s: `from` = `to` of an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Since {
    /// Its begin.
    pub from: f64,
    /// Its end.
    pub to: f64,
}

impl Since {
    /// An instant.
    pub fn at(age: f64) -> Self {
        Self { from: age, to: age }
    }

    /// Its middle, s.
    pub fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }

    /// The mean of `exp(−s/τ)` over it: `τ (e^(−from/τ) − e^(−to/τ)) / (to − from)`, for an instant the value there.
    ///
    /// ```
    /// use stillpoint_sensor::Since;
    ///
    /// let all = Since { from: 0.0, to: 8.0 };
    /// assert!((all.decayed(2.0_f64) - 0.25 * (1.0 - (-4.0_f64).exp())).abs() < 1e-15);
    /// ```
    pub fn decayed<D: Scalar>(&self, tau: D) -> D {
        let per = tau.recip();
        let length = self.to - self.from;
        if length < SHORTEST {
            return (per * -self.middle()).exp();
        }
        ((per * -self.from).exp() - (per * -self.to).exp()) * tau * lit::<D>(1.0 / length)
    }
}

/// A shorter stretch of time is an instant, s.
const SHORTEST: f64 = 1e-9;

/// A smaller rotation about an axis has no sign, rad.
const LEAST_ROTATION: f64 = 0.1;

/// The temperature assumed where none was recorded, °C.
pub const REFERENCE_TEMPERATURE: f64 = 25.0;

impl<D: Scalar> Kinematics<D> {
    /// Specific force (m/s²) and angular rate (rad/s) at the start of a recording at reference temperature.
    ///
    /// # Examples
    /// ```
    /// use nalgebra::Vector3;
    /// use stillpoint_sensor::{Kinematics, REFERENCE_TEMPERATURE};
    ///
    /// let truth = Kinematics::new(Vector3::new(0.0, 0.0, 9.8), Vector3::new(0.0, 0.0, 1.5));
    /// assert_eq!(truth.temperature, REFERENCE_TEMPERATURE);
    /// ```
    pub fn new(specific_force: Vector3<D>, angular_rate: Vector3<D>) -> Self {
        Self {
            specific_force,
            angular_rate,
            magnetic_field: Vector3::from_element(lit(0.0)),
            time: 0.0,
            temperature: REFERENCE_TEMPERATURE,
            angular_acceleration: Vector3::zeros(),
            specific_force_rate: Vector3::zeros(),
            last_change: Vector3::zeros(),
            vibration: Vector3::zeros(),
            temperature_rate: 0.0,
            warming: 0.0,
            last_turn: Vector3::zeros(),
            since_turn: Since::default(),
            attitude: Attitude::identity(),
        }
    }

    /// No rotation; specific force in m/s².
    ///
    /// # Examples
    /// ```
    /// use nalgebra::Vector3;
    /// use stillpoint_sensor::Kinematics;
    ///
    /// let warm = Kinematics { temperature: 40.0, ..Kinematics::at_rest(Vector3::new(0.0, 0.0, 9.8)) };
    /// assert_eq!(warm.angular_rate, Vector3::zeros());
    /// ```
    pub fn at_rest(specific_force: Vector3<D>) -> Self {
        Self::new(specific_force, Vector3::from_element(lit(0.0)))
    }

    /// The same instant over another scalar, as a constant.
    pub fn cast<E: Scalar>(&self) -> Kinematics<E> {
        Kinematics {
            specific_force: self.specific_force.map(|v| lit(v.re())),
            angular_rate: self.angular_rate.map(|v| lit(v.re())),
            magnetic_field: self.magnetic_field.map(|v| lit(v.re())),
            time: self.time,
            temperature: self.temperature,
            angular_acceleration: self.angular_acceleration,
            specific_force_rate: self.specific_force_rate,
            last_change: self.last_change,
            vibration: self.vibration,
            temperature_rate: self.temperature_rate,
            warming: self.warming,
            last_turn: self.last_turn,
            since_turn: self.since_turn,
            attitude: self.attitude,
        }
    }

    /// Returns the sense of the last turn about each axis: −1, 1, or 0 for a negligible angle.
    pub fn way_of_last_turn(&self) -> Vector3<f64> {
        self.last_turn.map(|rotation| {
            if rotation.abs() < LEAST_ROTATION {
                0.0
            } else {
                rotation.signum()
            }
        })
    }

    /// The signal that `sensor` measures.
    pub fn signal(&self, sensor: Sensor) -> Vector3<D> {
        match sensor {
            Sensor::Accelerometer => self.specific_force,
            Sensor::Gyroscope => self.angular_rate,
            Sensor::Magnetometer => self.magnetic_field,
        }
    }

    /// The same instant with another value of the signal that `sensor` measures.
    pub fn with_signal(&self, sensor: Sensor, signal: Vector3<D>) -> Self {
        match sensor {
            Sensor::Accelerometer => Self {
                specific_force: signal,
                ..*self
            },
            Sensor::Gyroscope => Self {
                angular_rate: signal,
                ..*self
            },
            Sensor::Magnetometer => Self {
                magnetic_field: signal,
                ..*self
            },
        }
    }
}

impl Kinematics<f64> {
    /// The same instant as constants of another scalar.
    pub fn lift<D: Scalar>(&self) -> Kinematics<D> {
        self.cast()
    }
}
