//! The magnetometer beside the Cramér–Rao bound: simulated sessions against their truth.
//!
//! ```text
//! true motion, parameters and noise ─► information ─► bound ─┐
//! simulated recording ─► calibrate ─► errors ────────────────┴─► summary
//! ```
//! The bound knows nothing of the fits: it has a model of the measurements of its own, differentiated by central differences at
//! the truth.

mod information;
mod session;
mod summary;

pub use session::{Found, Record, run};
pub use summary::{Class, Summary, summarise};
