//! Cost against length: a stepwise calibration of a session repeated 1, 10 and 100 times end to end.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin scaling [-- --repeat 3]
//! ```
//! Each length runs in a process of its own. Memory is what a calibration holds at its peak besides the
//! recording, counted by the allocator; the least of the repeated runs.

use std::process::{Command, ExitCode};

use calib::calibrate::{Request, calibrate};
use calib::recording::Stream;
use calib::simulate::Spec;
use calib::{Error, Recording};
use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use peak_alloc::PeakAlloc;
use stillpoint_benches::stages::median;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Time and memory per sample of a calibration against the length of the recording.
#[derive(Parser)]
struct Arguments {
    /// Calibrations per length; the median counts.
    #[arg(long, default_value_t = 3)]
    repeat: usize,
    /// Runs one length and prints samples, seconds and bytes.
    #[arg(long)]
    length: Option<usize>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match arguments.length {
        Some(length) => one(length, arguments.repeat),
        None => all(arguments.repeat).map(|table| table.to_string()),
    };
    match outcome {
        Ok(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Samples, seconds, and bytes at the peak beyond those before the calibration.
fn one(length: usize, repeat: usize) -> Result<String, Error> {
    let session = Spec::hand_held(1).run()?;
    let request = Request {
        gravity: session.truth.spec.gravity,
        ..Request::default()
    };
    let recordings = [repeated(&session.recording, length)];
    let samples = recordings[0].gyroscope.as_ref().map_or(0, Stream::len);
    // The first calibration also buys what threads keep for good: 4 MiB of work space for products of
    // matrices each.
    calibrate(&recordings, &[], &request)?;
    let mut bytes = usize::MAX;
    let seconds = median(repeat, || {
        MEMORY.reset_peak_usage();
        let before = MEMORY.current_usage();
        let outcome = calibrate(&recordings, &[], &request);
        bytes = bytes.min(MEMORY.peak_usage().saturating_sub(before));
        outcome
    });
    Ok(format!("{samples} {seconds} {bytes}"))
}

/// A table of all lengths.
fn all(repeat: usize) -> Result<Table, Error> {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header([
        "length",
        "samples",
        "ms",
        "ns per sample",
        "bytes per sample",
    ]);
    let this = std::env::current_exe().map_err(|e| Error::Input(e.to_string()))?;
    for length in [1, 10, 100] {
        let output = Command::new(&this)
            .args(["--length", &length.to_string()])
            .args(["--repeat", &repeat.to_string()])
            .output()
            .map_err(|e| Error::Input(e.to_string()))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let numbers: Vec<f64> = text
            .split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect();
        let [samples, seconds, bytes] = numbers[..] else {
            let why = String::from_utf8_lossy(&output.stderr);
            return Err(Error::Input(format!("{length} times: {why}")));
        };
        table.add_row([
            format!("{length} ×"),
            format!("{samples:.0}"),
            format!("{:.2}", 1e3 * seconds),
            format!("{:.1}", 1e9 * seconds / samples),
            format!("{:.0}", bytes / samples),
        ]);
    }
    Ok(table)
}

/// The recording end to end, `times` over.
fn repeated(recording: &Recording, times: usize) -> Recording {
    let stream = |stream: &Option<Stream>| stream.as_ref().map(|s| end_to_end(s, times));
    Recording {
        accelerometer: stream(&recording.accelerometer),
        gyroscope: stream(&recording.gyroscope),
        temperature: None,
        ..recording.clone()
    }
}

fn end_to_end(stream: &Stream, times: usize) -> Stream {
    let step = stream.median_step().unwrap_or(0.01);
    let (first, last) = (
        stream.t.first().copied().unwrap_or(0.0),
        stream.t.last().copied().unwrap_or(0.0),
    );
    let period = last - first + step;
    let shifted = |k: usize| stream.t.iter().map(move |t| t + k as f64 * period);
    Stream {
        t: (0..times).flat_map(shifted).collect(),
        values: stream.values.repeat(times),
    }
}
