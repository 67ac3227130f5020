//! One simulated session, calibrated both ways.

use calib::Error;
use calib::calibrate::{Method, Request, calibrate};
use calib::calibration::Calibration;
use calib::intervals::{Segmentation, Span};
use calib::methods::Fitted;
use calib::methods::joint::{BiasNoise, Chunk, JointFit, JointRequest, fit_joint};
use calib::simulate::{Clock, Fault, Grade, HandHeld, Motion, Session, Simulation, Spec};
use nalgebra::{DMatrix, DVector, Vector3};
use sensor::{PLACES, Sensor, base_names};

/// Random walk of the biases of a consumer-grade device, m/s²/√s and rad/s/√s: over five minutes the
/// accelerometer's bias moves by 1.7 mm/s² and the gyroscope's by 18 °/h, twice the error of the
/// mean of a seven-second rest.
const WALK: [f64; 2] = [1e-4, 5e-6];

/// Touch, slip and gap of a disturbed session: m/s², rad, s.
const TOUCH: f64 = 0.3;
const SLIP: f64 = 2e-3;
const GAP: f64 = 1.0;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Row {
    /// No noise at all.
    NoiseFree,
    /// Consumer grade, white noise.
    Consumer,
    /// Consumer grade, with random walk of both biases.
    ConsumerWalk,
    /// Tactical grade, white noise.
    Tactical,
    /// Tactical grade, with random walk.
    TacticalWalk,
    /// Consumer grade as 16-bit counts around 32768.
    Counts,
    /// Consumer grade on other clocks: 25 to 400 samples per second, each sensor with its own rate, phase
    /// and jitter, stamps rounded.
    Clocks,
    /// Consumer grade with one slip, one touch and one gap.
    Disturbed,
    /// Seven placements in one plane.
    Coplanar,
}

impl Row {
    /// What is simulated.
    pub fn spec(self, seed: u64) -> Spec {
        let mut spec = Spec::hand_held(seed);
        let tactical = matches!(self, Self::Tactical | Self::TacticalWalk);
        if tactical {
            spec.grade = Grade::Tactical;
        }
        if let Some([force, rate]) = self.walk() {
            spec.accelerometer.random_walk = force;
            spec.gyroscope.random_walk = rate;
        }
        match self {
            Self::NoiseFree => spec = spec.noise_free(),
            Self::Counts => {
                spec.accelerometer.counts = true;
                spec.accelerometer.step = 1.2e-3;
                spec.gyroscope.counts = true;
                spec.gyroscope.step = 1.1e-3;
            }
            Self::Clocks => clocks(&mut spec, seed),
            Self::Coplanar => {
                spec.motion = Motion::HandHeld(HandHeld {
                    placements: Some(7),
                    coplanar: true,
                    ..HandHeld::default()
                });
            }
            _ => {}
        }
        spec
    }

    /// The random walk densities it is simulated with.
    fn walk(self) -> Option<[f64; 2]> {
        match self {
            Self::ConsumerWalk => Some(WALK),
            Self::TacticalWalk => Some(WALK.map(|k| 0.1 * k)),
            _ => None,
        }
    }
}

/// Rates that sensors have, samples per second.
const RATES: [f64; 5] = [25.0, 50.0, 104.0, 200.0, 400.0];

/// Clocks of their own for both sensors.
fn clocks(spec: &mut Spec, seed: u64) {
    let rate = |k: u64| RATES[(k % RATES.len() as u64) as usize];
    let clock = |rate: f64, phase: f64| Clock {
        rate: Some(rate),
        phase: phase / rate,
        jitter: 0.02 / rate,
        resolution: if rate <= 100.0 { 1e-3 } else { 1e-4 },
        ..Clock::default()
    };
    spec.accelerometer.clock = clock(rate(seed), 0.3);
    spec.gyroscope.clock = clock(rate(seed / RATES.len() as u64), 0.0);
}

/// The errors of one method in one session.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub struct Figures {
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Estimate less truth.
    pub errors: Vec<f64>,
    /// Standard errors as stated.
    pub sigmas: Vec<f64>,
    /// Standard errors of the best estimate that knows the noise (the Cramér–Rao bound).
    pub bounds: Vec<f64>,
    /// Normalised estimation error squared.
    pub nees: f64,
}

