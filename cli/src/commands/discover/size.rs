//! Size of an effect in a familiar unit.

use std::f64::consts::FRAC_PI_2;

use calib::calibration::effect_named;
use calib::discover::EffectFinding;
use calib::truth::supposed;
use nalgebra::Vector3;
use sensor::{EffectRef, Kinematics, Quantity, Sensor};

use super::words::unit_of;
use crate::show;

/// A change of temperature that people know, K.
const WARMER: f64 = 10.0;

/// A size is stated where it is known to this share of it.
const KNOWN: f64 = 0.5;

/// The largest error over all orientations at one g and the start, else in a turn at 90 °/s about any axis, else ten degrees warmer; where the recording
/// does not determine that, what it shows of the effect.
pub fn of(effect: &EffectFinding, gravity: f64) -> String {
    let p: Vec<f64> = effect.parameters.iter().map(|p| p.value).collect();
    let std = effect.parameters.iter().map(|p| p.std.unwrap_or(0.0));
    let known = effect_named(&effect.name).filter(|known| known.params().len() == p.len());
    let state = known.and_then(|known| at_a_state(&known, &p, &std.collect::<Vec<_>>(), gravity));
    state.or_else(|| shown(effect)).unwrap_or_default()
}

fn at_a_state(effect: &EffectRef, p: &[f64], std: &[f64], gravity: f64) -> Option<String> {
    let directions = plan::faces_edges_corners();
    // Of parameters that only their sum is known of, each has a large error.
    let uncertainty = |truth: &Kinematics<f64>| {
        let own = effect.error_f64(truth, p);
        let by = |k: usize| {
            let mut moved = p.to_vec();
            moved[k] += std[k];
            (effect.error_f64(truth, &moved) - own).norm_squared()
        };
        (0..p.len()).map(by).sum::<f64>().sqrt()
    };
    let largest = |truth: &dyn Fn(Vector3<f64>) -> Kinematics<f64>| {
        let errors = directions.iter().map(|up| {
            let truth = truth(*up);
            (effect.error_f64(&truth, p).norm(), truth)
        });
        let largest = errors.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(largest).filter(|(error, _)| error.is_finite() && *error > 0.0)
    };
    let at_rest = |up: Vector3<f64>| supposed(up * gravity, Vector3::zeros());
    let turning = |axis: Vector3<f64>| supposed(Vector3::zeros(), axis * FRAC_PI_2);
    let warmer = |up: Vector3<f64>| Kinematics {
        temperature: at_rest(up).temperature + WARMER,
        ..at_rest(up)
    };
    let state = match effect.needs().contains(&Quantity::Time) {
        true => "at the start",
        false => "at one g",
    };
    let found = largest(&at_rest).map(|error| (error, state));
    let found = found.or_else(|| Some((largest(&turning)?, "at 90 °/s")));
    let ((error, truth), at) = found.or_else(|| Some((largest(&warmer)?, "10 °C warmer")))?;
    if uncertainty(&truth) > KNOWN * error {
        return None;
    }
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
