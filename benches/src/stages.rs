//! The stages of a calibration and of a discovery, each timed on its own. A new stage is a line in [`run`] or
//! `discovery`.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use calib::calibrate::{Request, calibrate, gyroscope_data};
use calib::discover::{self, Extension, State, families, rank};
use calib::intervals::segment;
use calib::kernel::{Tier, TurnProblem};
use calib::methods::{
    AccelerometerRequest, GyroscopeRequest, choose_multiplier, fit_accelerometer, fit_gyroscope,
    static_means,
};
use calib::recording::ReadOptions;
use calib::residuals::{Integrator, PropagatedGravity};
use calib::{Error, Recording};
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use solver::Problem;

/// What a stage took.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Its name.
    pub name: &'static str,
    /// Median time of one run, s.
    pub seconds: f64,
    /// Samples it works on.
    pub samples: usize,
    /// What it is compared with.
    pub floor: Option<&'static str>,
    /// Whether it is a part of the whole, and not a floor or another way to do a part.
    pub part: bool,
}

impl Stage {
    /// Nanoseconds per sample.
    pub fn per_sample(&self) -> f64 {
        1e9 * self.seconds / self.samples.max(1) as f64
    }
}

/// Floor of everything that looks at the samples.
const MEMORY: &str = "memory read";
/// Floor of everything that differentiates the turns.
const VALUES: &str = "turns, values";
/// All of it.
const WHOLE: &str = "calibrate";

