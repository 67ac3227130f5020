//! Which of Sensor Logger's accelerometers and gyroscopes is read.

use crate::{Content, Quantity, Stream};

/// With gravity, unprocessed before processed.
const ACCEL: [&str; 2] = ["AccelerometerUncalibrated", "TotalAcceleration"];
const GYRO: [&str; 2] = ["GyroscopeUncalibrated", "Gyroscope"];
const LINEAR: &str = "Accelerometer";
const GRAVITY: &str = "Gravity";

/// Keeps one stream of a sensor; `turned` for an accelerometer that reads -1 g on the axis that points up.
pub(crate) fn choose(content: &mut Content, turned: bool) {
    let streams = std::mem::take(&mut content.streams);
    let find = |name: &str| streams.iter().find(|stream| stream.source == name);
    let mut chosen: Vec<Stream> = Vec::new();
    let accel = ACCEL.iter().find_map(|name| find(name)).cloned();
    let sum = || sum(find(LINEAR)?, find(GRAVITY)?);
    if let Some(mut accel) = accel.or_else(sum) {
        accel.in_si = false;
        if turned {
            accel
                .values
                .iter_mut()
                .flatten()
                .for_each(|value| *value = -*value);
            let words = "Sensor Logger: an iPhone's accelerometer has the opposite sign, turned to +g on the axis that points up";
            content.warnings.push(words.to_owned());
        }
        chosen.push(accel);
    } else if find(LINEAR).is_some() {
        let words = "Accelerometer of Sensor Logger is without gravity and left out; record with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on";
        content.warnings.push(words.to_owned());
    }
    chosen.extend(GYRO.iter().find_map(|name| find(name)).cloned());
    let taken: Vec<&str> = chosen.iter().map(|stream| stream.source.as_str()).collect();
    let words = format!("Sensor Logger: taken are {}", taken.join(" and "));
    content.warnings.push(words);
    chosen.extend(
        streams
            .iter()
            .find(|stream| stream.quantity == Quantity::MagneticField)
            .cloned(),
    );
    content.streams = chosen;
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
