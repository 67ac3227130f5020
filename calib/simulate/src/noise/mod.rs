//! Noise of one sensor from its densities.

mod colour;
mod distribution;
mod flicker;
mod source;
mod spikes;
mod thermal;

use serde::{Deserialize, Serialize};

pub use distribution::Distribution;
pub(crate) use source::NoiseSource;
pub use spikes::Spikes;

/// Noise densities of one sensor, equal on its three axes; the unit `u` is m/s² or rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Noise {
    /// White noise (velocity or angle random walk) `N`, u/√Hz: a mean over `τ` has the standard
    /// deviation `N/√τ`.
    pub white: f64,
    /// Bias random walk `K`, u/√s: the bias moves by `K√τ` (standard deviation) in a time `τ`.
    pub random_walk: f64,
    /// Bias instability `B`, u: two-sided power spectral density `B²/(2πf)`; the Allan deviation is flat at
    /// `√(2 ln 2/π) B = 0.664 B` (IEEE Std 952).
    pub instability: f64,
}
