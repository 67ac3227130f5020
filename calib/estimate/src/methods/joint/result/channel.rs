//! The kinds of rows.

use serde::{Deserialize, Serialize};

/// The kinds of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Channel {
    /// Means of the accelerometer.
    #[serde(rename = "static_norm")]
    Force,
    /// Means of the gyroscope.
    #[serde(rename = "static_rate")]
    Rate,
    /// Directions carried through turns.
    Direction,
}
