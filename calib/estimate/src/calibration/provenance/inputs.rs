//! Inputs of a calibration: recordings, options, conventions.

use recording::intervals::{Moments, Segmentation, StaticInterval};
use recording::{AppliedBefore, Described, Recording, Stream};
use sensor::Sensor;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::calibrate::request::{Frame, GyroBias, Instant, Method, Request};
use crate::methods::joint::ClockMode;
use crate::residuals::Integrator;

/// The sign convention of every calibration: `sign_convention` in the file.
pub const SIGN_CONVENTION: &str = "specific force: +g on the axis that points up at rest; angular rate: right-handed about each axis";

/// Provenance of a calibration; part of the file's top level.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Version of the program that wrote the file.
    pub version: String,
    /// [`SIGN_CONVENTION`].
    pub sign_convention: String,
    /// The recordings; empty in files of versions that did not write them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<Input>,
    /// Options of the calibration.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub options: Option<Options>,
    /// SHA-256 of what corrects a reading, as it was written ([`Calibration::seal`](crate::calibration::Calibration::seal)): another one shows an edit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub numbers_sha256: Option<String>,
    /// The same of everything else that decides what the calibration is used for; absent in files of older versions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis_sha256: Option<String>,
}

impl Provenance {
    /// Builds it from the recordings and options, without hashes.
    pub fn of(inputs: Vec<Input>, options: Option<Options>) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").into(),
            sign_convention: SIGN_CONVENTION.into(),
            inputs,
            options,
            numbers_sha256: None,
            basis_sha256: None,
        }
    }
}

/// One recording that a calibration was made from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// The recording, as the user named it.
    pub recording: String,
    /// SHA-256 of its samples ([`fingerprint`]): the same for the same samples in another file or format.
    pub samples_sha256: String,
    /// Name of the file's format; absent in files of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<String>,
    /// The time that effects of time count from: the first stamp, s on the recording's clock.
    pub time_zero: f64,
    /// The last stamp, s.
    pub end: f64,
    /// The accelerometer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accelerometer: Option<SensorInput>,
    /// The gyroscope.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gyroscope: Option<SensorInput>,
    /// The thermometer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<TemperatureInput>,
    /// Corrections that systems had applied to the readings before they were recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub applied_before: Vec<AppliedBefore>,
}

/// The samples of one sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorInput {
    /// Number of samples.
    pub samples: usize,
    /// Samples per second by the median step, Hz.
    pub rate: Option<f64>,
    /// Unit of the readings: `m/s^2`, `rad/s`, or `raw` where `T` carries another unit to these.
    pub unit: String,
    /// Unit of the readings in the file, as `deg/s`; absent in files of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file_unit: Option<String>,
    /// The source of the unit: `option`, `file`, `samples`, or `nothing` where it was assumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file_unit_by: Option<String>,
    /// Axes that options read with the other sign, as `gx`: `T` and `bias` are for readings so flipped.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flipped: Vec<String>,
    /// Names of the columns of the axes x, y, z; empty in files of older versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub columns: Vec<String>,
    /// White noise density by the scatter within the static intervals, SI units per √Hz, root mean square over the axes.
    pub noise_density: Option<f64>,
}

/// The range of temperature, °C.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemperatureInput {
    /// Number of samples.
    pub samples: usize,
    /// The lowest.
    pub least: f64,
    /// The highest.
    pub greatest: f64,
    /// The mean.
    pub mean: f64,
}

/// Options of a calibration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Options {
    /// `stepwise`, `joint` or `six-position`.
    pub method: String,
    /// `triangular` or `symmetric`.
    pub frame: String,
    /// `exponential`, `first-order-normalized` or `first-order`.
    pub integrator: String,
    /// `adjacent` or `initial`.
    pub gyro_bias: String,
    /// `auto`, `stamps` or `even`.
    pub clock: String,
    /// The detector's multiplier in each recording.
    pub multipliers: Vec<f64>,
    /// Shortest static interval asked for, s.
    pub min_static: f64,
    /// True if the static intervals were given by hand.
    pub sections: bool,
    /// Static intervals that were left out, each by an instant within it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<Instant>,
    /// Effects that were asked for.
    pub effects: Vec<String>,
    /// Latitude, °.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub latitude: Option<f64>,
    /// Step between samples that was assumed instead of the stamps, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nominal_step: Option<f64>,
    /// True if the recordings were taken to be of one device even where they disagree.
    pub force_device: bool,
}

/// SHA-256 of the samples in hexadecimal: for accelerometer, gyroscope and temperature the number of samples (64 bits),
/// then `t` and the values of each, all as little-endian `f64`.
pub fn fingerprint(recording: &Recording) -> String {
    let mut hash = Sha256::new();
    for stream in [&recording.accelerometer, &recording.gyroscope] {
        let (t, values): (&[f64], &[_]) = match stream {
            Some(stream) => (&stream.t, &stream.values),
            None => (&[], &[]),
        };
        hash.update((t.len() as u64).to_le_bytes());
        for (t, value) in t.iter().zip(values) {
            let row = [*t, value.x, value.y, value.z].map(f64::to_le_bytes);
            hash.update(row.concat());
        }
    }
    let (t, celsius): (&[f64], &[f64]) = match &recording.temperature {
        Some(temperature) => (&temperature.t, &temperature.celsius),
        None => (&[], &[]),
    };
    hash.update((t.len() as u64).to_le_bytes());
    for row in t.iter().zip(celsius) {
        hash.update([row.0.to_le_bytes(), row.1.to_le_bytes()].concat());
    }
    hexadecimal(&hash.finalize())
}

