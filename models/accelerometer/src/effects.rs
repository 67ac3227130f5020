//! The effects an accelerometer can have. A new one is a file here, its `mod` line and its registry line.

use sensor::AnyEffect;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[];
