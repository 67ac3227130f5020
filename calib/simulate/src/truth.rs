//! Truth of a simulation, which the estimator does not know.

use sensor::Sensor;
use serde::{Deserialize, Serialize};
use solver::Parameters;

use super::hidden::HiddenTruth;
use super::noise::Noise;
use super::spec::Spec;

/// Name of the format in `truth.json`.
pub const TRUTH_SCHEMA: &str = "stillpoint.truth/1";

/// The truth behind a simulated recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// [`TRUTH_SCHEMA`].
    pub schema: String,
    /// The request with everything in it, the seed too.
    pub spec: Spec,
    /// The true parameters of the accelerometer's base model and effects, in the recording's units.
    /// A drifting bias is given as it was at the first sample.
    pub accelerometer: Parameters,
    /// The same of the gyroscope.
    pub gyroscope: Parameters,
    /// The same of the magnetometer, whose `T` carries to the field's microtesla; none without a magnetic field.
    #[serde(default, skip_serializing_if = "Parameters::is_empty")]
    pub magnetometer: Parameters,
    /// Noise densities of the accelerometer, SI units.
    pub accelerometer_noise: Noise,
    /// The same of the gyroscope.
    pub gyroscope_noise: Noise,
    /// Names of the effects that are on.
    pub effects: Vec<String>,
    /// Disturbances outside the catalogue, with their random values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hidden: Vec<HiddenTruth>,
    /// The placements, in order.
    pub static_intervals: Vec<StaticInterval>,
}

impl Truth {
    /// The true parameters of one sensor.
    pub fn parameters(&self, sensor: Sensor) -> &Parameters {
        match sensor {
            Sensor::Accelerometer => &self.accelerometer,
            Sensor::Gyroscope => &self.gyroscope,
            Sensor::Magnetometer => &self.magnetometer,
        }
    }

    /// The true value of the parameter called `name`, of any sensor.
    pub fn get(&self, name: &str) -> Option<f64> {
        let mut all = Sensor::ALL.into_iter().map(|s| self.parameters(s));
        all.find_map(|parameters| parameters.get(name))
    }
}

/// A placement: the device rests from `start` to `end`, unless a fault disturbs it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticInterval {
    /// Words for it, such as `face +z`.
    pub label: String,
    /// True time it begins, s.
    pub start: f64,
    /// True time it ends, s.
    pub end: f64,
    /// Attitude at its begin, a quaternion `[w, x, y, z]` from the body to the level frame (x east,
    /// y north, z up).
    pub attitude: [f64; 4],
    /// Specific force at its begin, body frame, m/s².
    pub specific_force: [f64; 3],
    /// Temperature in its middle, °C.
    pub temperature: f64,
    /// Root mean square of the table's vibration, m/s².
    pub vibration: [f64; 3],
    /// Mean of the accelerometer's bias less the bias at the first sample, in the recording's units.
    pub accelerometer_drift: [f64; 3],
    /// The same of the gyroscope.
    pub gyroscope_drift: [f64; 3],
    /// Faults that disturb it: `mount_slip`, `disturbed_interval`.
    pub faults: Vec<String>,
}
