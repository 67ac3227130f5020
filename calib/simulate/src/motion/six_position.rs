//! A six-position session: every axis up and down, at rest for minutes.

use serde::{Deserialize, Serialize};

use super::orientation::{Orientation, lattice};
use super::path::Path;
use super::placements::{Placement, Surroundings, path_through};
use super::turn::Hand;
use crate::random::{Purpose, Random};

/// The six faces, turned by hand from one to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct SixPosition {
    /// Length of each rest, s.
    pub rest: f64,
    /// Length of each turn, s.
    pub turn: f64,
    /// Deviation of a face from level, rad (standard deviation per axis).
    pub scatter: f64,
}

impl Default for SixPosition {
    fn default() -> Self {
        Self {
            rest: 300.0,
            turn: 4.0,
            scatter: 0.008,
        }
    }
}

impl SixPosition {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let mut random = Random::new(around.seed, Purpose::Motion);
        let placement = |orientation: Orientation, random: &mut Random| Placement {
            attitude: orientation.attitude(self.scatter, random),
            label: orientation.label,
            rest: self.rest,
            turn: self.turn,
        };
        let placements: Vec<Placement> = lattice(1)
            .into_iter()
            .map(|o| placement(o, &mut random))
            .collect();
        let hand = Hand {
            lift: 0.1,
            tremor: 1.0,
            ..Hand::default()
        };
        path_through(&placements, &hand, around, &mut random)
    }
}
