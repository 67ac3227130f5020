//! What a recording at rest says of its own noise.
//!
//! ```text
//! samples ──► AllanAccumulator ──► AllanCurve ──► identify ──► NoiseTerms ──► settling time
//! (streamed)  (bounded memory)     σ(τ)           (generalised least squares, covariance of σ²)
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod allan;
mod covariance;
mod curves;
mod identify;
mod interval;
mod long_csv;
mod settling;
mod stillness;
mod summary;
mod term;

pub use allan::{AllanAccumulator, AllanCurve, AllanPoint};
pub use curves::{RecordingCurves, SensorAccumulator, SensorCurves};
pub use identify::{Estimate, NoiseTerms, identify};
pub use interval::Interval;
pub use long_csv::curves_of_long_csv;
pub use settling::settling_time;
pub use stillness::{AtRest, Stillness};
pub use summary::{AxisNoise, CurvePoint, NOISE_SCHEMA, NoiseSummary, SensorNoise, TermValue};
pub use term::NoiseTerm;
