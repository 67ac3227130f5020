//! Arguments of `calibrate`.

use std::path::PathBuf;

use clap::ValueEnum;

use super::limits::LimitArgs;
use crate::commands::shared::inputs::{ClockArg, DetectorArgs, PlaceArgs, RecordingArgs};
use crate::commands::shared::leave_out::LeaveOutArgs;
use crate::commands::shared::pictures::PictureArgs;
use crate::output::Replace;
use crate::read_args::ReadArgs;

/// Calibrates both sensors from one or more recordings of one device.
///
/// Several recordings share scale factors and misalignments. Each has biases of its own where they
/// determine them almost for nothing, and where the data ask for it.
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
    /// The words of the call where they are not those of the process; no option.
    #[arg(skip)]
    pub call: Option<Vec<String>>,
    #[command(flatten)]
    pub(super) recordings: RecordingArgs,
    /// How to calibrate
    #[arg(long, value_enum, default_value_t = Method::Auto)]
    pub(super) method: Method,
    /// With `--method six-position`: correct by `I - M` as published, not by the inverse of `I + M`
    #[arg(long)]
    pub(super) first_order: bool,
    /// Effects to fit on top of the base models, such as gyro_g_sensitivity
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(super) effects: Vec<String>,
    /// What the device's type has in common, from `batch prior`: its information is added to that of the recording, its effects
    /// are fitted. The recording has to determine every parameter by itself
    #[arg(long, value_name = "FILE.json")]
    pub(super) prior: Option<PathBuf>,
    /// File that defines effects as expressions (TOML), to be named in `--effects`
    #[arg(long, value_name = "FILE.toml")]
    pub(super) effect_file: Vec<PathBuf>,
    /// Recording to take the gyroscope's turns from instead
    #[arg(long, value_name = "RECORDING")]
    pub(super) gyro_recording: Vec<PathBuf>,
    /// Frame of the accelerometer's matrix [default: triangular]
    #[arg(long, value_enum)]
    pub(super) frame: Option<FrameArg>,
    /// With `--method stepwise`: how the rate is integrated over a turn [default: exponential]
    #[arg(long, value_enum)]
    pub(super) integrator: Option<IntegratorArg>,
    /// Calibrate this sensor alone, whatever else was recorded
    #[arg(long, value_enum, value_name = "SENSOR")]
    pub(super) sensor: Option<SensorArg>,
    /// With `--method stepwise`: where the bias of a turn is taken from [default: adjacent]
    #[arg(long, value_enum)]
    pub(super) gyro_bias: Option<GyroBiasArg>,
    /// With `--method stepwise`: assume this sampling rate in turns instead of the time stamps, Hz (to reproduce published
    /// figures)
    #[arg(long, value_name = "HZ")]
    pub(super) nominal_rate: Option<f64>,
    /// By which clock the turns are integrated [default: auto]
    #[arg(long, value_enum)]
    pub(super) clock: Option<ClockArg>,
    /// Strength of the magnetic field of the place, µT: the magnetometer's scale is then absolute, else its `T` has
    /// determinant 1
    #[arg(long, value_name = "UT")]
    pub(super) field: Option<f64>,
    /// Table of static intervals picked by hand, for each recording in turn (columns `t0,t1` or
    /// `start,stop`)
    #[arg(long, value_name = "FILE")]
    pub(super) sections: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) leave_out: LeaveOutArgs,
    /// With `--method stepwise`: table of static means (columns `ax,ay,az`) for the accelerometer, instead of the recordings'
    #[arg(long, value_name = "FILE")]
    pub(super) static_means: Option<PathBuf>,
    /// Take the recordings to be of one device even where they disagree
    #[arg(long)]
    pub(super) force_device: bool,
    /// Write the calibration here
    #[arg(short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) replace: Replace,
    /// Print the calibration as JSON instead of tables
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) pictures: PictureArgs,
    #[command(flatten)]
    pub(super) limits: LimitArgs,
    #[command(flatten)]
    pub(super) place: PlaceArgs,
    #[command(flatten)]
    pub(super) detector: DetectorArgs,
    #[command(flatten)]
    pub(super) read: ReadArgs,
}

impl Args {
    /// Reads the recording so, where nothing else is said of that.
    pub fn read_as(&mut self, read: &ReadArgs) {
        if self.read.given().is_none() {
            self.read = read.clone();
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
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
pub(super) enum SensorArg {
    /// Needs static intervals and no turn
    Accelerometer,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum FrameArg {
    /// Upper triangular
    Triangular,
    /// Symmetric
    Symmetric,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum IntegratorArg {
    /// Exponential map of the mean of neighbouring samples
    Exponential,
    /// First order, unit length after each step
    FirstOrderNormalized,
    /// First order, as published
    FirstOrder,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum GyroBiasArg {
    /// Mean of the static intervals beside the turn
    Adjacent,
    /// First static interval of the recording, as published
    Initial,
}
