//! `--method joint`: recordings to a calibration by one weighted problem.

use effects::earth_rotation;
use gyroscope::EARTH_RATE;
use recording::averages::root_mean_square;
use recording::{Error, Recording};
use sensor::{BASE_PARAMETERS, Sensor};

use super::assemble::{effect_values, of_the_gyro_unit, of_the_unit, triad};
use super::cut::cut;
use super::left_out::left_out;
use super::outcome::Outcome;
use super::request::{Frame, Request};
use super::same_device::of_one_device;
use super::{checks, clocks};
use crate::calibration::{
    BiasTime, Calibration, Provenance, RecordingBias, RecordingClock, Remainder, SCHEMA,
    TO_DISCOVER, Triad, WITH_WALKS, in_symmetric_frame,
};
use crate::methods::earth::{self, on_the_earth, vertical_rate, vertical_rate_at};
use crate::methods::joint::{
    Channel, Disturbance, Flagged, JointFit, JointRequest, Missing, Reason, fit_joint,
};
use crate::methods::{Choice, Fitted};

/// A latitude whose vertical part of the earth's rotation is off by so many standard errors is doubted.
const REFUTED: f64 = 4.0;

/// A placement off by so much, m/s², though nothing shook it, was not touched: the sensor lies otherwise in its case, or
/// something lifts it.
const APART: f64 = 0.1;

/// A rest whose absence moves a parameter by so many of its standard errors is named.
const INFLUENTIAL: f64 = 4.0;

/// An effect is said to be missing where chance makes the rows speak so for one in fewer recordings than this.
const SPEAKS: f64 = 5e-4;

/// Calibrates by the joint method.
pub(super) fn calibrate(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    choices: Vec<Choice>,
    request: &Request,
    mut warnings: Vec<String>,
) -> Result<Outcome, Error> {
    if !request.static_means.is_empty() || recordings.iter().any(|r| r.accelerometer.is_none()) {
        return Err(Error::Usage(
            "the joint method needs recordings with an accelerometer: use --method stepwise".into(),
        ));
    }
    let means: Vec<_> = recordings
        .iter()
        .zip(&choices)
        .map(|(recording, choice)| crate::methods::static_means(recording, &choice.segmentation))
        .collect();
    checks::enough_rests(recordings, &choices, &means)?;
    checks::not_in_one_plane(&means)?;
    if !request.force_device {
        of_one_device(recordings.iter().copied().zip(means), request.gravity)?;
    }
    let mut recordings = recordings.to_vec();
    let mut choices = choices;
    for recording in gyro_recordings {
        let choice = cut(recording, request, None)?;
        warnings.extend(checks::of_the_detector(recording, &choice));
        choices.push(choice);
        recordings.push(recording);
    }
    let cut = choices.iter().map(|c| &c.segmentation);
    checks::refuse_unknowable(recordings.iter().copied().zip(cut), &request.effects)?;
    let (mut accelerometer, mut gyroscope) = (accelerometer::model(), gyroscope::model());
    for effect in &request.effects {
        accelerometer = accelerometer.with(*effect);
        gyroscope = gyroscope.with(*effect);
    }
    // Where nobody says the latitude and no effect estimates it, the earth's rotation is uncertainty.
    let earth = request.latitude.is_none() && !earth::is_among(&request.effects);
    let held = match request.latitude {
        Some(latitude) => {
            let (with_it, vertical) = on_the_earth(gyroscope, latitude);
            gyroscope = with_it;
            vec![vertical]
        }
        None => Vec::new(),
    };
    let fit = fit_joint(&JointRequest {
        accelerometer,
        gyroscope,
        held,
        clock: request.clock,
        earth,
        ..JointRequest::new(
            recordings
                .iter()
                .copied()
                .zip(choices.iter().map(|c| &c.segmentation))
                .collect(),
            request.gravity,
        )
    })?;
    let chosen: Vec<&Choice> = choices.iter().collect();
    let calibration = written_down(&fit, &recordings, &chosen, request, &mut warnings)?;
    let mut calibration = Calibration {
        warnings,
        ..calibration
    };
    calibration.carry_gravity(request.gravity_source);
    Ok(Outcome {
        calibration,
        choices,
        accelerometer: None,
        gyroscope: None,
        joint: Some(fit),
    })
}

