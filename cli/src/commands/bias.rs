//! `bias`: biases estimated again, everything else kept.

mod page;
mod updates;

use ::findings::Front;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::calibrate::implausible;
use calib::calibration::Calibration;
use calib::intervals::segment;
use calib::methods::online_bias::{
    LONG_ENOUGH, Stretch, gyroscope_stretches, update_accelerometer, update_gyroscope,
};

use crate::commands::shared::inputs::{DetectorArgs, DeviceArgs, load, read};
use crate::commands::shared::pictures::{PictureArgs, named};
use crate::exit::Failure;
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;

/// Estimates the gyroscope's bias again from rests of more than 20 s, and on request the
/// accelerometer's from rests in different orientations; scale factors and misalignments are kept.
///
/// The new calibration remembers the old biases under `history`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint bias cal.json today.csv -o cal-today.json")]
pub struct Args {
    /// Calibration written by `calibrate`
    #[arg(value_name = "CAL")]
    calibration: PathBuf,
    /// File or folder; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    recording: PathBuf,
    /// Estimate the accelerometer's bias too (at least four different orientations)
    #[arg(long)]
    accelerometer: bool,
    /// Leave the gyroscope's bias as it is
    #[arg(long, requires = "accelerometer")]
    no_gyroscope: bool,
    /// Write the new calibration here
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print the new calibration as JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let inputs: [&Path; 2] = [&args.calibration, &args.recording];
    let output = match &args.output {
        Some(path) => Some(Output::claim(path, args.replace, &inputs)?),
        None => None,
    };
    let names: &[&str] = if args.no_gyroscope { &[] } else { &["rates"] };
    let pictures = args.pictures.claim(names, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let old = load(&args.calibration)?;
    let recording = read(&args.recording, &args.read)?;
    recording
        .warnings
        .texts(Front::CommandLine)
        .iter()
        .for_each(|warning| show::warn(warning));
    args.device.check(&old, &[&recording])?;
    let (detector, _) = args.detector.detector()?;
    let segmentation = segment(&recording, &detector)?;
    let said = implausible(&recording, &segmentation, Some(&old), old.gravity);
    said.gates
        .iter()
        .chain(&said.warnings)
        .for_each(|found| show::warn(&found.text(Front::CommandLine)));
    let mut new = old.of_recording(&recording).into_owned();
    new.seal_again(&old);
    let mut stretches = Vec::new();
    if !args.no_gyroscope {
        stretches = gyroscope_stretches(&new, &recording, &segmentation)?;
        new = update_gyroscope(&new, &recording.name, &stretches)?;
    }
    if args.accelerometer {
        new = update_accelerometer(&new, &recording, &segmentation)?;
    }
    let json = show::json(&new)?;
    if let Some(output) = output {
        output.write(json.as_bytes())?;
    }
    if pictures.wanted() {
        let plot = (!stretches.is_empty()).then(|| page::plot(&stretches));
        let name = show::name(&recording.name);
        let plots = named(names.iter().copied(), plot);
        let drawn = plots.first().map(|(_, picture)| picture);
        let page = page::page(
            &name,
            &recording.warnings.texts(Front::CommandLine),
            &new,
            drawn,
        );
        pictures.write(&plots, &page)?;
    }
    show::print(&if args.json {
        json
    } else {
        show::wrapped(&text(&new, &stretches))
    })?;
    Ok(())
}

fn text(new: &Calibration, stretches: &[Stretch]) -> String {
    let mut text = String::new();
    if !stretches.is_empty() {
        let mut table = show::table(&["from, s", "to, s", "x, rad/s", "y, rad/s", "z, rad/s"]);
        for stretch in stretches {
            let cell = |k: usize| {
                let std = stretch.std[k];
                format!(
                    "{} ± {}",
                    show::value(stretch.residual[k], Some(std)),
                    show::error(Some(std))
                )
            };
            table.add_row([
                format!("{:.1}", stretch.span.from),
                format!("{:.1}", stretch.span.to),
                cell(0),
                cell(1),
                cell(2),
            ]);
        }
        let _ = writeln!(
            text,
            "Mean corrected rate in rests of more than {LONG_ENOUGH} s\n{table}\n"
        );
    }
    let mut table = show::table(&["bias", "before", "now", "change", "std error", "rests"]);
    for row in updates::updates(new) {
        table.add_row(row);
    }
    let _ = writeln!(text, "{table}");
    text
}
