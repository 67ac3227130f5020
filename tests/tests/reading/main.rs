//! What is read, in whatever form it comes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod file_layouts;
mod fuzz_corpus;
mod json_and_stamps;
mod make_formats;
mod names_and_units;
mod programs;
mod real_formats;
mod silent_losses;
mod spellings;
mod unit_detection;
