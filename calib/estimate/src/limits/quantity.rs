//! The quantities of a calibration that limits are about, in SI units whatever the unit of the readings.

use nalgebra::Vector3;
use sensor::{BasePart, PLACES, Sensor, base_names, base_part};

use crate::calibration::{Calibration, Triad};

/// Classes of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Scale,
    Misalignment,
    Bias,
}

/// Largest standard error of a class: relative, rad, or the corrected signal's unit.
pub(super) fn largest_error(triad: &Triad, class: Class) -> Option<f64> {
    let t = triad.t;
    let scale = triad.base().scale();
    let of_t = |wanted: bool| {
        let places = PLACES.iter().filter(move |(i, j)| (i == j) == wanted);
        places.filter_map(|&(i, j)| Some(triad.t_std[i][j]? / scale))
    };
    let greatest = |all: Vec<f64>| all.into_iter().reduce(f64::max);
    match class {
        Class::Scale => greatest(of_t(true).collect()),
        Class::Misalignment => greatest(of_t(false).collect()),
        Class::Bias => {
            let own = |(k, std): (usize, &Option<f64>)| Some((*std)? * Vector3::from(t[k]).norm());
            greatest(triad.bias_std.iter().enumerate().filter_map(own).collect())
        }
    }
}

/// The part of a residual that the noise within the intervals does not make: `r √(1 − 1/χ²)`; none without spare data.
pub(super) fn unexplained(triad: &Triad) -> Option<f64> {
    let chi2 = triad.reduced_chi2?;
    Some(triad.residual_rms * (1.0 - chi2.max(1.0).recip()).sqrt())
}

/// Value and standard error of a parameter by its name in `parameters`; of one that was held fixed the error is none.
pub fn parameter(calibration: &Calibration, name: &str) -> Option<(f64, Option<f64>)> {
    for sensor in Sensor::ALL {
        let Some(k) = base_names(sensor).iter().position(|n| n == name) else {
            continue;
        };
        let triad = calibration.triad(sensor)?;
        return Some(match PLACES.get(k) {
            Some(&(i, j)) => (triad.t[i][j], triad.t_std[i][j]),
            None => (
                triad.bias[k - PLACES.len()],
                triad.bias_std[k - PLACES.len()],
            ),
        });
    }
    let (effect, own) = name.split_once('.')?;
    let values = calibration.effects.iter().find(|e| e.name == effect)?;
    let found = values.parameters.iter().find(|p| p.name == own)?;
    Some((found.value, found.std))
}

/// Unit of a parameter.
pub(super) fn unit(calibration: &Calibration, name: &str) -> String {
    let effect = |values: &crate::calibration::EffectValues| {
        let own = name.strip_prefix(values.name.as_str())?.strip_prefix('.')?;
        let found = values.parameters.iter().find(|p| p.name == own)?;
        Some(found.unit.clone())
    };
    if let Some(unit) = calibration.effects.iter().find_map(effect) {
        return unit;
    }
    let Some((sensor, part)) = base_part(name) else {
        return "1".into();
    };
    let units = calibration.triad(sensor).and_then(|t| t.units.as_ref());
    match (part == BasePart::Bias, units) {
        (true, Some(units)) => units.reading.clone(),
        (true, None) => sensor.unit().into(),
        (false, Some(units)) => units.t.clone(),
        (false, None) => "1".into(),
    }
}
