//! A joint fit as a calibration.

use effects::earth_rotation;
use findings::{Findings, Kind};
use recording::{Error, Recording};
use sensor::{Model, Sensor};

use super::delays::count_from_the_earliest;
use super::determined::{check_force, check_rate};
use super::doubts::{disturbances, influences, placements_apart};
use super::latitude::LatitudeDoubt;
use super::misfits::say_misfits;
use super::triads::{force_triad, rate_triad};
use crate::calibrate::after_turns::{AfterTurns, Trials, not_excluded, rested_of};
use crate::calibrate::assemble::effect_values;
use crate::calibrate::checks;
use crate::calibrate::left_out::left_out;
use crate::calibrate::prepared::clocks;
use crate::calibrate::request::Frame;
use crate::calibrate::unusable_turns::TurnCount;
use crate::calibration::{
    Calibration, NotCalibrated, NotCalibratedReason, RecordingBias, RecordingClock, Remainder,
    Triad, in_symmetric_frame,
};
use crate::gravity::GravitySource;
use crate::methods::joint::{BiasMotion, Channel, JointFit};
use crate::methods::{Choice, Fitted};

/// Settings and circumstances that a calibration states beside the fit.
#[derive(Clone, Copy, Debug)]
pub struct Account {
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Who says it.
    pub gravity_source: GravitySource,
    /// Latitude, °, where it is known.
    pub latitude: Option<f64>,
    /// True if the earth's rotation in a model is not an error of the sensor: corrected rates keep it then.
    pub keeps_the_earth: bool,
    /// Frame of the result.
    pub frame: Frame,
    /// True if the caller searches for missing effects itself: no warning suggests that search then.
    pub names_what_is_missing: bool,
}

/// Builds the mark of a gyroscope that is not calibrated, as there is no usable turn.
fn without_a_turn(
    fit: &JointFit,
    rate: &Fitted,
    recordings: &[&Recording],
    choices: &[&Choice],
) -> NotCalibrated {
    let turns = choices.iter().map(|choice| choice.segmentation.turns.len());
    let lost = fit.data.lost.iter().map(|turn| &turn.fault);
    let count = TurnCount::of(turns.sum(), lost);
    let triad = rate_triad(fit, rate, None);
    let bias = RecordingBias {
        recording: recordings
            .last()
            .map_or_else(String::new, |r| r.name.clone()),
        bias: triad.bias,
        bias_std: triad.bias_std,
    };
    let reason = NotCalibratedReason::NoUsableTurn;
    NotCalibrated::gyroscope(reason, &count.finding(), Some(bias))
}

/// Returns true if a parameter is one of the model: its base's or an effect's.
fn is_of(model: &Model, name: &str) -> bool {
    let mut effects = model.effects().iter();
    owner(name) == model.sensor().prefix() || effects.any(|e| owner(name) == e.name())
}

/// The base model or effect of a parameter, by its name.
fn owner(name: &str) -> &str {
    name.split_once('.').map_or(name, |(owner, _)| owner)
}

/// Gates of static intervals in which the device moved; warns of turns that are long.
fn restless(
    fit: &JointFit,
    recordings: &[&Recording],
    choices: &[&Choice],
    gravity: f64,
    warnings: &mut Findings,
) -> Findings {
    let mut gates = Findings::new();
    let scale = fit.force_unit.scale;
    for (recording, choice) in recordings.iter().zip(choices) {
        let cut = &choice.segmentation;
        gates.extend(checks::restless(recording, cut, scale, gravity));
        warnings.extend(checks::long_turns(recording, cut));
    }
    gates
}

/// Findings on fitted parameters that no device has: units, signs and columns that were read wrongly.
fn read_wrongly(
    fit: &JointFit,
    force: &Fitted,
    rate: Option<&Fitted>,
    recordings: &[&Recording],
) -> checks::Said {
    let mut said = checks::ForceFit::of(force, fit.force_unit, fit.gravity, recordings).said();
    if let Some(rate) = rate {
        let (missed, unit) = (fit.missed(), &fit.force_unit);
        let of_rate = checks::RateFit::of(rate, &fit.rate_unit, missed, unit, recordings);
        said.append(of_rate.said());
    }
    said
}

