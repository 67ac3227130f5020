//! Where a calibration's time goes: stage by stage, with the floor that each is compared with.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin stages -- RECORDING [--repeat 20] [--read]
//! ```
//! Times are medians over the repetitions, per sample of the recording (both sensors at one stamp).

use std::path::PathBuf;
use std::process::ExitCode;

use calib::recording::ReadOptions;
use calib::{Error, Recording};
use clap::Parser;
use stillpoint_benches::stages::{Stage, print, read, run};

/// Time per sample of every stage of a calibration.
#[derive(Parser)]
struct Arguments {
    /// The recording.
    recording: PathBuf,
    /// Repetitions of each stage.
    #[arg(long, default_value_t = 20)]
    repeat: usize,
    /// Time the reading only, of any file of readings.
    #[arg(long)]
    read: bool,
    /// Local gravity, m/s².
    #[arg(long, default_value_t = calib::calibrate::STANDARD_GRAVITY)]
    gravity: f64,
}

fn main() -> ExitCode {
    match table(&Arguments::parse()) {
        Ok(table) => {
            print(&table);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn table(arguments: &Arguments) -> Result<Vec<Stage>, Error> {
    let mut table = vec![read(&arguments.recording, arguments.repeat)?];
    if !arguments.read {
        let recording = Recording::read(&arguments.recording, &ReadOptions::default())?;
        table.extend(run(&recording, arguments.gravity, arguments.repeat)?);
    }
    Ok(table)
}
