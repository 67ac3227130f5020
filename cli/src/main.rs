//! The command line: argument parsing, tables, progress. A thin door to `stillpoint-calib`.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod commands;
mod exit;
mod interrupt;
#[cfg(doc)]
pub mod manual;
mod output;
mod read_args;
mod report;
mod show;
mod threads;

use std::panic::AssertUnwindSafe;
use std::process::ExitCode;

use clap::Parser;

use exit::{Failure, USAGE};

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
    interrupt::install();
    threads::install();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if !error.use_stderr() => error.exit(),
        Err(error) => return ended(&wrong_call(&error)),
    };
    let result = std::panic::catch_unwind(AssertUnwindSafe(|| commands::run(cli.command)));
    match result {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => ended(&failure),
        Err(_) => ended(&Failure::bug()),
    }
}

fn ended(failure: &Failure) -> ExitCode {
    interrupt::give_way();
    show::failure(failure);
    ExitCode::from(failure.code)
}

/// What the parser of arguments refuses.
fn wrong_call(error: &clap::Error) -> Failure {
    let message = error.render().to_string();
    let message = message.trim().trim_start_matches("error: ");
    Failure::new(USAGE, message)
}
