//! The three axes of a triad.

use std::fmt;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// One axis of a sensor, or of the body frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// All three, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Its place in a vector: 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The axis after it: y after x, z after y, x after z.
    #[must_use]
    pub fn following(self) -> Self {
        Self::ALL[(self.index() + 1) % 3]
    }

    /// The unit vector along it.
    pub fn unit(self) -> Vector3<f64> {
        Vector3::ith(self.index(), 1.0)
    }

    /// `x`, `y` or `z`.
    pub fn letter(self) -> &'static str {
        ["x", "y", "z"][self.index()]
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.letter())
    }
}
