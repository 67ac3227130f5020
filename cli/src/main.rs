//! The command line: argument parsing, tables, progress. A thin door to `stillpoint-calib`.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod commands;
mod exit;
mod interrupt;
mod output;
mod read_args;
mod report;
mod show;

use std::panic::AssertUnwindSafe;
use std::process::ExitCode;

use clap::Parser;

use exit::Failure;

/// Calibrates an accelerometer and a gyroscope from a recording made by hand: hold the device
/// still, turn it, hold it still again.
#[derive(Debug, Parser)]
#[command(
    name = "stillpoint",
    version,
    after_help = "\
Example:
  stillpoint demo                              a simulated session, its hidden effect discovered
  stillpoint calibrate phone.csv -o cal.json   the calibration of a recording
  stillpoint discover phone.csv                what its model lacks
  stillpoint apply cal.json run.csv -o corrected.csv"
)]
struct Cli {
    #[command(subcommand)]
    command: commands::Command,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    interrupt::install();
    let result = std::panic::catch_unwind(AssertUnwindSafe(|| commands::run(cli.command)));
    let failure = match result {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(failure)) => failure,
        Err(_) => Failure::bug(),
    };
    if !failure.message.is_empty() {
        eprintln!("stillpoint: {}", show::printable(&failure.message));
    }
    ExitCode::from(failure.code)
}
