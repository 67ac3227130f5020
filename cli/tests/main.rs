//! The program as a person or a script calls it. One target: all of it is linked once, and no test waits for those of another file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

#[path = "../../tests/tests/bad_inputs/mod.rs"]
mod bad_inputs;
mod command_line;
mod commands;
mod common;
mod documents;
mod effect_file;
mod every_output;
mod faults;
mod limits;
mod limits_file;
mod not_calibrated;
mod options;
mod outputs;
mod proposed;
mod refused;
mod sealed;
mod shown;
mod tables;
