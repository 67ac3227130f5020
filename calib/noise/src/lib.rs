//! Noise of a sensor, estimated from a static recording.
//!
//! ```text
//! samples ──► lost, held ──► AllanAccumulator ──► AllanCurve ──► identify ──► NoiseTerms ──► settling time
//! (streamed)  steps, drift   (bounded memory)     σ(τ)           (generalised least squares, covariance of σ²)
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod allan;
mod changes;
mod covariance;
mod curves;
mod held;
mod identify;
mod interval;
mod long_csv;
mod lost;
mod settling;
mod stillness;
mod summary;
mod term;
mod warnings;

pub use allan::{AllanAccumulator, AllanCurve, AllanPoint};
pub use changes::{Drift, Step};
pub use curves::{RecordingCurves, SensorAccumulator, SensorCurves};
pub use held::Held;
pub use identify::{Estimate, NoiseTerms, identify};
pub use interval::Interval;
pub use long_csv::curves_of_long_csv;
pub use settling::settling_time;
pub use stillness::{AtRest, Stillness};
pub use summary::{
    AxisNoise, CurvePoint, Densities, NOISE_SCHEMA, NoiseSummary, SensorNoise, TermValue,
};
pub use term::NoiseTerm;
