//! `reckon`: the equations of motion solved with each calibration.

mod first_screen;
mod show_runs;
mod solve;

use ::findings::Front;
use std::path::PathBuf;

use calib::intervals::Span;
use calib::reckon::published::Procedure;
use calib::reckon::{Ending, Mode};
use clap::ValueEnum;
use nalgebra::Vector3;
use solve::{Known, Named, Run};

use crate::commands::shared::first_screen::wrote;
use crate::commands::shared::inputs::{DeviceArgs, as_paths, load, named_file, numbers, read_for};
use crate::commands::shared::pictures::{PictureArgs, named};
use crate::exit::{Failure, NOT_ENOUGH};
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;

/// Solves the equations of motion for the motion in each recording, with each calibration and with
/// the raw readings, and compares where it ends with where it ended.
///
/// The device must be at rest before the motion: that rest gives the first attitude and the
/// gyroscope's bias. A rest after it takes off the velocity and the tilt that have grown on the way.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  stillpoint reckon run/ --calibration mine=cal.json --displacement 4.095,0,0 --report run.html
  stillpoint reckon a/ b/ --procedure published --level 0.60,0.40 --vertical z,z \\
      --displacement 4.095,0,0 --displacement=-4.095,0,0    the authors' table")]
pub struct Args {
    /// Files or folders, one motion each
    #[arg(value_name = "RECORDING", required = true)]
    recordings: Vec<PathBuf>,
    /// A calibration and what to call it; without a name it is called as its file. The raw readings are always there as `raw`
    #[arg(long, value_name = "[NAME=]FILE")]
    calibration: Vec<String>,
    /// Where the attitude comes from [default: full]
    #[arg(long, value_enum)]
    mode: Option<ModeArg>,
    /// What the end of the motion is known to be [default: attitude]
    #[arg(long, value_enum)]
    ending: Option<EndingArg>,
    /// When the motion was, s, for each recording in turn [default: found]
    #[arg(long, value_name = "T0,T1", value_parser = numbers::<2>)]
    motion: Vec<[f64; 2]>,
    /// True displacement, m, for each recording in turn: along the device's axes at the start,
    /// turned level
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    displacement: Vec<[f64; 3]>,
    /// True horizontal distance, m, where the direction is not known
    #[arg(long, value_name = "M", conflicts_with = "displacement")]
    distance: Option<f64>,
    /// How to solve
    #[arg(long, value_enum, default_value_t = ProcedureArg::Equations)]
    procedure: ProcedureArg,
    #[command(flatten)]
    published: PublishedArgs,
    /// Write the results here (JSON)
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ModeArg {
    /// From the gyroscope
    Full,
    /// That of the rest before the motion, all the way
    Level,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum EndingArg {
    /// Nothing is known
    Free,
    /// At rest: the velocity that is left is taken off in proportion to time
    Velocity,
    /// At rest: the tilt that gravity shows there is taken off too
    Attitude,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum ProcedureArg {
    /// The equations of motion
    Equations,
    /// What the authors did: no attitude, gravity off one axis, samples over a level summed twice
    Published,
}

/// Constants of the published procedure.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "The published procedure")]
struct PublishedArgs {
    /// Level above which the filtered norm counts as motion, m/s², for each recording in turn
    #[arg(long, value_name = "M/S²", value_delimiter = ',')]
    level: Vec<f64>,
    /// Axis that gravity is taken off, for each recording in turn [default: z]
    #[arg(long, value_name = "AXIS", value_delimiter = ',')]
    vertical: Vec<AxisArg>,
    /// Gravity taken off, m/s² [default: 9.79]
    #[arg(long, value_name = "M/S²")]
    gravity: Option<f64>,
    /// Cutoff of the high-pass filter, Hz [default: 0.001]
    #[arg(long, value_name = "HZ")]
    high_pass: Option<f64>,
    /// Cutoff of the low-pass filter, Hz [default: 3]
    #[arg(long, value_name = "HZ")]
    low_pass: Option<f64>,
    /// Sampling rate assumed instead of the time stamps, Hz [default: 100]
    #[arg(long, value_name = "HZ")]
    assumed_rate: Option<f64>,
    /// Calibration whose readings pick the samples in motion for all [default: authors-proposed]
    #[arg(long, value_name = "NAME")]
    picked_by: Option<String>,
}

/// Refuses options of the procedure that was not asked for.
fn refuse_other_procedure(args: &Args) -> Result<(), Failure> {
    let PublishedArgs {
        level,
        vertical,
        gravity,
        high_pass,
        low_pass,
        assumed_rate,
        picked_by,
    } = &args.published;
    let (equations, published) = (ProcedureArg::Equations, ProcedureArg::Published);
    let own = [
        ("--mode", args.mode.is_some(), equations),
        ("--ending", args.ending.is_some(), equations),
        ("--motion", !args.motion.is_empty(), equations),
        ("--distance", args.distance.is_some(), equations),
        ("--level", !level.is_empty(), published),
        ("--vertical", !vertical.is_empty(), published),
        ("--gravity", gravity.is_some(), published),
        ("--high-pass", high_pass.is_some(), published),
        ("--low-pass", low_pass.is_some(), published),
        ("--assumed-rate", assumed_rate.is_some(), published),
        ("--picked-by", picked_by.is_some(), published),
    ];
    let other = own
        .into_iter()
        .find(|(_, given, of)| *given && *of != args.procedure);
    let Some((option, _, of)) = other else {
        return Ok(());
    };
    let why = match of {
        ProcedureArg::Published => {
            format!(
                "{option} is of the published procedure: add --procedure published, or leave it out"
            )
        }
        ProcedureArg::Equations => {
            format!("{option} means nothing to --procedure published: leave one of the two out")
        }
    };
    Err(Failure::usage(why))
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum AxisArg {
    X,
    Y,
    Z,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    refuse_other_procedure(args)?;
    let mut inputs = as_paths(&args.recordings);
    inputs.extend(args.calibration.iter().map(|named| named_file(named).1));
    let output = Output::claim_given(args.output.as_deref(), args.replace, &inputs)?;
    let names = show_runs::plot_names(&args.recordings);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let pictures = args.pictures.claim(&names, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let calibrations = calibrations(args)?;
    let (mut runs, mut remarks) = (Vec::new(), Vec::new());
    for (k, path) in args.recordings.iter().enumerate() {
        let first = calibrations.iter().find_map(Named::of_file);
        let recording = read_for(first, path, &args.read)?;
        remarks.extend(recording.warnings.texts(Front::CommandLine));
        for calibration in calibrations.iter().filter_map(Named::of_file) {
            args.device.check(calibration, &[&recording])?;
        }
        runs.push(run_of(args, k, &recording, &calibrations)?);
    }
    remarks.extend(runs.iter().flat_map(|run| run.warnings.clone()));
    let json = show::json(&runs)?;
    Output::write_given(output, &json)?;
    if pictures.wanted() {
        let plots = named(names.iter().copied(), show_runs::plots(&runs));
        pictures.write(&plots, &show_runs::report(&runs, &plots))?;
    }
    if args.json {
        show::warn_all(&remarks);
        return show::print(&json);
    }
    let written = args.output.as_deref().into_iter();
    let written = wrote(written.chain(args.pictures.paths()), "");
    first_screen::screen(&runs, remarks, written).show(|| show_runs::text(&runs))
}

/// Run `k` by the procedure asked for.
fn run_of(
    args: &Args,
    k: usize,
    recording: &calib::Recording,
    calibrations: &[Named],
) -> Result<Run, Failure> {
    let known = match (
        each(&args.displacement, k, args, "--displacement")?,
        args.distance,
    ) {
        (Some(displacement), _) => Known::Displacement(Vector3::from(displacement)),
        (None, Some(distance)) => Known::Distance(distance),
        (None, None) => Known::Nothing,
    };
    if args.procedure == ProcedureArg::Published {
        let (published, usual) = (&args.published, Procedure::default());
        let level = each(&published.level, k, args, "--level")?;
        let procedure = Procedure {
            level: level.unwrap_or(usual.level),
            vertical: each(&published.vertical, k, args, "--vertical")?.unwrap_or(AxisArg::Z)
                as usize,
            gravity: published.gravity.unwrap_or(usual.gravity),
            high_pass: published.high_pass.unwrap_or(usual.high_pass),
            low_pass: published.low_pass.unwrap_or(usual.low_pass),
            rate: published.assumed_rate.unwrap_or(usual.rate),
        };
        return solve::published(
            recording,
            calibrations,
            &procedure,
            published
                .picked_by
                .as_deref()
                .unwrap_or(solve::AUTHORS_PROPOSED),
            known,
        );
    }
    let span = each(&args.motion, k, args, "--motion")?;
    let span = span.map(|[from, to]| Span { from, to });
    let mode = match args.mode {
        None | Some(ModeArg::Full) => Mode::Full,
        Some(ModeArg::Level) => Mode::Level,
    };
    let ending = match args.ending {
        Some(EndingArg::Free) => Ending::Free,
        Some(EndingArg::Velocity) => Ending::Velocity,
        None | Some(EndingArg::Attitude) => Ending::Attitude,
    };
    solve::equations(recording, calibrations, span, mode, ending, known)
}

/// The value for recording `k` of an option given once for each recording or not at all.
fn each<T: Copy>(values: &[T], k: usize, args: &Args, name: &str) -> Result<Option<T>, Failure> {
    if values.is_empty() || values.len() == args.recordings.len() {
        return Ok(values.get(k).copied());
    }
    Err(Failure::usage(format!(
        "{name} given {} times for {} recordings: give it once for each",
        values.len(),
        args.recordings.len()
    )))
}

/// The raw readings, the authors' numbers where their procedure is asked for, and what was named.
fn calibrations(args: &Args) -> Result<Vec<Named>, Failure> {
    let mut all = vec![Named::raw()];
    if args.procedure == ProcedureArg::Published {
        all.extend(Named::authors());
    }
    for named in &args.calibration {
        let (name, path) = named_file(named);
        if all.iter().any(|other| other.name == name) {
            return Err(Failure::usage(format!(
                "--calibration {named}: there is a \"{name}\" already"
            ))
            .advise("choose another name"));
        }
        let calibration = load(path)?;
        if let Some(own) = calibration.not_calibrated.first() {
            return Err(Failure::new(
                NOT_ENOUGH,
                format!(
                    "--calibration {named}: the {} is not calibrated ({}), and the motion needs both sensors",
                    own.sensor.name(),
                    own.reason.in_words()
                ),
            )
            .advise("calibrate a recording with turns that can be used"));
        }
        all.push(Named::file(&name, calibration));
    }
    Ok(all)
}
