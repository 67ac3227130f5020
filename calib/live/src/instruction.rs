//! Instructions to the person, as values. The caller puts them into words.

use serde::{Deserialize, Serialize};

use crate::direction::Direction;
use crate::promise::Shortfall;

/// Instruction for the next action.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "do")]
#[non_exhaustive]
pub enum Instruction {
    /// No samples yet.
    Wait,
    /// Lay it down and let go: the first placement, in any direction.
    LayDown,
    /// It is still: leave it.
    Hold {
        /// Seconds until the placement is complete.
        remaining: f64,
    },
    /// Turn it to `to` and lay it down there.
    Turn {
        /// Direction to point up next.
        to: Direction,
        /// Verdict on the last placement.
        last: Verdict,
    },
    /// It is held in the hand: lay it down, or lean it against something.
    LetGo {
        /// Direction of the placement, if one is requested.
        at: Option<Direction>,
    },
    /// The surface under the device vibrates: lay the device elsewhere.
    Shaken,
    /// Turn more slowly: the gyroscope reads no more.
    TooFast {
        /// The axis, 0 to 2.
        axis: usize,
        /// The reading at which it stays, in its unit.
        at: f64,
    },
    /// The device measures no more: start it again.
    Paused,
    /// The device does not answer: wait, or go nearer.
    Reconnecting,
    /// The promised accuracy is reached: done.
    Enough,
    /// So many placements that more would not help, and less is known than promised: done.
    Short {
        /// Quantity that falls furthest short of the promise.
        of: Shortfall,
    },
}

impl Instruction {
    /// Returns true if the session ends with this instruction.
    pub fn ends(&self) -> bool {
        matches!(self, Self::Enough | Self::Short { .. })
    }
}

/// Verdict on a placement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It was the one asked for.
    Good,
    /// It was another one, which tells as much.
    GoodToo,
    /// It tells little beside those before.
    Repeated,
}

impl Instruction {
    /// Returns true if both instructions are equal apart from the remaining seconds.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Hold { .. }, Self::Hold { .. })) || self == other
    }
}
