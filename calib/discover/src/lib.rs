//! Discovery of model errors: comparison of simulation and data, and the terms that the model lacks.
//!
//! ```text
//! Session ──► State: joint fit ──► Projected z = Nᵀ r ──► rank(families) ──► Extension ─┐
//!    ▲        what is left           I + k² C                evidence          a name     │
//!    └────────────────────────────────────────────────────────────────────────────────────┘
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod base;
mod calibrated;
mod discovery;
mod explained;
mod family;
mod fault;
mod findings;
mod flicker;
mod gap;
mod noise;
mod pictures;
mod propose;
mod rank;
mod remainder;
mod request;
mod residuals_by_interval;
mod score;
mod search;
mod separation;
mod state;
mod time_constants;
mod units;
mod validation;

pub use discovery::{Discovery, discover};

pub use family::{Claim, Family, Hypothesis, families};
pub use fault::delay::{Delay, delay};
pub use fault::integrity::{Integrity, Size, integrity};
pub use fault::of_the_fit::disturbed;
pub use findings::beside::Beside;
pub use findings::{
    Confirmation, EffectFinding, FINDINGS_SCHEMA, Findings, RankedClaim, Says, Validation, Verdict,
};
pub use gap::channel::Channel;
pub use gap::held_out::{gap_of, held_out};
pub use gap::localise::{Disagreement, disagreements};
pub use gap::sequence::{Misfit, Sequence, channel_of};
pub use noise::noise_file::{GivenNoise, noise_in};
pub use noise::projected::{Projected, Whitened};
pub use noise::projected_columns::ProjectedColumns;
pub use pictures::{Covariate, Picture, Point, pictures};
pub use propose::{Proposal, Proposed, propose};
pub use rank::{Ranked, rank, shared};
pub use remainder::shape::Shape;
pub use remainder::shapes::shapes;
pub use remainder::unexplained::Unexplained;
pub use request::{Request, Session};
pub use residuals_by_interval::{ChannelResiduals, residuals_by_interval};
pub use score::{Score, log_tail, score};
pub use search::{Name, Search, Tie, search};
pub use separation::{
    Aim, Conditions, Design, Information, Rival, Rivalry, SETTLED, Separated, ShownBy, separate,
};
pub use state::{Extension, State};
pub use units::{
    Agreement, OwnEffect, SharedEffect, UNITS_SCHEMA, UnitAlone, UnitFindings, UnitSize,
    discover_units,
};
pub use validation::{Validated, validate};
