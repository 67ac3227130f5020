//! Recordings to a calibration: segment, accelerometer, gyroscope, checks, result.

mod assemble;
mod checks;
mod clocks;
mod gyro_data;
mod joint;
mod left_out;
mod magnetic;
mod means_file;
mod noise;
pub mod own_effects;
mod part_way;
mod rest_bias;
mod same_device;
mod static_norm;

pub use checks::not_in_one_plane;
pub use joint::{refuse_unobservable, written_down};
pub use magnetic::FIELDS;
pub use means_file::read_static_means;
pub use part_way::changes_part_way;
pub use same_device::of_one_device;

use std::borrow::Borrow;

use nalgebra::Vector3;
use recording::intervals::{Detector, Segmentation, Span, Turn, TurnFault};
use recording::readings::{FASTEST_HAND, Finding, tremor, without_spikes};
use recording::{Error, Recording};
use sensor::{AnyEffect, Model, Quantity};
use serde::{Deserialize, Serialize};

use crate::calibration::{Calibration, Options, RecordingClock};
use crate::gravity::GravitySource;
use crate::methods::joint::{ClockMode, JointFit, MOST_STATIC_INTERVALS, within_budget};
use crate::methods::{
    self, AccelerometerFit, AccelerometerRequest, Choice, GyroscopeData, GyroscopeFit,
    GyroscopeRequest, accelerometer_unit, fit_accelerometer, fit_gyroscope, static_means,
    static_means_by,
};
use crate::residuals::{Integrator, StaticMean};
use crate::truth::{Models, Sensing, Truth};

pub use crate::gravity::STANDARD_GRAVITY;

/// Sampling rates of sensors that may be assumed instead of stamps, Hz.
pub const NOMINAL_RATES: std::ops::RangeInclusive<f64> = 0.1..=1e5;

/// Fits at most after which the signs of changes of force are settled.
const HISTORIES: usize = 4;

/// The frame that the accelerometer's matrix is reported in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frame {
    /// Upper triangular: the sensor's x axis on the body's, its y axis in the body's x-y plane.
    #[default]
    Triangular,
    /// Symmetric: no rotation between sensor and body.
    Symmetric,
}

/// Where the bias of a turn is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GyroBias {
    /// The mean of the two rests beside the turn, which follows a drifting bias.
    #[default]
    Adjacent,
    /// The first rest of the recording, as published (Liu et al. 2021).
    Initial,
}

/// How to calibrate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// What [`Request::usual_method`] says.
    Auto,
    /// Accelerometer first, then the gyroscope by propagated gravity, as published.
    #[default]
    Stepwise,
    /// Both sensors and their effects in one weighted problem.
    Joint,
}

/// An instant of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instant {
    /// Which recording, from 1.
    pub recording: usize,
    /// Its stamp, s.
    pub t: f64,
}

/// What to calibrate and how.
#[derive(Clone, Debug)]
pub struct Request {
    /// How to calibrate.
    pub method: Method,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Where that comes from: what it leaves unknown is in the errors of the scale factors.
    pub gravity_source: GravitySource,
    /// The detector of motion.
    pub detector: Detector,
    /// Whether the detector's multiplier is chosen by the fit.
    pub choose_multiplier: bool,
    /// Static intervals given by hand, one list per recording; empty to detect them.
    pub sections: Vec<Vec<Span>>,
    /// Static intervals to leave out, each by an instant within it.
    pub left_out: Vec<Instant>,
    /// Frame of the result.
    pub frame: Frame,
    /// How the rate is integrated.
    pub integrator: Integrator,
    /// Where the bias of a turn is taken from.
    pub gyro_bias: GyroBias,
    /// Step between gyroscope samples to assume instead of the stamps, s.
    pub nominal_step: Option<f64>,
    /// Effects on top of the base models.
    pub effects: Vec<&'static dyn AnyEffect>,
    /// Latitude, °: the joint method then takes the earth's rotation off the gyroscope. Its vertical part is
    /// known, its horizontal part is estimated, as the heading of the recording is not known.
    pub latitude: Option<f64>,
    /// Take the recordings to be of one device even where they disagree.
    pub force_device: bool,
    /// By which clock the turns are integrated. What is left to the data are the stamps in the stepwise method, as
    /// published.
    pub clock: ClockMode,
    /// Strength of the magnetic field of the place, µT. Without it the scale of a magnetometer stays free.
    pub field: Option<f64>,
    /// Means to use for the accelerometer instead of those of the recordings.
    pub static_means: Vec<Vector3<f64>>,
}