/// What became of a session.
#[derive(Clone, Debug, serde::Serialize)]
pub struct SessionResult {
    /// Seed.
    pub seed: u64,
    /// The joint method.
    pub joint: Option<Figures>,
    /// The stepwise method.
    pub stepwise: Option<Figures>,
    /// What the joint method found disturbed, by kind and true interval.
    pub named: Vec<String>,
    /// What was disturbed, in the same form.
    pub disturbed: Vec<String>,
    /// Refusal or warnings.
    pub words: Vec<String>,
    /// Seconds for the joint fit.
    #[serde(skip)]
    pub seconds: f64,
}

/// Simulates and calibrates; the same seed gives the same result.
///
/// # Errors
/// A spec that contradicts itself.
pub fn run(row: Row, seed: u64) -> Result<SessionResult, Error> {
    let mut spec = row.spec(seed);
    let mut disturbed = Vec::new();
    if row == Row::Disturbed {
        disturb(&mut spec, seed, &mut disturbed)?;
    }
    let simulation = Simulation::new(&spec)?;
    let session = simulation.run()?;
    let request = Request {
        gravity: spec.gravity,
        ..Request::default()
    };
    let recordings = [session.recording.clone()];
    let mut result = SessionResult {
        seed,
        joint: None,
        stepwise: None,
        named: Vec::new(),
        disturbed,
        words: Vec::new(),
        seconds: 0.0,
    };
    if row == Row::Coplanar {
        let request = Request {
            method: Method::Joint,
            ..request
        };
        result.words = match calibrate(&recordings, &[], &request) {
            Err(refusal) => vec![format!("refused: {refusal}")],
            Ok(outcome) => outcome
                .calibration
                .warnings
                .texts(findings::Front::CommandLine),
        };
        return Ok(result);
    }
    let stepwise = match calibrate(&recordings, &[], &request) {
        Ok(outcome) => outcome,
        Err(refusal) => {
            result.words.push(format!("stepwise refused: {refusal}"));
            return Ok(result);
        }
    };
    let segmentation = &stepwise.choices[0].segmentation;
    let start = std::time::Instant::now();
    let fit = joint(&session, segmentation, None)?;
    result.seconds = start.elapsed().as_secs_f64();
    let walk = row.walk().unwrap_or_default();
    let bound = if fit.levels.iter().all(|l| l.size == 0.0) && row.walk().is_none() {
        fit.clone()
    } else {
        joint(&session, segmentation, Some(walk))?
    };
    let drift = drifts(&simulation, row.walk().is_some(), &fit);
    let truth = |name: &str| {
        let axis = name.strip_suffix(['x', 'y', 'z'])?;
        let place = ["x", "y", "z"].iter().position(|a| name.ends_with(a))?;
        let moved = match axis {
            "accel.b_" => drift[0][place],
            "gyro.b_" => drift[1][place],
            _ => 0.0,
        };
        Some(session.truth.get(name)? + moved)
    };
    let bounds = bound.all_fitted();
    result.joint = figures_of(&fit.all_fitted(), &bounds, truth);
    result.stepwise = figures_of(&as_fitted(&stepwise.calibration), &bounds, truth);
    result.named = named(&fit, &session);
    Ok(result)
}

fn joint(
    session: &Session,
    segmentation: &Segmentation,
    walk: Option<[f64; 2]>,
) -> Result<JointFit, Error> {
    fit_joint(&JointRequest {
        bias_noise: walk.map(BiasNoise::walks),
        ..JointRequest::new(
            vec![(&session.recording, segmentation)],
            session.truth.spec.gravity,
        )
    })
}

