//! What each clock makes of stamps that scatter and of samples taken unevenly.
//!
//! ```text
//! cargo run -p stillpoint-tests --bin clock-study -- --discover --row "J 2 %" --grade tactical
//! cargo run -p stillpoint-tests --bin clock-study -- --sessions 15 --grade tactical
//! ```
//!
//! Root mean square error of the nine gyroscope terms (ppm), by row: with the true times, with the clock that the data
//! choose, with the stamps as they are, with the even clock, and by the stepwise method (stamps). Then
//! the share that was chosen, and the root mean square of errors over stated errors.

use calib::calibrate::{Request, calibrate};
use calib::intervals::Segmentation;
use calib::methods::joint::{ClockMode, JointFit, JointRequest, fit_joint};
use calib::simulate::{Grade, Simulation, Spec};
use calib::{Error, Recording};
use clap::Parser;
use sensor::{Sensor, base_names};

/// What each clock makes of stamps that scatter and of samples taken unevenly.
#[derive(Debug, Parser)]
struct Args {
    /// Sessions of each row
    #[arg(long, default_value_t = 15)]
    sessions: u64,
    /// The first seed
    #[arg(long, default_value_t = 1000)]
    seed: u64,
    /// `consumer` or `tactical`; both without
    #[arg(long)]
    grade: Option<String>,
    /// Samples per second
    #[arg(long, value_delimiter = ',', default_value = "100")]
    rate: Vec<f64>,
    /// Count what `discover` claims of these sessions, which lack nothing, instead
    #[arg(long)]
    discover: bool,
    /// Only rows whose name contains this
    #[arg(long, default_value = "")]
    row: String,
}

/// Unevenness of the sampling (steps), noise of the stamps (s) and rounding (s).
const ROWS: [(&str, f64, f64, f64); 13] = [
    ("exact", 0.0, 0.0, 0.0),
    ("J 2 %", 0.02, 0.0, 0.0),
    ("J 5 %", 0.05, 0.0, 0.0),
    ("J 20 %", 0.2, 0.0, 0.0),
    ("S 0.5 ms", 0.0, 0.5e-3, 0.0),
    ("S 1 ms", 0.0, 1e-3, 0.0),
    ("S 1.5 ms", 0.0, 1.5e-3, 0.0),
    ("S 2 ms", 0.0, 2e-3, 0.0),
    ("S 4 ms", 0.0, 4e-3, 0.0),
    ("1 ms", 0.0, 0.0, 1e-3),
    ("J 5 % + 1 ms", 0.05, 0.0, 1e-3),
    ("J 20 % + S 1 ms", 0.2, 1e-3, 0.0),
    ("J 5 % + S 0.5 ms", 0.05, 0.5e-3, 0.0),
];

/// Sums of squares over sessions and terms.
#[derive(Default)]
struct Sums {
    /// Errors with the true times, by auto, stamps, even and stepwise.
    squares: [f64; 5],
    /// Errors over stated errors.
    normalised: f64,
    terms: f64,
    share: f64,
    misfit: f64,
    seconds: f64,
    sessions: f64,
}

fn main() -> Result<(), Error> {
    let args = Args::parse();
    println!("                                    rms of nine gyroscope terms, ppm");
    println!("grade    Hz  row              |  true  auto stamp  even  step | share  z   chi²  ms");
    for grade in ["consumer", "tactical"] {
        if args.grade.as_deref().is_some_and(|g| g != grade) {
            continue;
        }
        for &rate in &args.rate {
            for row in ROWS.iter().filter(|row| row.0.contains(&args.row)) {
                if args.discover {
                    print_claims(&args, grade, rate, row)?;
                    continue;
                }
                print_row(&args, grade, rate, row)?;
            }
        }
    }
    Ok(())
}

/// How many sessions `discover` claims something of.
fn print_claims(
    args: &Args,
    grade: &str,
    rate: f64,
    row: &(&str, f64, f64, f64),
) -> Result<(), Error> {
    let mut claims = Vec::new();
    for seed in args.seed..args.seed + args.sessions {
        let spec = spec(seed, grade, rate, row);
        let recording = Simulation::new(&spec)?.run()?.recording;
        let request = calib::discover::Request::new(spec.gravity);
        let found = calib::discover::discover(&[recording], &request)?.findings;
        let names = found.effects.iter().map(|effect| effect.name.clone());
        let faults = found.integrity.iter().map(|fault| fault.name.to_string());
        let rest = found.unexplained.iter().map(|_| "unexplained".to_owned());
        let all: Vec<String> = names.chain(faults).chain(rest).collect();
        if !all.is_empty() {
            claims.push(format!("{seed}: {}", all.join(", ")));
        }
    }
    let (count, all) = (claims.len(), args.sessions);
    println!(
        "{grade:8} {rate:3} {:16} | {count} of {all} sessions {claims:?}",
        row.0
    );
    Ok(())
}

