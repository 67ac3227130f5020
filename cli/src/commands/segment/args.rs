//! The arguments of `segment`.

use std::path::PathBuf;

use crate::commands::shared::inputs::{DetectorArgs, PlaceArgs};
use crate::commands::shared::pictures::PictureArgs;
use crate::output::Replace;
use crate::read_args::ReadArgs;

/// Shows when the device was still and when it turned.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint segment phone.csv --min-static 5")]
pub struct Args {
    /// File or folder; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    pub(super) recording: PathBuf,
    /// Write the intervals here (JSON)
    #[arg(short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) replace: Replace,
    /// Print JSON instead of tables
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