impl Request {
    /// The method where nobody names one: joint, whose stated errors hold under more conditions; stepwise where a recording
    /// has no accelerometer or where what is asked for is the stepwise method's alone (integrator, bias of a turn, an
    /// assumed step, means from a table).
    pub fn usual_method<R: Borrow<Recording>>(&self, recordings: &[R]) -> Method {
        let without_force = |r: &R| r.borrow().accelerometer.is_none();
        let as_published = self.integrator != Integrator::default()
            || self.gyro_bias != GyroBias::default()
            || self.nominal_step.is_some()
            || !self.static_means.is_empty();
        if as_published || recordings.iter().any(without_force) {
            Method::Stepwise
        } else {
            Method::Joint
        }
    }

    /// The same with a method that is no longer open.
    fn decided<R: Borrow<Recording>>(&self, recordings: &[R]) -> Self {
        let method = match self.method {
            Method::Auto => self.usual_method(recordings),
            named => named,
        };
        Self {
            method,
            ..self.clone()
        }
    }
}

impl Default for Request {
    fn default() -> Self {
        Self {
            method: Method::default(),
            gravity: STANDARD_GRAVITY,
            gravity_source: GravitySource::Given,
            detector: Detector::default(),
            choose_multiplier: true,
            sections: Vec::new(),
            left_out: Vec::new(),
            frame: Frame::default(),
            integrator: Integrator::default(),
            gyro_bias: GyroBias::default(),
            nominal_step: None,
            effects: Vec::new(),
            latitude: None,
            force_device: false,
            clock: ClockMode::default(),
            field: None,
            static_means: Vec::new(),
        }
    }
}

/// A calibration and what it was made from.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The result.
    pub calibration: Calibration,
    /// How each recording was cut.
    pub choices: Vec<Choice>,
    /// The fit of the accelerometer.
    pub accelerometer: Option<AccelerometerFit>,
    /// The fit of the gyroscope.
    pub gyroscope: Option<GyroscopeFit>,
    /// The joint fit, of that method.
    pub joint: Option<JointFit>,
}

/// Calibrates one device from its recordings; the gyroscope from `gyro_recordings` where there are
/// any, else from the same.
///
/// # Errors
/// Recordings that cannot be cut, too few orientations, a parameter that the data do not determine,
/// a fit that does not converge.
pub fn calibrate<R: Borrow<Recording>>(
    recordings: &[R],
    gyro_recordings: &[R],
    request: &Request,
) -> Result<Outcome, Error> {
    let recordings: Vec<&Recording> = recordings.iter().map(R::borrow).collect();
    let gyro_recordings: Vec<&Recording> = gyro_recordings.iter().map(R::borrow).collect();
    let request = request.decided(&recordings);
    calibrate_all(&recordings, &gyro_recordings, &request)
}

fn calibrate_all(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    let all = recordings.iter().chain(gyro_recordings);
    own_effects::grant_steps(&request.effects, all.copied());
    let mut said = Vec::new();
    let outcome = match clocks::without_bursts(recordings) {
        Some((evened, warnings)) => {
            said = warnings;
            by_clock(&evened.iter().collect::<Vec<_>>(), gyro_recordings, request)
        }
        None => by_clock(recordings, gyro_recordings, request),
    };
    said.extend(clocks::apart(recordings));
    let outcome = outcome.map(|mut outcome| {
        outcome.calibration.warnings.extend(said);
        state_inputs(&mut outcome, recordings, gyro_recordings, request);
        outcome
    });
    own_effects::blamed(&request.effects, outcome)
}

/// Writes down from what the calibration was made.
fn state_inputs(
    outcome: &mut Outcome,
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) {
    let same = |a: &Recording, b: &Recording| {
        a.accelerometer == b.accelerometer && a.gyroscope == b.gyroscope
    };
    let mut counted: Vec<&Recording> = Vec::new();
    for recording in recordings {
        if !counted.iter().any(|other| same(other, recording)) {
            counted.push(recording);
        }
    }
    counted.extend(gyro_recordings);
    let cut = outcome.choices.iter().map(|c| Some(&c.segmentation));
    let cut = cut.chain(std::iter::repeat(None));
    let multipliers = outcome.choices.iter().map(|c| c.segmentation.multiplier);
    let options = Options::of(request, multipliers.collect());
    let all = counted.into_iter().zip(cut);
    outcome.calibration.state_inputs(all, Some(options));
}

