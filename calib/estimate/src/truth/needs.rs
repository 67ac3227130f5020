//! Check that the quantities an effect needs can be determined.

use findings::{Finding, Kind};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{EffectRef, Quantity, Role, ScalarSensorRef, Sensor, silent_at_rest};

use super::sensing::Models;

/// Refuses an effect that needs what cannot be known of the recording.
///
/// # Errors
/// [`Error::NotEnough`] with the recording, the effect, the quantity, and what to do.
pub fn require(
    recording: &Recording,
    intervals: Option<&Segmentation>,
    models: &Models,
    effect: &EffectRef,
) -> Result<(), Error> {
    for quantity in effect.needs() {
        if Quantity::signal_of(effect.sensor()) == quantity {
            continue;
        }
        if let Some(found) = lacking(recording, intervals, models, quantity) {
            return Err(Error::not_enough(
                found
                    .in_recording(&recording.name)
                    .detail("effect", effect.name())
                    .detail("quantity", quantity.to_string()),
            ));
        }
    }
    Ok(())
}

/// Refuses a sensor of one dimension that needs what cannot be known of single instants of the recording.
///
/// # Errors
/// [`Error::NotEnough`] with the recording, the sensor, the quantity, and what to do.
pub fn require_of_instants(
    sensor: &ScalarSensorRef,
    recording: &Recording,
    intervals: Option<&Segmentation>,
    models: &Models,
) -> Result<(), Error> {
    let is_unknown = |q: &Quantity| {
        q.is_told_by_intervals() || lacking(recording, intervals, models, *q).is_some()
    };
    match sensor.needs().iter().find(|q| is_unknown(q)) {
        None => Ok(()),
        Some(quantity) => Err(Error::not_enough(
            Finding::of(Kind::SCALAR_NEEDS)
                .in_recording(&recording.name)
                .detail("name", sensor.name())
                .detail("quantity", quantity.to_string()),
        )),
    }
}

/// Why a quantity cannot be known of a recording.
fn lacking(
    recording: &Recording,
    intervals: Option<&Segmentation>,
    models: &Models,
    quantity: Quantity,
) -> Option<Finding> {
    let rests = intervals.map_or(0, |s| s.statics.len());
    let unseen = |sensor| {
        let is_missing = recording.stream(sensor).is_none();
        is_missing.then(|| Finding::of(Kind::EFFECT_NEEDS_SENSOR).of_sensor(sensor))
    };
    let unknown = |sensor, is_known: bool| {
        let found = || Finding::of(Kind::EFFECT_NEEDS_ERRORS).of_sensor(sensor);
        unseen(sensor).or_else(|| (!is_known).then(found))
    };
    let force = || unknown(Sensor::Accelerometer, models.accelerometer.is_some());
    let rate = || unknown(Sensor::Gyroscope, models.gyroscope.is_some());
    let still = |least: usize| {
        (rests < least).then(|| {
            Finding::of(Kind::EFFECT_NEEDS_RESTS)
                .count("least", least)
                .count("rests", rests)
        })
    };
    match quantity {
        Quantity::Time => None,
        Quantity::SpecificForce | Quantity::SpecificForceRate => force(),
        Quantity::AngularRate | Quantity::AngularAcceleration => rate(),
        Quantity::MagneticField => Some(Finding::of(Kind::EFFECT_NEEDS_FIELD)),
        Quantity::Temperature | Quantity::TemperatureRate | Quantity::Warming => {
            let is_missing = recording.temperature.is_none();
            is_missing.then(|| Finding::of(Kind::EFFECT_NEEDS_TEMPERATURE))
        }
        Quantity::LastTurn | Quantity::SinceTurn => unseen(Sensor::Gyroscope).or_else(|| still(1)),
        Quantity::LastChange => force().or_else(|| still(1)),
        // Vibration is what an interval has beyond the quietest.
        Quantity::Vibration => force().or_else(|| still(2)),
        Quantity::Attitude => force().or_else(rate).or_else(|| still(1)),
    }
}

/// Refuses an effect of the accelerometer with a parameter that shows in no static interval: nothing else says anything
/// of an accelerometer in a fit.
///
/// # Errors
/// [`Error::NotEnough`] with the effect, the parameter, the quantity, and what to do.
pub fn silent_at_static_intervals(effect: &EffectRef) -> Result<(), Error> {
    if effect.sensor() != Sensor::Accelerometer {
        return Ok(());
    }
    let Some((place, quantities)) = silent_at_rest(&**effect).into_iter().next() else {
        return Ok(());
    };
    let quantities: Vec<String> = quantities.iter().map(ToString::to_string).collect();
    Err(Error::not_enough(
        Finding::of(Kind::EFFECT_SILENT_AT_REST)
            .detail("effect", effect.name())
            .detail("parameter", &*effect.params()[place].name)
            .detail("quantities", quantities.join(" or the ")),
    ))
}

/// Refuses an effect with an instant: a fit has no derivative by it.
///
/// # Errors
/// [`Error::NotEnough`] with the effect, the parameter and what to do.
pub fn without_instant(effect: &EffectRef) -> Result<(), Error> {
    let instant = effect.params().iter().find(|p| p.role == Role::Instant);
    instant.map_or(Ok(()), |p| {
        Err(Error::not_enough(
            Finding::of(Kind::EFFECT_NEEDS_INSTANT)
                .detail("effect", effect.name())
                .detail("parameter", &*p.name),
        ))
    })
}
