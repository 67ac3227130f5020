//! A bias that decays after each turn.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};
use crate::motion::Motion;

/// `e = a s exp(−(t − t₀)/τ)` on one axis; `t₀` is the end of the last turn that is over and `s` the
/// sign of its rotation about the axis: a part that yields and creeps back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Relaxation {
    /// The sensor.
    pub sensor: Sensor,
    /// Its axis.
    pub axis: Axis,
    /// `a`, m/s² or rad/s.
    pub amplitude: f64,
    /// `τ`, s.
    #[serde(default = "seconds")]
    pub tau: f64,
}

/// Shorter than a rest.
fn seconds() -> f64 {
    3.0
}

impl Relaxation {
    pub(super) fn along(&self, motion: &Motion) -> Drawn {
        let turns = motion.turns().iter();
        let turns = turns.map(|(end, rotation)| (*end, rotation[self.axis.index()].signum()));
        Drawn {
            relaxation: *self,
            turns: turns.collect(),
        }
    }
}

/// The bias and the turns: end and sign of each, in order.
#[derive(Debug)]
pub(super) struct Drawn {
    relaxation: Relaxation,
    turns: Vec<(f64, f64)>,
}

impl Disturbance for Drawn {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let over = self.turns.partition_point(|(end, _)| *end <= at.time);
        let Some((end, sign)) = over.checked_sub(1).and_then(|k| self.turns.get(k)) else {
            return Vector3::zeros();
        };
        let decay = (-(at.time - end) / self.relaxation.tau).exp();
        self.relaxation.axis.unit() * (self.relaxation.amplitude * sign * decay)
    }

    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        let (ends, signs) = self.turns.iter().copied().unzip();
        BTreeMap::from([("ends".to_owned(), ends), ("signs".to_owned(), signs)])
    }
}