/// Calibrates by the clock that was asked for.
fn by_clock(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    if request.clock == ClockMode::Even && request.method == Method::Stepwise {
        let [recordings, others] = [recordings, gyro_recordings].map(clocks::on_even_clocks);
        let [recordings, others] = [&recordings, &others].map(|all| all.iter().collect::<Vec<_>>());
        return by_stamps(&recordings, &others, request);
    }
    by_stamps(recordings, gyro_recordings, request)
}

/// Calibrates by the stamps of the recordings, but for what the joint method makes of them.
fn by_stamps(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    let cleaned: Vec<_> = recordings.iter().map(|r| without_spikes(r)).collect();
    let mut warnings = Vec::new();
    let clean = recordings.iter().zip(&cleaned);
    let clean = clean.map(|(raw, cleaned)| cleaned.as_ref().map_or(*raw, |(clean, _)| clean));
    let recordings = checks::without_repeats(clean, &mut warnings);
    for (recording, found) in cleaned.iter().flatten() {
        warnings.extend(found.iter().map(|f| format!("{}: {f}", recording.name)));
    }
    let mut choices = recordings
        .iter()
        .enumerate()
        .map(|(k, recording)| cut(recording, request, Some(k)))
        .collect::<Result<Vec<_>, _>>()?;
    if request.method == Method::Joint {
        warnings.extend(within_budget(
            &recordings,
            &mut choices,
            MOST_STATIC_INTERVALS,
        ));
    }
    for (recording, choice) in recordings.iter().zip(&choices) {
        warnings.extend(checks::of_the_detector(recording, choice));
    }
    let parts = Parts {
        recordings: &recordings,
        gyro_recordings,
        request,
        warnings: &warnings,
    };
    let refused = match parts.fitted(choices.clone()) {
        Err(Error::NotEnough(reason)) => reason,
        Err(Error::NotConverged(reason)) => {
            return Err(Error::NotConverged(in_the_hand(reason, &recordings)));
        }
        Ok(outcome) => {
            let outcome = with_changes(outcome, &recordings, request.gravity);
            return magnetic::with_magnetometer(outcome, &recordings, request);
        }
        Err(other) => return Err(other),
    };
    match parts.without_gyroscope(choices, &refused) {
        Some(outcome) => Ok(outcome),
        None => Err(Error::NotEnough(in_the_hand(refused, &recordings))),
    }
}

/// The outcome with a warning for everything that changes part of the way through a recording.
fn with_changes(mut outcome: Outcome, recordings: &[&Recording], gravity: f64) -> Outcome {
    let triad = outcome.calibration.gyroscope.as_ref();
    let gyroscope = triad.map(|triad| (triad.base().t, triad.residual_rms.to_radians()));
    let mut warnings = Vec::new();
    for (recording, choice) in recordings.iter().zip(&outcome.choices) {
        let segmentation = &choice.segmentation;
        warnings.extend(checks::corrected_before(recording, segmentation));
        warnings.extend(gyroscope.and_then(|(t, _)| checks::too_fast(recording, segmentation, &t)));
        warnings.extend(changes_part_way(
            recording,
            &choice.segmentation,
            gravity,
            gyroscope,
        ));
    }
    outcome.calibration.warnings.extend(warnings);
    outcome
}

/// The reason with the cause that the readings show, if it is the hand.
fn in_the_hand(reason: String, recordings: &[&Recording]) -> String {
    match recordings.iter().find_map(|r| tremor(r)) {
        Some(rate) if rate < FASTEST_HAND => {
            format!("{reason}; {}", Finding::HandHeld { rate })
        }
        Some(rate) => format!(
            "{reason}; no quiet stretch is long enough to show a device at rest (in the quietest the rate \
             wavers by {rate:.2} rad/s): lay it down for 5 s between the turns, or lower --multiplier"
        ),
        None => reason,
    }
}

/// What a calibration is made from.
struct Parts<'a> {
    recordings: &'a [&'a Recording],
    gyro_recordings: &'a [&'a Recording],
    request: &'a Request,
    warnings: &'a [String],
}

