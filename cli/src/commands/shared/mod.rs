//! Shared parts of several commands: inputs, first screen, names and pictures.

pub mod figures;
pub mod first_screen;
pub mod inputs;
pub mod leave_out;
pub mod names;
pub mod pictures;
