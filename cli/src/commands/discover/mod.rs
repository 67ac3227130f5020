//! `discover`: where simulation and data disagree, and the name of what is missing.

mod advice;
mod alternatives;
mod emit;
pub mod first_screen;
mod held_out;
mod page;
mod plots;
mod size;
mod tables;
mod text;
mod units;
mod verdict;
mod words;

use ::findings::Front;
use std::path::PathBuf;

use calib::Recording;
use calib::discover::{Discovery, Findings, Request, discover, noise_in, validate};
use calib::recording::figure;
use emit::Emit;
pub use page::{page, page_after};
pub use plots::{PLOTS, plots};
pub use text::text;
pub use verdict::verdict;
pub use words::gaps;

use crate::commands::calibrate::limits::{self, gate};
use crate::commands::shared::first_screen::say;
use crate::commands::shared::inputs::{
    ClockArg, DetectorArgs, PlaceArgs, RecordingArgs, as_paths, own_effects, read, spinner,
};
use crate::commands::shared::names::Names;
use crate::commands::shared::pictures::PictureArgs;
use crate::exit::{Failure, USAGE};
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;

/// Finds what the base models lack: simulates the recording from the fitted model, compares, names the missing
/// effect, adds it, fits again and shows the gap before and after.
///
/// A gap is the root of the reduced chi² of what is left: 1 is explained to the noise that was measured in
/// the recording itself. Effects that the recording cannot tell apart are named together, with the recording that
/// would. Nothing is named unless chance would show as much in one of a hundred recordings (`--alpha`).
///
/// For what no effect of the catalogue explains a formula may be proposed: a sum of a few products of specific
/// force, rate, angular acceleration, temperature and time, of sizes, or of what was before (the last turn, the last
/// change of force or temperature), that closes the gap on intervals that the fit did not see. It is no name: another
/// formula may do as well.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint discover morning/ -o findings.json --report findings.html
  stillpoint discover morning/ --validation evening/   does the name hold on another recording?
  stillpoint allan overnight.csv -o noise.json
  stillpoint discover morning/ --noise noise.json      noise of the biases known: drift is told from it sooner
  stillpoint discover morning/ --emit-effect gyro_swirl.rs    the proposed formula as the source of an effect
  stillpoint discover evening/ --effect-file mine.toml        is it an effect of my own?
  stillpoint discover unit_1/ unit_2/ unit_3/ --units         what do sensors of this type share?

An effect of one's own, mine.toml:
  [[definitions]]
  name = \"gyro_swirl\"
  sensor = \"gyroscope\"
  x = \"k * fy * fz\"
  parameters = [{ name = \"k\", unit = \"rad/s/(m/s^2)^2\", typical = 5e-6 }]")]
