//! `batch`: many devices, in shards that can be killed, resumed and merged.

mod args;
mod failure;
mod merge;
mod options;
mod page;
mod prior;
mod tables;

use std::path::{Path, PathBuf};
use std::time::Duration;

use args::Action;
pub use args::Args;
use batch::{
    Manifest, PartHeader, Plan, Record, Status, Store, Timing, part_name, part_text, run,
    timings_name,
};
use failure::failure;
use indicatif::{ProgressBar, ProgressStyle};

use crate::exit::{Failure, GATE};
use crate::output::{Folder, Output, Replace};
use crate::show;

/// Runs the command.
pub fn run_command(args: &Args) -> Result<(), Failure> {
    match &args.action {
        Some(Action::Merge(args)) => return merge::run(args),
        Some(Action::Prior(args)) => return prior::run(args),
        None => {}
    }
    if !(args.budget > 0.0 && args.budget <= 1e7) {
        return Err(Failure::usage("--budget: seconds above 0 expected"));
    }
    let Some(folder) = &args.output else {
        return Err(Failure::usage("no output folder").advise("give one with -o OUT"));
    };
    let options = options::of(args)?;
    let manifest = Manifest::read(&args.inputs).map_err(failure)?;
    let sha = manifest.sha256(&options.text);
    let created_by = concat!("stillpoint ", env!("CARGO_PKG_VERSION"));
    let header = PartHeader::new(created_by, sha, args.shard, manifest.devices.len());
    refuse_within(folder, &manifest)?;
    let _made = Folder::make(folder)?;
    let part = folder.join(part_name(args.shard));
    if part.exists() && !args.resume && !args.force {
        return Err(Failure::exists("exists already")
            .in_file(show::path(&part))
            .advise("add --resume to keep what is complete or --force to compute all again"));
    }
    // Claimed now, so that another run of this shard into this folder is refused at once.
    let own = args.inputs.iter().chain(&args.prior);
    let own = own.chain(&args.limits.limits);
    let inputs: Vec<&Path> = own.map(PathBuf::as_path).collect();
    let claim = |name: &str| Output::claim_in(folder, name, Replace::forced(), &inputs);
    let part = claim(&part_name(args.shard))?;
    let timings = claim(&timings_name(args.shard))?;
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

/// Refuses an output folder that is or lies in an input, or whose results are inputs, through links.
fn refuse_within(folder: &Path, manifest: &Manifest) -> Result<(), Failure> {
    let resolved = |path: &Path| ::output::resolve(&std::path::absolute(path).unwrap_or_default());
    let out = resolved(folder);
    let results = out.join("devices");
    for input in manifest.devices.iter().flat_map(|d| &d.inputs) {
        let found = resolved(input);
        let relation = match (out.starts_with(&found), found.starts_with(&results)) {
            (true, _) => "is or lies in the input",
            (_, true) => "its results would be written over the input",
            _ => continue,
        };
        let why = format!(
            "-o {}: {relation} {}",
            show::path(folder),
            show::path(input)
        );
        return Err(Failure::usage(why).advise("choose another folder"));
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
