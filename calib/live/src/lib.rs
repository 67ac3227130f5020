//! Guided sessions: samples as they come, and what to do next.
//!
//! ```text
//! phyphox over HTTP ─┐
//! standard input     ├─ Source::poll ─► Batch ─► Session::take ─► Instruction  (hold still, turn to …, enough)
//! serial port        │      │ writes              │ detector, coverage, running calibration
//! file that grows ───┘      ▼                     ▼
//!                    the recording on disk       View  (what a terminal or a page shows)
//! ```
//!
//! A `Source` (feature `sources`) writes what it receives before it hands it on, so that a process that is killed loses nothing that it had.
//! A [`Session`] is a state machine without a clock: time is that of the stamps, so that a simulated session runs as fast as
//! it can be computed. What it says are values ([`Instruction`]); words are those of the command line.
//!
//! A placement is counted when both sensors have been still in level and spread for [`Aim::hold`] seconds. What is wanted
//! next is the direction that tells most ([`plan::next_placement`]); a placement elsewhere is taken for what it tells. After each,
//! the ordinary calibration runs on the samples so far and gives the standard errors ([`Estimate`]). A session is complete
//! when the planned number of placements tells nearly as much as the plan and both sensors are determined.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod attitude;
mod batch;
mod direction;
mod instruction;
mod motion;
mod promise;
mod running;
mod session;
#[cfg(feature = "sources")]
mod sources;
mod view;

pub use batch::{Batch, Event};
pub use direction::Direction;
pub use instruction::{Instruction, Verdict};
pub use motion::Motion;
pub use promise::{PROMISE, Promise, Shortfall};
pub use running::{Errors, Estimate};
pub use session::{Aim, Placement, Session};
#[cfg(feature = "sources")]
pub use sources::{
    Error, FILES, Finished, Limit, Lines, Opening, Phyphox, Recorder, Source, Waits, open,
};
pub use view::View;
