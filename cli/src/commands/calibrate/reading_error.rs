//! Standard errors of corrected readings, from the covariance of a calibration.

use std::f64::consts::{FRAC_PI_2, PI};

use calib::Calibration;
use calib::calibration::Triad;
use calib::methods::joint::Prediction;
use calib::truth::supposed;
use nalgebra::{DMatrix, Vector3};
use sensor::{Sensor, base_names};

use super::joint::TURN_TIME;

/// Standard errors of corrected readings at their worst over the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadingError {
    /// Standard error of one axis of specific force with a face of the device up, m/s².
    pub force: Option<f64>,
    /// Standard error of the heading after a turn of 90° in three seconds, rad.
    pub heading: Option<f64>,
}

/// By the covariance of a calibration: nothing of a sensor whose parameters have none.
pub fn of(calibration: &Calibration) -> ReadingError {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let force = prediction(calibration, Sensor::Accelerometer);
    let faces = axes.iter().flat_map(|axis| [*axis, -axis]);
    let at_rest = |prediction: &Prediction| {
        let errors = faces.clone().map(|up| {
            let truth = supposed(up * calibration.gravity, Vector3::zeros());
            prediction.std_of_reading(&truth).max()
        });
        errors.fold(0.0, f64::max)
    };
    // A gyroscope of which the bias alone is known has the scale factors of a perfect one.
    let has_scale = |triad: &Triad| triad.t_std[0][0].is_some();
    let rate = prediction(calibration, Sensor::Gyroscope)
        .filter(|_| calibration.gyroscope.as_ref().is_some_and(has_scale));
    let heading = rate.map(|rate| {
        let errors = axes.map(|axis| rate.std_of_heading(&axis, FRAC_PI_2, TURN_TIME));
        errors.into_iter().fold(0.0, f64::max)
    });
    let force = force.map(|prediction| at_rest(&prediction));
    ReadingError {
        force,
        heading: heading.filter(|angle| *angle < PI),
    }
}

/// The model of a sensor with the covariance of its parameters, gravity's doubt among it.
fn prediction(calibration: &Calibration, sensor: Sensor) -> Option<Prediction> {
    let (model, parameters) = calibration.model(sensor)?;
    let mut names = base_names(sensor).to_vec();
    for values in &calibration.effects {
        if values
            .effect()
            .is_ok_and(|effect| effect.sensor() == sensor)
        {
            let own = values.parameters.iter();
            names.extend(own.map(|p| format!("{}.{}", values.name, p.name)));
        }
    }
    let place = |name: &String| calibration.parameters.iter().position(|own| own == name);
    let places: Vec<Option<usize>> = names.iter().map(place).collect();
    if places.iter().all(Option::is_none) {
        return None;
    }
    let entry = |i: usize, j: usize| {
        let (i, j) = places
            .get(i)
            .copied()
            .flatten()
            .zip(places.get(j).copied().flatten())?;
        calibration.covariance.get(i)?.get(j).copied()
    };
    let count = parameters.len();
    Some(Prediction {
        model,
        parameters,
        covariance: DMatrix::from_fn(count, count, |i, j| entry(i, j).unwrap_or(0.0)),
    })
}
