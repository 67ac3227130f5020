//! Fit of cut recordings by the requested method; of the accelerometer alone where the turns do not determine the gyroscope.

use findings::{Finding, Findings, Kind};
use recording::intervals::{Segmentation, Span, is_of};
use recording::readings::{FASTEST_HAND, Symptom, tremor};
use recording::{Error, Recording};

use super::bias::count_motion;
use super::cut::Cut;
use super::explained::withdraw_explained;
use super::magnetic::with_magnetometer;
use super::outcome::Outcome;
use super::request::{Method, Request};
use super::scalar::with_scalars;
use super::stepwise::stepwise;
use super::unusable_turns::TurnCount;
use super::{changes_part_way, checks, count_scale_changes, joint};
use crate::methods::Choice;

/// Inputs of a fit.
#[derive(Clone, Copy)]
pub(super) struct Fit<'a> {
    /// The recordings.
    pub recordings: &'a Cut<'a>,
    /// Recordings for the gyroscope alone; empty where the others serve.
    pub turning: &'a Cut<'a>,
    /// The request.
    pub request: &'a Request,
    /// Remarks so far.
    pub remarks: &'a Findings,
}

impl Fit<'_> {
    /// Fits the sensors.
    ///
    /// # Errors
    /// As the method; a fit that fails for want of sound data names the hand where the readings show one.
    pub fn run(&self) -> Result<Outcome, Error> {
        if self.request.accelerometer_alone {
            return self.accelerometer_alone();
        }
        match self.by_method() {
            Ok(outcome) => {
                let recordings = &self.recordings.recordings;
                let outcome = self.with_changes(outcome);
                let outcome = with_what_placements_hide(outcome);
                let outcome = with_magnetometer(outcome, recordings, self.request)?;
                with_scalars(outcome, recordings, self.request)
            }
            Err(Error::NotConverged(reason)) => {
                let reason = self.for_the_turns(reason);
                Err(Error::not_converged(self.in_the_hand(reason)))
            }
            Err(Error::NotEnough(refused)) => self
                .without_gyroscope(&refused)
                .ok_or_else(|| Error::not_enough(self.in_the_hand(self.for_dead_axes(refused)))),
            other => other,
        }
    }

    /// The outcome with a warning for everything that changes part of the way through a recording, those of the gyroscope alone too.
    fn with_changes(&self, mut outcome: Outcome) -> Outcome {
        let triad = outcome.calibration.gyroscope.as_ref();
        let gyroscope = triad.map(|triad| (triad.base().t, triad.residual_rms.to_radians()));
        let mut warnings = Findings::new();
        for (recording, cut) in self.recordings.each().chain(self.turning.each()) {
            warnings.extend(checks::corrected_before(recording, cut));
            warnings.extend(gyroscope.and_then(|(t, _)| checks::too_fast(recording, cut, &t)));
            let mut changes = changes_part_way(recording, cut, self.request.gravity, gyroscope);
            let said = &outcome.calibration.warnings;
            changes.retain(|change| !is_left_out(change, said, recording));
            withdraw_motion(&mut outcome.calibration.warnings, recording, &changes);
            warnings.extend(changes);
            checks::say_dead_axes(&mut outcome.calibration.failed_gates, recording);
        }
        outcome.calibration.warnings.extend(warnings);
        withdraw_explained(&mut outcome.calibration.warnings);
        count_motion(&mut outcome.calibration);
        if outcome.joint.is_some() {
            let said: Vec<Finding> = outcome.calibration.warnings.iter().cloned().collect();
            count_scale_changes(&mut outcome.calibration, &said);
        }
        outcome
    }

    fn by_method(&self) -> Result<Outcome, Error> {
        let remarks = self.remarks.clone();
        match self.request.method {
            Method::Joint => joint::calibrate(self.recordings, self.turning, self.request, remarks),
            Method::Auto | Method::Stepwise => {
                stepwise(self.recordings, self.turning, self.request, remarks)
            }
        }
    }

    /// Fits the accelerometer and marks the gyroscope as not calibrated, where the turns are the reason of the refusal.
    fn without_gyroscope(&self, refused: &Finding) -> Option<Outcome> {
        if !self.turning.recordings.is_empty() {
            return None;
        }
        let count = TurnCount::of_cut(self.recordings.each().map(|(_, cut)| cut));
        let reason = count.reason()?;
        let mark = count.mark(reason, refused, self.recordings.each().last());
        let mut outcome = self.accelerometer_alone().ok()?;
        let calibration = &mut outcome.calibration;
        calibration.failed_gates.push(mark.gate());
        calibration.not_calibrated.push(mark);
        Some(outcome)
    }

    /// Fits the accelerometer as if nothing else had been recorded.
    fn accelerometer_alone(&self) -> Result<Outcome, Error> {
        let Cut {
            recordings,
            choices,
        } = self.recordings;
        let bare: Vec<Recording> = recordings
            .iter()
            .map(|recording| Recording {
                name: recording.name.clone(),
                accelerometer: recording.accelerometer.clone(),
                temperature: recording.temperature.clone(),
                ..Recording::default()
            })
            .collect();
        let only_force = bare.iter().zip(choices).map(|(recording, choice)| {
            let spans: Vec<Span> = choice.segmentation.statics.iter().map(|s| s.span).collect();
            let multiplier = choice.segmentation.multiplier;
            Choice {
                segmentation: Segmentation::from_spans(recording, &spans, multiplier),
                ..choice.clone()
            }
        });
        let alone = Cut {
            choices: only_force.collect(),
            recordings: bare.iter().collect(),
        };
        let fit = Fit {
            recordings: &alone,
            ..*self
        };
        let mut outcome = fit.by_method()?;
        outcome.choices = choices.clone();
        outcome
            .calibration
            .warnings
            .retain(|f| f.kind != Kind::NO_GYROSCOPE);
        Ok(outcome)
    }

    /// The reason why a fit came to no end: the turns, where the accelerometer by itself has one.
    fn for_the_turns(&self, reason: Box<Finding>) -> Box<Finding> {
        let may = reason.kind == Kind::FIT_STOPPED && self.turning.recordings.is_empty();
        match may && self.accelerometer_alone().is_ok() {
            true => Box::new(Finding::of(Kind::FIT_STOPPED_BY_TURNS)),
            false => reason,
        }
    }

    /// The reason, with axes that read nothing but noise as its cause.
    fn for_dead_axes(&self, reason: Box<Finding>) -> Box<Finding> {
        let recordings = self.recordings.recordings.iter();
        let dead = recordings.flat_map(|recording| checks::dead_axes(recording));
        dead.fold(reason, |reason, axis| Box::new(reason.because(axis)))
    }

    /// The reason, with the hand that held the device as its cause where the readings show one.
    fn in_the_hand(&self, reason: Box<Finding>) -> Box<Finding> {
        let cause = self.recordings.recordings.iter().find_map(|r| {
            let rate = tremor(r)?;
            Some(match rate < FASTEST_HAND.get() {
                true => Symptom::HandHeld { rate }.in_recording(r),
                false => Finding::of(Kind::NEVER_QUIET).number("rate", rate, "rad/s"),
            })
        });
        match cause {
            Some(cause) => Box::new(reason.because(cause)),
            None => reason,
        }
    }
}

