//! `apply(raw)`: the whole definition of the corrected signal.

use nalgebra::Vector3;
use sensor::{Kinematics, Sensor};

use super::Calibration;
use crate::recording::{Recording, Stream};

/// The corrected recording, each sensor on its own clock. A sensor that the calibration does not
/// speak of stays raw, which a warning says.
pub fn apply(calibration: &Calibration, recording: &Recording) -> Recording {
    let mut corrected = recording.clone();
    corrected.accelerometer = correct(calibration, recording, Sensor::Accelerometer, None);
    let force = corrected.accelerometer.as_ref();
    corrected.gyroscope = correct(calibration, recording, Sensor::Gyroscope, force);
    for (sensor, name, stream) in [
        (
            Sensor::Accelerometer,
            "accelerometer",
            &recording.accelerometer,
        ),
        (Sensor::Gyroscope, "gyroscope", &recording.gyroscope),
    ] {
        if stream.is_some() && calibration.triad(sensor).is_none() {
            corrected.warnings.push(format!(
                "the calibration has no {name}: its readings are left as they are"
            ));
        }
    }
    corrected
}

fn correct(
    calibration: &Calibration,
    recording: &Recording,
    sensor: Sensor,
    force: Option<&Stream>,
) -> Option<Stream> {
    let stream = match sensor {
        Sensor::Accelerometer => recording.accelerometer.as_ref()?,
        Sensor::Gyroscope => recording.gyroscope.as_ref()?,
    };
    let Some((model, p)) = calibration.model(sensor) else {
        return Some(stream.clone());
    };
    let start = recording.start();
    let values = stream
        .t
        .iter()
        .zip(&stream.values)
        .map(|(&t, raw)| {
            let mut rest =
                Kinematics::at_rest(force.and_then(|f| f.at(t)).unwrap_or_else(Vector3::zeros));
            rest.time = t - start;
            if let Some(celsius) = recording.temperature.as_ref().and_then(|c| c.at(t)) {
                rest.temperature = celsius;
            }
            model.correct(raw, &rest, &p)
        })
        .collect();
    Some(Stream {
        t: stream.t.clone(),
        values,
    })
}
