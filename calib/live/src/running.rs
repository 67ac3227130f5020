//! Running estimate: an ordinary calibration of the samples so far.

use calib::calibrate::{Request, calibrate};
use calib::calibration::Triad;
use calib::intervals::Span;
use calib::{Calibration, Recording};
use serde::Serialize;

/// Standard errors now.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Estimate {
    /// Placements used.
    pub placements: usize,
    /// Standard errors of the accelerometer, if it is determined.
    pub accelerometer: Option<Errors>,
    /// Standard errors of the gyroscope, if it is determined.
    pub gyroscope: Option<Errors>,
    /// Why there is no calibration yet.
    pub missing: Option<String>,
}

/// The largest standard errors of one sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Standard error of the scale factors.
    pub scale: f64,
    /// Standard error of the misalignments, rad.
    pub misalignment: f64,
    /// Standard error of the bias, m/s² or rad/s.
    pub bias: f64,
}

impl Estimate {
    /// Calibrates with static intervals that are known.
    pub(crate) fn of(recording: &Recording, spans: &[Span], request: &Request) -> Self {
        let request = Request {
            sections: vec![spans.to_vec()],
            ..request.clone()
        };
        let outcome = calibrate(std::slice::from_ref(recording), &[], &request);
        let placements = spans.len();
        match outcome {
            Ok(outcome) => Self::stated(placements, &outcome.calibration),
            Err(error) => Self {
                placements,
                missing: Some(error.to_string()),
                ..Self::default()
            },
        }
    }

    fn stated(placements: usize, calibration: &Calibration) -> Self {
        let errors = |triad: &Option<Triad>| triad.as_ref().and_then(Errors::of);
        Self {
            placements,
            accelerometer: errors(&calibration.accelerometer),
            gyroscope: errors(&calibration.gyroscope),
            missing: None,
        }
    }

    /// Returns true if both sensors are determined.
    pub fn is_complete(&self) -> bool {
        self.accelerometer.is_some() && self.gyroscope.is_some()
    }
}

impl Errors {
    /// `None` where a free parameter has none that is finite.
    fn of(triad: &Triad) -> Option<Self> {
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
        };
        let entries = |diagonal: bool| {
            let all = (0..9).filter(move |k| (k / 3 == k % 3) == diagonal);
            all.filter_map(|k| triad.t_std[k / 3][k % 3])
        };
        let errors = Self {
            scale: largest(&mut entries(true)),
            misalignment: largest(&mut entries(false)),
            bias: largest(&mut triad.bias_std.iter().flatten().copied()),
        };
        let all = [errors.scale, errors.misalignment, errors.bias];
        (triad.unobservable.is_empty() && all.iter().all(|e| e.is_finite() && *e > 0.0))
            .then_some(errors)
    }
}