/// The fit as a [`Calibration`], checked; `warnings` stay outside.
pub fn written_down(
    fit: &JointFit,
    recordings: &[&Recording],
    choices: &[&Choice],
    request: &Request,
    warnings: &mut Vec<String>,
) -> Result<Calibration, Error> {
    let force = fit.fitted(Sensor::Accelerometer);
    let rate = fit.has_gyroscope().then(|| fit.fitted(Sensor::Gyroscope));
    check_force(fit, &force, warnings)?;
    let mut failed_gates = Vec::new();
    for (recording, choice) in recordings.iter().zip(choices) {
        let segmentation = &choice.segmentation;
        let scale = fit.force_unit.scale;
        failed_gates.extend(checks::restless(
            recording,
            segmentation,
            scale,
            request.gravity,
        ));
        warnings.extend(checks::long_turns(recording, segmentation));
    }
    if let Some(rate) = &rate {
        failed_gates.extend(check_rate(fit, rate, warnings)?);
    }
    failed_gates.extend(placements_apart(fit));
    warnings.extend(of_the_unit(&fit.force_unit));
    if rate.is_some() {
        warnings.extend(of_the_gyro_unit(&fit.rate_unit, fit.force_unit.is_si()));
    }
    warnings.extend(clocks::doubts(fit));
    disturbances(fit, warnings);
    let remainders: Vec<Remainder> = fit.misfits().iter().map(Remainder::of).collect();
    let what_next = if request.is_discovery {
        ""
    } else {
        TO_DISCOVER
    };
    let misfits = remainders.iter();
    let misfits = misfits.filter_map(|r| r.warning(WITH_WALKS, what_next));
    let mut misfits: Vec<String> = misfits.collect();
    if misfits.is_empty() && !request.is_discovery {
        misfits.extend(fit.missing().and_then(|missing| of_missing(&missing)));
    }
    warnings.extend(misfits);
    warnings.extend(request.latitude.and_then(|l| latitude_in_doubt(fit, l)));
    influences(fit, warnings);
    // The earth's rotation is no error of the sensor: corrected rates keep it.
    let of_the_earth =
        |name: &str| request.latitude.is_some() && name.starts_with(earth_rotation().name());
    let all = fit.fitted_where(|name| !of_the_earth(name));
    let effects = effect_values(&fit.models[0], &all)
        .chain(effect_values(&fit.models[1], &all))
        .filter(|effect| !of_the_earth(&effect.name))
        .collect();
    let chi2 = |channel: Channel| {
        let own = remainders.iter().find(|r| r.channel == channel);
        own.map(|r| r.reduced_chi2)
    };
    let calibration = Calibration {
        schema: SCHEMA.into(),
        created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
        gravity: request.gravity,
        gravity_source: request.gravity_source,
        method: "joint".into(),
        accelerometer: Some(Triad {
            reduced_chi2: chi2(Channel::Force),
            ..force_triad(fit, &force, recordings)
        }),
        gyroscope: rate.as_ref().map(|rate| Triad {
            reduced_chi2: chi2(Channel::Direction),
            ..rate_triad(fit, rate, recordings)
        }),
        magnetometer: None,
        magnetic_field: None,
        effects,
        left_out: left_out(fit, &all),
        parameters: all.free,
        covariance: all.covariance,
        misfit: remainders,
        warnings: Vec::new(),
        clocks: RecordingClock::of(fit),
        history: Vec::new(),
        failed_gates,
        limits: Vec::new(),
        prior: None,
        provenance: Provenance::of(Vec::new(), None),
    };
    Ok(match request.frame {
        Frame::Triangular => calibration,
        Frame::Symmetric => in_symmetric_frame(calibration),
    })
}

/// Refuses a fit that leaves combinations of parameters open: no effect beside them closes those.
///
/// # Errors
/// [`Error::NotEnough`] with the placements and turns to add.
pub fn refuse_unobservable(fit: &JointFit) -> Result<(), Error> {
    let is_open = |fitted: &Fitted| fitted.rank < fitted.free.len();
    let unsaid = &mut Vec::new();
    let force = fit.fitted(Sensor::Accelerometer);
    if is_open(&force) {
        check_force(fit, &force, unsaid)?;
    }
    let rate = fit.has_gyroscope().then(|| fit.fitted(Sensor::Gyroscope));
    if let Some(rate) = rate.filter(is_open) {
        check_rate(fit, &rate, unsaid)?;
    }
    Ok(())
}

fn check_force(fit: &JointFit, fitted: &Fitted, warnings: &mut Vec<String>) -> Result<(), Error> {
    let evidence = checks::ForceEvidence {
        fitted,
        directions: fit.directions(),
        scale: fit.force_unit.scale,
        gravity: fit.gravity,
        ending: fit.ending,
    };
    checks::accelerometer_is_determined(&evidence, warnings)
}

