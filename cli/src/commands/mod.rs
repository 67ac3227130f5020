//! One file per command.

mod apply;
mod calibrate;
mod inputs;
mod segment;

use clap::Subcommand;

use crate::exit::Failure;

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    Calibrate(Box<calibrate::Args>),
    Segment(segment::Args),
    Apply(apply::Args),
}

/// Runs a command.
pub fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Calibrate(args) => calibrate::run(&args),
        Command::Segment(args) => segment::run(&args),
        Command::Apply(args) => apply::run(&args),
    }
}
