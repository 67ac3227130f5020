//! What the person is told, as values; words are the caller's.

use serde::{Deserialize, Serialize};

use crate::direction::Direction;
use crate::promise::Shortfall;

/// What to do now.
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
        /// What is wanted next.
        to: Direction,
        /// What became of the last placement.
        last: Verdict,
    },
    /// It is held in the hand: lay it down, or lean it against something.
    LetGo {
        /// Where.
        at: Option<Direction>,
    },
    /// What it lies on vibrates: lay it elsewhere.
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
    /// What was promised is reached: done.
    Enough,
    /// So many placements that more would not help, and less is known than promised: done.
    Short {
        /// What falls furthest short.
        of: Shortfall,
    },
}

impl Instruction {
    /// Whether the session ends with it.
    pub fn ends(&self) -> bool {
        matches!(self, Self::Enough | Self::Short { .. })
    }
}

/// What became of a placement.
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
    /// Whether `other` says the same but for seconds that run.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Hold { .. }, Self::Hold { .. })) || self == other
    }
}
