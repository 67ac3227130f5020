//! Residuals that the fits minimise, each written once for any scalar.

mod gravity_norm;
mod integrator;
mod own_bias;
mod propagated_gravity;
mod stacked;
mod static_rate;

pub use gravity_norm::GravityNorm;
pub use integrator::{Integrator, attitude_of};
pub use own_bias::OwnBias;
pub use propagated_gravity::{PropagatedGravity, TurnData};
pub use stacked::Stacked;
pub use static_rate::StaticRate;

use nalgebra::Vector3;
use sensor::Kinematics;

use crate::truth::unneeded;

/// A mean reading (raw unit) and what else is known of its static interval.
#[derive(Clone, Copy, Debug)]
pub struct StaticMean {
    /// Mean reading, raw unit (3).
    pub raw: Vector3<f64>,
    /// The other sensor's truth, time and temperature.
    pub rest: Kinematics<f64>,
    /// Standard deviation of an axis of the mean by the white noise within the interval, raw unit;
    /// zero where it is not known.
    pub white: f64,
}

impl StaticMean {
    /// Builds a mean of which nothing else is known.
    pub fn bare(raw: Vector3<f64>) -> Self {
        Self {
            raw,
            rest: unneeded(),
            white: 0.0,
        }
    }
}
