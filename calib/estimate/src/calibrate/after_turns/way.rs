//! The ways in which a reading may be off after a turn.

use nalgebra::Vector3;

/// Causes of an error right after a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Nothing: a bias.
    Turn,
    /// The force.
    Force,
    /// The change of the force: a part of the reading follows it late.
    Change,
}

impl Way {
    pub const ALL: [Self; 3] = [Self::Turn, Self::Force, Self::Change];

    /// The error of each axis after a turn to this force, up to a factor; `change` is what the force has changed by.
    pub fn of(self, force: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Turn => Vector3::repeat(1.0),
            Self::Force => *force,
            Self::Change => *change,
        }
    }

    /// Returns true if it comes again after every turn, whatever the force was before.
    pub fn comes_again(self) -> bool {
        self != Self::Change
    }

    /// Returns true if all axes may have one factor: no two axes have one bias.
    pub fn may_be_alike(self) -> bool {
        self != Self::Turn
    }
}
