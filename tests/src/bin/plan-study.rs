//! Predicted and found standard errors of a planned session, and those of placements in random order.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin plan-study -- --sessions 300
//! ```

use std::process::ExitCode;

use clap::Parser;
use stillpoint_tests::plan_study::{Row, study};

/// A planned session simulated many times over, against its prediction
#[derive(Debug, Parser)]
struct Args {
    /// Sessions of either kind
    #[arg(long, default_value_t = 300)]
    sessions: u64,
    /// Placements
    #[arg(long, default_value_t = 12)]
    placements: usize,
}

fn main() -> ExitCode {
    let args = Args::parse();
    match study(args.placements, args.sessions) {
        Ok(rows) => {
            println!(
                "{:16} {:>10} {:>10} {:>7} {:>10} {:>7} {:>5}",
                "parameter", "predicted", "found", "ratio", "random", "share", "n"
            );
            for row in &rows {
                print(row);
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
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