/// One slip, one touch, one gap, each at its own random place.
fn disturb(spec: &mut Spec, seed: u64, names: &mut Vec<String>) -> Result<(), Error> {
    let plain = Simulation::new(spec)?;
    let rests = plain.placements();
    let inner = rests.len() as u64 - 2;
    let slip = 1 + (seed * 7 + 1) % inner;
    let touch = 1 + (slip + 2 + (seed * 3) % (inner - 4)) % inner;
    let gap = 1 + (slip + 4 + (seed * 5) % (inner - 6)) % inner;
    let (slip, touch, gap) = (slip as usize, touch as usize, gap as usize);
    spec.faults.push(Fault::Slip {
        interval: slip,
        angle: SLIP,
    });
    spec.faults.push(Fault::Touch {
        interval: touch,
        size: TOUCH,
    });
    let middle = 0.5 * (rests[gap].1 + rests[gap + 1].0) - 0.5 * GAP;
    spec.faults.push(Fault::Gap {
        start: middle,
        length: GAP,
    });
    names.push(format!("slip {slip}"));
    names.push(format!("touch {touch}"));
    names.push(format!("gap {gap}"));
    Ok(())
}

/// What the fit names, by the true placement that holds the middle of its times.
fn named(fit: &JointFit, session: &Session) -> Vec<String> {
    use findings::Kind;
    let rests = &session.truth.static_intervals;
    let before = |t: f64| rests.iter().rposition(|r| r.start <= t).unwrap_or(0);
    let mut names: Vec<String> = fit
        .flagged
        .iter()
        .map(|a| {
            let kind = match a.fault.kind {
                Kind::CREEP | Kind::SETTLING | Kind::MOUNT_SLIP => "slip",
                Kind::RATE_EXCURSION => "excursion",
                Kind::TURN_MISSED => "turn",
                _ => "touch",
            };
            format!("{kind} {}", before(0.5 * (a.span.from + a.span.to)))
        })
        .collect();
    names.extend(
        fit.data
            .lost
            .iter()
            .map(|l| format!("gap {}", before(0.5 * (l.span.from + l.span.to)))),
    );
    names
}

/// Mean drift of both biases over the rests that the fit has seen.
fn drifts(simulation: &Simulation, walks: bool, fit: &JointFit) -> [Vector3<f64>; 2] {
    [Sensor::Accelerometer, Sensor::Gyroscope].map(|sensor| {
        if !walks {
            return Vector3::zeros();
        }
        let spans: Vec<Span> = fit
            .data
            .chunks
            .iter()
            .filter_map(|c| span(c, sensor))
            .collect();
        let (mut sum, mut count) = (Vector3::zeros(), 0.0);
        for sample in simulation.samples(sensor) {
            let next = spans.partition_point(|s| s.to <= sample.t);
            if spans.get(next).is_some_and(|s| s.from <= sample.t) {
                sum += sample.drift;
                count += 1.0;
            }
        }
        sum / count
    })
}

fn span(chunk: &Chunk, sensor: Sensor) -> Option<Span> {
    chunk.mean(sensor).map(|m| m.span)
}

fn figures_of(
    fitted: &Fitted,
    bounds: &Fitted,
    truth: impl Fn(&str) -> Option<f64>,
) -> Option<Figures> {
    let mut figures = Figures::default();
    for name in &fitted.free {
        figures
            .errors
            .push(fitted.parameters.get(name)? - truth(name)?);
        figures.sigmas.push(fitted.standard_error(name)?);
        figures.bounds.push(bounds.standard_error(name)?);
        figures.names.push(name.clone());
    }
    let n = fitted.free.len();
    let sigma = &figures.sigmas;
    let correlation =
        DMatrix::from_fn(n, n, |i, j| fitted.covariance[i][j] / (sigma[i] * sigma[j]));
    let z = DVector::from_fn(n, |i, _| figures.errors[i] / sigma[i]);
    figures.nees = correlation
        .cholesky()
        .map_or(f64::NAN, |c| z.dot(&c.solve(&z)));
    Some(figures)
}

/// A calibration read back as parameters with a covariance.
fn as_fitted(calibration: &Calibration) -> Fitted {
    let mut parameters = solver::Parameters::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let Some(triad) = calibration.triad(sensor) else {
            continue;
        };
        for (k, name) in base_names(sensor).into_iter().enumerate() {
            let value = match PLACES.get(k) {
                Some(&(i, j)) => triad.t[i][j],
                None => triad.bias[k - 9],
            };
            parameters.push(name, "", value);
        }
    }
    Fitted {
        parameters,
        free: calibration.parameters.clone(),
        covariance: calibration.covariance.clone(),
        rank: calibration.parameters.len(),
        condition: 1.0,
        unobservable: Vec::new(),
    }
}