impl Parts<'_> {
    fn fitted(&self, choices: Vec<Choice>) -> Result<Outcome, Error> {
        let warnings = self.warnings.to_vec();
        let (recordings, others) = (self.recordings, self.gyro_recordings);
        match self.request.method {
            Method::Joint => joint::calibrate(recordings, others, choices, self.request, warnings),
            Method::Auto | Method::Stepwise => {
                stepwise(recordings, others, choices, self.request, warnings)
            }
        }
    }

    /// The accelerometer alone, where saturated turns are why the gyroscope is not known; it is said.
    fn without_gyroscope(&self, choices: Vec<Choice>, reason: &str) -> Option<Outcome> {
        let turns = || choices.iter().flat_map(|c| &c.segmentation.turns);
        let saturated = |t: &&Turn| matches!(t.fault, Some(TurnFault::Saturated { .. }));
        let lost = turns().filter(saturated).count();
        if lost == 0 || !self.gyro_recordings.is_empty() {
            return None;
        }
        let of = turns().count();
        let bare: Vec<Recording> = self
            .recordings
            .iter()
            .map(|recording| Recording {
                name: recording.name.clone(),
                accelerometer: recording.accelerometer.clone(),
                temperature: recording.temperature.clone(),
                ..Recording::default()
            })
            .collect();
        let only_force = bare.iter().zip(&choices).map(|(recording, choice)| {
            let spans: Vec<Span> = choice.segmentation.statics.iter().map(|s| s.span).collect();
            let multiplier = choice.segmentation.multiplier;
            Choice {
                segmentation: Segmentation::from_spans(recording, &spans, multiplier),
                ..choice.clone()
            }
        });
        let parts = Parts {
            recordings: &bare.iter().collect::<Vec<_>>(),
            ..*self
        };
        let mut outcome = parts.fitted(only_force.collect()).ok()?;
        outcome.choices = choices;
        let calibration = &mut outcome.calibration;
        calibration.warnings.retain(|w| w != NO_GYROSCOPE);
        calibration.warnings.push(format!(
            "the gyroscope is not calibrated: it is saturated in {lost} of {of} turns, and the others are \
             not enough ({reason}); turn more slowly or set a larger range"
        ));
        Some(outcome)
    }
}

/// Said where only the accelerometer is calibrated.
const NO_GYROSCOPE: &str = "no gyroscope in the recording: only the accelerometer is calibrated";

/// Accelerometer first, then the gyroscope.
fn stepwise(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    choices: Vec<Choice>,
    request: &Request,
    mut warnings: Vec<String>,
) -> Result<Outcome, Error> {
    if request.static_means.is_empty() {
        let cut = choices.iter().map(|c| &c.segmentation);
        checks::refuse_unknowable(recordings.iter().copied().zip(cut), &request.effects)?;
        checks::refuse_attitude(&request.effects)?;
    }
    let accelerometer = accelerometer(recordings, &choices, request, &mut warnings)?;
    let separate = gyro_recordings
        .iter()
        .map(|recording| {
            let choice = cut(recording, request, None)?;
            warnings.extend(checks::of_the_detector(recording, &choice));
            Ok((recording, choice.segmentation))
        })
        .collect::<Result<Vec<_>, Error>>()?;
    let turning: Vec<(&Recording, &Segmentation)> = if separate.is_empty() {
        recordings
            .iter()
            .copied()
            .zip(choices.iter().map(|c| &c.segmentation))
            .collect()
    } else {
        separate.iter().map(|(r, s)| (**r, s)).collect()
    };
    if !separate.is_empty() {
        checks::refuse_unknowable(turning.iter().copied(), &request.effects)?;
    }
    let gyroscope = gyroscope(
        &turning,
        separate.is_empty(),
        accelerometer.as_ref(),
        request,
        &mut warnings,
    )?;
    let even = request.clock == ClockMode::Even;
    let clocks = turning
        .iter()
        .filter(|(recording, _)| recording.gyroscope.is_some());
    let clocks = clocks
        .map(|(recording, _)| RecordingClock::given(&recording.name, even))
        .collect();
    let mut calibration = assemble::calibration(assemble::Parts {
        recordings,
        turning: &turning,
        choices: &choices,
        accelerometer: accelerometer.as_ref(),
        gyroscope: gyroscope.as_ref(),
        request,
        warnings,
    })?;
    calibration.carry_gravity(request.gravity_source);
    Ok(Outcome {
        calibration: Calibration {
            clocks,
            ..calibration
        },
        choices,
        accelerometer,
        gyroscope,
        joint: None,
    })
}

