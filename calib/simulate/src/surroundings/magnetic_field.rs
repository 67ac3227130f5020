//! The magnetic field of the place.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::motion::Motion;
use crate::random::{Purpose, Random};

/// A field that is the same everywhere, but for what iron nearby does to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct MagneticField {
    /// Strength, µT.
    pub strength: f64,
    /// Angle below the horizontal, degrees.
    pub inclination: f64,
    /// Standard deviation per axis by which it differs from placement to placement, µT.
    pub unevenness: f64,
}

impl Default for MagneticField {
    /// Middle Europe.
    fn default() -> Self {
        Self {
            strength: 48.0,
            inclination: 65.0,
            unevenness: 0.0,
        }
    }
}

/// The field along a motion.
#[derive(Clone, Debug)]
pub(crate) struct PlacedField {
    /// In the level frame (x east, y north, z up), µT.
    everywhere: Vector3<f64>,
    /// Begin and end of the placements, s, and what the field is off by there.
    uneven: Vec<(f64, f64, Vector3<f64>)>,
}

impl MagneticField {
    pub(crate) fn place(&self, seed: u64, motion: &Motion) -> PlacedField {
        let (down, north) = self.inclination.to_radians().sin_cos();
        let rests = motion.segments().iter().filter(|s| s.rest.is_some());
        let uneven = rests.enumerate().map(|(place, segment)| {
            let off = Random::new(seed, Purpose::Uneven(place)).normal3();
            (segment.start, segment.end, off * self.unevenness)
        });
        PlacedField {
            everywhere: Vector3::new(0.0, north, -down) * self.strength,
            uneven: if self.unevenness > 0.0 {
                uneven.collect()
            } else {
                Vec::new()
            },
        }
    }
}

impl PlacedField {
    /// The field at time `t`, level frame, µT.
    pub fn at(&self, t: f64) -> Vector3<f64> {
        let next = self.uneven.partition_point(|(_, end, _)| *end < t);
        let here = self.uneven.get(next).filter(|(start, ..)| *start <= t);
        self.everywhere + here.map_or_else(Vector3::zeros, |(.., off)| *off)
    }
}
