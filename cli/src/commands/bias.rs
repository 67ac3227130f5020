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
    LONG_ENOUGH, Stretch, drift_at_rest, earth_in_bias, gyroscope_stretches, update_accelerometer,
    update_gyroscope,
};
use calib::readings::symptoms;
use sensor::Sensor;

use crate::commands::shared::first_screen::{Screen, Step, apply_to, wrote};
use crate::commands::shared::inputs::{DetectorArgs, DeviceArgs, gates_of, load, read_for};
use crate::commands::shared::names::Names;
use crate::commands::shared::pictures::{PictureArgs, named};
use crate::exit::Failure;
use crate::output::{Output, Replace};
use crate::pages::evaluation::doubted;
use crate::read_args::ReadArgs;
use crate::show;
use crate::show::command_line;

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
    let output = Output::claim_given(args.output.as_deref(), args.replace, &inputs)?;
    let names: &[&str] = if args.no_gyroscope { &[] } else { &["rates"] };
    let pictures = args.pictures.claim(names, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let old = load(&args.calibration)?;
    let recording = read_for(Some(&old), &args.recording, &args.read)?;
    let mut remarks = recording.warnings.clone();
    // What the old biases make of it is renewed; doubts are about what the new ones leave.
    args.device.refuse(&old, &[&recording])?;
    let (detector, _) = args.detector.detector()?;
    let segmentation = segment(&recording, &detector)?;
    let said = implausible(&recording, &segmentation, Some(&old), old.gravity);
    let found = symptoms(&recording, &segmentation);
    remarks.extend(found.iter().map(|found| found.in_recording(&recording)));
    remarks.extend(said.gates);
    remarks.extend(said.warnings);
    let mut new = old.of_recording(&recording).into_owned();
    new.seal_again(&old);
    let mut stretches = Vec::new();
    if !args.no_gyroscope {
        stretches = gyroscope_stretches(&new, &recording, &segmentation)?;
        new = update_gyroscope(&new, &recording.name, &stretches)?;
        remarks.extend(drift_at_rest(&recording.name, &stretches));
        remarks.extend(earth_in_bias(&recording.name, &stretches));
    }
    if args.accelerometer {
        new = update_accelerometer(&new, &recording, &segmentation)?;
    }
    let doubts = args.device.doubts(&new, &[&recording])?;
    remarks.extend(gates_of(&new));
    remarks.extend(doubts.iter().cloned());
    let json = show::json(&new)?;
    Output::write_given(output, &json)?;
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
    let remarks = remarks.texts(Front::CommandLine);
    if args.json {
        show::warn_all(&remarks);
        return show::print(&json);
    }
    let names = Names::of([&recording]);
    let remarks = names.all_short(&remarks);
    screen(args, &new, doubted(&doubts), &remarks).show(|| text(&new, &stretches))
}

/// The first screen: how far the biases moved and whether that is of this device, then each of them.
fn screen(
    args: &Args,
    new: &Calibration,
    doubt: Option<(&str, Option<String>)>,
    remarks: &[String],
) -> Screen {
    let moved = [
        moved(new, Sensor::Gyroscope, 3600.0 * 1f64.to_degrees(), "°/h"),
        moved(new, Sensor::Accelerometer, 1e3, "mm/s²"),
    ];
    let moved: Vec<String> = moved.into_iter().flatten().collect();
    let recording = command_line(&args.recording);
    let next = match &args.output {
        Some(path) => apply_to(&recording, &command_line(path)),
        None => Step::new(
            "keep the calibration",
            format!(
                "stillpoint bias {} {recording} -o today.json",
                command_line(&args.calibration)
            ),
        ),
    };
    let (why, advice) = doubt.unzip();
    let next = advice.flatten().map_or(next, Step::words);
    let moved = format!("The {}.", moved.join("; the "));
    Screen {
        verdict: why.map(str::to_owned).into_iter().chain([moved]).collect(),
        tables: vec![updates::brief(new)],
        next: vec![next],
        written: wrote(args.output.as_deref(), ""),
        remarks: remarks.to_vec(),
        ..Screen::default()
    }
}

/// A change of so many standard errors of the new bias is more than chance.
const MOVED: f64 = 2.0;

/// By how much the bias of a sensor moved, on the axis where that is most; `None` where it was not estimated again.
fn moved(new: &Calibration, sensor: Sensor, factor: f64, unit: &str) -> Option<String> {
    let mut updates = new.history.iter().rev();
    let update = updates.find(|update| update.sensor == sensor.prefix())?;
    let std = new.triad(sensor)?.bias_std;
    let of = |k: usize| {
        let change = (update.bias[k] - update.bias_before[k]).abs();
        (change, std[k].unwrap_or(0.0))
    };
    let (change, error) = (0..3).map(of).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_chance = (0..3).map(of).all(|(change, std)| change <= MOVED * std);
    let [change, error] = [change, error].map(|v| show::rounded(factor * v, 2));
    let name = sensor.name();
    Some(match is_chance {
        true => {
            format!("{name}'s bias has moved by no more than chance ({change} ± {error} {unit})")
        }
        false => format!("{name}'s bias moved by up to {change} {unit}"),
    })
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
    let header = ["bias", "before", "now", "change", "std error", "rests"];
    let table = show::table_of(&header, updates::updates(new));
    let _ = writeln!(text, "{table}");
    text
}
