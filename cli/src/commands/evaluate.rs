//! `evaluate`: calibrations side by side on a recording that they have not seen.

mod compared;

use std::path::{Path, PathBuf};

use calib::Evaluation;
use serde_json::json;

use self::compared::{Asked, Calibrations, Compared, Gravities, JudgedLimits, compared};
use crate::commands::calibrate::limits::{self, LimitArgs};
use crate::commands::shared::first_screen::{Screen, Step};
use crate::commands::shared::inputs::{DetectorArgs, DeviceArgs, check_gravity};
use crate::commands::shared::names::Names;
use crate::commands::shared::pictures::PictureArgs;
use crate::exit::Failure;
use crate::output::Replace;
use crate::pages::evaluation::{self, Head, Next};
use crate::pages::verdict::Judged;
use crate::read_args::ReadArgs;
use crate::show;
use crate::show::command_line;

/// Compares calibrations on a recording, the raw readings always among them: the norm of gravity
/// at rest, its direction after each turn with what is left of the rate at rest taken off, and that rate:
/// the error of the gyroscope's bias.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint evaluate evening/ --calibration morning=cal.json --report check.html
  stillpoint evaluate evening/ --calibration morning=cal.json --limits limits.toml   (`calibrate --help` has one)

Residuals of the limits are those of this recording, everything else is that of the calibration.")]
pub struct Args {
    /// File or folder; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    recording: PathBuf,
    /// A calibration and what to call it; without a name it is called as its file
    #[arg(long, value_name = "[NAME=]FILE")]
    calibration: Vec<String>,
    /// Local gravity, m/s², that all are compared with [default: that of each calibration, of raw readings that of the first]
    #[arg(long, value_name = "M/S²")]
    gravity: Option<f64>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    replace: Replace,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let calibrations = Calibrations::named(&args.calibration)?;
    let limits = args.limits.read()?;
    if limits.is_some() && calibrations.all.is_empty() {
        let why = Failure::usage("--limits: there is no calibration to judge");
        return Err(why.advise("add --calibration FILE"));
    }
    args.gravity.map_or(Ok(()), check_gravity)?;
    let gravities = Gravities::of(args.gravity, &calibrations.all);
    let mut inputs = vec![args.recording.as_path()];
    inputs.extend(calibrations.files.iter().map(|(_, path)| *path));
    inputs.extend(args.limits.limits.as_deref());
    let pictures = args
        .pictures
        .claim(&evaluation::PLOTS, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let asked = Asked {
        recording: &args.recording,
        detector: &args.detector,
        device: args.device,
        read: &args.read,
    };
    let found = compared(&asked, &calibrations, &gravities)?;
    let judged = found.judged_by(limits.as_ref(), &calibrations.all);
    let (level, sentence, next) = found.verdict(&calibrations.all, &judged);
    let next = steps(args, &calibrations.files, &next);
    if pictures.wanted() {
        let named = calibrations.all.iter();
        let named: Vec<_> = named.map(|(name, c)| (name.as_str(), c)).collect();
        let (page, plots) = evaluation::page(
            &found.recording,
            &found.segmentation,
            &named,
            &found.rows,
            (&HEADER, &cells(&found.rows)),
            &gravities.rows(&calibrations.all),
            Head {
                judged: Judged {
                    level,
                    sentence: sentence.clone(),
                    next: next.iter().map(show::step).collect(),
                },
                limits: limits::shown_of(&judged),
                warnings: &found.warnings,
            },
        )?;
        pictures.write(&plots, &page)?;
    }
    match args.json {
        true => print_json(&found, &gravities.rows(&calibrations.all), &judged)?,
        false => show_screen(&found, &judged, (sentence, next))?,
    }
    limits::gate_of(&judged)
}

/// Prints a row of each, raw readings first.
fn print_json(found: &Compared, gravities: &[f64], judged: &JudgedLimits) -> Result<(), Failure> {
    show::warn_all(&found.warnings);
    let row = |((name, e), gravity): (&(String, Evaluation), &f64)| {
        let own = judged.iter().find(|(judged, _)| judged == name);
        match own {
            Some((_, lines)) => {
                json!({"name": name, "gravity": gravity, "misfit": e, "limits": lines})
            }
            None => json!({"name": name, "gravity": gravity, "misfit": e}),
        }
    };
    let rows: Vec<_> = found.rows.iter().zip(gravities).map(row).collect();
    show::print(&show::json(&rows)?)
}

/// Shows the verdict, the tables and what comes next.
fn show_screen(
    found: &Compared,
    judged: &JudgedLimits,
    (sentence, next): (String, Vec<Step>),
) -> Result<(), Failure> {
    let limits = judged
        .iter()
        .map(|(name, lines)| format!("{}: {}", show::name(name), limits::text(lines)));
    let names = Names::of([&found.recording]);
    let tables = [
        limits.collect(),
        table(&found.rows).to_string(),
        fields(&found.rows),
    ];
    let tables = tables.into_iter();
    let tables = tables.map(|table| table.trim_matches('\n').to_owned());
    let exceeded = judged.iter().flat_map(|(_, lines)| lines);
    let screen = Screen {
        verdict: vec![sentence],
        tables: tables.filter(|table| !table.is_empty()).collect(),
        next,
        remarks: names.all_short(&found.warnings),
        reserved: exceeded.filter(|line| !line.pass).count(),
        ..Screen::default()
    };
    screen.show(String::new)
}

/// The commands behind what comes next.
fn steps(args: &Args, files: &[(String, &Path)], next: &[Next]) -> Vec<Step> {
    let recording = command_line(&args.recording) + &args.read.command_line();
    let step = |next: &Next| match next {
        Next::NameCalibration => {
            let command = format!("stillpoint evaluate {recording} --calibration cal.json");
            Some(Step::new("name a calibration", command))
        }
        Next::RecordAtRest => Some(Step::words(evaluation::RECORD_AT_REST)),
        Next::CalibrateThis => Some(Step::words(evaluation::CALIBRATE_THIS)),
        Next::Use(place) => {
            let (name, file) = files.get(*place)?;
            let file = command_line(file);
            let command = format!("stillpoint apply {file} {recording} -o corrected.csv");
            Some(Step::new(format!("use {}", show::name(name)), command))
        }
        Next::EstimateBias(place) => {
            let file = command_line(files.get(*place)?.1);
            let command = format!("stillpoint bias {file} {recording} -o today.json");
            Some(Step::new("renew the gyroscope's bias", command))
        }
        Next::Advice(text) => Some(Step::words(text.clone())),
    };
    next.iter().filter_map(step).collect()
}

const HEADER: [&str; 6] = [
    "calibration",
    "static",
    "|f| - g,\nmm/s²",
    "turns",
    "turn, °",
    "rate at rest, °/s",
];

fn cells(rows: &[(String, Evaluation)]) -> Vec<Vec<String>> {
    let number =
        |value: Option<f64>, digits: usize| value.map_or("-".into(), |v| format!("{v:.digits$}"));
    let row = |(name, e): &(String, Evaluation)| {
        vec![
            show::name(name),
            e.static_intervals.to_string(),
            number(e.modulus_rms.map(|v| 1e3 * v), 2),
            e.turns.to_string(),
            number(e.direction_rms, 4),
            e.static_rate.map_or("-".into(), |rate| {
                let [x, y, z] = rate.map(f64::to_degrees);
                let digits = if x.hypot(y).hypot(z) < 0.1 { 4 } else { 3 };
                format!("{x:.digits$} {y:.digits$} {z:.digits$}")
            }),
        ]
    };
    rows.iter().map(row).collect()
}

/// The magnetic field over the static intervals, where there is a magnetometer.
fn fields(rows: &[(String, Evaluation)]) -> String {
    let header = [
        "calibration",
        "static",
        "norm of the field",
        "its spread, %",
        "angle to up, °",
        "its spread, °",
    ];
    let row = |(name, e): &(String, Evaluation)| {
        let field = e.magnetic_field?;
        Some([
            show::name(name),
            field.static_intervals.to_string(),
            show::value(field.norm, Some(0.01 * field.norm)),
            format!("{:.2}", 100.0 * field.norm_spread),
            format!("{:.1}", field.angle),
            format!("{:.2}", field.angle_spread),
        ])
    };
    let rows: Vec<_> = rows.iter().filter_map(row).collect();
    match rows.is_empty() {
        true => String::new(),
        false => format!("\n{}", show::table_of(&header, rows)),
    }
}

fn table(rows: &[(String, Evaluation)]) -> comfy_table::Table {
    show::table_of(&HEADER, cells(rows))
}
