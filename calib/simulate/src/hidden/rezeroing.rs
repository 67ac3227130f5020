//! A zero that the device sets anew while it rests.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};
use crate::motion::Motion;
use crate::random::Random;

/// A bias that jumps `after` seconds into every rest that lasts so long, to a value that is independent of those before:
/// each component normal with standard deviation `amplitude`. It begins at zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rezeroing {
    /// The sensor.
    pub sensor: Sensor,
    /// Standard deviation of each component, m/s² or rad/s.
    pub amplitude: f64,
    /// From the end of a turn to the jump, s.
    #[serde(default = "seconds")]
    pub after: f64,
}

fn seconds() -> f64 {
    3.0
}

impl Rezeroing {
    pub(super) fn along(&self, motion: &Motion, random: &mut Random) -> Drawn {
        let ends = motion.turns().iter().map(|(end, _)| *end);
        let resting = ends.filter(|end| motion.is_still(*end, end + self.after));
        Drawn {
            jumps: resting
                .map(|end| (end + self.after, random.normal3() * self.amplitude))
                .collect(),
        }
    }
}

/// When the bias jumps, and to what.
#[derive(Debug)]
pub(super) struct Drawn {
    jumps: Vec<(f64, Vector3<f64>)>,
}

impl Disturbance for Drawn {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let over = self.jumps.partition_point(|(t, _)| *t <= at.time);
        let last = over.checked_sub(1).and_then(|k| self.jumps.get(k));
        last.map_or_else(Vector3::zeros, |(_, bias)| *bias)
    }

    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        let times = self.jumps.iter().map(|(t, _)| *t).collect();
        BTreeMap::from([("jumps".to_owned(), times)])
    }
}
