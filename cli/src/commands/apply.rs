//! `apply`: a recording corrected by a calibration.

use ::findings::Front;
use std::path::{Path, PathBuf};

use calib::Recording;
use calib::calibration::apply_under;
use calib::recording::{field_names, stream_to_csv, to_csv, to_parquet};

use crate::commands::shared::inputs::{DeviceArgs, load, read};
use crate::exit::{Failure, USAGE};
use crate::output::{Filled, Folder, Output, Replace};
use crate::read_args::ReadArgs;
use crate::{show, steps};

/// Corrects a recording: base model plus effects, each sensor on its own clock.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint apply cal.json run.csv -o corrected.csv")]
pub struct Args {
    /// Calibration written by `calibrate`
    #[arg(value_name = "CAL")]
    calibration: PathBuf,
    /// File or folder; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    recording: PathBuf,
    /// Write the corrected recording here (CSV, m/s² and rad/s) instead of to standard output;
    /// a name without extension becomes a folder that keeps each sensor's own clock
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let inputs: [&Path; 2] = [&args.calibration, &args.recording];
    let target = match &args.output {
        Some(path) => Target::claim(path, args.replace, &inputs)?,
        None => Target::Stdout,
    };
    args.replace.end_if_all_exist()?;
    let calibration = load(&args.calibration)?;
    let recording = read(&args.recording, &args.read)?;
    args.device.check(&calibration, &[&recording])?;
    let mut corrected: Recording = apply_under(&steps::watch(), &calibration, &recording)?;
    let written = target.write(&mut corrected);
    for warning in &corrected.warnings {
        show::warn(&warning.text(Front::CommandLine));
    }
    written
}

/// Destination of the corrected recording.
pub(super) enum Target {
    Stdout,
    File(Box<Output>),
    Parquet(Box<Output>),
    /// `acc.csv`, `gyro.csv` and `mag.csv` of a folder, each sensor on its own clock.
    Folder(Box<[Output; 3]>, Folder),
}

impl Target {
    /// A name without an extension is a folder.
    pub(super) fn claim(path: &Path, replace: Replace, inputs: &[&Path]) -> Result<Self, Failure> {
        if path.extension().is_some() {
            let is_parquet = path
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
            if is_parquet && let Err(error) = to_parquet(&mut Recording::default()) {
                // This build cannot, and nothing has been read yet.
                let message = format!("-o {}: {error}", show::path(path));
                return Err(Failure::new(USAGE, message));
            }
            let output = Box::new(Output::claim(path, replace, inputs)?);
            return Ok(match is_parquet {
                true => Self::Parquet(output),
                false => Self::File(output),
            });
        }
        let folder = Folder::make(path)?;
        let acc = Output::claim_in(path, "acc.csv", replace, inputs)?;
        let gyro = Output::claim_in(path, "gyro.csv", replace, inputs)?;
        let mag = Output::claim_in(path, "mag.csv", replace, inputs)?;
        Ok(Self::Folder(Box::new([acc, gyro, mag]), folder))
    }

    pub(super) fn write(self, corrected: &mut Recording) -> Result<(), Failure> {
        match self {
            Self::Stdout => {
                show::print(&to_csv(corrected))?;
                Ok(())
            }
            Self::File(output) => output.write(to_csv(corrected).as_bytes()),
            Self::Parquet(output) => output.write(&to_parquet(corrected)?),
            Self::Folder(outputs, _folder) => {
                let [acc, gyro, mag] = *outputs;
                let field = corrected.magnetometer.as_ref();
                let names = field.map(|field| format!("t,{}", field_names(field)));
                let mut filled = Vec::new();
                for (output, stream, names) in [
                    (acc, corrected.accelerometer.as_ref(), "t,ax,ay,az"),
                    (gyro, corrected.gyroscope.as_ref(), "t,gx,gy,gz"),
                    (
                        mag,
                        field.map(|field| &field.stream),
                        names.as_deref().unwrap_or_default(),
                    ),
                ] {
                    if let Some(stream) = stream {
                        let text = stream_to_csv(stream, names);
                        filled.push(output.fill(|out| out.write_all(text.as_bytes()))?);
                    }
                }
                filled.into_iter().try_for_each(Filled::publish)
            }
        }
    }
}
