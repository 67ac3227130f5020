//! Predicted and found standard errors of a planned session, and those of placements in random order.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin plan-study -- --sessions 300
//! cargo run --release -p stillpoint-tests --bin plan-study -- --after 5,6,8,10
//! ```
//!
//! With `--after` it cuts the phone's recording after so many placements, follows what the plan asks for next in simulation,
//! and holds the number against the fewest of an exhaustive search.

use std::process::ExitCode;

use clap::Parser;
use stillpoint_tests::phone;
use stillpoint_tests::plan_next::follow;
use stillpoint_tests::plan_study::{Row, study};

/// Gravity where the phone was, m/s².
const GRAVITY: f64 = 9.7951;

/// A planned session simulated many times over, against its prediction
#[derive(Debug, Parser)]
struct Args {
    /// Sessions of either kind
    #[arg(long, default_value_t = 300)]
    sessions: u64,
    /// Placements
    #[arg(long, default_value_t = 12)]
    placements: usize,
    /// Placements of the phone's recording after which the plan is asked
    #[arg(long, value_delimiter = ',', value_name = "N,..", conflicts_with_all = ["sessions", "placements"])]
    after: Vec<usize>,
}

fn main() -> ExitCode {
    let args = Args::parse();
    if !args.after.is_empty() {
        return after(&args.after);
    }
    match study(args.placements, args.sessions) {
        Ok(found) => {
            println!(
                "{:16} {:>10} {:>10} {:>7} {:>10} {:>7} {:>5}",
                "parameter", "predicted", "found", "ratio", "random", "share", "n"
            );
            for row in &found.rows {
                print(row);
            }
            println!(
                "cut off either end of a rest: {:.2} s counted on, {:.2} s found",
                found.cut_predicted, found.cut_found
            );
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Fails where a parameter stays open or two placements more than the fewest are asked for.
fn after(counts: &[usize]) -> ExitCode {
    if phone::folder().is_none() {
        return ExitCode::SUCCESS;
    }
    println!(
        "{:>5} {:>7} {:>6} {:>11} {:>12} {:>12}",
        "after", "advised", "fewest", "unobserved", "accel. ppm", "gyro. ppm"
    );
    let mut code = ExitCode::SUCCESS;
    for count in counts {
        let recording = phone::recording("multi_position/rec_1");
        match recording.and_then(|recording| follow(&recording, *count, GRAVITY)) {
            Ok(found) => {
                let [force, rate] = found.largest.map(|e| 1e6 * e);
                println!(
                    "{:>5} {:>7} {:>6} {:>11} {force:>12.0} {rate:>12.0}",
                    found.after,
                    found.advised,
                    found.fewest,
                    found.unobservable.len()
                );
                if !found.is_as_asked() {
                    code = ExitCode::FAILURE;
                }
            }
            Err(error) => {
                eprintln!("after {count}: {error}");
                code = ExitCode::FAILURE;
            }
        }
    }
    code
}

fn print(row: &Row) {
    println!(
        "{:16} {:10.3e} {:10.3e} {:7.3} {:10.3e} {:7.3} {:>5}",
        row.name,
        row.predicted,
        row.found,
        row.found / row.predicted,
        row.random,
        row.found / row.random,
        row.sessions
    );
}
