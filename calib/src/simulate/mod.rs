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

mod clock;
mod device;
mod drift;
mod effects;
mod environment;
mod fault;
mod hidden;
mod motion;
mod noise;
mod random;
mod readout;
mod samples;
mod simulation;
mod spec;
mod truth;
mod vibration;
mod world;
mod write;

pub use clock::{Clock, Stamp};
pub use device::Grade;
pub use effects::{Effects, SIZE, catalogue};
pub use environment::Temperature;
pub use fault::Fault;
pub use hidden::{
    Heading, Hidden, HiddenTruth, Pattern, Periodic, Relaxation, SizeEffect, Telegraph,
};
pub use motion::{Cart, HandHeld, SixPosition, Still, Walking};
pub use noise::Noise;
pub use samples::{Sample, Samples};
pub use simulation::{MOST_SAMPLES, Session, Simulation};
pub use spec::{EARTH_RATE, EXAMPLE, Motion, SensorSpec, Spec};
pub use truth::{StaticInterval, TRUTH_SCHEMA, Truth};
pub use vibration::Vibration;
pub use write::FILES;

pub(crate) use spec::complaint::hint;
