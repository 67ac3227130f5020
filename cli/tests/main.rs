//! The program as a person or a script calls it. One target: all of it is linked once, and no test waits for those of another file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

#[path = "../../tests/tests/bad_inputs/mod.rs"]
mod bad_inputs;
mod batch;
mod command_line;
mod common;
mod convert;
mod discover;
mod documents;
mod effect_file;
mod every_output;
mod faults;
mod limits;
mod limits_file;
mod live;
mod not_calibrated;
mod options;
mod outputs;
mod plan;
mod proposed;
mod refused;
mod sealed;
mod shown;
mod tables;
