//! Whether what an effect needs can be known.

use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{AnyEffect, Quantity, Role, Sensor, silent_at_rest};

use super::sensing::Models;

/// Why a quantity cannot be known of a recording, and what to do about it.
type Why = (&'static str, &'static str);

/// Refuses an effect that needs what cannot be known of the recording.
///
/// # Errors
/// [`Error::NotEnough`] with the recording, the effect, the quantity, and what to do.
pub fn require(
    recording: &Recording,
    intervals: Option<&Segmentation>,
    models: &Models,
    effect: &dyn AnyEffect,
) -> Result<(), Error> {
    for quantity in effect.needs() {
        if Quantity::signal_of(effect.sensor()) == quantity {
            continue;
        }
        if let Some((why, advice)) = lacking(recording, intervals, models, quantity) {
            return Err(Error::not_enough(format!(
                "{}: the effect {} needs the {quantity}, which cannot be known: {why}; {advice}",
                recording.name,
                effect.name()
            )));
        }
    }
    Ok(())
}

fn lacking(
    recording: &Recording,
    intervals: Option<&Segmentation>,
    models: &Models,
    quantity: Quantity,
) -> Option<Why> {
    let rests = intervals.map_or(0, |s| s.statics.len());
    let force = || {
        let none: Why = (
            "the recording has no accelerometer",
            "record both sensors, or leave the effect out",
        );
        let unknown: Why = (
            "nothing is known of the errors of the accelerometer",
            "calibrate both sensors, or leave the effect out",
        );
        let missing = recording.accelerometer.is_none().then_some(none);
        missing.or(models.accelerometer.is_none().then_some(unknown))
    };
    let rate = || {
        let none: Why = (
            "the recording has no gyroscope",
            "record both sensors, or leave the effect out",
        );
        let unknown: Why = (
            "nothing is known of the errors of the gyroscope",
            "calibrate both sensors, or leave the effect out",
        );
        let missing = recording.gyroscope.is_none().then_some(none);
        missing.or(models.gyroscope.is_none().then_some(unknown))
    };
    let still = |least: usize, why: &'static str| {
        let advice = "let the device lie still in between, or leave the effect out";
        (rests < least).then_some((why, advice))
    };
    match quantity {
        Quantity::Time => None,
        Quantity::SpecificForce | Quantity::SpecificForceRate => force(),
        Quantity::AngularRate | Quantity::AngularAcceleration => rate(),
        Quantity::MagneticField => Some((
            "only the magnetometer's own effects see it",
            "leave the effect out",
        )),
        Quantity::Temperature | Quantity::TemperatureRate | Quantity::Warming => recording.temperature.is_none().then_some((
            "no temperature was recorded",
            "record it, or leave the effect out",
        )),
        Quantity::LastTurn | Quantity::SinceTurn => recording
            .gyroscope
            .is_none()
            .then_some((
                "the recording has no gyroscope",
                "record both sensors, or leave the effect out",
            ))
            .or_else(|| still(1, "no static interval shows where a turn ended")),
        Quantity::LastChange => force().or_else(|| {
            let why = "no static interval shows where the device came from";
            still(1, why)
        }),
        Quantity::Vibration => force().or_else(|| {
            let why = "fewer than two static intervals, and vibration is what one has beyond the quietest";
            still(2, why)
        }),
        Quantity::Attitude => force().or_else(rate).or_else(|| {
            let why = "no static interval shows which way is up";
            still(1, why)
        }),
    }
}

/// Refuses an effect of the accelerometer with a parameter that shows in no static interval: nothing else says anything
/// of an accelerometer in a fit.
///
/// # Errors
/// [`Error::NotEnough`] with the effect, the parameter, the quantity, and what to do.
pub fn silent_at_static_intervals(effect: &dyn AnyEffect) -> Result<(), Error> {
    if effect.sensor() != Sensor::Accelerometer {
        return Ok(());
    }
    let Some((place, quantities)) = silent_at_rest(effect).into_iter().next() else {
        return Ok(());
    };
    let quantities: Vec<String> = quantities.iter().map(ToString::to_string).collect();
    Err(Error::not_enough(format!(
        "the effect {name}: its {} shows only where the {} is not zero, and a calibration sees the accelerometer at \
         static intervals, where it is; leave it out of --effects (`stillpoint discover` looks for {name} where it can)",
        effect.params()[place].name,
        quantities.join(" or the "),
        name = effect.name(),
    )))
}

/// Refuses an effect with an instant: a fit has no derivative by it.
///
/// # Errors
/// [`Error::NotEnough`] with the effect, the parameter and what to do.
pub fn without_instant(effect: &dyn AnyEffect) -> Result<(), Error> {
    let instant = effect.params().iter().find(|p| p.role == Role::Instant);
    instant.map_or(Ok(()), |p| {
        Err(Error::not_enough(format!(
            "the effect {name} needs the time {}, which cannot be known by a calibration: leave it out of --effects \
             (`stillpoint discover` looks for {name} at every time)",
            p.name,
            name = effect.name(),
        )))
    })
}
