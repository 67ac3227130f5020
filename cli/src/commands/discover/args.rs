//! The arguments of `discover`.

use std::path::PathBuf;

use crate::commands::shared::inputs::{ClockArg, DetectorArgs, PlaceArgs, RecordingArgs};
use crate::commands::shared::leave_out::LeaveOutArgs;
use crate::commands::shared::pictures::PictureArgs;
use crate::output::Replace;
use crate::read_args::ReadArgs;

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
    pub(super) recordings: RecordingArgs,
    /// Another recording of the device: the gap before and after is shown on it, the calibration held
    #[arg(long, value_name = "RECORDING")]
    pub(super) validation: Option<PathBuf>,
    /// Chance of any false claim about a device that lacks nothing, over the whole catalogue
    #[arg(long, value_name = "P", default_value_t = 0.01)]
    pub(super) alpha: f64,
    /// Take random walk and bias instability from this file of `allan` [default: estimated]
    #[arg(long, value_name = "FILE")]
    pub(super) noise: Option<PathBuf>,
    /// Estimate flicker (1/f) noise of the biases too: fewer false claims on cheap sensors, but effects that differ from
    /// placement to placement may pass for it
    #[arg(long, conflicts_with = "noise")]
    pub(super) flicker: bool,
    /// File that defines effects as expressions (TOML): they join the catalogue of this run
    #[arg(long, value_name = "FILE.toml")]
    pub(super) effect_file: Vec<PathBuf>,
    /// Each recording is that of another unit of one type: the evidence of all is added up, calibration, noise and the size
    /// of what is named are each unit's own, and whether the sizes agree is said
    #[arg(long, conflicts_with_all = ["validation", "emit_effect", "noise", "force_device", "leave_out", "report", "plots"])]
    pub(super) units: bool,
    #[command(flatten)]
    pub(super) leave_out: LeaveOutArgs,
    /// Take recordings for those of one device even where their scale factors differ
    #[arg(long)]
    pub(super) force_device: bool,
    /// Write the proposed formula here, as the source of an effect that bears the file's name
    #[arg(long, value_name = "FILE.rs")]
    pub(super) emit_effect: Option<PathBuf>,
    /// By which clock the turns are integrated
    #[arg(long, value_enum, default_value_t = ClockArg::Auto)]
    pub(super) clock: ClockArg,
    /// Write the findings here
    #[arg(short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) replace: Replace,
    /// Print the findings as JSON instead of tables
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) pictures: PictureArgs,
    #[command(flatten)]
    pub(super) place: PlaceArgs,
    #[command(flatten)]
    pub(super) detector: DetectorArgs,
    #[command(flatten)]
    pub(super) read: ReadArgs,
}
