//! The manual. Every `console` block is run by `cli/tests/documents/manual.rs`.

#[doc = include_str!("../manual/method.md")]
pub mod method {}

#[doc = include_str!("../manual/experiment.md")]
pub mod experiment {}

#[doc = include_str!("../manual/calibration_file.md")]
pub mod calibration_file {}

#[doc = include_str!("../manual/options.md")]
pub mod options {}

#[doc = include_str!("../manual/files.md")]
pub mod files {}

#[doc = include_str!("../manual/simulation.md")]
pub mod simulation {}

#[doc = include_str!("../manual/browser.md")]
pub mod browser {}

#[doc = include_str!("../manual/safety.md")]
pub mod safety {}

#[doc = include_str!("../manual/quality.md")]
pub mod quality {}

#[doc = include_str!("../manual/extending.md")]
pub mod extending {}

#[doc = include_str!("../manual/decisions.md")]
pub mod decisions {}

#[doc = include_str!("../manual/glossary.md")]
pub mod glossary {}
