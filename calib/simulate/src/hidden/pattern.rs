//! A bias that depends on orientation in fine detail.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::Vector3;
use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};
use crate::random::Random;

/// `e = a Πᵢ sin(k uᵢ + φᵢ)` on one axis, `u = f/‖f‖` the direction of specific force: finer over the
/// sphere than any polynomial of low order. The phases `φ` are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pattern {
    /// The sensor.
    pub sensor: Sensor,
    /// Its axis.
    pub axis: Axis,
    /// `a`, m/s² or rad/s; the root mean square over the sphere is about a third of it.
    pub amplitude: f64,
    /// `k`: from one extreme to the next it takes about `π/k` rad.
    #[serde(default = "fine")]
    pub wavenumber: f64,
}

/// Extremes 25° apart.
fn fine() -> f64 {
    7.0
}

impl Pattern {
    pub(super) fn draw(&self, random: &mut Random) -> Drawn {
        let phases = Vector3::from_fn(|_, _| random.uniform(0.0..TAU));
        Drawn {
            pattern: *self,
            phases,
        }
    }
}

/// A pattern and its phases.
#[derive(Debug)]
pub(super) struct Drawn {
    pattern: Pattern,
    phases: Vector3<f64>,
}

impl Disturbance for Drawn {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let Some(direction) = at.force.try_normalize(1e-9) else {
            return Vector3::zeros();
        };
        let waves = (direction * self.pattern.wavenumber + self.phases).map(f64::sin);
        self.pattern.axis.unit() * (self.pattern.amplitude * waves.product())
    }

    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        BTreeMap::from([("phases".to_owned(), self.phases.as_slice().to_vec())])
    }
}
