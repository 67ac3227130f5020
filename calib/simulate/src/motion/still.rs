//! A device that lies still, for hours if wanted.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::orientation::upright;
use super::path::Path;
use super::placements::{Placement, Surroundings, path_through};
use super::turn::Hand;
use crate::random::{Purpose, Random};

/// One long rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Still {
    /// Length, s.
    pub duration: f64,
    /// Body direction that points up; need not have unit length.
    pub up: [f64; 3],
}

impl Default for Still {
    fn default() -> Self {
        Self {
            duration: 3600.0,
            up: [0.0, 0.0, 1.0],
        }
    }
}

impl Still {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let up = Vector3::from(self.up)
            .try_normalize(0.0)
            .unwrap_or_else(Vector3::z);
        let placement = Placement {
            label: "still".into(),
            attitude: upright(&up),
            rest: self.duration,
            turn: 0.0,
        };
        let hand = Hand::default();
        path_through(
            &[placement],
            &hand,
            around,
            &mut Random::new(around.seed, Purpose::Motion),
        )
    }
}
