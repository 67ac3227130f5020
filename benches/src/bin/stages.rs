//! Where a calibration's time goes: stage by stage, with the floor that each is compared with.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin stages -- RECORDING [--repeat 20]
//! ```
//! Times are medians over the repetitions, per sample of the recording (both sensors at one stamp).

use std::path::PathBuf;
use std::process::ExitCode;

use calib::Recording;
use calib::recording::ReadOptions;
use clap::Parser;
use stillpoint_benches::stages::{print, run};

/// Time per sample of every stage of a calibration.
#[derive(Parser)]
struct Arguments {
    /// The recording.
    recording: PathBuf,
    /// Repetitions of each stage.
    #[arg(long, default_value_t = 20)]
    repeat: usize,
    /// Local gravity, m/s².
    #[arg(long, default_value_t = calib::calibrate::STANDARD_GRAVITY)]
    gravity: f64,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let recording = match Recording::read(&arguments.recording, &ReadOptions::default()) {
        Ok(recording) => recording,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(3);
        }
    };
    match run(&recording, arguments.gravity, arguments.repeat) {
        Ok(table) => {
            print(&table);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(4)
        }
    }
}
