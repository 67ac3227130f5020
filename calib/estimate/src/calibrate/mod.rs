//! Recordings to a calibration: segment, accelerometer, gyroscope, checks, result.

mod assemble;
mod checks;
mod clocks;
mod cut;
mod joint;
mod left_out;
mod magnetic;
mod noise;
mod outcome;
pub mod own_effects;
mod part_way;
pub(crate) mod request;
mod rest_bias;
mod same_device;
mod static_norm;
mod stepwise;
mod unusable_turns;

pub(crate) use checks::few_directions;
pub use checks::{
    Said, implausible, implausible_base, none_is_there_twice, none_is_turned, not_in_one_plane,
    without_copies,
};
pub use joint::{Account, LatitudeDoubt, refuse_unobservable, written_down};
pub use magnetic::FIELDS;
pub use outcome::Outcome;
pub use part_way::changes_part_way;
pub use recording::read_static_means;
pub use request::{Frame, GyroBias, Instant, Method, NOMINAL_RATES, Request};
pub use same_device::{gyroscope_of_one_device, of_one_device};
pub use stepwise::gyroscope_data;

use std::borrow::Borrow;

use findings::{Findings, Kind};
use recording::intervals::{Segmentation, Span};
use recording::readings::{FASTEST_HAND, Symptom, tremor, without_spikes};
use recording::{AppliedBefore, Error, Recording};
use sensor::Sensor;

use self::cut::cut;
use self::stepwise::stepwise;
use self::unusable_turns::TurnCount;
use crate::calibration::Options;
use crate::methods::joint::{ClockMode, MOST_STATIC_INTERVALS, within_budget};
use crate::methods::{Choice, cut_several};

pub use crate::gravity::STANDARD_GRAVITY;

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
    request.refuse_ignored()?;
    magnetic::refuse_alone(&recordings)?;
    calibrate_all(&recordings, &gyro_recordings, &request)
}

fn calibrate_all(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    let all = recordings.iter().chain(gyro_recordings);
    own_effects::grant_steps(&request.effects, all.copied());
    let mut said = Findings::new();
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
    let (mut counted, _) = without_copies(recordings.iter().copied());
    counted.extend(gyro_recordings);
    let cut = outcome.choices.iter().map(|c| Some(&c.segmentation));
    let cut = cut.chain(std::iter::repeat(None));
    let multipliers = outcome.choices.iter().map(|c| c.segmentation.multiplier);
    let options = Options::of(request, multipliers.collect());
    let all = counted.into_iter().zip(cut);
    let reads_zero: Vec<bool> = all
        .clone()
        .map(|(recording, cut)| cut.is_some_and(|cut| checks::reads_zero_at_rest(recording, cut)))
        .collect();
    let calibration = &mut outcome.calibration;
    calibration.state_inputs(all, Some(options));
    let inputs = calibration.provenance.inputs.iter_mut();
    for (input, _) in inputs.zip(reads_zero).filter(|(_, reads_zero)| *reads_zero) {
        let gyroscope = AppliedBefore::by(AppliedBefore::UNKNOWN, Sensor::Gyroscope);
        let claims = &mut input.applied_before;
        if !claims.iter().any(|claim| claim.sensor == gyroscope.sensor) {
            claims.push(gyroscope);
        }
    }
    let mixed = calibration.mixed_corrections();
    calibration.warnings.extend(mixed);
    calibration.seal();
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
    let mut warnings = Findings::new();
    let clean = recordings.iter().zip(&cleaned);
    let clean = clean.map(|(raw, cleaned)| cleaned.as_ref().map_or(*raw, |(clean, _)| clean));
    let (recordings, copies) = without_copies(clean);
    warnings.extend(copies);
    let own = recordings.iter().flat_map(|r| r.warnings.iter().cloned());
    warnings.extend(own);
    for (recording, found) in cleaned.iter().flatten() {
        warnings.extend(found.iter().map(|f| f.in_recording(recording)));
    }
    let mut choices = cut_several(recordings.len(), &request.detector, |k, detector| {
        let request = Request {
            detector: *detector,
            ..request.clone()
        };
        cut(recordings[k], &request, Some(k))
    })?;
    if !request.force_device {
        let cut = choices.iter().map(|choice| &choice.segmentation);
        none_is_there_twice(recordings.iter().copied().zip(cut))?;
        let cut = choices.iter().map(|choice| &choice.segmentation);
        none_is_turned(recordings.iter().copied().zip(cut), request.gravity)?;
    }
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
    if request.accelerometer_alone {
        return parts.accelerometer_alone(choices);
    }
    let refused = match parts.fitted(choices.clone()) {
        Err(Error::NotEnough(reason)) => reason,
        Err(Error::NotConverged(reason)) => {
            return Err(Error::not_converged(in_the_hand(reason, &recordings)));
        }
        Ok(outcome) => {
            let outcome = with_changes(outcome, &recordings, request.gravity);
            return magnetic::with_magnetometer(outcome, &recordings, request);
        }
        Err(other) => return Err(other),
    };
    match parts.without_gyroscope(choices, &refused) {
        Some(outcome) => Ok(outcome),
        None => Err(Error::not_enough(in_the_hand(refused, &recordings))),
    }
}

