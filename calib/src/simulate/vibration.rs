//! A table that vibrates during some placements.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::random::Random;

/// Vibration at rest: white within the sensor's bandwidth, another strength in every placement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Vibration {
    /// Largest root mean square per axis, m/s²; a placement has between 0.3 and 1 of it.
    pub rms: f64,
    /// Share of the placements that vibrate.
    pub share: f64,
}

impl Default for Vibration {
    fn default() -> Self {
        Self {
            rms: 0.4,
            share: 0.5,
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
}