/// Refuses or warns; the gates that the gyroscope fails.
fn check_rate(
    fit: &JointFit,
    fitted: &Fitted,
    warnings: &mut Vec<String>,
) -> Result<Vec<String>, Error> {
    let evidence = checks::RateEvidence {
        fitted,
        turns: fit.chords.len(),
        scale: fit.rate_unit.scale,
        rms: root_mean_square(&fit.chords),
        ending: fit.ending,
    };
    if !fit.chords.is_empty() {
        checks::gyroscope_is_determined(&evidence, warnings)?;
        warnings.extend(checks::turned_axes(&evidence));
    }
    Ok(checks::gyroscope_gates(&evidence, fit.force_unit.is_si()))
}

/// The placements whose force no touch explains: nothing shook, and they are off by more than [`APART`].
fn placements_apart(fit: &JointFit) -> Option<String> {
    let apart = |a: &&Flagged| {
        let is_pushed = a.kind == Disturbance::DisturbedInterval && a.reason == Reason::Disturbed;
        is_pushed && !a.shook && a.size > APART
    };
    let all: Vec<String> = fit
        .flagged
        .iter()
        .filter(apart)
        .map(|a| {
            let name = &fit.data.sources[a.recording].name;
            format!(
                "{name}: static interval {} by {:.2} m/s²",
                a.interval + 1,
                a.size
            )
        })
        .collect();
    (!all.is_empty()).then(|| {
        format!(
            "placements disagree with the others though nothing shook there ({}): did the sensor slip in its case? The \
             calibration is without them; fix the sensor and record again",
            all.join(", ")
        )
    })
}

/// An effect that the rows speak for though no channel as a whole misfits: its part in the errors is not in them.
fn of_missing(missing: &Missing) -> Option<String> {
    (missing.p_value < SPEAKS).then(|| {
        format!(
            "misfit of the accelerometer by an effect that its model lacks, most like {} (chi² {:.1} of {} degrees of freedom, \
             p = {:.0e} of all that were tried): no standard error contains it. `stillpoint discover` tells what it is and \
             estimates it",
            missing.effect.name(),
            missing.statistic,
            missing.dof,
            missing.p_value,
        )
    })
}

/// Names what was disturbed, with interval and times.
fn disturbances(fit: &JointFit, warnings: &mut Vec<String>) {
    let name = |recording: usize| &fit.data.sources[recording].name;
    for lost in &fit.data.lost {
        warnings.push(format!(
            "{}: turn {} (t = {:.2} to {:.2} s) is not used: {}",
            name(lost.recording),
            lost.turn + 1,
            lost.span.from,
            lost.span.to,
            lost.fault
        ));
    }
    for (place, gap) in &fit.data.gaps {
        let rest = &fit.data.rests[*place];
        warnings.push(format!(
            "{}: static interval {} (t = {:.2} to {:.2} s) has a gap of {:.2} s at t = {:.2} s",
            name(rest.recording),
            rest.interval + 1,
            rest.span.from,
            rest.span.to,
            gap.length(),
            gap.from
        ));
    }
    if let Some(shaken) = fit.data.shakes_throughout() {
        warnings.push(format!(
            "{shaken} of {} static intervals shake more than the quiet parts of the recording: was the device \
             held in the hand? They are weighted by their own noise, and touches are not told from it",
            fit.data.rests.len()
        ));
    }
    for (place, source) in fit.data.sources.iter().enumerate() {
        if source.moves_at_rest() {
            warnings.push(format!(
                "{}: the device sways in its static intervals and comes back, as one that is held in the hand does: turns begin \
                 and end off its mean attitude there, and creeping is not told from it. Lay it down for smaller errors",
                name(place)
            ));
        }
    }
    for flagged in &fit.flagged {
        let (what, done) = match flagged.kind {
            _ if flagged.reason == Reason::BiasStepped => (
                "static interval",
                "the bias stepped within it, so that its mean is not used",
            ),
            Disturbance::MountSlip | Disturbance::SuddenSlip => (
                "static interval",
                "the device crept while it should have rested (mount_slip); its creep is fitted",
            ),
            Disturbance::DisturbedInterval => (
                "static interval",
                "something touched or pushed the device (disturbed_interval); its force is not used",
            ),
            Disturbance::RateExcursion => (
                "static interval",
                "the mean of the gyroscope is off in this interval alone; it is not used",
            ),
            Disturbance::BadTurn => (
                "turn",
                "gravity is missed by far more than the noise; the turn is not used",
            ),
        };
        let detail = if flagged.detail.is_empty() { "" } else { ": " };
        warnings.push(format!(
            "{}: {what} {} (t = {:.2} to {:.2} s): {done}{detail}{}",
            name(flagged.recording),
            flagged.interval + 1,
            flagged.span.from,
            flagged.span.to,
            flagged.detail
        ));
    }
}

