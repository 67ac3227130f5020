//! Do the stated errors hold? Simulated sessions against their truth, many at a time.

mod session;
mod summary;

pub use session::{Figures, Row, SessionResult, run};
pub use summary::{Summary, Tally, summarise};
