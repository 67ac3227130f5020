//! What several commands share: their inputs, their first screen, and where their pictures go.

pub mod figures;
pub mod first_screen;
pub mod inputs;
pub mod names;
pub mod pictures;
