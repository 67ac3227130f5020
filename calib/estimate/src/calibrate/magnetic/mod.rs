//! The magnetometer, after the sensors that give it the attitude.
//!
//! `inertial` is what their calibration leaves open, `collect` cuts the recordings into placements and `turns` carries
//! the heading from one to the next, `stepped` and `wandering` look for a bias that moves, `missing` asks whether
//! an effect of the catalogue would explain what is left, `write` puts the fit into the calibration.

mod collect;
mod inertial;
mod left_out;
mod missing;
mod source;
mod stepped;
mod turns;
mod units;
mod wandering;
mod write;

use findings::{Finding, Kind};
use inertial::Inertial;
use recording::averages::median;
use recording::{Error, FieldUnit, Recording, figure};
use sensor::{EffectRef, Quantity, Sensor};

use self::left_out::left_out;
use self::units::Units;
use super::bias::count_motion_of;
use super::checks::turned_field;
use super::outcome::Outcome;
use super::request::{Method, Request};
use crate::calibration::Calibration;
use crate::methods::Choice;
use crate::methods::magnetic::{MagneticRequest, fit_magnetometer};

/// Strengths of a magnetic field that may be given, µT. The earth's is 22 to 67.
pub const FIELDS: std::ops::RangeInclusive<f64> = 1.0..=1000.0;

/// The outcome with its magnetometer; with a warning that says why where that cannot be calibrated.
///
/// # Errors
/// [`Error::NotEnough`] where an effect of the magnetometer is asked for and it cannot be calibrated, [`Error::Usage`]
/// where recordings have different units.
pub(super) fn with_magnetometer(
    mut outcome: Outcome,
    recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    let asked = |effect: &&EffectRef| effect.sensor() == Sensor::Magnetometer;
    let asked = request.effects.iter().find(asked);
    if recordings.iter().all(|r| r.magnetometer.is_none()) {
        return match asked {
            Some(effect) => Err(Error::not_enough(
                Finding::of(Kind::EFFECT_NEEDS_SENSOR)
                    .of_sensor(Sensor::Magnetometer)
                    .detail("effect", effect.name())
                    .detail("quantity", Quantity::MagneticField.to_string()),
            )),
            None => Ok(outcome),
        };
    }
    match fitted(&mut outcome, recordings, request) {
        Ok(()) => Ok(outcome),
        Err(Error::NotEnough(reason) | Error::NotConverged(reason)) if asked.is_none() => {
            outcome.calibration.warnings.push(
                Finding::of(Kind::MAGNETOMETER_NOT_CALIBRATED).detail("why", reason.to_string()),
            );
            Ok(outcome)
        }
        Err(other) => Err(other),
    }
}

/// A calibration of the other sensors with the magnetometer of the recordings that it was made from, cut as `choices` say; with a warning that
/// says why where that cannot be calibrated.
///
/// # Errors
/// [`Error::Usage`] where recordings have different units.
pub fn beside_the_others(
    calibration: Calibration,
    recordings: &[&Recording],
    choices: &[&Choice],
    latitude: Option<f64>,
) -> Result<Calibration, Error> {
    let outcome = Outcome {
        calibration,
        choices: choices.iter().copied().cloned().collect(),
        accelerometer: None,
        gyroscope: None,
        joint: None,
    };
    let request = Request {
        method: Method::Joint,
        latitude,
        ..Request::default()
    };
    Ok(with_magnetometer(outcome, recordings, &request)?.calibration)
}

/// Refuses recordings of a magnetometer and nothing else.
///
/// # Errors
/// [`Error::NotEnough`] with what to record beside it.
pub(super) fn refuse_alone(recordings: &[&Recording]) -> Result<(), Error> {
    match recordings.iter().find(|r| r.is_magnetometer_only()) {
        Some(alone) => Err(Error::not_enough(
            Finding::of(Kind::MAGNETOMETER_ALONE).in_recording(&alone.name),
        )),
        None => Ok(()),
    }
}

