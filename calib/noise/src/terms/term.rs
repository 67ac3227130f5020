//! The five noise terms of an inertial sensor and what each adds to the Allan variance.

use sensor::Sensor;
use serde::{Deserialize, Serialize};

/// A noise term: one slope of the Allan deviation.
///
/// | term | coefficient | `σ²(τ)` | slope of `σ` | unit for a signal in `u` |
/// |---|---|---|---|---|
/// | quantisation | `Q` | `3 Q² / τ²` | −1 | `u·s` |
/// | white noise | `N` | `N² / τ` | −½ | `u·√s` |
/// | bias instability | `B` | `(2 ln 2 / π) B²` | 0 | `u` |
/// | random walk of the rate | `K` | `K² τ / 3` | +½ | `u/√s` |
/// | ramp | `R` | `R² τ² / 2` | +1 | `u/s` |
///
/// Source: IEEE Std 952-1997, annex C.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseTerm {
    /// Rounding in an integrating converter: white noise of the integrated signal.
    Quantisation,
    /// Angle random walk of a gyroscope, velocity random walk of an accelerometer.
    WhiteNoise,
    /// Flicker noise (`1/f`) of the signal.
    BiasInstability,
    /// Random walk of the bias.
    RandomWalk,
    /// Steady drift of the bias.
    Ramp,
}

impl NoiseTerm {
    /// All five, in the order of their slopes.
    pub const ALL: [Self; 5] = [
        Self::Quantisation,
        Self::WhiteNoise,
        Self::BiasInstability,
        Self::RandomWalk,
        Self::Ramp,
    ];

    /// `σ²(τ)` of the term with coefficient 1.
    pub fn variance(self, tau: f64) -> f64 {
        match self {
            Self::Quantisation => 3.0 / (tau * tau),
            Self::WhiteNoise => 1.0 / tau,
            Self::BiasInstability => 2.0 * std::f64::consts::LN_2 / std::f64::consts::PI,
            Self::RandomWalk => tau / 3.0,
            Self::Ramp => tau * tau / 2.0,
        }
    }

    /// Its name for a sensor.
    pub fn name(self, sensor: Sensor) -> &'static str {
        match (self, sensor) {
            (Self::Quantisation, _) => "quantisation noise",
            (Self::WhiteNoise, Sensor::Gyroscope) => "angle random walk",
            (Self::WhiteNoise, Sensor::Accelerometer) => "velocity random walk",
            (Self::BiasInstability, _) => "bias instability",
            (Self::RandomWalk, Sensor::Gyroscope) => "rate random walk",
            (Self::RandomWalk, Sensor::Accelerometer) => "acceleration random walk",
            (Self::Ramp, Sensor::Gyroscope) => "rate ramp",
            (Self::Ramp, Sensor::Accelerometer) => "acceleration ramp",
            (Self::WhiteNoise, Sensor::Magnetometer) => "white noise",
            (Self::RandomWalk, Sensor::Magnetometer) => "random walk",
            (Self::Ramp, Sensor::Magnetometer) => "ramp",
        }
    }

    /// The SI unit of its coefficient.
    pub fn unit(self, sensor: Sensor) -> &'static str {
        match (self, sensor) {
            (Self::Quantisation, Sensor::Gyroscope) => "rad",
            (Self::Quantisation, Sensor::Accelerometer) => "m/s",
            (Self::WhiteNoise, Sensor::Gyroscope) => "rad/√s",
            (Self::WhiteNoise, Sensor::Accelerometer) => "m/s/√s",
            (Self::BiasInstability, Sensor::Gyroscope) => "rad/s",
            (Self::BiasInstability, Sensor::Accelerometer) => "m/s²",
            (Self::RandomWalk, Sensor::Gyroscope) => "rad/s/√s",
            (Self::RandomWalk, Sensor::Accelerometer) => "m/s²/√s",
            (Self::Ramp, Sensor::Gyroscope) => "rad/s²",
            (Self::Ramp, Sensor::Accelerometer) => "m/s³",
            (Self::Quantisation, Sensor::Magnetometer) => "µT s",
            (Self::WhiteNoise, Sensor::Magnetometer) => "µT √s",
            (Self::BiasInstability, Sensor::Magnetometer) => "µT",
            (Self::RandomWalk, Sensor::Magnetometer) => "µT/√s",
            (Self::Ramp, Sensor::Magnetometer) => "µT/s",
        }
    }

    /// The unit of its coefficient where the readings are counts.
    pub fn unit_in_counts(self) -> &'static str {
        match self {
            Self::Quantisation => "counts·s",
            Self::WhiteNoise => "counts·√s",
            Self::BiasInstability => "counts",
            Self::RandomWalk => "counts/√s",
            Self::Ramp => "counts/s",
        }
    }

    /// The unit in which filters take the same number: 1 √s is 1/√Hz.
    pub fn density_unit(self, sensor: Sensor) -> Option<&'static str> {
        match (self, sensor) {
            (Self::WhiteNoise, Sensor::Gyroscope) => Some("rad/s/√Hz"),
            (Self::WhiteNoise, Sensor::Accelerometer) => Some("m/s²/√Hz"),
            (Self::RandomWalk, Sensor::Gyroscope) => Some("rad/s²/√Hz"),
            (Self::RandomWalk, Sensor::Accelerometer) => Some("m/s³/√Hz"),
            _ => None,
        }
    }
}