/// The rests and turns of a recording without those that are left out; `k` is its place among those that sections were
/// given for.
fn cut(recording: &Recording, request: &Request, k: Option<usize>) -> Result<Choice, Error> {
    let mut choice = whole(recording, request, k)?;
    let of_this = request
        .left_out
        .iter()
        .filter(|i| Some(i.recording) == k.map(|k| k + 1));
    let instants: Vec<f64> = of_this.map(|instant| instant.t).collect();
    if !instants.is_empty() {
        choice.segmentation = choice.segmentation.without(recording, &instants)?;
    }
    Ok(choice)
}

/// All rests and turns of a recording.
fn whole(recording: &Recording, request: &Request, k: Option<usize>) -> Result<Choice, Error> {
    let named = |error| match error {
        Error::NotEnough(what) => Error::NotEnough(format!("{}: {what}", recording.name)),
        other => other,
    };
    if let Some(spans) = k
        .and_then(|k| request.sections.get(k))
        .filter(|spans| !spans.is_empty())
    {
        let segmentation = Segmentation::from_spans(recording, spans, request.detector.multiplier);
        return Ok(Choice {
            segmentation,
            trials: Vec::new(),
            shortened: None,
        });
    }
    let (choose, gravity) = (request.choose_multiplier, request.gravity);
    let detector = Detector {
        creeping: request.method == Method::Joint,
        ..request.detector
    };
    methods::cut(recording, &detector, choose, gravity).map_err(named)
}

/// The accelerometer's fit; `None` where no recording has one.
fn accelerometer(
    recordings: &[&Recording],
    choices: &[Choice],
    request: &Request,
    warnings: &mut Vec<String>,
) -> Result<Option<AccelerometerFit>, Error> {
    if request.static_means.is_empty() && recordings.iter().all(|r| r.accelerometer.is_none()) {
        warnings
            .push("no accelerometer in the recording: only the gyroscope's bias is found".into());
        return Ok(None);
    }
    let mut names = Vec::new();
    let mut means = Vec::new();
    if request.static_means.is_empty() {
        for (recording, choice) in recordings.iter().zip(choices) {
            names.push(recording.name.clone());
            means.push(static_means(recording, &choice.segmentation));
        }
    } else {
        names.push("static means".into());
        means.push(
            request
                .static_means
                .iter()
                .map(|m| checks::bare_mean(*m))
                .collect(),
        );
    }
    checks::enough_rests(recordings, choices, &means)?;
    checks::not_in_one_plane(&means)?;
    let model = accelerometer_model(request);
    let raw: Vec<Vector3<f64>> = means.iter().flatten().map(|m| m.raw).collect();
    let unit = accelerometer_unit(&raw, request.gravity);
    if let Some(unit) = unit.filter(|_| !model.effects().is_empty()) {
        if !request.static_means.is_empty() {
            checks::force_is_all_they_need(model.effects())?;
        } else {
            let first = Sensing::first(model.clone(), unit);
            means = known_means(recordings, choices, |_| first.clone());
        }
        checks::the_norm_tells_them(&model, &means, &unit, request.gravity)?;
    }
    let force_device = request.force_device;
    let mut request = AccelerometerRequest {
        recordings: means,
        names,
        model,
        gravity: request.gravity,
    };
    if !force_device {
        same_device::same_device(&request)?;
    }
    let mut fit = fit_accelerometer(&request)?;
    if choices.len() == request.recordings.len()
        && request.model.effects().iter().any(|e| looks_back(*e))
    {
        let shared = request.model.parameters().len();
        for _ in 0..HISTORIES {
            let by = |k: usize| Sensing::new(request.model.clone(), fit.fitted.local(shared, k));
            let again = known_means(recordings, choices, by);
            let same = again
                .iter()
                .flatten()
                .zip(request.recordings.iter().flatten());
            let same = same
                .into_iter()
                .all(|(a, b)| a.rest.last_change == b.rest.last_change);
            request.recordings = again;
            fit = fit_accelerometer(&request)?;
            if same {
                break;
            }
        }
    }
    checks::accelerometer_is_determined(&checks::ForceEvidence::of(&fit, &request), warnings)?;
    Ok(Some(fit))
}

