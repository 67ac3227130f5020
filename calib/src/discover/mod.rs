//! Where simulation and data disagree, and what the model lacks.
//!
//! ```text
//! Session ──► State: joint fit ──► Projected z = Nᵀ r ──► rank(families) ──► Extension ─┐
//!    ▲        what is left           I + k² C                evidence          a name     │
//!    └────────────────────────────────────────────────────────────────────────────────────┘
//! ```

mod columns;
mod discovery;
mod enough;
mod family;
mod fault;
mod findings;
mod gap;
mod linear;
mod noise;
mod pictures;
mod propose;
mod rank;
mod remainder;
mod request;
mod score;
mod search;
mod state;
mod visible;

use fault::{integrity, time_offset};
use gap::{channel, held_out, localise, validation};
use noise::{noise_file, projected};
use remainder::{scatter, shape, unexplained, weighed_again};

pub use channel::{Channel, Misfit, Sequence, channel_of};
pub use discovery::{Discovery, discover};
pub use family::{Claim, Family, Hypothesis, families};
pub use findings::{EffectFinding, FINDINGS_SCHEMA, Findings, RankedClaim, Validation, Verdict};
pub use held_out::{gap_of, held_out};
pub use integrity::{Integrity, disturbed, integrity};
pub use localise::{Disagreement, disagreements};
pub use noise_file::{GivenNoise, noise_in};
pub use pictures::{Covariate, Picture, Point, pictures};
pub use projected::{Projected, Whitened};
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