impl Input {
    /// Returns the samples of the accelerometer or the gyroscope.
    pub fn sensor(&self, sensor: Sensor) -> Option<&SensorInput> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => None,
        }
    }

    /// Builds the entry of a recording with the static intervals found in it; `scales` are SI units per unit of its
    /// accelerometer and gyroscope.
    pub fn of(
        recording: &Recording,
        intervals: Option<&Segmentation>,
        scales: [Option<f64>; 2],
    ) -> Self {
        let streams = [&recording.accelerometer, &recording.gyroscope];
        let last = streams.into_iter().flatten().filter_map(|s| s.t.last());
        type Of = fn(&StaticInterval) -> Option<Moments>;
        let sensor = |sensor: Sensor, unit: &str, scale: Option<f64>, of: Of| {
            let stream = recording.stream(sensor)?;
            let si = scale.is_none_or(|s| (0.5..2.0).contains(&s));
            let described = recording.description.of(sensor);
            let in_file = described.filter(|own| !own.unit.is_empty());
            Some(SensorInput {
                samples: stream.len(),
                rate: stream.usual_step().map(f64::recip),
                unit: if si { unit } else { "raw" }.into(),
                columns: in_file.map_or_else(Vec::new, Described::axes),
                file_unit: in_file.map(|own| own.unit.to_owned()),
                flipped: in_file.map_or_else(Vec::new, |own| {
                    own.flipped.iter().map(|axis| (*axis).to_owned()).collect()
                }),
                file_unit_by: in_file.map(|own| own.unit_by.name().to_owned()),
                noise_density: noise_density(stream, intervals, of)
                    .map(|n| n * scale.unwrap_or(1.0)),
            })
        };
        let [force, rate] = scales;
        Self {
            recording: recording.name.clone(),
            samples_sha256: fingerprint(recording),
            format: Some(recording.description.format.to_owned()).filter(|name| !name.is_empty()),
            time_zero: recording.start(),
            end: last.copied().fold(f64::NEG_INFINITY, f64::max),
            accelerometer: sensor(Sensor::Accelerometer, "m/s^2", force, |r| r.accelerometer),
            gyroscope: sensor(Sensor::Gyroscope, "rad/s", rate, |r| r.gyroscope),
            temperature: recording.temperature.as_ref().and_then(|temperature| {
                let all = &temperature.celsius;
                (!all.is_empty()).then(|| TemperatureInput {
                    samples: all.len(),
                    least: all.iter().copied().fold(f64::INFINITY, f64::min),
                    greatest: all.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                    mean: all.iter().sum::<f64>() / all.len() as f64,
                })
            }),
            applied_before: recording.description.applied_before.clone(),
        }
    }
}

/// Root of the variance of a sample times the step, by the static intervals; `None` without any.
fn noise_density(
    stream: &Stream,
    intervals: Option<&Segmentation>,
    of: fn(&StaticInterval) -> Option<Moments>,
) -> Option<f64> {
    let moments: Vec<Moments> = intervals?.statics.iter().filter_map(of).collect();
    let freedom: f64 = moments.iter().map(|m| m.count as f64 - 1.0).sum();
    let squares = |m: &Moments| m.covariance.trace() / 3.0 * (m.count as f64 - 1.0);
    let sum: f64 = moments.iter().map(squares).sum();
    let density = (sum / freedom * stream.usual_step()?).sqrt();
    (freedom > 0.0 && density.is_finite()).then_some(density)
}

pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Options {
    /// Builds the record from a request and the chosen multipliers.
    pub fn of(request: &Request, multipliers: Vec<f64>) -> Self {
        let method = match request.method {
            Method::Auto => "auto",
            Method::Stepwise => "stepwise",
            Method::Joint => "joint",
        };
        let frame = match request.frame {
            Frame::Triangular => "triangular",
            Frame::Symmetric => "symmetric",
        };
        let integrator = match request.integrator {
            Integrator::Exponential => "exponential",
            Integrator::FirstOrderNormalized => "first-order-normalized",
            Integrator::FirstOrder => "first-order",
        };
        let gyro_bias = match request.gyro_bias {
            GyroBias::Adjacent => "adjacent",
            GyroBias::Initial => "initial",
        };
        let clock = match request.clock {
            ClockMode::Auto => "auto",
            ClockMode::Stamps => "stamps",
            ClockMode::Even => "even",
        };
        Self {
            method: method.into(),
            frame: frame.into(),
            integrator: integrator.into(),
            gyro_bias: gyro_bias.into(),
            clock: clock.into(),
            multipliers,
            min_static: request.detector.min_static,
            sections: request.sections.iter().any(|spans| !spans.is_empty()),
            left_out: request.left_out.clone(),
            effects: request.effects.iter().map(|e| e.name().into()).collect(),
            latitude: request.latitude,
            nominal_step: request.nominal_step,
            force_device: request.force_device,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn recording(z: f64) -> Recording {
        Recording {
            name: "a".into(),
            accelerometer: Some(Stream {
                t: vec![0.0, 0.01],
                values: vec![Vector3::new(0.0, 0.0, z); 2],
            }),
            ..Recording::default()
        }
    }

    #[test]
    fn the_fingerprint_is_of_the_samples_and_not_of_the_name() {
        let mut renamed = recording(9.8);
        renamed.name = "b".into();
        assert_eq!(fingerprint(&recording(9.8)), fingerprint(&renamed));
        assert_ne!(fingerprint(&recording(9.8)), fingerprint(&recording(9.9)));
        // Three counts of zero: SHA-256 of 24 zero bytes, by coreutils' sha256sum.
        let empty = "9d908ecfb6b256def8b49a7c504e6c889c4b0e41fe6ce3e01863dd7b61a20aa0";
        assert_eq!(fingerprint(&Recording::default()), empty);
    }
}
