//! `cargo run --release -p stillpoint-tests --bin magnetometer-study [SESSIONS]`: the errors of a magnetometer, and those of the
//! other sensors with and without it, beside the Cramér–Rao bound (150 sessions).

use rayon::iter::{IntoParallelIterator, ParallelIterator};
use sensor::Sensor;
use stillpoint_tests::magnetic::{Class, Record, run, summarise};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sessions = std::env::args().nth(1).map(|arg| arg.parse::<u64>());
    let sessions = sessions.transpose()?.unwrap_or(150);
    let records: Vec<Record> = (0..sessions)
        .into_par_iter()
        .map(|seed| run(seed).map_err(|e| format!("session {seed}: {e}")))
        .collect::<Result<_, _>>()?;
    println!(
        "{:36} number  covers | over the bound: rms  stated  rms, whole intervals | rms error  bound",
        "class"
    );
    for sensor in Sensor::ALL {
        for class in Class::ALL {
            for magnetometer in [true, false] {
                let Some(s) = summarise(&records, sensor, class, magnetometer) else {
                    continue;
                };
                let beside = if magnetometer { "with" } else { "without" };
                let name = format!("{} {class:?}, {beside}", sensor.prefix());
                println!(
                    "{name:36} {:6} {:5.1} % | {:19.3} {:7.3} {:21.3} | {:9.2e} {:9.2e}",
                    s.count,
                    100.0 * s.coverage,
                    s.over_bound[0],
                    s.over_bound[1],
                    s.over_bound_of_whole,
                    s.size[0],
                    s.size[1]
                );
            }
        }
    }
    Ok(())
}