/// The gyroscope's fit; `None` where no recording has one or there is no gravity to carry.
fn gyroscope(
    turning: &[(&Recording, &Segmentation)],
    same_recordings: bool,
    accelerometer: Option<&AccelerometerFit>,
    request: &Request,
    warnings: &mut Vec<String>,
) -> Result<Option<GyroscopeFit>, Error> {
    let Some(accelerometer) = accelerometer else {
        return Ok(None);
    };
    if turning.iter().all(|(r, _)| r.gyroscope.is_none()) {
        if !turning.is_empty() {
            warnings.push(NO_GYROSCOPE.into());
        }
        return Ok(None);
    }
    let model = gyroscope_model(request);
    let mut sources = Vec::new();
    for (k, (recording, segmentation)) in turning.iter().enumerate() {
        if recording.gyroscope.is_none() || recording.accelerometer.is_none() {
            warnings.push(format!(
                "{}: a sensor is missing: the recording says nothing of the gyroscope",
                recording.name
            ));
            continue;
        }
        let place = same_recordings.then_some(k);
        sources.push(gyro_data::Source {
            recording,
            segmentation,
            place,
            accelerometer,
            request,
        });
    }
    let mut asked = GyroscopeRequest {
        recordings: gyro_data::collect_all(&sources, &model, warnings),
        model,
        integrator: request.integrator,
    };
    let mut fit = fit_gyroscope(&asked)?;
    if asked.model.effects().iter().any(|e| follows_the_fit(*e)) {
        let shared = asked.model.parameters().len();
        let p = fit.fitted.parameters.values()[..shared].to_vec();
        let fitted = Sensing::new(asked.model.clone(), p);
        asked.recordings = gyro_data::collect_by(&sources, &fitted);
        fit = fit_gyroscope(&asked)?;
    }
    checks::gyroscope_is_determined(&checks::RateEvidence::of(&fit), warnings)?;
    Ok(Some(fit))
}

/// Whether an effect looks at where the device came from: a change of force is told from none by the accelerometer's
/// own fit.
fn looks_back(effect: &dyn AnyEffect) -> bool {
    let looks = [Quantity::LastChange, Quantity::Vibration];
    effect.needs().iter().any(|need| looks.contains(need))
}

/// Whether what an effect looks at comes from the gyroscope's own fit.
fn follows_the_fit(effect: &dyn AnyEffect) -> bool {
    let from_rates = [Quantity::AngularAcceleration, Quantity::Attitude];
    effect.needs().iter().any(|need| from_rates.contains(need))
}

/// The sound turns and the rests of a recording as the gyroscope's fit takes them, with the directions
/// of gravity by `accelerometer`.
pub fn gyroscope_data(
    recording: &Recording,
    segmentation: &Segmentation,
    accelerometer: &AccelerometerFit,
    request: &Request,
) -> GyroscopeData {
    let of = gyro_data::Source {
        recording,
        segmentation,
        place: None,
        accelerometer,
        request,
    };
    let all = gyro_data::collect_all(&[of], &gyroscope_model(request), &mut Vec::new());
    all.into_iter().next().unwrap_or_default()
}

/// The static means with what effects look at, by an accelerometer for each recording.
fn known_means(
    recordings: &[&Recording],
    choices: &[Choice],
    by: impl Fn(usize) -> Sensing,
) -> Vec<Vec<StaticMean>> {
    let of = |(k, (recording, choice)): (usize, (&&Recording, &Choice))| {
        let models = Models {
            accelerometer: Some(by(k)),
            ..Models::default()
        };
        let truth = Truth::as_far_as_known(recording, Some(&choice.segmentation), models);
        static_means_by(&truth, &choice.segmentation)
    };
    recordings.iter().zip(choices).enumerate().map(of).collect()
}

/// The accelerometer's base model with its effects.
fn accelerometer_model(request: &Request) -> Model {
    let effects = request.effects.iter();
    effects.fold(accelerometer::model(), |model, effect| model.with(*effect))
}

/// The gyroscope's base model with its effects.
fn gyroscope_model(request: &Request) -> Model {
    let effects = request.effects.iter();
    effects.fold(gyroscope::model(), |model, effect| model.with(*effect))
}
