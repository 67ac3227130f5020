//! The command line: argument parsing, tables, progress. A thin door to `stillpoint-calib`.
//!
//! A library, so that the program of this package and the command of the Python package are the same.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod call;
mod commands;
mod exit;
mod interrupt;
#[cfg(doc)]
pub mod manual;
mod output;
mod pages;
mod quoted;
mod read_args;
mod report;
mod show;
mod steps;
mod terminal;
mod threads;
#[doc(hidden)]
pub mod without_effect;

pub use commands::shared::figures;

use std::ffi::{OsStr, OsString};
use std::panic::AssertUnwindSafe;
use std::path::Path;

use clap::{CommandFactory, FromArgMatches, Parser};

use exit::Failure;

/// Calibrates an accelerometer and a gyroscope from a recording made by hand: hold the device
/// still, turn it, hold it still again.
#[derive(Debug, Parser)]
#[command(
    name = "stillpoint",
    version,
    max_term_width = terminal::COLUMNS,
    help_template = commands::HELP,
    after_help = "\
Example:
  stillpoint demo                              a simulated session, its hidden effect discovered
  stillpoint phone.csv                         what is in a file, and what to do
  stillpoint calibrate phone.csv -o cal.json   the calibration of a recording
  stillpoint discover phone.csv                what its model lacks
  stillpoint apply cal.json run.csv -o corrected.csv"
)]
struct Cli {
    #[command(flatten)]
    terminal: terminal::TerminalArgs,
    #[command(subcommand)]
    command: commands::Command,
}

/// The command line, for tests that go over it.
#[doc(hidden)]
pub fn command() -> clap::Command {
    let mut command = Cli::command();
    command.build();
    command
}

/// Runs the command in `args`, the program's name first, to its end, and gives its exit status. The process is the
/// command's from then on: its signals and its threads.
///
/// # Examples
/// ```
/// assert_eq!(stillpoint_cli::run(["stillpoint".into(), "--version".into()]), 0);
/// ```
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    interrupt::install();
    threads::install();
    let words: Vec<OsString> = args.into_iter().collect();
    call::remember(&words);
    let cli = match parsed(words) {
        Ok(cli) => cli,
        // Help and version go to standard output.
        Err(error) if !error.use_stderr() => {
            return match show::printed(error.print()) {
                Ok(()) => 0,
                Err(failure) => ended(&failure),
            };
        }
        Err(error) => return ended(&wrong_call(&error)),
    };
    cli.terminal.install();
    let result = std::panic::catch_unwind(AssertUnwindSafe(|| {
        commands::run(cli.command, Cli::command)
    }));
    match result {
        Ok(Ok(())) => 0,
        Ok(Err(failure)) => ended(&failure),
        Err(_) => ended(&Failure::bug()),
    }
}

/// The call; a file alone is one to look at.
fn parsed(mut words: Vec<OsString>) -> Result<Cli, clap::Error> {
    let colour = terminal::Colour::in_call(&words).choice();
    let mut command = Cli::command().color(colour);
    if let [_, file] = words.as_slice()
        && !file.is_empty()
        && command.find_subcommand(file).is_none()
        && is_file(file)
    {
        words.insert(1, "info".into());
    }
    let matches = command.try_get_matches_from_mut(words)?;
    Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// Returns true if a word is a file to look at. Of one that the system does not tell of, `info` says why.
fn is_file(word: &OsStr) -> bool {
    let is_option = word.as_encoded_bytes().starts_with(b"-");
    Path::new(word).try_exists().unwrap_or(!is_option)
}

fn ended(failure: &Failure) -> u8 {
    interrupt::give_way();
    // A thread that waits for what never comes has a file that is empty.
    ::output::leftovers().remove();
    show::failure(failure);
    failure.code
}

/// Builds the failure for arguments that the parser refuses.
fn wrong_call(error: &clap::Error) -> Failure {
    let message = error.render().to_string();
    let message = message.trim().trim_start_matches("error: ");
    Failure::usage(message)
}
