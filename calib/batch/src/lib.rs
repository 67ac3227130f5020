//! Many devices: one calibration each, in shards that can be killed, run again and merged.
//!
//! ```text
//! Manifest ──shard K/N──► run ──► devices/ID/cal.json, record.json ──► part-K-of-N.jsonl ──► merge ──► JSONL, CSV
//! (folders, CSV,           │        (one device each, found again by hash)  (written whole)      └──► statistics
//!  TOML, JSON lines)       └─ a panic or a budget ends one device only
//! ```
//!
//! A shard is idempotent: the same inputs, options and version give the same bytes, whoever computes them and however often.
//! What times say is kept apart (`timings-K-of-N.jsonl`).
#![doc = include_str!("../ENGINES.md")]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod calibrations;
mod device;
mod error;
mod fault;
mod hash;
mod manifest;
mod merge;
mod part;
mod population;
mod record;
mod run;
mod shard;
pub mod statistics;
mod store;

pub use calibrations::calibrations_of;
pub use device::Options;
pub use error::Error;
pub use hash::members;
pub use manifest::{Device, DeviceOptions, Manifest};
pub use merge::{Merged, merge, part_files, to_csv};
pub use part::{Identity, PartHeader, part_name, part_text, timings_name};
pub use population::{Session, fit_prior, prior_of};
pub use record::{Finding, Misfit, Parameter, Record, Status, Timing};
pub use run::{Plan, Progress, run};
pub use shard::Shard;
pub use store::Store;
