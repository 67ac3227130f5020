//! `apply`: a recording corrected by a calibration.

use std::path::{Path, PathBuf};

use calib::Recording;
use calib::calibration::apply_under;
use calib::recording::{FOLDER_FILES, FolderFile, to_csv, to_parquet};

use crate::commands::shared::first_screen::say_written;
use crate::commands::shared::inputs::{DeviceArgs, load, read_for};
use crate::exit::Failure;
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
    let recording = read_for(Some(&calibration), &args.recording, &args.read)?;
    args.device.check(&calibration, &[&recording])?;
    let mut corrected: Recording = apply_under(&steps::watch(), &calibration, &recording)?;
    let written = target.write(&mut corrected);
    show::warn_each(&corrected.warnings);
    written?;
    let to_file = args
        .output
        .as_deref()
        .filter(|path| *path != Path::new("-"));
    to_file.map_or(Ok(()), say_written)
}

/// Destination of the corrected recording.
pub(super) enum Target {
    Stdout,
    File(Box<Output>),
    Parquet(Box<Output>),
    /// The files of a folder at the path, each sensor on its own clock.
    Folder(Vec<Output>, PathBuf, Folder),
}

impl Target {
    /// A name without an extension is a folder, `-` the standard output.
    pub(super) fn claim(path: &Path, replace: Replace, inputs: &[&Path]) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return Ok(Self::Stdout);
        }
        if path.extension().is_some() {
            let is_parquet = path
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
            if is_parquet && let Err(error) = to_parquet(&mut Recording::default()) {
                // This build cannot, and nothing has been read yet.
                let message = format!("-o {}: {error}", show::path(path));
                return Err(Failure::usage(message));
            }
            let output = Box::new(Output::claim(path, replace, inputs)?);
            return Ok(match is_parquet {
                true => Self::Parquet(output),
                false => Self::File(output),
            });
        }
        let folder = Folder::make(path)?;
        let claim = |file: &FolderFile| Output::claim_in(path, file.name, replace, inputs);
        let outputs = FOLDER_FILES.iter().map(claim);
        let outputs = outputs.collect::<Result<_, _>>()?;
        Ok(Self::Folder(outputs, path.to_owned(), folder))
    }

    pub(super) fn write(self, corrected: &mut Recording) -> Result<(), Failure> {
        match self {
            Self::Stdout => {
                show::print(&to_csv(corrected))?;
                Ok(())
            }
            Self::File(output) => output.write(to_csv(corrected).as_bytes()),
            Self::Parquet(output) => output.write(&to_parquet(corrected)?),
            Self::Folder(outputs, path, _folder) => fill_folder(outputs, &path, corrected),
        }
    }
}

/// Writes the files of a folder that the recording has something for.
fn fill_folder(outputs: Vec<Output>, folder: &Path, recording: &Recording) -> Result<(), Failure> {
    let mut filled = Vec::new();
    let mut without = Vec::new();
    for (output, file) in outputs.into_iter().zip(&FOLDER_FILES) {
        match (file.text)(recording) {
            Some(text) => filled.push(output.fill(|out| out.write_all(text.as_bytes()))?),
            None => without.push(folder.join(file.name)),
        }
    }
    filled.into_iter().try_for_each(Filled::publish)?;
    for old in without.iter().filter(|old| old.exists()) {
        show::warn(&format!(
            "{}: of an earlier recording, and read with the new one: remove it",
            show::path(old)
        ));
    }
    Ok(())
}
