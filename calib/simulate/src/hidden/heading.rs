//! A bias fixed in the world.

use nalgebra::Vector3;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};

/// `e = a Rᵀ h`, `h` a horizontal direction of the world seen from the body: what a magnetic field does
/// to a sensor that feels it. A turn about the vertical changes it, which gravity does not see.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heading {
    /// The sensor.
    pub sensor: Sensor,
    /// `a`, m/s² or rad/s.
    pub amplitude: f64,
    /// Azimuth of `h`, from east (x) to north (y), rad.
    #[serde(default)]
    pub azimuth: f64,
}

impl Disturbance for Heading {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let (sin, cos) = self.azimuth.sin_cos();
        let horizontal = Vector3::new(cos, sin, 0.0);
        at.attitude.inverse_transform_vector(&horizontal) * self.amplitude
    }
}
