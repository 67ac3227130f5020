//! What several commands share: their inputs, and where their pictures go.

pub mod figures;
pub mod inputs;
pub mod pictures;
