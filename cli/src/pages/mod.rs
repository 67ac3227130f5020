//! Content of reports: from results to pages, pictures and sentences.
//!
//! ```text
//! recordings, how they were cut, calibration ──► Session (static intervals, turns, what is left of each)
//! Session ──► coverage · residuals · quantiles · noise ──► Picture
//! Calibration ──► parameters · provenance · verdict    ──► calibration::page, refusal::page, evaluation::page
//! ```

pub mod calibration;
pub mod coverage;
pub mod direction;
pub mod evaluation;
mod intervals_plot;
mod noise;
pub mod parameters;
pub mod provenance;
mod quantiles;
pub mod refusal;
pub mod residual;
pub mod residuals;
pub mod session;
pub mod verdict;

pub use intervals_plot::intervals_plot;
