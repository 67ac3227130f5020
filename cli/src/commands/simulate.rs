//! `simulate`: a recording with known truth.

use std::path::PathBuf;

use calib::simulate::{Simulation, Spec};

use super::inputs::spinner;
use crate::exit::{Failure, INPUT};
use crate::show;

/// Simulates a recording with known truth: motion, sensor errors, noise, effects, faults.
///
/// Writes `acc.csv`, `gyro.csv` and `truth.json` into a folder. The same spec gives the same bytes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example of a SPEC.toml:
  seed = 7
  grade = \"consumer\"
  [motion.hand_held]
  placements = 30
  [effects.gyro_g_sensitivity]
  size = 1.0

  stillpoint simulate SPEC.toml -o session/
  stillpoint calibrate session/")]
pub struct Args {
    /// What to simulate (TOML)
    #[arg(value_name = "SPEC.toml")]
    spec: PathBuf,
    /// Folder to write to
    #[arg(short, value_name = "DIR")]
    output: PathBuf,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let name = args.spec.display().to_string();
    let text = std::fs::read_to_string(&args.spec)
        .map_err(|e| Failure::new(INPUT, format!("{name}: {e}")))?;
    let simulation = Simulation::new(&Spec::from_toml(&text, &name)?)?;
    let progress = spinner("simulating");
    let truth = simulation.write(&args.output, args.force)?;
    progress.finish_and_clear();
    show::print(&format!(
        "{}: {:.0} s, {} placements, seed {}, effects: {}",
        args.output.display(),
        simulation.duration(),
        truth.static_intervals.len(),
        truth.spec.seed,
        if truth.effects.is_empty() {
            "none".into()
        } else {
            truth.effects.join(", ")
        }
    ))?;
    Ok(())
}
