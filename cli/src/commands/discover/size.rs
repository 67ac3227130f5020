//! Size of an effect in a familiar unit.

use std::f64::consts::FRAC_PI_2;

use calib::calibration::effect_named;
use calib::discover::EffectFinding;
use calib::truth::supposed;
use nalgebra::Vector3;
use sensor::{AnyEffect, Kinematics, Sensor};

use super::words::unit_of;
use crate::show;

/// A change of temperature that people know, K.
const WARMER: f64 = 10.0;

/// The largest error over all orientations at one g, else in a turn at 90 °/s about any axis, else ten degrees warmer, else what the
/// recording shows of it.
pub fn of(effect: &EffectFinding, gravity: f64) -> String {
    let values: Vec<f64> = effect.parameters.iter().map(|p| p.value).collect();
    let known = effect_named(&effect.name).filter(|known| known.params().len() == values.len());
    let state = known.and_then(|known| at_a_state(known, &values, gravity));
    state.or_else(|| shown(effect)).unwrap_or_default()
}

fn at_a_state(effect: &dyn AnyEffect, p: &[f64], gravity: f64) -> Option<String> {
    let directions = plan::faces_edges_corners();
    let largest = |truth: &dyn Fn(Vector3<f64>) -> Kinematics<f64>| {
        let errors = directions
            .iter()
            .map(|up| effect.error_f64(&truth(*up), p).norm());
        Some(errors.fold(0.0, f64::max)).filter(|error| error.is_finite() && *error > 0.0)
    };
    let at_rest = |up: Vector3<f64>| supposed(up * gravity, Vector3::zeros());
    let turning = |axis: Vector3<f64>| supposed(Vector3::zeros(), axis * FRAC_PI_2);
    let warmer = |up: Vector3<f64>| Kinematics {
        temperature: at_rest(up).temperature + WARMER,
        ..at_rest(up)
    };
    let found = largest(&at_rest).map(|error| (error, "at one g"));
    let found = found.or_else(|| Some((largest(&turning)?, "at 90 °/s")));
    let (error, at) = found.or_else(|| Some((largest(&warmer)?, "10 °C warmer")))?;
    let (factor, unit) = match effect.sensor() {
        Sensor::Accelerometer => (1e3, "mm/s²"),
        Sensor::Gyroscope => (3600.0 * 1f64.to_degrees(), "°/h"),
        Sensor::Magnetometer => return None,
    };
    Some(format!("{} {unit} {at}", show::rounded(factor * error, 2)))
}

/// Returns the rms of the effect in the recording, or its largest coefficient.
fn shown(effect: &EffectFinding) -> Option<String> {
    if let Some((before, after)) = effect.rms_before.zip(effect.rms_after)
        && before > after
    {
        let (factor, unit) = unit_of(effect.channel);
        let size = (before.powi(2) - after.powi(2)).sqrt();
        return Some(format!(
            "{} {unit} rms here",
            show::rounded(factor * size, 2)
        ));
    }
    let parameters = effect.parameters.iter();
    let largest = parameters.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))?;
    Some(match largest.unit.as_str() {
        "s" => format!("{} ms", show::figures(1e3 * largest.value, 2)),
        unit => format!("{:.1e} {unit}", largest.value),
    })
}