/// Warns of clocks, disturbances, what the model leaves, another latitude, and intervals that decide alone.
fn doubts(
    fit: &JointFit,
    remainders: &[Remainder],
    recordings: &[&Recording],
    account: &Account,
    warnings: &mut Findings,
) {
    warnings.extend(clocks::doubts(fit));
    disturbances(fit, warnings);
    let is_of_search = account.names_what_is_missing;
    say_misfits(fit, remainders, recordings, is_of_search, warnings);
    // More than the earth turns is an error of the gyroscope, whatever the latitude.
    let doubt = account.latitude.and_then(|l| LatitudeDoubt::of(fit, l));
    let doubt = doubt.filter(LatitudeDoubt::is_of_the_earth);
    warnings.extend(doubt.map(|doubt| doubt.finding()));
    influences(fit, warnings);
}

/// The fit as a [`Calibration`], checked; `warnings` stay outside.
pub fn written_down(
    fit: &JointFit,
    recordings: &[&Recording],
    choices: &[&Choice],
    account: &Account,
    warnings: &mut Findings,
) -> Result<Calibration, Error> {
    let force = fit.fitted(Sensor::Accelerometer);
    let rate = fit.has_gyroscope().then(|| fit.fitted(Sensor::Gyroscope));
    let turned = rate.as_ref().filter(|_| !fit.chords.is_empty());
    check_force(fit, &force, warnings)?;
    let mut failed_gates = restless(fit, recordings, choices, account.gravity, warnings);
    if let Some(rate) = turned {
        check_rate(fit, rate, warnings)?;
    }
    let lost = rate.as_ref().filter(|_| turned.is_none());
    let lost = lost.map(|rate| without_a_turn(fit, rate, recordings, choices));
    let not_calibrated: Vec<NotCalibrated> = lost.into_iter().collect();
    failed_gates.extend(not_calibrated.iter().map(NotCalibrated::gate));
    failed_gates.extend(placements_apart(fit));
    read_wrongly(fit, &force, turned, recordings).add_to(&mut failed_gates, warnings);
    let remainders: Vec<Remainder> = fit.misfits().iter().map(Remainder::of).collect();
    doubts(fit, &remainders, recordings, account, warnings);
    let motions = fit.bias_motions();
    let last = |motions: &[Option<BiasMotion>]| motions.last().copied().flatten();
    let [moved_force, moved_rate] = [last(&motions[0]), last(&motions[1])];
    let of_the_earth =
        |name: &str| account.keeps_the_earth && owner(name) == earth_rotation().name();
    let of_a_lost_gyroscope = |name: &str| turned.is_none() && is_of(&fit.models[1], name);
    let all = fit.fitted_where(|name| !of_the_earth(name) && !of_a_lost_gyroscope(name));
    let of_turns = turned.map(|_| effect_values(&fit.models[1], &all));
    let effects = effect_values(&fit.models[0], &all)
        .chain(of_turns.into_iter().flatten())
        .filter(|effect| !of_the_earth(&effect.name))
        .collect();
    // What settles where the device turned at rest is its support.
    let rests = (!warnings.has(Kind::RESTS_TURN)).then(|| rested_of(fit, recordings, &motions[0]));
    let settling = rests.flatten();
    let settling = settling.as_deref().and_then(Trials::within);
    let slow = settling.as_ref().map(|own| not_excluded(fit, own));
    let chi2 = |channel: Channel| {
        let own = remainders.iter().find(|r| r.channel == channel);
        own.map(|r| r.reduced_chi2)
    };
    let mut calibration = Calibration {
        accelerometer: Some(Triad {
            reduced_chi2: chi2(Channel::Force),
            ..force_triad(fit, &force, moved_force.as_ref())
        }),
        gyroscope: turned.map(|rate| Triad {
            reduced_chi2: chi2(Channel::Direction),
            ..rate_triad(fit, rate, moved_rate.as_ref())
        }),
        not_calibrated,
        effects,
        left_out: left_out(fit, &all, &slow.unwrap_or_default()),
        parameters: all.free,
        covariance: all.covariance,
        misfit: remainders,
        clocks: RecordingClock::of(fit),
        failed_gates,
        ..Calibration::by("joint", account.gravity, account.gravity_source)
    };
    let settles = settling.and_then(|own| AfterTurns::of(fit, recordings, &own, &calibration));
    if let Some(settles) = settles {
        settles.count(&mut calibration, warnings);
    }
    count_from_the_earliest(&mut calibration);
    Ok(match account.frame {
        Frame::Triangular => calibration,
        Frame::Symmetric => in_symmetric_frame(calibration),
    })
}