/// The outcome with a warning for everything that changes part of the way through a recording.
fn with_changes(mut outcome: Outcome, recordings: &[&Recording], gravity: f64) -> Outcome {
    let triad = outcome.calibration.gyroscope.as_ref();
    let gyroscope = triad.map(|triad| (triad.base().t, triad.residual_rms.to_radians()));
    let mut warnings = Findings::new();
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
fn in_the_hand(
    reason: Box<findings::Finding>,
    recordings: &[&Recording],
) -> Box<findings::Finding> {
    let cause = recordings.iter().find_map(|r| {
        let rate = tremor(r)?;
        Some(match rate < FASTEST_HAND {
            true => Symptom::HandHeld { rate }.in_recording(r),
            false => findings::Finding::of(Kind::NeverQuiet).number("rate", rate, "rad/s"),
        })
    });
    match cause {
        Some(cause) => Box::new(reason.because(cause)),
        None => reason,
    }
}

/// Inputs of a calibration.
struct Parts<'a> {
    recordings: &'a [&'a Recording],
    gyro_recordings: &'a [&'a Recording],
    request: &'a Request,
    warnings: &'a Findings,
}

impl Parts<'_> {
    fn fitted(&self, choices: Vec<Choice>) -> Result<Outcome, Error> {
        let warnings = self.warnings.clone();
        let (recordings, others) = (self.recordings, self.gyro_recordings);
        match self.request.method {
            Method::Joint => joint::calibrate(recordings, others, choices, self.request, warnings),
            Method::Auto | Method::Stepwise => {
                stepwise(recordings, others, choices, self.request, warnings)
            }
        }
    }

    /// The accelerometer, with the reason in the place of the gyroscope, where the turns are why that one is not known.
    fn without_gyroscope(
        &self,
        choices: Vec<Choice>,
        refused: &findings::Finding,
    ) -> Option<Outcome> {
        if !self.gyro_recordings.is_empty() {
            return None;
        }
        let count = TurnCount::of_cut(choices.iter().map(|choice| &choice.segmentation));
        let reason = count.reason()?;
        let cut = choices.iter().map(|choice| &choice.segmentation);
        let mut known = self.recordings.iter().copied().zip(cut);
        let mark = count.mark(reason, refused, known.next_back());
        let mut outcome = self.accelerometer_alone(choices).ok()?;
        let calibration = &mut outcome.calibration;
        calibration.failed_gates.push(mark.gate());
        calibration.not_calibrated.push(mark);
        Some(outcome)
    }

    /// The accelerometer as if nothing else had been recorded.
    fn accelerometer_alone(&self, choices: Vec<Choice>) -> Result<Outcome, Error> {
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
        let mut outcome = parts.fitted(only_force.collect())?;
        outcome.choices = choices;
        outcome
            .calibration
            .warnings
            .retain(|f| f.kind != Kind::NoGyroscope);
        Ok(outcome)
    }
}
