//! `import`: another tool's calibration as a `cal.json`.

use std::path::{Path, PathBuf};

use calib::{Calibration, read_text};
use exchange::import;

use crate::exit::{Failure, INPUT};
use crate::output::{Output, Replace};
use crate::show;

/// Reads a calibration of imu_tk or Kalibr, so that `evaluate` compares it with others on your own recording.
///
/// imu_tk: the texts of accelerometer and gyroscope, in this order, or a folder with acc.calib and gyro.calib. Kalibr: its
/// imu.yaml, also as the crate imu-calib writes it.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint import imu.yaml -o kalibr.json
  stillpoint import test_imu_acc.calib test_imu_gyro.calib -o imu_tk.json
  stillpoint evaluate run.csv --calibration kalibr=kalibr.json --calibration own=cal.json")]
pub struct Args {
    /// Files or a folder of the tool
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The tool; recognised by the number of files when not given
    #[arg(long, value_enum)]
    from: Option<From>,
    /// Write the calibration here
    #[arg(short, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    replace: Replace,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum From {
    /// Two texts of 21 numbers
    #[value(name = "imu_tk")]
    ImuTk,
    /// imu.yaml
    Kalibr,
}

/// File names that `export --to imu_tk` writes.
const OF_FOLDER: [&str; 2] = ["acc.calib", "gyro.calib"];

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let files: Vec<PathBuf> = match &args.files[..] {
        [folder] if folder.is_dir() => OF_FOLDER.iter().map(|name| folder.join(name)).collect(),
        given => given.to_vec(),
    };
    let inputs: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let output = Output::claim(&args.output, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let calibration = read(&files, args.from)?;
    output.write(show::json(&calibration)?.as_bytes())?;
    show::warn_each(&calibration.warnings);
    show::print(&format!(
        "{}: a calibration of {}",
        show::path(&args.output),
        calibration.method
    ))
}

fn read(files: &[PathBuf], from: Option<From>) -> Result<Calibration, Failure> {
    let found = match (files, from) {
        ([yaml], None | Some(From::Kalibr)) => import::kalibr(&read_text(yaml)?),
        ([acc, gyro], None | Some(From::ImuTk)) => {
            import::imu_tk(&read_text(acc)?, &read_text(gyro)?)
        }
        _ => {
            let said = match from {
                Some(From::Kalibr) => "--from kalibr: ",
                Some(From::ImuTk) => "--from imu_tk: ",
                None => "",
            };
            let why = format!(
                "{said}one imu.yaml of Kalibr, or two texts of imu_tk (accelerometer, gyroscope) expected"
            );
            return Err(Failure::usage(why).advise("name those"));
        }
    };
    found.map_err(|error| {
        let names: Vec<String> = files.iter().map(|f| show::path(f)).collect();
        Failure::of(INPUT, error.finding().in_file(names.join(", ")))
    })
}
