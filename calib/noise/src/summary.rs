//! The result of an Allan analysis, as written to `noise.json`.

use recording::Error;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::allan::AllanCurve;
use super::curves::{RecordingCurves, SensorCurves};
use super::identify::{NoiseTerms, identify};
use super::settling::settling_time;
use super::term::NoiseTerm;

/// The schema this version writes.
pub const NOISE_SCHEMA: &str = "stillpoint.noise/1";

/// Noise of both sensors, SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseSummary {
    /// [`NOISE_SCHEMA`].
    pub schema: String,
    /// Program and version.
    pub created_by: String,
    /// Accelerometer, m/s².
    pub accelerometer: Option<SensorNoise>,
    /// Gyroscope, rad/s.
    pub gyroscope: Option<SensorNoise>,
    /// How long to rest before a calibration, s: where the gyroscope's deviation is flat on every
    /// axis. Null where the recording is too short to tell.
    pub initial_static_time: Option<f64>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Noise of one sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorNoise {
    /// Number of samples.
    pub samples: usize,
    /// Time between samples, s.
    pub step: f64,
    /// Gaps in the recording.
    pub gaps: usize,
    /// x, y, z.
    pub axes: [AxisNoise; 3],
}

/// Noise of one axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisNoise {
    /// The five terms; empty where the recording is too short or the signal never changes.
    pub terms: Vec<TermValue>,
    /// Relative misfit of `σ²` beyond its scatter; the intervals include it.
    pub model_error: Option<f64>,
    /// The Allan deviation.
    pub curve: Vec<CurvePoint>,
}

/// A noise term with its interval; the five of an axis hold together with 95 % confidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermValue {
    /// Which.
    pub term: NoiseTerm,
    /// Its name for this sensor.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Coefficient; zero where the fit does without.
    pub value: f64,
    /// Lower end of the interval; above zero where the data need the term.
    pub lower: f64,
    /// Upper end; null where the recording does not bound it.
    pub upper: Option<f64>,
}

/// A point of the Allan deviation with its 95 % interval and the fit there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Averaging time, s.
    pub tau: f64,
    /// Allan deviation.
    pub deviation: f64,
    /// Lower end; null without a fit.
    pub lower: Option<f64>,
    /// Upper end; null without a fit or without bound.
    pub upper: Option<f64>,
    /// The deviation that the terms give.
    pub fitted: Option<f64>,
}

impl NoiseSummary {
    /// Identifies the noise terms of every axis.
    ///
    /// # Errors
    /// Curves without any sensor.
    pub fn of(curves: &RecordingCurves) -> Result<Self, Error> {
        if curves.accelerometer.is_none() && curves.gyroscope.is_none() {
            return Err(Error::NotEnough(
                "no sensor with two samples in the recording".into(),
            ));
        }
        let mut warnings = Vec::new();
        let mut settling = Vec::new();
        let mut sensor = |curves: &Option<SensorCurves>, sensor: Sensor| {
            let curves = curves.as_ref()?;
            let fits = curves.axes.each_ref().map(identify);
            for (axis, fit) in ["x", "y", "z"].iter().zip(&fits) {
                warnings.extend(
                    warning(fit.as_ref()).map(|w| format!("{} {axis}: {w}", sensor.prefix())),
                );
            }
            if curves.gaps > 0 {
                warnings.push(format!(
                    "{}: {} gaps in the recording; no difference reaches across",
                    sensor.prefix(),
                    curves.gaps
                ));
            }
            if sensor == Sensor::Gyroscope {
                settling = fits
                    .iter()
                    .map(|fit| settling_time(fit.as_ref()?, curves.axes[0].step))
                    .collect();
            }
            Some(sensor_noise(curves, &fits, sensor))
        };
        let accelerometer = sensor(&curves.accelerometer, Sensor::Accelerometer);
        let gyroscope = sensor(&curves.gyroscope, Sensor::Gyroscope);
        let initial_static_time = settling
            .into_iter()
            .collect::<Option<Vec<f64>>>()
            .filter(|times| !times.is_empty())
            .map(|times| times.into_iter().fold(0.0, f64::max));
        if gyroscope.is_some() && initial_static_time.is_none() {
            warnings.push(
                "the gyroscope's deviation does not turn flat: record a longer rest to learn how long \
                 the initial one must be"
                    .into(),
            );
        }
        Ok(Self {
            schema: NOISE_SCHEMA.into(),
            created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
            accelerometer,
            gyroscope,
            initial_static_time,
            warnings,
        })
    }
}

/// What is wrong with a fit, if anything.
fn warning(fit: Option<&NoiseTerms>) -> Option<String> {
    match fit {
        None => Some("too short, or a signal that never changes: no noise terms".into()),
        Some(fit) if fit.model_error > 0.0 => Some(format!(
            "five noise terms miss the Allan variance by {:.0} % (a filter, a resonance or a motion); \
             the intervals include that",
            100.0 * fit.model_error
        )),
        Some(_) => None,
    }
}

fn sensor_noise(
    curves: &SensorCurves,
    fits: &[Option<NoiseTerms>; 3],
    sensor: Sensor,
) -> SensorNoise {
    let axis = |k: usize| AxisNoise {
        terms: fits[k]
            .as_ref()
            .map(|fit| terms(fit, sensor))
            .unwrap_or_default(),
        model_error: fits[k].as_ref().map(|fit| fit.model_error),
        curve: points(&curves.axes[k], fits[k].as_ref()),
    };
    SensorNoise {
        samples: curves.axes[0].samples,
        step: curves.axes[0].step,
        gaps: curves.gaps,
        axes: [axis(0), axis(1), axis(2)],
    }
}

fn terms(fit: &NoiseTerms, sensor: Sensor) -> Vec<TermValue> {
    let value = |e: &super::identify::Estimate| TermValue {
        term: e.term,
        name: e.term.name(sensor).into(),
        unit: e.term.unit(sensor).into(),
        value: e.value,
        lower: e.interval.lower,
        upper: e.interval.upper.is_finite().then_some(e.interval.upper),
    };
    fit.estimates.iter().map(value).collect()
}

/// The points whose averaging time fits into the recording at least four times.
fn points(curve: &AllanCurve, fit: Option<&NoiseTerms>) -> Vec<CurvePoint> {
    let enough = |factor: usize| 4 * factor <= curve.samples;
    curve
        .points
        .iter()
        .filter(|point| enough(point.factor))
        .map(|point| {
            let interval = fit.map(|fit| fit.interval(point));
            CurvePoint {
                tau: point.tau,
                deviation: point.deviation,
                lower: interval.map(|i| i.lower),
                upper: interval.map(|i| i.upper).filter(|u| u.is_finite()),
                fitted: fit.map(|fit| fit.deviation(point.tau)),
            }
        })
        .collect()
}