/// What is simulated.
fn spec(seed: u64, grade: &str, rate: f64, row: &(&str, f64, f64, f64)) -> Spec {
    let mut spec = Spec::hand_held(seed);
    spec.rate = rate;
    if grade == "tactical" {
        spec.grade = Grade::Tactical;
    }
    let clock = &mut spec.gyroscope.clock;
    (clock.sampling_jitter, clock.jitter, clock.resolution) = (row.1 / rate, row.2, row.3);
    spec
}

fn print_row(
    args: &Args,
    grade: &str,
    rate: f64,
    row: &(&str, f64, f64, f64),
) -> Result<(), Error> {
    let mut sums = Sums::default();
    for seed in args.seed..args.seed + args.sessions {
        session(seed, grade, rate, row, &mut sums)?;
    }
    let rms = sums.squares.map(|s| 1e6 * (s / sums.terms).sqrt());
    let n = sums.sessions;
    println!(
        "{grade:8} {rate:3} {:16} | {:5.0} {:5.0} {:5.0} {:5.0} {:5.0} | {:4.2} {:5.2} {:5.2} {:4.0}",
        row.0,
        rms[0],
        rms[1],
        rms[2],
        rms[3],
        rms[4],
        sums.share / n,
        (sums.normalised / sums.terms).sqrt(),
        sums.misfit / n,
        1e3 * sums.seconds / n,
    );
    Ok(())
}

fn session(
    seed: u64,
    grade: &str,
    rate: f64,
    row: &(&str, f64, f64, f64),
    sums: &mut Sums,
) -> Result<(), Error> {
    let spec = spec(seed, grade, rate, row);
    let session = Simulation::new(&spec)?.run()?;
    let mut exact = spec.clone();
    (
        exact.gyroscope.clock.jitter,
        exact.gyroscope.clock.resolution,
    ) = (0.0, 0.0);
    let truly = Simulation::new(&exact)?.run()?;
    let request = Request {
        gravity: spec.gravity,
        ..Request::default()
    };
    let Ok(stepwise) = calibrate(std::slice::from_ref(&session.recording), &[], &request) else {
        println!("seed {seed}: stepwise refuses");
        return Ok(());
    };
    let segmentation = &stepwise.choices[0].segmentation;
    let fit = |recording: &Recording, clock| joint(recording, segmentation, spec.gravity, clock);
    let start = std::time::Instant::now();
    let auto = fit(&session.recording, ClockMode::Auto)?;
    sums.seconds += start.elapsed().as_secs_f64();
    let fits = [
        fit(&truly.recording, ClockMode::Stamps)?.all_fitted(),
        auto.all_fitted(),
        fit(&session.recording, ClockMode::Stamps)?.all_fitted(),
        fit(&session.recording, ClockMode::Even)?.all_fitted(),
    ];
    let triad = stepwise.calibration.gyroscope.as_ref();
    for (k, name) in base_names(Sensor::Gyroscope).iter().take(9).enumerate() {
        let Some(truth) = session.truth.get(name) else {
            continue;
        };
        for (fit, sum) in fits.iter().zip(&mut sums.squares) {
            let value = fit.parameters.get(name).unwrap_or(f64::NAN);
            *sum += (value - truth).powi(2);
        }
        let (i, j) = sensor::PLACES[k];
        let stepwise = triad.map_or(f64::NAN, |triad| triad.t[i][j]);
        sums.squares[4] += (stepwise - truth).powi(2);
        let error = fits[1].parameters.get(name).unwrap_or(f64::NAN) - truth;
        sums.normalised += (error / fits[1].standard_error(name).unwrap_or(f64::NAN)).powi(2);
        sums.terms += 1.0;
    }
    let clock = auto.data.sources[0].clock;
    sums.share += clock.share;
    sums.misfit += clock.misfit.unwrap_or(f64::NAN);
    sums.sessions += 1.0;
    Ok(())
}

fn joint(
    recording: &Recording,
    segmentation: &Segmentation,
    gravity: f64,
    clock: ClockMode,
) -> Result<JointFit, Error> {
    fit_joint(&JointRequest {
        clock,
        ..JointRequest::new(vec![(recording, segmentation)], gravity)
    })
}
