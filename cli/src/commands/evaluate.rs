//! `evaluate`: calibrations side by side on a recording that they have not seen.

use ::findings::{Finding, Front};
use std::path::{Path, PathBuf};

use calib::calibrate::{STANDARD_GRAVITY, changes_part_way, implausible};
use calib::limits::{LimitLine, Residuals, judge_on};
use calib::methods::cut;
use calib::readings::{symptoms, without_spikes};
use calib::recording::figure;
use calib::{Calibration, Evaluation, evaluate};
use serde_json::json;

use crate::commands::calibrate::limits::{self, LimitArgs};
use crate::commands::shared::first_screen::{Screen, Step};
use crate::commands::shared::inputs::{
    DetectorArgs, DeviceArgs, check_gravity, gates_of, load, named_file, read_for, spinner,
};
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
    let (mut files, mut calibrations) = (Vec::new(), Vec::new());
    for named in &args.calibration {
        let (name, path) = named_file(named);
        if files.iter().any(|(other, _)| *other == name) {
            return Err(Failure::usage(format!(
                "--calibration {named}: another one is called {name}; name them apart (NAME=FILE)"
            )));
        }
        calibrations.push((name.clone(), load(path)?));
        files.push((name, path));
    }
    let limits = args.limits.read()?;
    if limits.is_some() && calibrations.is_empty() {
        let why = "--limits: there is no calibration to judge; add --calibration FILE";
        return Err(Failure::usage(why));
    }
    args.gravity.map_or(Ok(()), check_gravity)?;
    let gravities = Gravities::of(args.gravity, &calibrations);
    let mut inputs = vec![args.recording.as_path()];
    inputs.extend(files.iter().map(|(_, path)| *path));
    inputs.extend(args.limits.limits.as_deref());
    let pictures = args
        .pictures
        .claim(&evaluation::PLOTS, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let (detector, choose) = args.detector.detector()?;
    let first = calibrations.first().map(|(_, calibration)| calibration);
    let recording = read_for(first, &args.recording, &args.read)?.decimated();
    let mut warnings = recording.warnings.clone();
    warnings.extend(gravities.differ(&calibrations));
    let mut doubts: Vec<Vec<Finding>> = Vec::new();
    // Of several calibrations each warning names its own.
    let of = |name: &str, text: String| match calibrations.len() {
        1 => text,
        _ => format!("{}: {text}", show::name(name)),
    };
    for (name, calibration) in &calibrations {
        warnings.extend(gates_of(calibration).map(|text| of(name, text)));
        let doubted = args.device.doubts(calibration, &[&recording])?;
        let of_biases = calibration.doubts_biases_of(&recording);
        for doubt in doubted.iter().chain(&of_biases) {
            warnings.push(match calibrations.len() {
                1 => doubt.clone(),
                _ => of(name, doubt.text(Front::CommandLine)).into(),
            });
        }
        doubts.push(doubted);
    }
    let progress = spinner("comparing");
    let choice = cut(&recording, &detector, choose, gravities.raw)?;
    // What is wrong with the readings is in every misfit.
    let spikes = without_spikes(&recording).map_or_else(Vec::new, |(_, found)| found);
    for found in symptoms(&recording, &choice.segmentation)
        .iter()
        .chain(&spikes)
    {
        warnings.push(found.in_recording(&recording));
    }
    let measure = |c, gravity| evaluate(&recording, &choice.segmentation, c, gravity);
    let mut rows: Vec<(String, Evaluation)> = vec![("raw".into(), measure(None, gravities.raw)?)];
    for (name, calibration) in &calibrations {
        let left = measure(Some(calibration), gravities.of_calibration(calibration))?;
        rows.push((name.clone(), left));
    }
    progress.finish_and_clear();
    // Misfits of a recording in which something changes say nothing of a calibration.
    let by_first = calibrations.first().zip(rows.get(1));
    let gyroscope = by_first.and_then(|((_, calibration), (_, evaluation))| {
        let t = calibration.gyroscope.as_ref()?.base().t;
        Some((t, evaluation.direction_rms?.to_radians()))
    });
    warnings.extend(changes_part_way(
        &recording,
        &choice.segmentation,
        gravities.raw,
        gyroscope,
    ));
    let said = implausible(&recording, &choice.segmentation, first, gravities.raw);
    warnings.extend(said.gates);
    warnings.extend(said.warnings);
    let warnings = warnings.texts(Front::CommandLine);
    let judged: Vec<(String, Vec<LimitLine>)> = calibrations
        .iter()
        .zip(rows.iter().skip(1))
        .filter_map(|((name, c), (_, e))| {
            let left = Residuals {
                at_rest: e.modulus_rms,
                after_turn: e.direction_rms,
            };
            Some((name.clone(), judge_on(limits.as_ref()?, c, left)))
        })
        .collect();
    let failed: Vec<Option<String>> = calibrations
        .iter()
        .map(|(name, calibration)| failing(name, calibration, &judged))
        .collect();
    let (level, sentence, next) =
        evaluation::judged(&rows, (&doubts, &failed), (&choice.segmentation, &warnings));
    let next = steps(args, &files, &next);
    if pictures.wanted() {
        let named: Vec<_> = calibrations
            .iter()
            .map(|(name, c)| (name.as_str(), c))
            .collect();
        let (page, plots) = evaluation::page(
            &recording,
            &choice.segmentation,
            &named,
            &rows,
            (&HEADER, &cells(&rows)),
            &gravities.rows(&calibrations),
            Head {
                judged: Judged {
                    level,
                    sentence: sentence.clone(),
                    next: next.iter().map(show::step).collect(),
                },
                limits: limits::shown_of(&judged),
                warnings: &warnings,
            },
        )?;
        pictures.write(&plots, &page)?;
    }
    if args.json {
        show::warn_all(&warnings);
        let row = |((name, e), gravity): (&(String, Evaluation), f64)| {
            let own = judged.iter().find(|(judged, _)| judged == name);
            match own {
                Some((_, lines)) => {
                    json!({"name": name, "gravity": gravity, "misfit": e, "limits": lines})
                }
                None => json!({"name": name, "gravity": gravity, "misfit": e}),
            }
        };
        let rows = rows.iter().zip(gravities.rows(&calibrations)).map(row);
        let rows: Vec<_> = rows.collect();
        show::print(&show::json(&rows)?)?;
    } else {
        let verdict = |(name, lines): &(String, Vec<LimitLine>)| {
            format!("{}: {}", show::name(name), limits::text(lines))
        };
        let verdicts: String = judged.iter().map(verdict).collect();
        let names = Names::of([&recording]);
        let screen = Screen {
            verdict: vec![sentence],
            tables: [verdicts, table(&rows).to_string(), fields(&rows)]
                .into_iter()
                .map(|table| table.trim_matches('\n').to_owned())
                .filter(|table| !table.is_empty())
                .collect(),
            next,
            remarks: names.all_short(&warnings),
            reserved: judged
                .iter()
                .map(|(_, lines)| lines.iter().filter(|line| !line.pass).count())
                .sum(),
            ..Screen::default()
        };
        screen.show(String::new)?;
    }
    limits::gate_of(&judged)
}

