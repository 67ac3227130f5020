//! Files written whole or not at all.
//!
//! ```text
//! Output::claim ──► fill ──► Filled ──► publish
//!   │ beside the target:      │ synced    │ renamed
//!   ▼ exclusive, locked       ▼           ▼
//!  .NAME.stillpoint-PROCESS-RANDOM.partial  the target, until then as it was
//! ```
//!
//! An [`Output`] is claimed before anything is computed, so that a folder that cannot be written, a file in the way, an input
//! that would be written over and a second run are found at once. What a person names is written through links; what we name
//! ourselves ([`Output::claim_in`], [`Folder::make_own`]) follows none. What a run that is ended leaves is in
//! [`leftovers`]; a [`Growing`] file is the exception that keeps what has come.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod claim;
mod error;
mod folder;
mod growing;
mod identity;
mod leftovers;
mod partial;

pub use claim::{Existing, Filled, Output, refuse_input};
pub use error::{Error, Reason};
pub use folder::Folder;
pub use growing::Growing;
pub use identity::{is_same_file, resolve};
pub use leftovers::{Leftovers, leftovers};
