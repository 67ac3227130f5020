//! The arguments of `allan`.

use std::path::PathBuf;

use crate::commands::shared::inputs::numbers;
use crate::commands::shared::pictures::PictureArgs;
use crate::output::Replace;
use crate::read_args::ReadArgs;

/// Overlapping Allan deviation of a recording at rest, the five noise terms with their intervals,
/// and the initial static time they advise.
///
/// Only a rest has an Allan deviation: where the device moved, the longest rest is taken (with a
/// warning), and a recording without a rest of a minute is refused. A plain CSV is read as a stream: a
/// day at 200 Hz takes hardly more memory than a minute.
///
/// Samples that are missing singly or a few at a time are bridged, longer gaps are not; single samples far from their neighbours
/// are left out; steps, drifts, readings that stand still and readings coarser than their noise are said. Behind a filter
/// the terms are those of means that are long beside it. White noise and random walk are also given as the densities that filters take. Readings in counts have
/// their noise in counts.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint allan overnight.csv -o noise.json --report noise.html")]
pub struct Args {
    /// File or folder; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    pub(super) recording: PathBuf,
    /// Analyse this stretch, s; motion in it is then not looked for [default: all of it, or the
    /// longest rest]
    #[arg(long, value_name = "T0,T1", value_parser = numbers::<2>, allow_hyphen_values = true)]
    pub(super) rest: Option<[f64; 2]>,
    /// Write the noise terms and the curves here (JSON, SI units)
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
    pub(super) read: ReadArgs,
}
