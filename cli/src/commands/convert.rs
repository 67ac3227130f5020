//! `convert`: a recording in plain form.

mod left_out;

use ::findings::{Finding, Front, Kind};
use std::path::PathBuf;

use calib::Recording;
use calib::recording::UnitBy;

use super::apply::Target;
use crate::commands::shared::first_screen::say_written;
use crate::commands::shared::inputs::read;
use crate::exit::Failure;
use crate::output::Replace;
use crate::read_args::ReadArgs;
use crate::show;

/// Writes a recording as plain CSV or Parquet: seconds, m/s², rad/s, °C.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A name without an extension is a folder, in which each sensor keeps its own clock.
Other columns than those of the sensors are left out, which is said. Stamps
since 1970 stay so, and dates become such, in seconds.

Example:
  stillpoint convert log.ulg -o plain/
  stillpoint convert experiment.zip -o experiment.csv
  stillpoint convert experiment.zip -o experiment.parquet")]
pub struct Args {
    /// File or folder; `-` reads standard input
    #[arg(value_name = "FILE")]
    recording: PathBuf,
    /// Write here: `.csv`, `.parquet` (a feature of the build), or a folder for acc.csv, gyro.csv, mag.csv and temp.csv
    #[arg(short, value_name = "OUT", required = true)]
    output: PathBuf,
    #[command(flatten)]
    replace: Replace,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let extension = args
        .output
        .extension()
        .map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        None | Some("csv" | "txt" | "parquet") => {}
        Some(other) => {
            let output = show::path(&args.output);
            return Err(
                Failure::usage(format!("-o {output}: .{other} is not written"))
                    .advise("name a .csv file or a folder"),
            );
        }
    }
    let target = Target::claim(&args.output, args.replace, &[&args.recording])?;
    args.replace.end_if_all_exist()?;
    let mut recording = read(&args.recording, &args.read)?;
    let written = target.write(&mut recording);
    let mut warnings = recording.warnings.texts(Front::CommandLine);
    let assumed = recording.unit_assumed();
    warnings.extend(assumed.map(|found| found.text(Front::CommandLine)));
    warnings.extend(counts_in_file(&recording));
    warnings.extend(left_out::columns(&recording));
    if extension.is_some() {
        warnings.extend(left_out::samples(&recording));
    }
    warnings.iter().for_each(|warning| show::warn(warning));
    written?;
    say_written(&args.output)
}

/// A warning for every sensor that the file states to be in counts: they are written as they are.
fn counts_in_file(recording: &Recording) -> impl Iterator<Item = String> + '_ {
    let sensors = recording.description.sensors.iter();
    let stated = sensors.filter(|own| own.unit == "counts" && own.unit_by == UnitBy::File);
    stated.map(|own| {
        let found = Finding::of(Kind::READ_AS_COUNTS).in_recording(&recording.name);
        found.of_sensor(own.sensor).text(Front::CommandLine)
    })
}
