//! Bundle adjustments (BAL) and pose graphs (g2o) by apex-solver and factrs, on one thread.
//!
//! ```text
//! rust-peers apex bal FILE free|fixed sparse|dense|implicit     rust-peers apex g2o FILE
//! rust-peers factrs bal FILE free|fixed                         rust-peers factrs g2o FILE
//! ```
//! Prints one line as `graph-table` does: name, cost at the start and the end (½ ‖r‖²), steps, seconds
//! of the processor from the problem in memory to the solution, largest memory in MB.
//! `RAYON_NUM_THREADS=1` is to be set: both crates take all processors otherwise.

mod apex;
mod bal;
mod camera;
mod factrs_peer;

use std::error::Error;
use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

/// What a peer found.
pub struct Outcome {
    pub start: f64,
    pub cost: f64,
    pub steps: usize,
    pub seconds: f64,
    pub ending: String,
}

/// Time of this process on processors: of all its threads.
pub fn processor_seconds() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    Duration::try_from(now).unwrap_or_default().as_secs_f64()
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let found = match words[..] {
        ["apex", "bal", file, gauge, method] => apex::bundle(file, gauge == "fixed", method)?,
        ["apex", "g2o", file] => apex::poses(file)?,
        ["factrs", "bal", file, gauge] => factrs_peer::bundle(file, gauge == "fixed")?,
        ["factrs", "g2o", file] => factrs_peer::poses(file),
        _ => return Err("see the first lines of main.rs".into()),
    };
    println!(
        "{} {:.12e} {:.12e} {} {:.6} {:.1} {}",
        words[0],
        found.start,
        found.cost,
        found.steps,
        found.seconds,
        largest_memory(),
        found.ending
    );
    Ok(())
}

/// Largest memory of this process in MB.
fn largest_memory() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}
