//! The manual, chapter by chapter. As a book, with pictures and links: `mdbook build cli/manual`.
//!
//! Every block of commands in it is run by `cli/tests/documents`. Those in Rust are tests of the crates that they use.

#[doc = include_str!("../manual/first_calibration.md")]
pub mod first_calibration {}

#[doc = include_str!("../manual/report.md")]
pub mod report {}

#[doc = include_str!("../manual/experiment.md")]
pub mod experiment {}

#[doc = include_str!("../manual/browser.md")]
pub mod browser {}

#[doc = include_str!("../manual/files.md")]
pub mod files {}

#[doc = include_str!("../manual/noise.md")]
pub mod noise {}

#[doc = include_str!("../manual/calibration_file.md")]
pub mod calibration_file {}

#[doc = include_str!("../manual/findings.md")]
pub mod findings {}

#[doc = include_str!("../manual/simulation.md")]
pub mod simulation {}

#[doc = include_str!("../manual/options.md")]
pub mod options {}

#[doc = include_str!("../manual/method.md")]
pub mod method {}

#[doc = include_str!("../manual/quality.md")]
pub mod quality {}

#[doc = include_str!("../manual/safety.md")]
pub mod safety {}

#[doc = include_str!("../manual/decisions.md")]
pub mod decisions {}

#[doc = include_str!("../manual/tuning.md")]
pub mod tuning {}

#[doc = include_str!("../manual/glossary.md")]
pub mod glossary {}

#[cfg_attr(not(doctest), doc = include_str!("../manual/extending.md"))]
pub mod extending {}

#[cfg_attr(not(doctest), doc = include_str!("../manual/solver.md"))]
pub mod solver {}
