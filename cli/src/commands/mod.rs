//! One file per command.

mod allan;
mod apply;
mod batch;
mod bias;
pub mod calibrate;
mod convert;
mod demo;
mod discover;
mod effects;
mod evaluate;
mod export;
mod generate;
mod import;
mod info;
mod live;
mod page;
mod plan;
mod reckon;
mod segment;
pub mod shared;
mod simulate;

use clap::Subcommand;

use crate::exit::Failure;

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    Demo(demo::Args),
    Info(info::Args),
    Calibrate(Box<calibrate::Args>),
    Batch(Box<batch::Args>),
    Live(Box<live::Args>),
    Segment(segment::Args),
    Apply(apply::Args),
    Convert(convert::Args),
    Allan(allan::Args),
    Bias(bias::Args),
    Reckon(Box<reckon::Args>),
    Evaluate(evaluate::Args),
    Simulate(simulate::Args),
    Discover(Box<discover::Args>),
    Effects(effects::Args),
    Plan(Box<plan::Args>),
    Export(Box<export::Args>),
    Import(import::Args),
    Page(page::Args),
    #[command(hide = true)]
    Generate(generate::Args),
}

/// Runs a command.
pub fn run(command: Command, whole: fn() -> clap::Command) -> Result<(), Failure> {
    match command {
        Command::Demo(args) => demo::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Calibrate(args) => calibrate::run(&args),
        Command::Batch(args) => batch::run_command(&args),
        Command::Live(args) => live::run(&args),
        Command::Segment(args) => segment::run(&args),
        Command::Apply(args) => apply::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Allan(args) => allan::run(&args),
        Command::Bias(args) => bias::run(&args),
        Command::Reckon(args) => reckon::run(&args),
        Command::Evaluate(args) => evaluate::run(&args),
        Command::Simulate(args) => simulate::run(&args),
        Command::Discover(args) => discover::run(&args),
        Command::Effects(args) => effects::run(&args),
        Command::Plan(args) => plan::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Import(args) => import::run(&args),
        Command::Page(args) => page::run(&args),
        Command::Generate(args) => generate::run(&args, whole()),
    }
}
