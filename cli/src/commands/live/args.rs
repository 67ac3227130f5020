//! The arguments of `live`.

use std::path::PathBuf;

use crate::commands::shared::inputs::PlaceArgs;
use crate::output::Replace;
use crate::read_args::ReadArgs;

/// Guides through a recording while it is made, and calibrates it.
///
/// Says when the device lies still for long enough, where to turn it next, what is wrong (in the hand, shaken, too fast,
/// paused) and how well the parameters are known so far. What comes is written as it comes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
phyphox: open an experiment with Accelerometer and Gyroscope (+, Add simple
experiment; not Linear acceleration), then ⋮, Allow remote access. The address
is shown below. Serial ports: a line for each sample, in any layout that
`calibrate` reads.

Example:
  stillpoint live http://192.168.0.12:8080 --gravity 9.8055 -o cal.json
  stillpoint live 192.168.0.12:8080 --web      the same, with a page to look at
  stillpoint live /dev/ttyUSB0 --baud 115200 -- --method joint
  logger | stillpoint live - --out session/")]
pub struct Args {
    /// Address of phyphox's remote access, serial port, file that grows, or `-` for standard input
    pub(super) source: String,
    /// Show the session as a page on 127.0.0.1
    #[arg(long)]
    pub(super) web: bool,
    /// Folder for what comes, new or empty [default: live-1, or the next number that is free]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Write the calibration here
    #[arg(short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Placements to aim at
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(9..=60))]
    pub(super) placements: u16,
    /// How long each placement lies still, s
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    pub(super) hold: f64,
    /// Speed of a serial port, bits per second
    #[arg(long, value_name = "BAUD", default_value_t = 115_200)]
    pub(super) baud: u32,
    /// Time between two requests, s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.25)]
    pub(super) poll: f64,
    /// Write instructions and events here as they come, a JSON document a line
    #[arg(long, value_name = "FILE")]
    pub(super) events: Option<PathBuf>,
    /// Print the calibration as JSON instead of tables
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) replace: Replace,
    #[command(flatten)]
    pub(super) place: PlaceArgs,
    #[command(flatten)]
    pub(super) read: ReadArgs,
    /// Options of `calibrate` for the recording, after `--`
    #[arg(last = true, value_name = "CALIBRATE OPTIONS")]
    pub(super) calibrate: Vec<String>,
}