/// The median time of `repeat` runs of `work`, s.
pub fn median<T>(repeat: usize, mut work: impl FnMut() -> T) -> f64 {
    let mut seconds: Vec<f64> = (0..repeat.max(1))
        .map(|_| {
            let start = Instant::now();
            black_box(work());
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

/// Times the stages on a recording.
///
/// # Errors
/// A recording that cannot be calibrated.
pub fn run(recording: &Recording, gravity: f64, repeat: usize) -> Result<Vec<Stage>, Error> {
    let request = Request {
        gravity,
        ..Request::default()
    };
    let detector = &request.detector;
    let choice = choose_multiplier(recording, detector, gravity)?;
    let accelerometer = AccelerometerRequest {
        recordings: vec![static_means(recording, &choice.segmentation)],
        names: vec![recording.name.clone()],
        model: accelerometer::model(),
        gravity,
    };
    let force = fit_accelerometer(&accelerometer)?;
    let gyroscope = GyroscopeRequest {
        recordings: vec![gyroscope_data(
            recording,
            &choice.segmentation,
            &force,
            &request,
        )],
        model: gyroscope::model(),
        integrator: Integrator::Exponential,
    };
    let samples = recording.gyroscope.as_ref().map_or(0, |s| s.len());
    let turning = gyroscope.recordings[0].turns.iter().map(|t| t.t.len());
    let turning = turning.sum();
    let stage = |name, samples, floor, part, seconds| Stage {
        name,
        seconds,
        samples,
        floor,
        part,
    };
    let mut table = vec![
        stage(
            MEMORY,
            samples,
            None,
            false,
            median(repeat, || sum(recording)),
        ),
        stage(
            "segment at one multiplier",
            samples,
            Some(MEMORY),
            false,
            median(repeat, || segment(recording, detector)),
        ),
        stage(
            "choose the multiplier",
            samples,
            Some(MEMORY),
            true,
            median(repeat, || choose_multiplier(recording, detector, gravity)),
        ),
        stage(
            "accelerometer fit",
            samples,
            Some(MEMORY),
            true,
            median(repeat, || fit_accelerometer(&accelerometer)),
        ),
        stage(
            "gyroscope fit",
            samples,
            Some(MEMORY),
            true,
            median(repeat, || fit_gyroscope(&gyroscope)),
        ),
        stage(
            WHOLE,
            samples,
            Some(MEMORY),
            false,
            median(repeat, || {
                calibrate(std::slice::from_ref(recording), &[], &request)
            }),
        ),
    ];
    discovery(recording, gravity, repeat, |name, seconds| {
        table.push(stage(name, samples, Some(MEMORY), false, seconds));
    })?;
    kernel(&gyroscope, repeat, |name, floor, seconds| {
        table.push(stage(name, turning, floor, false, seconds));
    });
    Ok(table)
}

/// Times the reading of a recording's files; the first of the table of [`run`].
///
/// # Errors
/// As [`Recording::read`].
pub fn read(path: &Path, repeat: usize) -> Result<Stage, Error> {
    let read = || Recording::read(path, &ReadOptions::default());
    let samples = read()?.gyroscope.map_or(0, |s| s.len());
    Ok(Stage {
        name: "read",
        seconds: median(repeat, read),
        samples,
        floor: None,
        part: false,
    })
}

/// The joint estimate, the tests of the whole catalogue against it, and all of `discover`.
fn discovery(
    recording: &Recording,
    gravity: f64,
    repeat: usize,
    mut add: impl FnMut(&'static str, f64),
) -> Result<(), Error> {
    let request = discover::Request::new(gravity);
    let recordings = std::slice::from_ref(recording);
    let session = discover::Session::new(recordings, &request)?;
    let nothing = Extension::default;
    let base = State::fit(&session, nothing())?;
    let fit = || State::fit(&session, nothing());
    add("joint estimate", median(repeat, fit));
    let tests = || {
        let families = families(&base, &request.candidates());
        rank(&base.projected, &families, base.levels())
    };
    add("tests of the catalogue", median(repeat, tests));
    let whole = || discover::discover(recordings, &request);
    add("discover", median(repeat, whole));
    Ok(())
}

/// One evaluation of the turns by each tier.
fn kernel(
    request: &GyroscopeRequest,
    repeat: usize,
    mut add: impl FnMut(&'static str, Option<&'static str>, f64),
) {
    let x = request.model.parameters().values().to_vec();
    let free: Vec<usize> = (0..x.len()).collect();
    let names = [
        (Tier::Affine, "turns, Jacobian: affine"),
        (Tier::General, "turns, Jacobian: any model"),
        (Tier::Straight, "turns, Jacobian: straight dual numbers"),
    ];
    for (tier, name) in names {
        let residual = PropagatedGravity {
            model: &request.model,
            turns: &request.recordings[0].turns,
            integrator: request.integrator,
            sigma: 1.0,
        };
        let Some(problem) = TurnProblem::at(residual, tier) else {
            continue;
        };
        let mut rows = Vec::new();
        if tier == Tier::Affine {
            add(
                VALUES,
                None,
                median(repeat, || problem.values(&x, &mut rows)),
            );
        }
        let seconds = median(repeat, || problem.linearize(&x, &free, &mut rows));
        add(name, Some(VALUES), seconds);
    }
}

/// Every stamp and every reading once.
fn sum(recording: &Recording) -> f64 {
    let streams = [&recording.accelerometer, &recording.gyroscope];
    let of_stream = |stream: &calib::recording::Stream| {
        let values = stream.values.iter().flat_map(|v| v.iter());
        values.chain(&stream.t).sum::<f64>()
    };
    streams.into_iter().flatten().map(of_stream).sum()
}

/// Prints the table: stage, time per sample, share of the whole, and how often its floor it takes.
pub fn print(stages: &[Stage]) {
    let find = |name: &str| stages.iter().find(|s| s.name == name);
    let whole = find(WHOLE).map_or(f64::NAN, |s| s.seconds);
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header([
        "stage",
        "ms",
        "ns per sample",
        "share",
        "floor",
        "times the floor",
    ]);
    for stage in stages {
        let share = match stage.part || stage.name == WHOLE {
            true => format!("{:.0} %", 100.0 * stage.seconds / whole),
            false => String::new(),
        };
        let floor = stage.floor.and_then(find);
        table.add_row([
            stage.name.to_string(),
            format!("{:.3}", 1e3 * stage.seconds),
            format!("{:.1}", stage.per_sample()),
            share,
            stage.floor.unwrap_or_default().to_string(),
            floor.map_or_else(String::new, |f| {
                format!("{:.1}", stage.per_sample() / f.per_sample())
            }),
        ]);
    }
    println!("{table}");
}
