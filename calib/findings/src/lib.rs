//! Typed findings, the verdict made of them, and the one place with words for both.
//!
//! ```text
//! readers, checks, fits ──► Finding { kind, level, place, numbers, consequence, remedies } ──► Verdict
//!                                 └──► words: one entry per kind ──► terminal, page, cal.json, batch, Python
//! ```
//! A library says what it found as data; nobody decides anything by a text.
//!
//! ```
//! use stillpoint_findings::{Finding, Front, Kind, Level, Verdict};
//! use sensor::Sensor;
//!
//! let found = Finding::of(Kind::GRAVITY_ASSUMED)
//!     .of_sensor(Sensor::Accelerometer)
//!     .number("gravity", 9.80665, "m/s^2")
//!     .number("share", 2.2e-3, "share");
//! assert_eq!(found.level, Level::Remark);
//! assert!(found.text(Front::CommandLine).contains("--gravity"));
//! assert_eq!(Verdict::of(&[found]).level.name(), "good");
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod document;
mod finding;
mod inputs;
mod kind;
mod level;
mod list;
mod of_models;
mod remedy;
pub mod texts;
pub mod tuning;
mod usual;
mod verdict;
mod words;

pub use finding::{Consequence, Detail, Finding, Number, Place};
pub use inputs::Inputs;
pub use kind::Kind;
pub use level::Level;
pub use list::Findings;
pub use remedy::{OptionName, Remedy, Setting};
pub use tuning::Tuning;
pub use verdict::{Grade, Step, Verdict, gravest_first};
pub use words::{Front, human, manual_table, names, significant, turns};