fn fitted(
    outcome: &mut Outcome,
    recordings: &[&Recording],
    request: &Request,
) -> Result<(), Error> {
    for recording in recordings {
        no_axis_is_constant(recording)?;
    }
    let unit = common_unit(recordings, request)?;
    let units = Units::of(unit, request.field.is_some());
    if outcome.calibration.accelerometer.is_none() {
        return Err(Error::not_enough(Finding::of(Kind::ATTITUDE_NOT_SEEN)));
    }
    let model = request.model(Sensor::Magnetometer);
    let inertial = Inertial::of(&outcome.calibration);
    let with_field: Vec<usize> = (0..recordings.len())
        .filter(|&k| recordings[k].magnetometer.is_some())
        .collect();
    let choices = &outcome.choices;
    let collected = collect::collect(
        with_field
            .iter()
            .map(|&k| (recordings[k], &choices[k].segmentation)),
        &outcome.calibration,
        &inertial,
        unit.map_or(1.0, FieldUnit::in_microtesla),
    );
    let base = MagneticRequest {
        model: &model,
        placements: collected.placements,
        changes: collected.changes,
        recordings: with_field.len(),
        parts: with_field.len(),
        errors: inertial.errors(),
        strength: request.field,
        walk: collected.walk,
    };
    let whole = fit_magnetometer(base.clone())?;
    let has_temperature = with_field
        .iter()
        .all(|&k| recordings[k].temperature.is_some());
    let missing = missing::effect(&model, &whole, has_temperature, |larger| {
        fit_magnetometer(base.clone().with_model(larger)).ok()
    });
    let mut names: Vec<&str> = with_field
        .iter()
        .map(|&k| recordings[k].name.as_str())
        .collect();
    // A step looks like a drift, and the other way round: the one that leaves less is meant.
    let step = stepped::stepped(&base, &whole, names[0], &units);
    let left = missing.as_ref().map_or(f64::INFINITY, |own| own.unevenness);
    let step = step.filter(|(fit, _)| fit.unevenness < left);
    let missing = missing.filter(|_| step.is_none());
    let is_divided = step.is_some();
    let (fit, step) = step.map_or((whole, None), |(fit, step)| (fit, Some(step)));
    if is_divided {
        names = vec![names[0]; fit.fields.len()];
    }
    write::write(
        &mut outcome.calibration,
        &write::Written {
            fit: &fit,
            model: &model,
            inertial: &inertial,
            recordings: &names,
            is_divided,
            units,
            strength_given: request.field.is_some(),
            missing,
            updates_others: request.method == Method::Joint,
        },
    );
    if !is_divided {
        let left_out = left_out(base, &fit, units.field);
        outcome.calibration.left_out.extend(left_out);
    }
    outcome.calibration.warnings.extend(step);
    let calibration = &mut outcome.calibration;
    if let Some(moves) = wandering::told_from_the_field(calibration, &fit, &units) {
        let is_field = |kind| matches!(kind, Kind::FIELD_UNEVEN | Kind::FIELD_LITTLE_UNEVEN);
        calibration.warnings.retain(|found| !is_field(found.kind));
        count_motion_of(calibration, std::slice::from_ref(&moves));
        calibration.warnings.push(moves);
    }
    let written = calibration.magnetometer.as_ref();
    let written = written.zip(calibration.magnetic_field.as_ref());
    let turned = written.and_then(|(triad, field)| {
        let with_field: Vec<&Recording> = with_field.iter().map(|&k| recordings[k]).collect();
        let inclination = field.last.inclination;
        turned_field(&triad.base().t, inclination, request.latitude, &with_field)
    });
    calibration.warnings.extend(turned);
    Ok(())
}

/// Refuses a magnetometer of which an axis never changes.
fn no_axis_is_constant(recording: &Recording) -> Result<(), Error> {
    let values = recording
        .magnetometer
        .iter()
        .flat_map(|own| &own.stream.values);
    let Some(first) = values.clone().next() else {
        return Ok(());
    };
    match (0..3).find(|&axis| values.clone().all(|value| value[axis] == first[axis])) {
        Some(axis) => Err(Error::not_enough(
            Finding::of(Kind::FIELD_AXIS_CONSTANT)
                .in_recording(&recording.name)
                .detail("axis", ["x", "y", "z"][axis])
                .detail("value", figure(first[axis])),
        )),
        None => Ok(()),
    }
}

/// The unit of all magnetometers; `None` where no file states it.
fn common_unit(recordings: &[&Recording], request: &Request) -> Result<Option<FieldUnit>, Error> {
    let all = recordings
        .iter()
        .filter_map(|r| Some((r, r.magnetometer.as_ref()?.unit)));
    let all: Vec<_> = all.collect();
    let unit = all.first().and_then(|(_, unit)| *unit);
    if let Some((other, differs)) = all.iter().find(|(_, other)| *other != unit) {
        let word = |unit: Option<FieldUnit>| unit.map_or("no stated unit", FieldUnit::name);
        return Err(Error::usage(
            Finding::of(Kind::FIELD_UNITS_DIFFER)
                .in_recording(&other.name)
                .of_sensor(Sensor::Magnetometer)
                .detail("unit", word(*differs))
                .detail("other", all[0].0.name.clone())
                .detail("others", word(unit)),
        ));
    }
    if unit.is_none() {
        of_one_size(recordings)?;
    }
    if let Some(field) = request.field.filter(|field| !FIELDS.contains(field)) {
        let expected = format!("{} to {} µT", FIELDS.start(), FIELDS.end());
        return Err(Error::usage(
            Finding::of(Kind::OUT_OF_RANGE)
                .detail("key", "field")
                .detail("value", figure(field))
                .detail("expected", expected),
        ));
    }
    Ok(unit)
}

findings::tuning! {
    /// Readings of recordings without a unit whose lengths differ by more are in different units: bias included, no device's are.
    OTHER_UNIT: f64 = 5.0;
}

/// Refuses magnetometers that nobody gives a unit, and whose readings are of different sizes.
fn of_one_size(recordings: &[&Recording]) -> Result<(), Error> {
    let size = |recording: &&Recording| {
        let values = &recording.magnetometer.as_ref()?.stream.values;
        Some((
            recording.name.clone(),
            median(values.iter().map(|v| v.norm()))?,
        ))
    };
    let sizes: Vec<(String, f64)> = recordings.iter().filter_map(size).collect();
    let Some((first, of_first)) = sizes.first() else {
        return Ok(());
    };
    let is_other = |(_, own): &&(String, f64)| {
        !(OTHER_UNIT.get().recip()..OTHER_UNIT.get()).contains(&(own / of_first))
    };
    let Some((name, own)) = sizes.iter().find(is_other) else {
        return Ok(());
    };
    let words = |size: f64| format!("readings of about {size:.3}");
    Err(Error::usage(
        Finding::of(Kind::FIELD_UNITS_DIFFER)
            .in_recording(name)
            .of_sensor(Sensor::Magnetometer)
            .detail("unit", words(*own))
            .detail("other", first.clone())
            .detail("others", words(*of_first)),
    ))
}
