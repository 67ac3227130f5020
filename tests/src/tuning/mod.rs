//! How much depends on a tuning constant: results of sessions with it and with another value in its place.
//!
//! ```text
//! sessions ─► outcomes ──┐
//!    └ one constant × ½ ─┴► moved: whose findings, and whose numbers, are others
//! ```

mod sessions;
mod sources;
mod table;

pub use sessions::{Job, Moved, Outcome, moved, outcomes, sessions, simulate};
pub use sources::{Constant, constants};
pub use table::{Row, measured_on, page, rows_of, words, written_again};
