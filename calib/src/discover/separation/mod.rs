//! What tells a named effect from one that the recordings cannot tell from it, and which recording would.
//!
//! ```text
//! recorded: State ──► Information ─┐
//!                                  ├─ + ──► Rivalry::separation = λ (1 − ρ²)
//! Design ──► simulate ──► State ───┘              ▲
//!    └────────── exchange: the design that raises it most (Ds-optimality)
//! ```

mod design;
mod information;
mod rivalry;

pub use design::{Aim, Conditions, Design, SETTLED, Separated, ShownBy, separate};
pub use information::Information;
pub use rivalry::{Rival, Rivalry};
