//! Noise of a sensor, estimated from a static recording.
//!
//! ```text
//! samples ──► outliers ──► lost, held ──► AllanAccumulator ──► AllanCurve ──► identify ──► NoiseTerms ──► settling time
//! (streamed)  (left out)   steps, drift   (bounded memory)     σ(τ)           (generalised least squares, covariance of σ²)
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod allan;
mod curves;
mod long_csv;
mod samples;
mod summary;
mod terms;
mod warnings;

pub use allan::{AllanAccumulator, AllanCurve, AllanPoint};
pub use curves::{RecordingCurves, SensorAccumulator, SensorCurves};
pub use long_csv::curves_of_long_csv;
pub use samples::changes::{Drift, Step};
pub use samples::coarse::Coarse;
pub use samples::held::Held;
pub use samples::outliers::Outliers;
pub use samples::stillness::{AtRest, Stillness};
pub use summary::{
    AxisNoise, CurvePoint, Densities, NOISE_SCHEMA, NoiseSummary, RandomWalk, SensorNoise,
    TermValue,
};
pub use terms::identify::{Estimate, NoiseTerms, identify};
pub use terms::interval::Interval;
pub use terms::settling::settling_time;
pub use terms::term::NoiseTerm;
