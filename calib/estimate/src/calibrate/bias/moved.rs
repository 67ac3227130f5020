//! Standard errors of biases that moved: the stated bias is a mean, and a corrected reading is off by the motion about it.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::{PLACES, Sensor, base_names};

use crate::calibration::Calibration;

findings::tuning! {
    /// Root mean square of an even motion from 0 to 1 about its mean, 1/√12.
    OF_A_RAMP: f64 = 0.288_675_134_594_812_9;

    /// Largest standard deviation of a step from 0 to 1, one in the middle.
    OF_A_STEP: f64 = 0.5;
}

/// Adds the mean square of their motion to the variances of the biases of which the calibration's findings say that they moved.
///
/// Without it the standard error is that of the mean: a gyroscope's bias that jumps by 1000 °/h would be stated to 2 °/h.
pub fn count_motion(calibration: &mut Calibration) {
    let found: Vec<Finding> = calibration.warnings.iter().cloned().collect();
    count_motion_of(calibration, &found);
}

/// The same of these findings.
pub fn count_motion_of(calibration: &mut Calibration, found: &[Finding]) {
    let n = calibration.parameters.len();
    let mut added = vec![0.0; n];
    for found in found {
        let Some((sensor, motion)) = motion(calibration, found) else {
            continue;
        };
        let names = &base_names(sensor)[PLACES.len()..];
        for (name, motion) in names.iter().zip(&motion) {
            let own = format!("{name}[{}]", found.place.recording.as_deref().unwrap_or(""));
            let named = |name: &str| calibration.parameters.iter().position(|p| p == name);
            if let Some(k) = named(&own).or_else(|| named(name)) {
                added[k] += motion * motion;
            }
        }
    }
    if calibration.covariance.len() == n && added.iter().any(|&variance| variance > 0.0) {
        let mut covariance = calibration.covariance_matrix();
        (0..n).for_each(|k| covariance[(k, k)] += added[k]);
        let values = calibration.parameter_values();
        calibration.write_parameters(&values, &covariance);
    }
}

/// The root mean square of the motion that a finding tells, in the unit of the bias.
fn motion(calibration: &Calibration, found: &Finding) -> Option<(Sensor, Vector3<f64>)> {
    let sensor = found.place.sensor?;
    let triad = calibration.triad(sensor)?;
    let near_si = triad.base().t.determinant().abs().cbrt();
    let size = found.value("size").map_or(0.0, f64::abs) / near_si;
    let motion = match found.kind {
        Kind::BIAS_MOVED => OF_A_RAMP.get() * Vector3::repeat(found.value("change")? / near_si),
        Kind::BIAS_WANDERED | Kind::BIAS_UNSTEADY => Vector3::repeat(size),
        Kind::BIAS_STEP => {
            let axis = ["x", "y", "z"].map(|axis| found.word("axis") == Some(axis));
            let all = axis == [false; 3];
            Vector3::from_fn(|k, _| {
                if all || axis[k] {
                    OF_A_STEP.get() * size
                } else {
                    0.0
                }
            })
        }
        _ => return None,
    };
    Some((sensor, motion))
}
