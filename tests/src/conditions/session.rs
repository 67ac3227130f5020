//! One session under one condition, calibrated by both methods.

use calib::Error;
use calib::calibrate::{Method, Request, calibrate};
use calib::calibration::Calibration;
use calib::intervals::Span;
use calib::simulate::{Session, Simulation, Spec};
use nalgebra::{DMatrix, DVector, Vector3};
use sensor::{PLACES, Sensor, base_names};
use serde::{Deserialize, Serialize};

use super::catalogue::{Bound, Condition};

const SENSORS: [Sensor; 2] = [Sensor::Accelerometer, Sensor::Gyroscope];

/// The errors of one method in one session.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Names of the parameters of both base models.
    pub names: Vec<String>,
    /// Estimate less truth, SI.
    pub errors: Vec<f64>,
    /// Standard errors as stated.
    pub sigmas: Vec<f64>,
    /// Half-widths of the 95 % intervals as stated.
    pub widths: Vec<f64>,
    /// Normalised estimation error squared.
    pub nees: Option<f64>,
    /// Residual over noise, squared, per degree of freedom: gravity's norm, its direction after turns.
    pub reduced_chi2: [Option<f64>; 2],
}

/// What became of a session by one method.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The errors, unless it was refused.
    pub estimate: Option<Estimate>,
    /// Exit status: 0, 1 for a failed gate, 4 and 5 for refusals.
    pub exit: u8,
    /// Warnings, failed gates or the refusal.
    pub words: Vec<String>,
}

/// What became of a session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Name of the condition.
    pub row: String,
    /// Seed.
    pub seed: u64,
    /// The joint method.
    pub joint: Outcome,
    /// The stepwise method.
    pub stepwise: Outcome,
    /// Standard errors of an estimate that knows true times and noise, in the order of the names.
    pub bounds: Option<Vec<f64>>,
}

impl Record {
    /// What became of it by one method.
    pub fn by(&self, method: Method) -> &Outcome {
        match method {
            Method::Auto | Method::Joint => &self.joint,
            Method::Stepwise => &self.stepwise,
        }
    }
}

/// Simulates and calibrates; the same seed gives the same result.
///
/// # Errors
/// A spec that contradicts itself.
pub fn run(condition: &Condition, seed: u64) -> Result<Record, Error> {
    let spec = condition.spec(seed);
    let simulation = Simulation::new(&spec)?;
    let session = simulation.run()?;
    let by = |method| by(method, condition, &simulation, &session);
    let (joint, stepwise) = (by(Method::Joint), by(Method::Stepwise));
    Ok(Record {
        row: condition.name.into(),
        seed,
        joint,
        stepwise,
        bounds: bounds(condition, seed)?,
    })
}

/// What the joint method states of the same device and motion on a good day.
fn bounds(condition: &Condition, seed: u64) -> Result<Option<Vec<f64>>, Error> {
    if condition.bound == Bound::Unknown {
        return Ok(None);
    }
    let simulation = Simulation::new(&condition.good_day(seed))?;
    let session = simulation.run()?;
    let joint = by(Method::Joint, condition, &simulation, &session);
    Ok(joint.estimate.map(|e| e.sigmas))
}

fn by(
    method: Method,
    condition: &Condition,
    simulation: &Simulation,
    session: &Session,
) -> Outcome {
    let spec = simulation.spec();
    let mut request = Request {
        gravity: spec.gravity,
        method,
        ..Request::default()
    };
    (condition.ask)(spec, &mut request);
    let recordings = [session.recording.clone()];
    match calibrate(&recordings, &[], &request) {
        Err(refusal) => Outcome {
            estimate: None,
            exit: match refusal {
                Error::NotEnough(_) => 4,
                Error::NotConverged(_) | Error::Solver(_) => 5,
                Error::Usage(_) => 2,
                _ => 3,
            },
            words: vec![refusal.to_string()],
        },
        Ok(outcome) => {
            let statics = &outcome.choices[0].segmentation.statics;
            let spans: Vec<Span> = statics.iter().map(|s| s.span).collect();
            let drifts = SENSORS.map(|sensor| drift(simulation, sensor, &spans));
            let calibration = &outcome.calibration;
            Outcome {
                estimate: estimate(calibration, |name| true_value(session, &drifts, name)),
                exit: u8::from(!calibration.failed_gates.is_empty()),
                words: calibration.findings().texts(findings::Front::CommandLine),
            }
        }
    }
}

/// True value of a parameter; a bias that drifts is its mean over the static intervals.
fn true_value(session: &Session, drifts: &[Vector3<f64>; 2], name: &str) -> Option<f64> {
    let place = ["x", "y", "z"].iter().position(|a| name.ends_with(a))?;
    let moved = match name.get(..name.len() - 1)? {
        "accel.b_" => drifts[0][place],
        "gyro.b_" => drifts[1][place],
        _ => 0.0,
    };
    Some(session.truth.get(name)? + moved)
}

fn drifts_at_all(spec: &Spec, sensor: Sensor) -> bool {
    let own = spec.sensor(sensor);
    own.random_walk > 0.0 || own.instability > 0.0 || own.thermal_drift > 0.0
}

/// Mean drift of a bias over these spans of stamps, in the recording's unit.
fn drift(simulation: &Simulation, sensor: Sensor, spans: &[Span]) -> Vector3<f64> {
    if !drifts_at_all(simulation.spec(), sensor) {
        return Vector3::zeros();
    }
    let (mut sum, mut count) = (Vector3::zeros(), 0.0);
    for sample in simulation.samples(sensor) {
        let next = spans.partition_point(|s| s.to <= sample.t);
        if spans.get(next).is_some_and(|s| s.from <= sample.t) {
            sum += sample.drift;
            count += 1.0;
        }
    }
    let own = simulation.spec().sensor(sensor);
    let unit = if own.counts { own.step } else { 1.0 };
    sum / f64::max(count, 1.0) / unit
}

/// A calibration against the truth: the parameters of the base models that it states errors of.
fn estimate(calibration: &Calibration, truth: impl Fn(&str) -> Option<f64>) -> Option<Estimate> {
    let mut found = Estimate {
        reduced_chi2: SENSORS.map(|s| calibration.triad(s).and_then(|t| t.reduced_chi2)),
        ..Estimate::default()
    };
    let mut places = Vec::new();
    for sensor in SENSORS {
        let triad = calibration.triad(sensor)?;
        for (k, name) in base_names(sensor).into_iter().enumerate() {
            let Some(place) = calibration.parameters.iter().position(|p| *p == name) else {
                continue;
            };
            let value = match PLACES.get(k) {
                Some(&(i, j)) => triad.t[i][j],
                None => triad.bias[k - 9],
            };
            let sigma = calibration.covariance[place][place].sqrt();
            found.errors.push(value - truth(&name)?);
            found.sigmas.push(sigma);
            found.widths.push(NORMAL * sigma);
            found.names.push(name);
            places.push(place);
        }
    }
    found.nees = nees(&found, &calibration.covariance, &places);
    Some(found)
}

/// Half-width of a normal 95 % interval in standard errors.
const NORMAL: f64 = 1.959_963_985;

fn nees(of: &Estimate, covariance: &[Vec<f64>], places: &[usize]) -> Option<f64> {
    let (n, s) = (places.len(), &of.sigmas);
    let correlation = DMatrix::from_fn(n, n, |i, j| {
        covariance[places[i]][places[j]] / (s[i] * s[j])
    });
    let z = DVector::from_fn(n, |i, _| of.errors[i] / s[i]);
    let nees = z.dot(&correlation.cholesky()?.solve(&z));
    nees.is_finite().then_some(nees)
}
