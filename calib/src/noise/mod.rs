//! What a recording at rest says of its own noise.
//!
//! ```text
//! samples ──► AllanAccumulator ──► AllanCurve ──► identify ──► NoiseTerms ──► settling time
//! (streamed)  (bounded memory)     σ(τ)           (generalised least squares, covariance of σ²)
//! ```

mod allan;
mod covariance;
mod identify;
mod interval;
mod settling;
mod term;

pub use allan::{AllanAccumulator, AllanCurve, AllanPoint};
pub use identify::{Estimate, NoiseTerms, identify};
pub use interval::Interval;
pub use settling::settling_time;
pub use term::NoiseTerm;
