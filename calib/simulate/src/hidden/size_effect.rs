//! The three accelerometers of a triad sit in different places.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};
use crate::random::Random;

/// `eᵢ = [ω̇ × rᵢ + ω × (ω × rᵢ)]ᵢ`: axis `i` sits at `rᵢ`, a random direction times `a`. Silent at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeEffect {
    /// `a`, m.
    pub amplitude: f64,
}

impl SizeEffect {
    pub(super) fn draw(&self, random: &mut Random) -> Drawn {
        Drawn {
            arms: [(); 3].map(|()| random.direction() * self.amplitude),
        }
    }
}

/// Positions of the three axes, m.
#[derive(Debug)]
pub(super) struct Drawn {
    arms: [Vector3<f64>; 3],
}

impl Disturbance for Drawn {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        Vector3::from_fn(|i, _| {
            let arm = &self.arms[i];
            let swing = at.angular_acceleration.cross(arm);
            (swing + at.rate.cross(&at.rate.cross(arm)))[i]
        })
    }

    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        let arms = self.arms.iter().zip(["x", "y", "z"]);
        arms.map(|(arm, axis)| (format!("arm_{axis}"), arm.as_slice().to_vec()))
            .collect()
    }
}
