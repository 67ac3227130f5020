//! `simulate`: a recording with known truth.

use std::path::PathBuf;

use calib::simulate::{EXAMPLE, FILES, Simulation, Spec};
use sensor::Sensor;

use crate::commands::shared::inputs::spinner;
use crate::exit::{Failure, USAGE};
use crate::output::{Filled, Folder, Output, Replace};
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
  the earth's rotation               latitude
  a magnetometer, iron nearby        [magnetic_field] strength, inclination,
                                     unevenness; [magnetometer]")]
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
    #[command(flatten)]
    replace: Replace,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let (Some(spec), Some(folder), false) = (&args.spec, &args.output, args.example) else {
        return show::print(EXAMPLE.trim_end());
    };
    let text = calib::read_text(spec)?;
    let read = Spec::from_toml(&text, &show::path(spec)).map_err(wrong_call)?;
    let simulation = Simulation::new(&read).map_err(wrong_call)?;
    let _folder = Folder::make(folder)?;
    let claim = |name: &str| {
        let inputs = [spec.as_path()];
        Output::claim_in(folder, name, args.replace, &inputs)
    };
    let sensors = Sensor::ALL.into_iter().zip(FILES);
    let sensors = sensors.filter(|(sensor, _)| simulation.has(*sensor));
    let readings: Vec<(Sensor, Output)> = sensors
        .map(|(sensor, name)| Ok((sensor, claim(name)?)))
        .collect::<Result<_, Failure>>()?;
    let json = claim(FILES[3])?;
    args.replace.end_if_all_exist()?;
    let progress = spinner("simulating");
    let mut files = simulation.files();
    let mut filled = Vec::new();
    for (sensor, output) in readings {
        filled.push(output.fill(|out| files.readings(sensor, out))?);
    }
    let truth = files.truth();
    let document = show::json(&truth)?;
    filled.push(json.fill(|out| out.write_all(document.as_bytes()))?);
    filled.into_iter().try_for_each(Filled::publish)?;
    progress.finish_and_clear();
    show::print(&show::wrapped(&format!(
        "{}: {:.0} s, {} placements, seed {}, effects: {}",
        show::path(folder),
        simulation.duration(),
        truth.static_intervals.len(),
        truth.spec.seed,
        if truth.effects.is_empty() {
            "none".into()
        } else {
            truth.effects.join(", ")
        }
    )))?;
    Ok(())
}

/// A spec is part of the call, as a configuration is: what is wrong with it is status 2.
fn wrong_call(error: calib::Error) -> Failure {
    Failure {
        code: USAGE,
        kind: "usage",
        ..Failure::from(error)
    }
}
