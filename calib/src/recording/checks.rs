//! What samples tell about the recording: refused, or worth a warning.

use sensor::Sensor;

use super::Stream;
use super::place::in_file;
use super::samples::Samples;
use super::units::{AccelUnit, GyroUnit};
use crate::Error;

/// Repeated rows and equal stamps.
pub(super) fn order(
    name: &str,
    samples: &Samples,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let repeats = samples.repeats;
    if repeats.count > 0 {
        warnings.push(format!(
            "{name}:{}: {} rows between lines {} and {} repeat earlier rows, stamp and values; left out",
            repeats.first, repeats.count, repeats.first, repeats.last
        ));
    }
    if samples.t.len() < 2 && samples.merged + repeats.count > 0 {
        return Err(in_file(
            name,
            "every time stamp is the same; --rate HZ reads the rows as evenly spaced",
        ));
    }
    if samples.merged > samples.t.len() {
        return Err(in_file(
            name,
            format!(
                "{} of {} rows share their stamp with another: stamps are too coarse; --rate HZ reads the rows as evenly spaced",
                samples.merged,
                samples.merged + samples.t.len()
            ),
        ));
    }
    if samples.merged > 0 {
        warnings.push(format!(
            "{name}: {} rows with the stamp of another, merged to their mean",
            samples.merged
        ));
    }
    Ok(())
}

/// Stuck axes and absurd sizes.
pub(super) fn values(
    _name: &str,
    _sensor: Sensor,
    _samples: &Samples,
    _warnings: &mut Vec<String>,
) -> Result<(), Error> {
    Ok(())
}

/// The stream without values that a slower sensor merely held.
pub(super) fn without_held(
    _name: &str,
    _sensor: Sensor,
    stream: Stream,
    _warnings: &mut Vec<String>,
) -> Stream {
    stream
}

/// Interruptions.
pub(super) fn gaps(name: &str, sensor: Sensor, stream: &Stream, warnings: &mut Vec<String>) {
    let gaps = stream.gaps();
    let longest = gaps
        .iter()
        .max_by(|a, b| (a.t1 - a.t0).total_cmp(&(b.t1 - b.t0)));
    if let Some(longest) = longest {
        warnings.push(format!(
            "{name}: {} gap{} in the {}, the longest {:.3} s from {:.3} s on",
            gaps.len(),
            if gaps.len() == 1 { "" } else { "s" },
            called(sensor),
            longest.t1 - longest.t0,
            longest.t0
        ));
    }
}

pub(super) fn called(sensor: Sensor) -> &'static str {
    match sensor {
        Sensor::Accelerometer => "accelerometer",
        Sensor::Gyroscope => "gyroscope",
    }
}

/// The accelerometer's unit: stated, or told by the size of gravity.
pub(super) fn accel_unit(
    _name: &str,
    _stream: &Stream,
    stated: Option<AccelUnit>,
    _warnings: &mut Vec<String>,
) -> Result<AccelUnit, Error> {
    Ok(stated.unwrap_or(AccelUnit::MetresPerSecondSquared))
}

/// The gyroscope's unit: stated, or rad/s.
pub(super) fn gyro_unit(
    _name: &str,
    _stream: &Stream,
    stated: Option<GyroUnit>,
    _warnings: &mut Vec<String>,
) -> GyroUnit {
    stated.unwrap_or(GyroUnit::RadiansPerSecond)
}

/// True if the readings can be temperatures in °C.
pub(super) fn temperature(name: &str, celsius: &[f64], warnings: &mut Vec<String>) -> bool {
    let possible = celsius.iter().all(|c| (-60.0..=150.0).contains(c));
    if !possible {
        warnings.push(format!(
            "{name}: temperatures beyond -60 to 150 °C, left out; a unit in the column's name, as in `temp [K]`, helps"
        ));
    }
    possible
}
