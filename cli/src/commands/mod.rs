//! One file per command.

mod allan;
mod apply;
mod batch;
mod bias;
pub mod calibrate;
pub mod convert;
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

/// The help of the program: its commands by what a person wants.
pub const HELP: &str = "\
{about-with-newline}
{usage-heading} {usage}

Look at a recording
  info       what is in a file, and the command that calibrates it
  segment    when the device was still and when it turned
  allan      the noise of a device at rest
  evaluate   calibrations side by side on another recording
Record
  plan       which placements and turns to record next
  live       a session that is guided while it is recorded
Calibrate
  calibrate  the calibration of a device from its recordings
  discover   what the model of the sensors lacks
  demo       all of it on a simulated session, truth beside estimate
  simulate   a recording whose truth is known
  effects    the catalogue of effects
Use a calibration
  apply      corrects a recording
  bias       renews the biases, keeps everything else
  reckon     position from a recording, with each calibration
  export     writes a calibration as another tool reads it
  import     reads a calibration of another tool
  convert    writes a recording as plain CSV
  page       writes the page that calibrates in a browser
Many devices
  batch      calibrates many devices, in parts that can be resumed

`stillpoint COMMAND --help` explains a command.

Options:
{options}{after-help}";

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
