//! Where simulation and data disagree, and what the model lacks.
//!
//! ```text
//! Session ──► State: joint fit ──► Projected z = Nᵀ r ──► rank(families) ──► Extension ─┐
//!    ▲        what is left           I + k² C                evidence          a name     │
//!    └────────────────────────────────────────────────────────────────────────────────────┘
//! ```

mod channel;
mod columns;
mod discovery;
mod enough;
mod family;
mod findings;
mod held_out;
mod integrity;
mod linear;
mod localise;
mod noise_file;
mod pictures;
mod projected;
mod propose;
mod rank;
mod request;
mod scatter;
mod score;
mod search;
mod shape;
mod state;
mod time_offset;
mod unexplained;
mod validation;
mod visible;

pub use channel::{Channel, Misfit, Sequence, channel_of};
pub use discovery::{Discovery, discover};
pub use family::{Claim, Family, Hypothesis, families};
pub use findings::{EffectFinding, FINDINGS_SCHEMA, Findings, RankedClaim, Validation, Verdict};
pub use held_out::{gap_of, held_out};
pub use integrity::{Integrity, disturbed, integrity};
pub use localise::{Disagreement, disagreements};
pub use noise_file::{GivenWalks, walks_in};
pub use pictures::{Covariate, Picture, Point, pictures};
pub use projected::{Projected, Walks, Whitened};
pub use propose::{Proposal, Proposed, propose};
pub use rank::{Ranked, rank, shared};
pub use request::{Request, Session};
pub use score::{Score, log_tail, score};
pub use search::{Name, Search, Tie, search};
pub use shape::{Shape, shapes};
pub use state::{Extension, State};
pub use time_offset::{Delay, delay};
pub use unexplained::{Unexplained, unexplained};
pub use validation::validate;
