//! Choice among the accelerometers and gyroscopes of a Sensor Logger file.

use crate::{Content, Error, Quantity, Stream};
use findings::{Finding, Kind};

/// The app, as findings call it.
const SYSTEM: &str = "Sensor Logger";

/// With gravity, unprocessed before processed.
const ACCEL: [&str; 2] = ["AccelerometerUncalibrated", "TotalAcceleration"];
const GYRO: [&str; 2] = ["GyroscopeUncalibrated", "Gyroscope"];
const LINEAR: &str = "Accelerometer";
const GRAVITY: &str = "Gravity";

/// Keeps one stream of a sensor; `turned` for an accelerometer that reads -1 g on the axis that points up.
///
/// # Errors
/// The only accelerometer is without gravity.
pub(crate) fn choose(content: &mut Content, turned: bool) -> Result<(), Error> {
    let mut streams = std::mem::take(&mut content.streams);
    // Taken out, not copied: a recording is there once.
    let mut taken = |name: &str| {
        let at = streams.iter().position(|stream| stream.source == name)?;
        Some(streams.remove(at))
    };
    let mut chosen: Vec<Stream> = Vec::new();
    let mut accel = ACCEL.iter().find_map(|name| taken(name));
    let linear = taken(LINEAR);
    if accel.is_none() {
        accel = linear
            .as_ref()
            .zip(taken(GRAVITY))
            .and_then(|(linear, gravity)| sum(linear, &gravity));
    }
    let gyro = GYRO.iter().find_map(|name| taken(name));
    if let Some(mut accel) = accel {
        accel.in_si = false;
        if turned {
            accel
                .values
                .iter_mut()
                .flatten()
                .for_each(|value| *value = -*value);
            let turned = Finding::of(Kind::SIGN_TURNED).detail("system", SYSTEM);
            content.warnings.push(turned);
        }
        chosen.push(accel);
    } else if linear.is_some() {
        return Err(Error::refused(Finding::of(Kind::LOGGER_WITHOUT_GRAVITY)));
    }
    chosen.extend(gyro);
    let taken: Vec<&str> = chosen.iter().map(|stream| stream.source.as_str()).collect();
    let taken = Finding::of(Kind::STREAMS_CHOSEN)
        .detail("system", SYSTEM)
        .detail("streams", taken.join(" and "));
    content.warnings.push(taken);
    let field = |stream: &Stream| stream.quantity == Quantity::MagneticField;
    chosen.extend(streams.into_iter().find(field));
    content.streams = chosen;
    Ok(())
}

/// The accelerometer with gravity from what the system takes apart, at the stamps that both have.
fn sum(linear: &Stream, gravity: &Stream) -> Option<Stream> {
    let mut sum = Stream::new("Accelerometer + Gravity", 0, Quantity::SpecificForce);
    let mut others = gravity.stamps.iter().zip(&gravity.values).peekable();
    for (stamp, value) in linear.stamps.iter().zip(&linear.values) {
        while others.next_if(|(other, _)| *other < stamp).is_some() {}
        if let Some((_, other)) = others.next_if(|(other, _)| *other == stamp) {
            sum.stamps.push(*stamp);
            sum.values
                .push(std::array::from_fn(|axis| value[axis] + other[axis]));
        }
    }
    (2 * sum.stamps.len() >= linear.stamps.len()).then_some(sum)
}
