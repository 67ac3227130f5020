//! `simulate`: a recording with known truth.

use std::path::PathBuf;

use calib::simulate::{EXAMPLE, Simulation, Spec};

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
  stillpoint calibrate session/

Conditions and their keys (--example prints all keys with units):
  uneven sampling, stamps right      [gyroscope.clock] sampling_jitter
  noise and rounding of stamps       [gyroscope.clock] jitter, resolution
  two clocks                         [gyroscope.clock] rate, offset, rate_error
  a clock that changes               [[faults]] clock_change
  lost samples                       [gyroscope.clock] lost, [[faults]] gap, lost
  held or interpolated samples       [gyroscope] resampled
  noise that is not white            [gyroscope] low_pass, correlation
  Laplace noise, spikes              [gyroscope] distribution, spikes
  flicker, walk, thermal drift       [gyroscope] instability, random_walk,
                                     thermal_drift
  coarse steps, dead zone, range     [gyroscope] step, dead_zone, range
  hand: tremor, sway                 [unsteady] tremor, sway
  constant yaw, settling             [unsteady] yaw, settling
  a table that vibrates              [vibration] rms, frequency, rocking
  knocks, sampling at an instant     [motion.hand_held] shock, knocks; sampling
  short, few, slow                   [motion.hand_held] rest, placements, turn
  the earth's rotation               latitude")]
pub struct Args {
    /// What to simulate (TOML)
    #[arg(value_name = "SPEC.toml", required_unless_present = "example")]
    spec: Option<PathBuf>,
    /// Folder to write to
    #[arg(short, value_name = "DIR", required_unless_present = "example")]
    output: Option<PathBuf>,
    /// Print a specification with every key, its unit and its meaning
    #[arg(long)]
    example: bool,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let (Some(spec), Some(output), false) = (&args.spec, &args.output, args.example) else {
        show::print(EXAMPLE.trim_end())?;
        return Ok(());
    };
    let name = spec.display().to_string();
    let text =
        std::fs::read_to_string(spec).map_err(|e| Failure::new(INPUT, format!("{name}: {e}")))?;
    let simulation = Simulation::new(&Spec::from_toml(&text, &name)?)?;
    let progress = spinner("simulating");
    let truth = simulation.write(output, args.force)?;
    progress.finish_and_clear();
    show::print(&format!(
        "{}: {:.0} s, {} placements, seed {}, effects: {}",
        output.display(),
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
