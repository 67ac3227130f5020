//! Recordings with known truth.
//!
//! ```text
//! Spec ──► Simulation ──► Samples (streamed) ──► Session { recording, truth } · write(dir)
//!           │  motion      closed form: attitude, rate, acceleration
//!           │  world       f = Rᵀ(a + g z), temperature
//!           └─ device      raw = base⁻¹(truth + Σ effect(truth)), averaged over the sample's window
//! ```
//!
//! The simulation shares the sensor models with the estimator, and nothing else: motion is a formula
//! here, where the estimator integrates.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod device;
mod drift;
mod effects;
mod hidden;
mod motion;
mod noise;
mod random;
mod samples;
mod sampling;
mod session;
mod simulation;
mod spec;
mod surroundings;
mod truth;
mod world;
mod write;

pub use device::Grade;
pub use gyroscope::EARTH_RATE;
pub use hidden::{
    Heading, Hidden, HiddenTruth, Pattern, Periodic, Relaxation, Rezeroing, SizeEffect, Telegraph,
};
pub use motion::{Cart, HandHeld, Planned, PlannedLeg, PlannedStep, SixPosition, Still, Walking};
pub use noise::{Distribution, Noise, Spikes};
pub use samples::{Sample, Samples};
pub use sampling::{Between, Clock, Resampled, Sampling, Stamp};
pub use session::{MOST_SAMPLES, Session};
pub use simulation::Simulation;
pub use spec::{EXAMPLE, Effects, Motion, OwnEffects, SIZE, SensorSpec, Spec};
pub use surroundings::{Fault, MagneticField, Temperature, Unsteady, Vibration};
pub use truth::{StaticInterval, TRUTH_SCHEMA, Truth};
pub use write::{FILES, Files};
