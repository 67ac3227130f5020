//! Does discovery find what is hidden, and nothing where nothing is?

mod formulas;
mod row;
mod session;
mod size;
mod summary;

pub use row::{Job, Row};
pub use session::{Record, hidden_in, run, spec_of};
pub use summary::{Summary, summarise};
