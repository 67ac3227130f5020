//! A bias that swings.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};

/// `e = a sin(2πt/period + phase)` on one axis: a cooling fan, an interfering radio.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Periodic {
    /// The sensor.
    pub sensor: Sensor,
    /// Its axis.
    pub axis: Axis,
    /// `a`, m/s² or rad/s.
    pub amplitude: f64,
    /// s.
    pub period: f64,
    /// rad.
    #[serde(default)]
    pub phase: f64,
}

impl Disturbance for Periodic {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let angle = TAU * at.time / self.period + self.phase;
        self.axis.unit() * (self.amplitude * angle.sin())
    }
}