pub struct Args {
    #[command(flatten)]
    recordings: RecordingArgs,
    /// Another recording of the device: the gap before and after is shown on it, the calibration held
    #[arg(long, value_name = "RECORDING")]
    validation: Option<PathBuf>,
    /// Chance of any false claim about a device that lacks nothing, over the whole catalogue
    #[arg(long, value_name = "P", default_value_t = 0.01)]
    alpha: f64,
    /// Take random walk and bias instability from this file of `allan` [default: estimated]
    #[arg(long, value_name = "FILE")]
    noise: Option<PathBuf>,
    /// Estimate flicker (1/f) noise of the biases too: fewer false claims on cheap sensors, but effects that differ from
    /// placement to placement may pass for it
    #[arg(long, conflicts_with = "noise")]
    flicker: bool,
    /// File that defines effects as expressions (TOML): they join the catalogue of this run
    #[arg(long, value_name = "FILE.toml")]
    effect_file: Vec<PathBuf>,
    /// Each recording is that of another unit of one type: the evidence of all is added up, calibration, noise and the size
    /// of what is named are each unit's own, and whether the sizes agree is said
    #[arg(long, conflicts_with_all = ["validation", "emit_effect", "noise", "force_device", "report", "plots"])]
    units: bool,
    /// Take recordings for those of one device even where their scale factors differ
    #[arg(long)]
    force_device: bool,
    /// Write the proposed formula here, as the source of an effect that bears the file's name
    #[arg(long, value_name = "FILE.rs")]
    emit_effect: Option<PathBuf>,
    /// By which clock the turns are integrated
    #[arg(long, value_enum, default_value_t = ClockArg::Auto)]
    clock: ClockArg,
    /// Write the findings here
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print the findings as JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    place: PlaceArgs,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let mut inputs = args.recordings.paths();
    if inputs.is_empty() {
        return Err(Failure::new(
            USAGE,
            "no recording given: name a file or a folder",
        ));
    }
    let files = args.validation.iter().chain(&args.noise);
    inputs.extend(files.chain(&args.effect_file).cloned());
    held_out::refuse_same_path(args.validation.as_deref(), &args.recordings.paths())?;
    let mut request = request(args)?;
    let output = match &args.output {
        Some(path) => Some(Output::claim(path, args.replace, &as_paths(&inputs))?),
        None => None,
    };
    let emit = match &args.emit_effect {
        Some(path) => {
            let taken = &request.catalogue;
            Some(Emit::claim(path, args.replace, &as_paths(&inputs), taken)?)
        }
        None => None,
    };
    let pictures = args
        .pictures
        .claim(&PLOTS, args.replace, &as_paths(&inputs))?;
    args.replace.end_if_all_exist()?;
    if let Some(path) = &args.noise {
        let given = noise_in(path)?;
        given.notes.iter().for_each(|note| show::warn(note));
        request.noise = Some(given.noise);
    }
    let recordings = args.recordings.read(&args.read)?;
    let validation = args.validation.as_ref();
    let validation = validation.map(|path| read(path, &args.read)).transpose()?;
    let read = recordings.iter().chain(&validation);
    let remarks = read.flat_map(|r| r.warnings.texts(Front::CommandLine));
    let remarks: Vec<String> = remarks.collect();
    held_out::refuse_same_data(validation.as_ref(), &recordings)?;
    if args.units {
        return of_units(args, &recordings, &request, output);
    }
    let found = look(&recordings, validation.as_ref(), &request);
    // Where there is no discovery they may explain why.
    let mut discovery = found.inspect_err(|_| match args.json {
        true => show::warn_all(&remarks),
        false => say(&remarks),
    })?;
    limits::state(&mut discovery.findings.calibration, None);
    let findings = &discovery.findings;
    let json = json(findings)?;
    if let Some(output) = output {
        output.write(json.as_bytes())?;
    }
    if let Some(emit) = emit {
        emit.write(findings)?;
    }
    if pictures.wanted() {
        let plots = plots(&discovery);
        pictures.write(&plots, &page(&discovery, &recordings, &request, &plots)?)?;
    }
    if args.json {
        let warnings = findings.calibration.warnings.texts(Front::CommandLine);
        show::warn_all(&[remarks, warnings].concat());
        show::print(&json)?;
    } else {
        let of_all = recordings.iter().chain(&validation);
        let screen = first_screen::screen(args, findings, &recordings, &remarks);
        screen.show(|| text(&discovery, &Names::of(of_all)))?;
    }
    gate(&findings.calibration)
}

/// What several units of one type share.
fn of_units(
    args: &Args,
    recordings: &[Recording],
    request: &Request,
    output: Option<Output>,
) -> Result<(), Failure> {
    let findings = units::look(recordings, request)?;
    let remarks = units::warnings(&findings);
    let json = show::json(&findings)?;
    if let Some(output) = output {
        output.write(json.as_bytes())?;
    }
    if args.json {
        show::warn_all(&remarks);
        show::print(&json)?;
    } else {
        units::screen(args.output.as_deref(), &findings, remarks)
            .show(|| units::text(&findings))?;
    }
    units::gate(&findings)
}

fn request(args: &Args) -> Result<Request, Failure> {
    let gravity = args.place.gravity()?;
    if !(args.alpha > 0.0 && args.alpha <= 0.5) {
        return Err(Failure::new(
            USAGE,
            format!(
                "--alpha {}: a chance above 0 and at most 0.5 expected; 0.01 is one false claim in a hundred \
                 recordings",
                figure(args.alpha)
            ),
        ));
    }
    let (detector, choose_multiplier) = args.detector.detector()?;
    let mut request = Request {
        alpha: args.alpha,
        force_device: args.force_device,
        latitude: args.place.latitude,
        clock: args.clock.mode(),
        flicker: args.flicker,
        detector,
        choose_multiplier,
        gravity_source: gravity.source,
        ..Request::new(gravity.value)
    };
    request.catalogue.extend(own_effects(&args.effect_file)?);
    Ok(request)
}

/// The discovery, with the gap on the validation recording.
pub fn look(
    recordings: &[Recording],
    validation: Option<&Recording>,
    request: &Request,
) -> Result<Discovery, Failure> {
    let spinner = spinner("looking for what is missing");
    let mut discovery = discover(recordings, request)?;
    if let Some(recording) = validation {
        spinner.set_message("comparing with the validation recording");
        discovery.findings.validation = validate(recording, request, &discovery)?;
    }
    spinner.finish_and_clear();
    Ok(discovery)
}

/// The document that `-o` and `--json` give.
pub fn json(findings: &Findings) -> Result<String, Failure> {
    show::json(findings)
}
