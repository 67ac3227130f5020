//! `batch`: many devices, in shards that can be killed, resumed and merged.

mod merge;
mod options;
mod page;
mod prior;
mod tables;

use std::path::{Path, PathBuf};
use std::time::Duration;

use batch::{
    Error, Fault, Manifest, PartHeader, Plan, Record, Shard, Status, Store, Timing, part_name,
    part_text, run, timings_name,
};
use clap::Subcommand;
use indicatif::{ProgressBar, ProgressStyle};

use crate::commands::calibrate::limits::LimitArgs;
use crate::commands::shared::inputs::{ClockArg, DetectorArgs, PlaceArgs};
use crate::exit::{Failure, GATE, INPUT, OUTPUT, USAGE};
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;

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
multiplier, min_static, rate, accel_unit, gyro_unit; only `inputs` is required:
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
    action: Option<Action>,
    /// Folders whose sub-folders and files are a device each, or manifest files
    #[arg(value_name = "MANIFEST|DIR", required = true)]
    inputs: Vec<PathBuf>,
    /// Write results into this folder
    #[arg(short, value_name = "OUT", required = true)]
    output: Option<PathBuf>,
    /// Keep devices that are complete and made from the same inputs, options and version
    #[arg(long)]
    resume: bool,
    /// Calibrate the K-th of N parts of the devices only
    #[arg(long, value_name = "K/N", default_value = "1/1")]
    shard: Shard,
    /// Devices at a time [default: one per core]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// Longest time for a device, s; then it has failed, and the others go on
    #[arg(long, value_name = "SECONDS", default_value_t = 600.0)]
    budget: f64,
    /// How to calibrate
    #[arg(long, value_enum, default_value_t = options::BatchMethod::Auto)]
    method: options::BatchMethod,
    /// Effects to fit on top of the base models
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    effects: Vec<String>,
    /// Look for what the model of each device lacks; its cal.json is then that of the final model
    #[arg(long)]
    discover: bool,
    /// What the type has in common, from `batch prior`
    #[arg(long, value_name = "FILE.json")]
    prior: Option<PathBuf>,
    /// By which clock the turns are integrated
    #[arg(long, value_enum, default_value_t = ClockArg::Auto)]
    clock: ClockArg,
    /// Replace an existing part
    #[arg(long, conflicts_with = "resume")]
    force: bool,
    /// Print the records as JSON instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    place: PlaceArgs,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Subcommand)]
enum Action {
    Merge(merge::Args),
    Prior(prior::Args),
}

/// Runs the command.
pub fn run_command(args: &Args) -> Result<(), Failure> {
    match &args.action {
        Some(Action::Merge(args)) => return merge::run(args),
        Some(Action::Prior(args)) => return prior::run(args),
        None => {}
    }
    if !(args.budget > 0.0 && args.budget <= 1e7) {
        return Err(Failure::new(USAGE, "--budget: seconds above 0 expected"));
    }
    let Some(folder) = &args.output else {
        return Err(Failure::new(
            USAGE,
            "no output folder; give one with -o OUT",
        ));
    };
    let options = options::of(args)?;
    let manifest = Manifest::read(&args.inputs).map_err(failure)?;
    let sha = manifest.sha256(&options.text);
    let created_by = concat!("stillpoint ", env!("CARGO_PKG_VERSION"));
    let header = PartHeader::new(created_by, sha, args.shard, manifest.devices.len());
    refuse_within(folder, &manifest)?;
    std::fs::create_dir_all(folder).map_err(|e| {
        let why = format!(
            "{}: cannot be made: {e}; choose a folder that can be written to",
            show::path(folder)
        );
        Failure::new(OUTPUT, why)
    })?;
    let part = folder.join(part_name(args.shard));
    if part.exists() && !args.resume && !args.force {
        return Err(Failure::exists(format!(
            "{}: exists already; add --resume to keep what is complete or --force to compute all again",
            show::path(&part)
        )));
    }
    // Claimed now, so that another run of this shard into this folder is refused at once.
    let part = Output::claim(&part, Replace::forced(), &[])?;
    let timings = Output::claim(
        &folder.join(timings_name(args.shard)),
        Replace::forced(),
        &[],
    )?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let plan = Plan {
        manifest,
        shard: args.shard,
        options,
        resume: args.resume,
        jobs: args.jobs.unwrap_or(cores).max(1),
        budget: Duration::from_secs_f64(args.budget),
    };
    let found = calibrated(&plan, &Store::new(folder))?;
    let (records, times): (Vec<Record>, Vec<Timing>) = found.into_iter().unzip();
    part.write(part_text(&header, &records).as_bytes())?;
    let times: Vec<String> = times
        .iter()
        .map(|t| serde_json::to_string(t).unwrap_or_default())
        .collect();
    timings.write((times.join("\n") + "\n").as_bytes())?;
    show::print(&match args.json {
        true => show::json(&records)?,
        false => tables::of_run(&records),
    })?;
    verdict(&records)
}

