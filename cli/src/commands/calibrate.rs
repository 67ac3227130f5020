//! `calibrate`: recordings to a calibration.

pub mod clocks;
pub mod joint;
mod leave_out;
pub mod left_out;
pub mod limits;
pub mod prior;
mod six_position;
pub mod tables;

use std::path::PathBuf;

use calib::Recording;
use calib::calibrate::{
    Frame, GyroBias, NOMINAL_RATES, Outcome, Request, calibrate, read_static_means,
};
use calib::effect_file::catalogue_with;
use calib::gravity::Gravity;
use calib::intervals::{Span, read_sections};
use calib::methods::cut;
use calib::prior::Prior;
use calib::recording::figure;
use calib::residuals::Integrator;
use clap::ValueEnum;
use limits::{LimitArgs, gate};
use nalgebra::Vector3;
use sensor::AnyEffect;

use crate::commands::shared::inputs::{
    ClockArg, DetectorArgs, PlaceArgs, RecordingArgs, as_paths, own_effects, read, spinner,
};
use crate::commands::shared::pictures::{PictureArgs, Pictures};
use crate::exit::{Failure, INPUT, NOT_CONVERGED, NOT_ENOUGH, USAGE};
use crate::output::{Output, Replace};
use crate::pages::session::Session;
use crate::pages::{calibration, refusal};
use crate::read_args::ReadArgs;
use crate::show;

/// Calibrates both sensors from one or more recordings of one device.
///
/// Several recordings share scale factors and misalignments and have biases of their own where the
/// data ask for it.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Signs: at rest specific force is +g on the axis that points up; rates are right-handed about each axis.

Example:
  stillpoint calibrate morning/ evening/ --gravity 9.8055 -o cal.json --report cal.html
  stillpoint calibrate morning/ --limits limits.toml   exit 1 and the reasons where one is not kept

limits.toml (every key may be left out):
  required = [\"accelerometer\", \"gyroscope\"]
  [accelerometer]              # gyroscope the same, with residual_deg
  residual_mm_s2 = 5.0
  reduced_chi2 = 9.0
  scale = 1e-3                 # largest standard errors: relative,
  misalignment = 1e-3          # rad,
  bias = 0.01                  # m/s^2 (rad/s)
  intervals = 12               # static intervals (turns), at least
  [effects]
  gyro_g_sensitivity = 1e-4    # largest parameter
  [standard_errors]
  \"accel.s_x\" = 5e-4
  [values]
  \"gyro.b_z\" = [-0.02, 0.02]")]