/// The outcome with a warning where the placements would not show an effect of the usual size.
fn with_what_placements_hide(mut outcome: Outcome) -> Outcome {
    let untested = checks::untested_linearity(&outcome.calibration);
    outcome.calibration.warnings.extend(untested);
    outcome
}

/// Returns true if a finding is of a recording, or of a part of it.
fn is_in(found: &Finding, recording: &Recording) -> bool {
    let place = found.place.recording.as_deref();
    place.is_some_and(|own| is_of(own, &recording.name))
}

/// Returns true for a turn that misses gravity and that the fit has left out and said so.
fn is_left_out(change: &Finding, said: &Findings, recording: &Recording) -> bool {
    let middle = |found: &Finding| Some(0.5 * (found.place.t0? + found.place.t1?));
    let holds = |found: &Finding, at: f64| {
        found.place.t0.is_some_and(|t0| t0 < at) && found.place.t1.is_some_and(|t1| at < t1)
    };
    let is_said = |found: &Finding| {
        let is_turn = matches!(found.kind, Kind::TURN_MISSED | Kind::TURN_WITHOUT_SAMPLES);
        is_turn && is_in(found, recording) && middle(change).is_some_and(|at| holds(found, at))
    };
    change.kind == Kind::TURN_OFF && said.iter().any(is_said)
}

/// Takes back that a bias moved or wandered where something of its sensor changes part of the way: that is how it moved.
fn withdraw_motion(warnings: &mut Findings, recording: &Recording, changes: &[Finding]) {
    let changed = |found: &Finding| {
        let mut sensors = changes.iter().filter_map(|change| change.place.sensor);
        found
            .place
            .sensor
            .is_some_and(|own| sensors.any(|sensor| sensor == own))
    };
    warnings.retain(|found| {
        let moves = matches!(
            found.kind,
            Kind::BIAS_MOVED | Kind::BIAS_WANDERED | Kind::BIAS_UNSTEADY
        );
        !(moves && is_in(found, recording) && changed(found))
    });
}