/// Status 1 where a device failed.
fn verdict(records: &[Record]) -> Result<(), Failure> {
    let failed: Vec<&Record> = records
        .iter()
        .filter(|r| r.status != Status::Pass)
        .collect();
    let Some(first) = failed.first() else {
        return Ok(());
    };
    let why = format!(
        "{} of {} devices failed; the first is {}: {}",
        failed.len(),
        records.len(),
        show::name(&first.id),
        first.reasons.first().map_or("", String::as_str)
    );
    Err(Failure::new(GATE, why))
}

/// Refuses an output folder that is or lies in an input.
fn refuse_within(folder: &Path, manifest: &Manifest) -> Result<(), Failure> {
    let Ok(out) = std::path::absolute(folder) else {
        return Ok(());
    };
    let inputs = manifest.devices.iter().flat_map(|d| &d.inputs);
    for input in inputs.filter_map(|path| std::path::absolute(path).ok()) {
        if out.starts_with(&input) {
            let why = format!(
                "-o {}: is or lies in the input {}; choose another folder",
                show::path(folder),
                show::path(&input)
            );
            return Err(Failure::new(USAGE, why));
        }
    }
    Ok(())
}

/// Runs a plan with a bar that says rate and time left.
fn calibrated(plan: &Plan, store: &Store) -> Result<Vec<(Record, Timing)>, Failure> {
    let all = 0..plan.manifest.devices.len();
    let bar = ProgressBar::new(all.filter(|k| plan.shard.has(*k)).count() as u64);
    let style = "{bar:24} {pos}/{len} devices, {per_sec}, {eta} left, {msg}";
    if let Ok(style) = ProgressStyle::with_template(style) {
        bar.set_style(style);
    }
    if !bar.is_hidden() {
        bar.enable_steady_tick(Duration::from_millis(200));
    }
    let failed = std::sync::atomic::AtomicUsize::new(0);
    let found = run(plan, store, |progress| {
        let order = std::sync::atomic::Ordering::Relaxed;
        if progress.record.status != Status::Pass {
            failed.fetch_add(1, order);
        }
        if !bar.is_hidden() {
            bar.set_message(format!("{} failed", failed.load(order)));
        }
        bar.inc(1);
    });
    bar.finish_and_clear();
    found.map_err(failure)
}

/// A batch's error in words.
fn failure(error: Error) -> Failure {
    let code = match &error {
        Error::Output { .. } => OUTPUT,
        Error::TooFew { .. } => crate::exit::NOT_ENOUGH,
        _ => INPUT,
    };
    match &error {
        Error::Parts(faults) => {
            let lines: Vec<String> = faults.iter().map(fault).collect();
            let lines = match lines.is_empty() {
                true => "no part of a batch; name its output folder or its part files".to_owned(),
                false => lines.join("\n  "),
            };
            Failure::new(code, format!("the parts make no whole:\n  {lines}"))
        }
        other => Failure::new(code, other.to_string()),
    }
}

/// What is wrong with a part, and what to do.
fn fault(fault: &Fault) -> String {
    match fault {
        Fault::Unreadable { path, what } => {
            format!(
                "{}: {what}; run its shard again with --resume",
                show::path(path)
            )
        }
        Fault::Foreign {
            path,
            found,
            expected,
        } => {
            format!(
                "{}: of another run ({found}; {expected} expected)",
                show::path(path)
            )
        }
        Fault::Missing { shard } => {
            format!(
                "part {}/{} is missing; run it with --shard {}/{} --resume",
                shard.k, shard.n, shard.k, shard.n
            )
        }
        Fault::Lacks { index } => format!("device {} of the manifest is in no part", index + 1),
        _ => "a part cannot be merged".to_owned(),
    }
}
