//! Cost against length: a stepwise calibration of a session repeated 1, 10 and 100 times end to end; and against the
//! number of recordings: the joint estimate of 1 to 32 recordings of 37 placements each.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin scaling [-- --repeat 3]
//! cargo run --release -p stillpoint-benches --bin scaling -- --recordings [--missing] [--repeat 3]
//! ```
//! Each length and number runs in a process of its own. Memory is what a calibration holds at its peak besides the
//! recording, counted by the allocator; the least of the repeated runs.

use std::collections::BTreeMap;
use std::process::{Command, ExitCode};

use calib::calibrate::{Method, Request, calibrate};
use calib::recording::Stream;
use calib::simulate::{HandHeld, Motion, Spec};
use calib::{Error, Recording};
use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use peak_alloc::PeakAlloc;
use sensor::Sensor;
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
    /// Against the number of recordings, by the joint estimate.
    #[arg(long)]
    recordings: bool,
    /// A gyroscope that feels the specific force, which the model does not know.
    #[arg(long)]
    missing: bool,
    /// Runs so many recordings and prints seconds and bytes.
    #[arg(long)]
    count: Option<u64>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let repeat = arguments.repeat;
    let outcome = match (arguments.length, arguments.count) {
        (Some(length), _) => one(length, repeat),
        (None, Some(count)) => several(count, arguments.missing, repeat),
        (None, None) if arguments.recordings => {
            of_recordings(arguments.missing, repeat).map(|t| t.to_string())
        }
        (None, None) => all(repeat).map(|table| table.to_string()),
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
    let (seconds, bytes) = measured(repeat, || calibrate(&recordings, &[], &request))?;
    Ok(format!("{samples} {seconds} {bytes}"))
}

/// Seconds, and bytes at the peak beyond those before the calibration, of so many recordings of one device.
fn several(count: u64, missing: bool, repeat: usize) -> Result<String, Error> {
    let truth = Spec::hand_held(1).run()?.truth;
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].map(|s| truth.parameters(s));
    let named = sensors
        .iter()
        .flat_map(|p| p.names().iter().cloned().zip(p.values().to_vec()));
    let device: BTreeMap<String, f64> = named.collect();
    let mut effects = BTreeMap::new();
    if missing {
        let sizes = [("xx", 1e-4), ("yy", -1.5e-4), ("zz", 2e-4)];
        let sizes: BTreeMap<String, f64> = sizes.map(|(k, v)| (k.to_owned(), v)).into();
        effects.insert("gyro_g_sensitivity".to_owned(), sizes);
    }
    let spec = |seed: u64| Spec {
        motion: Motion::HandHeld(HandHeld {
            placements: Some(37),
            ..HandHeld::default()
        }),
        parameters: device.clone(),
        effects: effects.clone(),
        ..Spec::hand_held(seed)
    };
    let recordings = (1..=count).map(|seed| Ok(spec(seed).run()?.recording));
    let recordings: Vec<Recording> = recordings.collect::<Result<_, Error>>()?;
    let request = Request {
        gravity: spec(1).gravity,
        method: Method::Joint,
        ..Request::default()
    };
    let (seconds, bytes) = measured(repeat, || calibrate(&recordings, &[], &request))?;
    Ok(format!("{seconds} {bytes}"))
}

/// Median time, and least memory at the peak beyond that before, of what is done.
fn measured<T>(repeat: usize, work: impl Fn() -> Result<T, Error>) -> Result<(f64, usize), Error> {
    // The first also buys what threads keep for good: 4 MiB of work space for products of matrices each.
    work()?;
    let mut bytes = usize::MAX;
    let seconds = median(repeat, || {
        MEMORY.reset_peak_usage();
        let before = MEMORY.current_usage();
        let outcome = work();
        bytes = bytes.min(MEMORY.peak_usage().saturating_sub(before));
        outcome
    });
    Ok((seconds, bytes))
}

/// A table of all numbers of recordings.
fn of_recordings(missing: bool, repeat: usize) -> Result<Table, Error> {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["recordings", "s", "s each", "MB", "MB each"]);
    for count in [1, 2, 4, 8, 16, 32] {
        let count_text = count.to_string();
        let mut arguments = vec!["--count", &count_text];
        if missing {
            arguments.push("--missing");
        }
        let [seconds, bytes] = of_process(&arguments, repeat)?;
        let each = f64::from(count);
        table.add_row([
            format!("{count}"),
            format!("{seconds:.3}"),
            format!("{:.3}", seconds / each),
            format!("{:.1}", 1e-6 * bytes),
            format!("{:.1}", 1e-6 * bytes / each),
        ]);
    }
    Ok(table)
}

/// What this program prints, run by itself.
fn of_process<const N: usize>(arguments: &[&str], repeat: usize) -> Result<[f64; N], Error> {
    let this = std::env::current_exe().map_err(|e| Error::input(e.to_string()))?;
    let output = Command::new(this)
        .args(arguments)
        .args(["--repeat", &repeat.to_string()])
        .output()
        .map_err(|e| Error::input(e.to_string()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers = text.split_whitespace().filter_map(|word| word.parse().ok());
    <[f64; N]>::try_from(numbers.collect::<Vec<f64>>()).map_err(|_| {
        let why = String::from_utf8_lossy(&output.stderr);
        Error::input(format!("{}: {why}", arguments.join(" ")))
    })
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
    for length in [1, 10, 100] {
        let arguments = ["--length", &length.to_string()];
        let [samples, seconds, bytes] = of_process(&arguments, repeat)?;
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