pub struct Args {
    #[command(flatten)]
    recordings: RecordingArgs,
    /// How to calibrate
    #[arg(long, value_enum, default_value_t = Method::Auto)]
    method: Method,
    /// With `--method six-position`: correct by `I - M` as published, not by the inverse of `I + M`
    #[arg(long)]
    first_order: bool,
    /// Effects to fit on top of the base models, such as gyro_g_sensitivity
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    effects: Vec<String>,
    /// What the device's type has in common, from `batch prior`: its information is added to that of the recording, its effects
    /// are fitted
    #[arg(long, value_name = "FILE.json")]
    prior: Option<PathBuf>,
    /// File that defines effects as expressions (TOML), to be named in `--effects`
    #[arg(long, value_name = "FILE.toml")]
    effect_file: Vec<PathBuf>,
    /// Recording to take the gyroscope's turns from instead
    #[arg(long, value_name = "RECORDING")]
    gyro_recording: Vec<PathBuf>,
    /// Frame of the accelerometer's matrix
    #[arg(long, value_enum, default_value_t = FrameArg::Triangular)]
    frame: FrameArg,
    /// How the rate is integrated over a turn
    #[arg(long, value_enum, default_value_t = IntegratorArg::Exponential)]
    integrator: IntegratorArg,
    /// Where the bias of a turn is taken from
    #[arg(long, value_enum, default_value_t = GyroBiasArg::Adjacent)]
    gyro_bias: GyroBiasArg,
    /// Assume this sampling rate in turns instead of the time stamps, Hz (to reproduce published
    /// figures)
    #[arg(long, value_name = "HZ")]
    nominal_rate: Option<f64>,
    /// By which clock the turns are integrated
    #[arg(long, value_enum, default_value_t = ClockArg::Auto)]
    clock: ClockArg,
    /// Strength of the magnetic field of the place, µT: the magnetometer's scale is then absolute, else its `T` has
    /// determinant 1
    #[arg(long, value_name = "UT")]
    field: Option<f64>,
    /// Table of static intervals picked by hand, for each recording in turn (columns `t0,t1` or
    /// `start,stop`)
    #[arg(long, value_name = "FILE")]
    sections: Vec<PathBuf>,
    /// Static intervals to leave out, each by an instant within it, s; of the second recording as 2:61.5
    #[arg(
        long,
        value_name = "T,T",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    leave_out: Vec<leave_out::LeftOut>,
    /// Table of static means (columns `ax,ay,az`) for the accelerometer, instead of the recordings'
    #[arg(long, value_name = "FILE")]
    static_means: Option<PathBuf>,
    /// Take the recordings to be of one device even where they disagree
    #[arg(long)]
    force_device: bool,
    /// Write the calibration here
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print the calibration as JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    place: PlaceArgs,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Method {
    /// Joint; stepwise where a recording has no accelerometer, or where an option is the stepwise method's alone
    Auto,
    /// Accelerometer first, then the gyroscope by propagated gravity (Liu et al. 2021)
    Stepwise,
    /// Both sensors in one problem weighted by the recording's own noise
    Joint,
    /// Each axis once up and once down, from six recordings or one
    SixPosition,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FrameArg {
    /// Upper triangular
    Triangular,
    /// Symmetric
    Symmetric,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum IntegratorArg {
    /// Exponential map of the mean of neighbouring samples
    Exponential,
    /// First order, unit length after each step
    FirstOrderNormalized,
    /// First order, as published
    FirstOrder,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum GyroBiasArg {
    /// Mean of the static intervals beside the turn
    Adjacent,
    /// First static interval of the recording, as published
    Initial,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let mut inputs = args.recordings.paths();
    inputs.extend(args.gyro_recording.iter().chain(&args.sections).cloned());
    inputs.extend(args.static_means.iter().chain(&args.effect_file).cloned());
    if inputs.is_empty() {
        return Err(Failure::new(
            USAGE,
            "no recording given: name a file or a folder",
        ));
    }
    inputs.extend(args.limits.limits.iter().chain(&args.prior).cloned());
    let mut request = request(args)?;
    let limits = args.limits.read()?;
    let prior = args.prior.as_deref().map(Prior::read).transpose()?;
    if let Some(prior) = &prior {
        prior::with_effects(prior, &mut request)?;
    }
    let output = match &args.output {
        Some(path) => Some(Output::claim(path, args.replace, &as_paths(&inputs))?),
        None => None,
    };
    let names = plot_names(args);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let pictures = args
        .pictures
        .claim(&names, args.replace, &as_paths(&inputs))?;
    args.replace.end_if_all_exist()?;
    let recordings = match args.recordings.read(&args.read) {
        Ok(recordings) => recordings,
        Err(failure) => return Err(refused(failure, pictures, &[], &request)),
    };
    if let Method::SixPosition = args.method {
        let (detector, gravity) = (
            request.detector,
            Gravity {
                value: request.gravity,
                source: request.gravity_source,
            },
        );
        let (first_order, json) = (args.first_order, args.json);
        let recordings = &recordings;
        return six_position::run(six_position::Call {
            recordings,
            detector,
            gravity,
            first_order,
            json,
            limits,
            output,
            pictures,
        });
    }
    let gyro_recordings = args
        .gyro_recording
        .iter()
        .map(|p| read(p, &args.read).map(calib::Recording::decimated))
        .collect::<Result<Vec<_>, _>>()?;
    request.sections = sections(args, &recordings)?;
    request.left_out = leave_out::instants(&args.leave_out, recordings.len())?;
    let spinner = spinner("calibrating");
    let mut outcome = match calibrate(&recordings, &gyro_recordings, &request) {
        Ok(outcome) => outcome,
        Err(error) => {
            // A calibration carries the readers' warnings; where there is none they may explain why.
            let warnings = recordings.iter().flat_map(|r| r.warnings.clone());
            show::warn_all(&warnings.collect::<Vec<_>>());
            return Err(refused(error.into(), pictures, &recordings, &request));
        }
    };
    spinner.finish_and_clear();
    if let Some(prior) = &prior {
        prior.inform(&mut outcome.calibration)?;
    }
    limits::state(&mut outcome.calibration, limits.as_ref());
    if pictures.wanted() {
        draw(pictures, &recordings, &outcome)?;
    }
    finish(args, output, &outcome)
}

/// Names of the plots that this call draws.
fn plot_names(args: &Args) -> Vec<String> {
    if let Method::SixPosition = args.method {
        return six_position::PLOTS.map(str::to_owned).to_vec();
    }
    calibration::plot_names(args.recordings.recordings.len().max(1))
}

/// What pages show of the recordings. One that repeats another's data was counted once and is shown as that one.
pub(super) fn session<'a>(
    recordings: impl IntoIterator<Item = &'a Recording>,
    outcome: &'a Outcome,
) -> Result<Session<'a>, Failure> {
    let mut counted: Vec<&Recording> = Vec::new();
    for recording in recordings {
        let same = |other: &&Recording| {
            other.accelerometer == recording.accelerometer && other.gyroscope == recording.gyroscope
        };
        if !counted.iter().any(same) {
            counted.push(recording);
        }
    }
    let segmentations = outcome.choices.iter().map(|choice| &choice.segmentation);
    let cut = counted.into_iter().zip(segmentations);
    let calibration = &outcome.calibration;
    Ok(Session::of(cut, Some(calibration), calibration.gravity)?)
}

/// Writes plots and report. Every recording has a plot of its own.
fn draw(pictures: Pictures, recordings: &[Recording], outcome: &Outcome) -> Result<(), Failure> {
    let calibration = &outcome.calibration;
    let session = session(recordings, outcome)?;
    let units = tables::units(outcome);
    let plots = calibration::pictures(calibration, &session, units);
    let page = calibration::page(calibration, &session, &plots, units)?;
    pictures.write(&plots, &page)
}

/// The failure itself; where a report was asked for, it says why and shows what there is.
fn refused(
    failure: Failure,
    pictures: Pictures,
    recordings: &[Recording],
    request: &Request,
) -> Failure {
    if !pictures.wanted() || ![INPUT, NOT_ENOUGH, NOT_CONVERGED].contains(&failure.code) {
        return failure;
    }
    let choices: Vec<_> = recordings
        .iter()
        .map(|r| {
            cut(
                r,
                &request.detector,
                request.choose_multiplier,
                request.gravity,
            )
            .ok()
        })
        .collect();
    let cut: Vec<_> = recordings
        .iter()
        .zip(&choices)
        .filter_map(|(r, choice)| Some((r, &choice.as_ref()?.segmentation)))
        .collect();
    let (page, plots) = refusal::page(&failure, recordings, &cut, request.gravity);
    match pictures.write(&plots, &page) {
        Ok(()) => failure,
        Err(other) => other,
    }
}

/// Refuses options that the method would ignore.
fn check_method(args: &Args) -> Result<(), Failure> {
    let six = matches!(args.method, Method::SixPosition);
    let joint = matches!(args.method, Method::Joint);
    let senseless = [
        (
            "--first-order",
            args.first_order && !six,
            "--method six-position",
        ),
        (
            "--sections",
            !args.sections.is_empty() && six,
            "--method stepwise or joint",
        ),
        (
            "--leave-out",
            !args.leave_out.is_empty() && six,
            "--method stepwise or joint",
        ),
        (
            "--static-means",
            args.static_means.is_some() && (six || joint),
            "--method stepwise",
        ),
        (
            "--effects",
            !args.effects.is_empty() && six,
            "--method stepwise or joint",
        ),
        (
            "--prior",
            args.prior.is_some() && six,
            "--method stepwise or joint",
        ),
        (
            "--gyro-recording",
            !args.gyro_recording.is_empty() && six,
            "--method stepwise or joint",
        ),
        (
            "--nominal-rate",
            args.nominal_rate.is_some() && six,
            "--method stepwise",
        ),
    ];
    for (option, given, method) in senseless {
        if given {
            let why = format!(
                "{option} means nothing with this method; use it with {method}, or leave it out"
            );
            return Err(Failure::new(USAGE, why));
        }
    }
    Ok(())
}

fn request(args: &Args) -> Result<Request, Failure> {
    check_method(args)?;
    let gravity = args.place.gravity()?;
    let (detector, choose_multiplier) = args.detector.detector()?;
    let own = own_effects(&args.effect_file)?;
    let effects = args
        .effects
        .iter()
        .map(|name| {
            let mut all = catalogue_with(&own);
            all.find(|effect| effect.name() == name).ok_or_else(|| {
                Failure::new(
                    USAGE,
                    format!(
                        "--effects {name}: not in the catalogue ({})",
                        catalogue_names(&own)
                    ),
                )
            })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let nominal_step = match args.nominal_rate {
        Some(rate) if NOMINAL_RATES.contains(&rate) => Some(rate.recip()),
        Some(rate) => {
            return Err(Failure::new(
                USAGE,
                format!(
                    "--nominal-rate {}: a rate from {} to {} Hz expected",
                    figure(rate),
                    figure(*NOMINAL_RATES.start()),
                    figure(*NOMINAL_RATES.end())
                ),
            ));
        }
        None => None,
    };
    let static_means: Vec<Vector3<f64>> = match &args.static_means {
        Some(path) => read_static_means(path)?,
        None => Vec::new(),
    };
    Ok(Request {
        method: match args.method {
            Method::Auto => calib::calibrate::Method::Auto,
            Method::Joint => calib::calibrate::Method::Joint,
            Method::Stepwise | Method::SixPosition => calib::calibrate::Method::Stepwise,
        },
        gravity: gravity.value,
        gravity_source: gravity.source,
        detector,
        choose_multiplier,
        sections: Vec::new(),
        left_out: Vec::new(),
        frame: match args.frame {
            FrameArg::Triangular => Frame::Triangular,
            FrameArg::Symmetric => Frame::Symmetric,
        },
        integrator: match args.integrator {
            IntegratorArg::Exponential => Integrator::Exponential,
            IntegratorArg::FirstOrderNormalized => Integrator::FirstOrderNormalized,
            IntegratorArg::FirstOrder => Integrator::FirstOrder,
        },
        gyro_bias: match args.gyro_bias {
            GyroBiasArg::Adjacent => GyroBias::Adjacent,
            GyroBiasArg::Initial => GyroBias::Initial,
        },
        nominal_step,
        effects,
        latitude: args.place.latitude,
        force_device: args.force_device,
        clock: args.clock.mode(),
        field: args.field,
        static_means,
    })
}

fn catalogue_names(own: &[&'static dyn AnyEffect]) -> String {
    let names: Vec<&str> = catalogue_with(own).map(|e| e.name()).collect();
    names.join(", ")
}

fn sections(args: &Args, recordings: &[Recording]) -> Result<Vec<Vec<Span>>, Failure> {
    match args.sections.as_slice() {
        [] => Ok(Vec::new()),
        [one] => recordings
            .iter()
            .map(|r| Ok(read_sections(one, r)?))
            .collect(),
        many if many.len() == recordings.len() => many
            .iter()
            .zip(recordings)
            .map(|(path, r)| Ok(read_sections(path, r)?))
            .collect(),
        many => Err(Failure::new(
            USAGE,
            format!(
                "{} tables of --sections for {} recordings: give one for all or one for each",
                many.len(),
                recordings.len()
            ),
        )),
    }
}

fn finish(args: &Args, output: Option<Output>, outcome: &Outcome) -> Result<(), Failure> {
    let calibration = &outcome.calibration;
    let json = show::json(&calibration)?;
    show::warn_all(&calibration.warnings);
    if let Some(output) = output {
        output.write(json.as_bytes())?;
    }
    if args.json {
        show::print(&json)?;
    } else {
        let verdict = limits::text(&calibration.limits);
        let shares = calibration
            .prior
            .as_ref()
            .map_or_else(String::new, prior::text);
        let text = verdict + &tables::text(outcome) + &shares;
        show::print(&show::wrapped(&text))?;
    }
    gate(calibration)
}
