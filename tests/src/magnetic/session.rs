//! One simulated session, calibrated with its magnetometer and without, beside its bounds.

use calib::Error;
use calib::calibrate::{Method, Outcome, Request, calibrate};
use calib::intervals::Span;
use calib::simulate::{HandHeld, MagneticField, Motion, Session, Simulation, Spec};
use sensor::{BASE_PARAMETERS, PLACES, Sensor, base_names};

use super::information::{Bound, bound, parameters};

/// One parameter of one session.
#[derive(Clone, Debug)]
pub struct Found {
    /// Its name.
    pub name: String,
    /// Estimate less truth.
    pub error: f64,
    /// Standard error as stated.
    pub sigma: f64,
    /// The bound for the static intervals as the calibration found them.
    pub bound: f64,
    /// The bound for the static intervals as they were.
    pub bound_of_whole: f64,
}

/// One session.
#[derive(Clone, Debug)]
pub struct Record {
    /// Seed.
    pub seed: u64,
    /// All three sensors.
    pub with: Vec<Found>,
    /// Accelerometer and gyroscope by themselves.
    pub without: Vec<Found>,
}

/// A session of consumer grade in Middle Europe's field.
fn spec(seed: u64) -> Spec {
    Spec {
        motion: Motion::HandHeld(HandHeld {
            placements: Some(30),
            initial_rest: Some(20.0),
            ..HandHeld::default()
        }),
        magnetic_field: Some(MagneticField::default()),
        ..Spec::hand_held(seed)
    }
}

/// Simulates and calibrates; the same seed gives the same result.
///
/// # Errors
/// A refusal of the calibration.
pub fn run(seed: u64) -> Result<Record, Error> {
    let simulation = Simulation::new(&spec(seed))?;
    let session = simulation.run()?;
    let mut bare = session.clone();
    bare.recording.magnetometer = None;
    Ok(Record {
        seed,
        with: found(&simulation, &session)?,
        without: found(&simulation, &bare)?,
    })
}

fn found(simulation: &Simulation, session: &Session) -> Result<Vec<Found>, Error> {
    let request = Request {
        method: Method::Joint,
        gravity: session.truth.spec.gravity,
        ..Request::default()
    };
    let outcome = calibrate(std::slice::from_ref(&session.recording), &[], &request)?;
    let magnetometer = session.recording.magnetometer.is_some();
    let used: Vec<Span> = outcome.choices[0]
        .segmentation
        .statics
        .iter()
        .map(|rest| rest.span)
        .collect();
    let truth = &session.truth;
    let whole: Vec<Span> = truth
        .static_intervals
        .iter()
        .map(|rest| Span {
            from: rest.start,
            to: rest.end,
        })
        .collect();
    let all = estimates(&outcome, session);
    let free = |name: &str| all.iter().any(|(free, ..)| free == name);
    let of = |spans: &[Span]| bound(simulation, truth, spans, magnetometer, free);
    let (by_used, by_whole): (Bound, Bound) = (of(&used)?, of(&whole)?);
    let beside = |(name, error, sigma): &(String, f64, f64)| {
        Some(Found {
            error: *error,
            sigma: *sigma,
            bound: by_used.of(name)?,
            bound_of_whole: by_whole.of(name)?,
            name: name.clone(),
        })
    };
    Ok(all.iter().filter_map(beside).collect())
}

/// Name, error and stated error of each free parameter.
fn estimates(outcome: &Outcome, session: &Session) -> Vec<(String, f64, f64)> {
    let mut all = Vec::new();
    for sensor in Sensor::ALL {
        let Some(triad) = outcome.calibration.triad(sensor) else {
            continue;
        };
        let truth = parameters(&session.truth, sensor);
        for (k, name) in base_names(sensor)
            .into_iter()
            .enumerate()
            .take(BASE_PARAMETERS)
        {
            let (value, sigma) = match PLACES.get(k) {
                Some(&(i, j)) => (triad.t[i][j], triad.t_std[i][j]),
                None => (triad.bias[k - 9], triad.bias_std[k - 9]),
            };
            let Some(sigma) = sigma.filter(|sigma| *sigma > 0.0) else {
                continue;
            };
            all.push((name, value - truth[k], sigma));
        }
    }
    all
}
