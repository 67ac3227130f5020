//! Do stated errors hold outside the simulator's comfort, and is what is wrong said?
//!
//! ```text
//! catalogue ─► spec of a seed ─► session (both methods) ─► JSON lines ─► summary ─► table
//!                                   └ words ─► kinds: right under this condition, or an absent cause
//! ```

mod catalogue;
mod kind;
mod session;
mod store;
mod summary;
mod table;

pub use catalogue::{CONDITIONS, Condition, condition};
pub use kind::Kind;
pub use session::{Estimate, Outcome, Record, run};
pub use store::{Stored, read};
pub use summary::{CLASSES, Class, Summary, ratio, summarise};
pub use table::{HEADING, row, words};
