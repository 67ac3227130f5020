//! The arguments of `batch`.

use std::path::PathBuf;

use batch::Shard;
use clap::{Subcommand, ValueEnum};

use super::{merge, prior};
use crate::commands::calibrate::limits::LimitArgs;
use crate::commands::shared::inputs::{ClockArg, DetectorArgs, PlaceArgs};
use crate::read_args::ReadArgs;

/// Calibrates many devices: a folder or a file each, or a line each of a manifest. What is wrong with one device stops no other.
///
/// In OUT every device has `devices/ID/cal.json`; each shard writes a part with a line of JSON per device. The same inputs,
/// options and version give the same bytes, however often a shard is killed and run again.
#[derive(Debug, clap::Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "\
A manifest has a line per device (CSV with a header, JSON lines, or TOML with [[device]]); paths are
relative to it. Its columns are id, inputs, lot, station, time, gravity, latitude, method, effects,
multiplier, min_static, rate, accel_unit, gyro_unit, mag_unit; only `inputs` is required:
  id,inputs,lot,gravity,method
  A7,A7/morning.csv;A7/evening.csv,L12,9.8055,joint

Example:
  stillpoint batch devices/ -o out --limits limits.toml   every folder and file in devices/
  stillpoint batch manifest.csv -o out --shard 3/8 --resume
  stillpoint batch merge out -o all --jsonl --csv --report
  stillpoint batch prior out -o prior.json                what the type has in common

Exit status 1 where a device failed. The crate's documentation has the commands for many machines
(HyperQueue, GNU parallel)."
)]
pub struct Args {
    #[command(subcommand)]
    pub(super) action: Option<Action>,
    /// Folders whose sub-folders and files are a device each, or manifest files
    #[arg(value_name = "MANIFEST|DIR", required = true)]
    pub(super) inputs: Vec<PathBuf>,
    /// Write results into this folder
    #[arg(short, value_name = "OUT", required = true)]
    pub(super) output: Option<PathBuf>,
    /// Keep devices that are complete and made from the same inputs, options and version
    #[arg(long)]
    pub(super) resume: bool,
    /// Calibrate the K-th of N parts of the devices only
    #[arg(long, value_name = "K/N", default_value = "1/1")]
    pub(super) shard: Shard,
    /// Devices at a time [default: one per core]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
    /// Longest time for a device, s; then it has failed, and the others go on
    #[arg(long, value_name = "SECONDS", default_value_t = 600.0)]
    pub(super) budget: f64,
    /// How to calibrate
    #[arg(long, value_enum, default_value_t = BatchMethod::Auto)]
    pub(super) method: BatchMethod,
    /// Effects to fit on top of the base models
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(super) effects: Vec<String>,
    /// Look for what the model of each device lacks; its cal.json is then that of the final model
    #[arg(long)]
    pub(super) discover: bool,
    /// What the type has in common, from `batch prior`
    #[arg(long, value_name = "FILE.json")]
    pub(super) prior: Option<PathBuf>,
    /// By which clock the turns are integrated
    #[arg(long, value_enum, default_value_t = ClockArg::Auto)]
    pub(super) clock: ClockArg,
    /// Replace an existing part
    #[arg(long, conflicts_with = "resume")]
    pub(super) force: bool,
    /// Print the records as JSON instead of a table
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) limits: LimitArgs,
    #[command(flatten)]
    pub(super) place: PlaceArgs,
    #[command(flatten)]
    pub(super) detector: DetectorArgs,
    #[command(flatten)]
    pub(super) read: ReadArgs,
}

#[derive(Debug, Subcommand)]
pub(super) enum Action {
    Merge(merge::Args),
    Prior(prior::Args),
}

/// The methods that a batch knows.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum BatchMethod {
    /// Joint; stepwise where a recording has no accelerometer
    Auto,
    /// Accelerometer first, then the gyroscope by propagated gravity
    Stepwise,
    /// Both sensors in one problem weighted by the recording's own noise
    Joint,
}
