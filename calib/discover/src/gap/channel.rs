//! The kinds of comparison between the model and the data.

use serde::Serialize;

/// A kind of comparison between the model and the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Channel {
    /// Norm of the specific force at rest.
    StaticNorm,
    /// Mean rate at rest.
    StaticRate,
    /// Direction of gravity carried through the turns.
    Direction,
    /// Specific force while the device turns.
    MovingForce,
}

impl Channel {
    /// Those that the joint fit compares, in the order of its rows.
    pub const ALL: [Self; 3] = [Self::StaticNorm, Self::StaticRate, Self::Direction];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::StaticNorm => "norm of specific force at rest",
            Self::StaticRate => "rate at rest",
            Self::Direction => "gravity direction through turns",
            Self::MovingForce => "specific force while turning",
        }
    }
}
