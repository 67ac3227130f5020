//! Separation of a named effect from those that the recordings cannot tell from it, and the recording that would do it.
//!
//! ```text
//! recorded: State ──► Information ─┐
//!                                  ├─ + ──► Rivalry::separation = λ (1 − ρ²)
//! Design ──► simulate ──► State ───┘              ▲
//!    └────────── exchange: the design that raises it most (Ds-optimality)
//! ```

mod aim;
mod design;
mod exchange;
mod information;
mod rivalry;

pub use aim::{Aim, SETTLED, Separated, ShownBy};
pub use design::{Conditions, Design};
pub use exchange::separate;
pub use information::Information;
pub use rivalry::{Rival, Rivalry};
