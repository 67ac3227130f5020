//! `batch prior`: what the devices of a type have in common.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use batch::{Error, calibrations_of, prior_of};
use calib::Calibration;
use calib::gravity::GravitySource;
use calib::prior::Prior;

use super::failure::failure;
use crate::commands::calibrate::limits::number;
use crate::commands::shared::inputs::{load, looked_at};
use crate::exit::{Failure, INPUT};
use crate::output::{Output, Replace};
use crate::show;

/// Estimates mean and spread of the parameters over the devices of a type, the sessions' own errors taken off: random effects
/// by restricted likelihood. Devices that do not belong are left out and named.
///
/// `calibrate --prior` and `batch --prior` then know what the type has in common. Give --gravity to the batch: an error of
/// gravity is the same in every device and is not seen in their spread.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint batch devices/ -o out --gravity 9.8055 --effects gyro_g_sensitivity
  stillpoint batch prior out -o prior.json
  stillpoint calibrate short.csv --gravity 9.8055 --prior prior.json -o cal.json")]
pub struct Args {
    /// Output folders of `batch`, or files of calibrations
    #[arg(value_name = "OUT|CAL", required = true)]
    inputs: Vec<PathBuf>,
    /// Write the prior here
    #[arg(short, value_name = "FILE.json")]
    output: PathBuf,
    #[command(flatten)]
    replace: Replace,
    /// Print the prior as JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let mut found = Vec::new();
    for input in &args.inputs {
        let named = |path: PathBuf| (name(input, &path), path);
        found.extend(files(input)?.into_iter().map(named));
    }
    tell_apart(&mut found);
    let inputs: Vec<&Path> = found.iter().map(|(_, path)| path.as_path()).collect();
    let output = Output::claim(&args.output, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let mut calibrations: Vec<(String, Calibration)> = Vec::new();
    for (name, path) in &found {
        calibrations.push((name.clone(), load(path)?));
    }
    let before = calibrations.len();
    let mut seen = HashSet::new();
    calibrations.retain(|(_, calibration)| seen.insert(samples(calibration)));
    let copies = before - calibrations.len();
    if copies > 0 {
        show::warn(&format!(
            "{copies} of {before} calibrations are of the same samples as another: each counts once"
        ));
    }
    let assumed = |(_, c): &&(String, Calibration)| c.gravity_source == GravitySource::Assumed;
    let assumed = calibrations.iter().filter(assumed).count();
    if assumed > 0 {
        show::warn(&format!(
            "of {assumed} calibrations gravity was assumed: an error of gravity is the same in all of them, and neither the spread nor the \
             error of the mean of the accelerometer's scale factors has it; run the batch with --gravity"
        ));
    }
    let informed = calibrations
        .iter()
        .filter(|(_, c)| c.prior.is_some())
        .count();
    if informed > 0 {
        let why = format!(
            "{informed} of {} calibrations were made with a prior: their errors are not those of their sessions",
            calibrations.len()
        );
        return Err(Failure::new(INPUT, why).advise("run the batch without --prior"));
    }
    let prior = prior_of(&calibrations).map_err(failure)?;
    let json = show::json(&prior)?;
    output.write(json.as_bytes())?;
    show::print(&if args.json { json } else { text(&prior) })
}

/// The device of a calibration: its folder in the output of a batch, else the file's name.
fn name(input: &Path, path: &Path) -> String {
    let name = match input.is_dir() {
        true => path.parent().and_then(Path::file_name),
        false => path.file_stem(),
    };
    name.unwrap_or_default().to_string_lossy().into_owned()
}

/// Folders in place of names that several files share, as `cal.json`; paths where these do too.
fn tell_apart(found: &mut [(String, PathBuf)]) {
    rename_shared(found, |path| {
        let folder = path.parent().and_then(Path::file_name)?;
        Some(folder.to_string_lossy().into_owned())
    });
    rename_shared(found, |path| Some(path.display().to_string()));
}

fn rename_shared(found: &mut [(String, PathBuf)], other: impl Fn(&Path) -> Option<String>) {
    let names: Vec<String> = found.iter().map(|(name, _)| name.clone()).collect();
    for (name, path) in found {
        if names.iter().filter(|own| *own == name).count() > 1 {
            *name = other(path).unwrap_or_else(|| name.clone());
        }
    }
}

/// The hashes that tell the samples behind a calibration from others; its own numbers where it does not say.
fn samples(calibration: &Calibration) -> Vec<String> {
    let inputs = &calibration.provenance.inputs;
    let own = inputs.iter().map(|input| input.samples_sha256.clone());
    match inputs.is_empty() {
        true => calibration
            .provenance
            .numbers_sha256
            .iter()
            .cloned()
            .collect(),
        false => own.collect(),
    }
}

/// The calibrations at a path.
fn files(input: &Path) -> Result<Vec<PathBuf>, Failure> {
    let found = looked_at(input, std::fs::metadata(input))?;
    if !found.is_some_and(|found| found.is_dir()) {
        return Ok(vec![input.to_owned()]);
    }
    calibrations_of(input).map_err(|error| match error {
        Error::Io { path, source } => Failure::new(INPUT, source.to_string())
            .in_file(show::path(&path))
            .advise("name the output folder of a batch"),
        other => failure(other),
    })
}

fn text(prior: &Prior) -> String {
    let mut table = show::table(&["parameter", "mean", "spread", "error of the mean"]);
    for (k, name) in prior.parameters.iter().enumerate() {
        table.add_row([
            name.clone(),
            show::value(prior.mean[k], Some(prior.mean_covariance[k][k].sqrt())),
            number(prior.covariance[k][k].sqrt()),
            number(prior.mean_covariance[k][k].sqrt()),
        ]);
    }
    let shown: Vec<String> = prior
        .outsiders
        .iter()
        .take(8)
        .map(|id| show::name(id))
        .collect();
    let outsiders = match prior.outsiders.len() {
        0 => String::new(),
        n => format!(
            "; {n} do not belong: {}{}",
            shown.join(", "),
            if n > 8 { ", …" } else { "" }
        ),
    };
    let without = match prior.without {
        0 => String::new(),
        n => format!("; {n} lack parameters"),
    };
    format!("{} devices{outsiders}{without}\n{table}", prior.devices)
}