/// Names the rests without which a parameter would be another.
fn influences(fit: &JointFit, warnings: &mut Vec<String>) {
    for influence in fit.influences() {
        if influence.change > INFLUENTIAL && influence.change.is_finite() {
            let rest = &fit.data.rests[influence.rest];
            warnings.push(format!(
                "{}: without static interval {} (t = {:.2} to {:.2} s) {} would move by {:.1} of its \
                 standard errors",
                fit.data.sources[rest.recording].name,
                rest.interval + 1,
                rest.span.from,
                rest.span.to,
                influence.parameter,
                influence.change
            ));
        }
    }
}

fn force_triad(fit: &JointFit, fitted: &Fitted, recordings: &[&Recording]) -> Triad {
    let mut triad = triad(Sensor::Accelerometer, fitted);
    triad.residual_rms = fit.norm_rms();
    triad.bias_time = bias_time(fit, Sensor::Accelerometer, &triad.bias);
    triad.static_intervals = Some(fit.data.rests.len());
    let shared = fit.models[0].parameter_count();
    if fit.own_force_bias {
        triad.recordings = own_biases(Sensor::Accelerometer, fitted, shared, recordings);
    }
    triad
}

/// For which time the bias of the last recording holds.
fn bias_time(fit: &JointFit, sensor: Sensor, bias: &[f64; 3]) -> Option<BiasTime> {
    let last = fit.data.sources.len().checked_sub(1)?;
    let moved = fit.bias_motion(sensor, last)?;
    let unit = fit.unit(sensor).scale;
    let change = moved.change / unit;
    let at = |share: f64| std::array::from_fn(|k| bias[k] + share * change[k]);
    Some(BiasTime {
        holds: "mean over the static intervals".into(),
        from: moved.span.from,
        to: moved.span.to,
        start: at(-moved.before),
        end: at(1.0 - moved.before),
        change: change.into(),
        change_std: (moved.std / unit).into(),
    })
}

/// Says where the data refute the vertical part of the earth's rotation that the latitude gives.
fn latitude_in_doubt(fit: &JointFit, latitude: f64) -> Option<String> {
    let (pull, std) = fit.pull_of_held(&vertical_rate())?;
    let given = vertical_rate_at(latitude);
    let seen = given + pull;
    (pull.abs() > REFUTED * std).then(|| {
        let sine = (seen / EARTH_RATE).clamp(-1.0, 1.0);
        format!(
            "--latitude {latitude}: the earth's rotation would have a vertical part of {given:.2e} rad/s, the recording \
             shows {seen:.2e} ± {std:.0e} rad/s, as at a latitude of {:.0}°: is its sign right?",
            sine.asin().to_degrees()
        )
    })
}

fn rate_triad(fit: &JointFit, fitted: &Fitted, recordings: &[&Recording]) -> Triad {
    let mut triad = triad(Sensor::Gyroscope, fitted);
    triad.residual_rms = fit.direction_rms().to_degrees();
    triad.bias_time = bias_time(fit, Sensor::Gyroscope, &triad.bias);
    triad.dynamic_intervals = Some(fit.chords.len());
    let shared = fit.models[1].parameter_count();
    triad.recordings = own_biases(Sensor::Gyroscope, fitted, shared, recordings);
    triad
}

/// The bias of every recording, where there are several.
fn own_biases(
    sensor: Sensor,
    fitted: &Fitted,
    shared: usize,
    recordings: &[&Recording],
) -> Vec<RecordingBias> {
    if recordings.len() < 2 {
        return Vec::new();
    }
    let of = |(k, recording): (usize, &&Recording)| {
        let bias = &fitted.local(shared, k)[9..BASE_PARAMETERS];
        let std = ["x", "y", "z"].map(|axis| {
            let common = format!("{}.b_{axis}", sensor.prefix());
            let own = format!("{common}[{}]", recording.name);
            fitted
                .standard_error(&own)
                .or(fitted.standard_error(&common))
        });
        RecordingBias {
            recording: recording.name.clone(),
            bias: [bias[0], bias[1], bias[2]],
            bias_std: std,
        }
    };
    recordings.iter().enumerate().map(of).collect()
}