/// Why not to use a calibration: a limit, or a gate of its own recordings.
fn failing(
    name: &str,
    calibration: &Calibration,
    judged: &[(String, Vec<LimitLine>)],
) -> Option<String> {
    let own = judged.iter().find(|(other, _)| other == name);
    let limit = own.and_then(|(_, lines)| limits::failing(lines));
    let gate = || {
        let failed = !calibration.failed_gates.is_empty();
        failed.then(|| "a quality gate of its own recording".to_owned())
    };
    limit.or_else(gate)
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

/// The gravity that each row is compared with.
struct Gravities {
    given: Option<f64>,
    raw: f64,
}

impl Gravities {
    /// Builds the reference gravities: the given value, else each calibration's own. The raw readings take that of the
    /// first.
    fn of(given: Option<f64>, calibrations: &[(String, Calibration)]) -> Self {
        let first = calibrations
            .first()
            .map(|(_, calibration)| calibration.gravity);
        let raw = given.or(first).unwrap_or(STANDARD_GRAVITY);
        Self { given, raw }
    }

    fn of_calibration(&self, calibration: &Calibration) -> f64 {
        self.given.unwrap_or(calibration.gravity)
    }

    /// Returns the gravity of each row, m/s²: the raw readings, then the calibrations.
    fn rows(&self, calibrations: &[(String, Calibration)]) -> Vec<f64> {
        let own = calibrations.iter().map(|(_, c)| self.of_calibration(c));
        std::iter::once(self.raw).chain(own).collect()
    }

    /// Returns a note if the gravities differ.
    fn differ(&self, calibrations: &[(String, Calibration)]) -> Option<String> {
        let is_other = |(_, c): &(String, Calibration)| self.of_calibration(c) != self.raw;
        calibrations.iter().any(is_other).then(|| {
            let own = calibrations.iter().map(|(name, c)| format!("{} {} m/s²", show::name(name), figure(c.gravity)));
            format!(
                "the calibrations were made for different gravities ({}): each is compared with its own, the raw readings with \
                 that of the first; --gravity compares all with one",
                own.collect::<Vec<_>>().join(", ")
            )
        })
    }
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
