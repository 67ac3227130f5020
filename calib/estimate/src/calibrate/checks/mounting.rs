//! A gyroscope that is mounted, logged or scaled otherwise than it should be.

use nalgebra::Matrix3;
use sensor::Base;

use super::determined::{LOST, RateEvidence};

/// An element of the gyroscope's matrix this far from that of aligned axes is no misalignment.
const TURNED: f64 = 0.26;

/// A scale this far from one on all axes of readings in SI units is a unit or a time base.
const COMMON_SCALE: f64 = 0.03;
/// The same to a factor of two, the commonest of wrong rates, and the sensor's own errors on top.
const COMMON_SCALES: std::ops::RangeInclusive<f64> = 0.45..=2.2;

/// Reasons not to use a gyroscope's fit as it stands.
pub(in crate::calibrate) fn gyroscope_gates(fit: &RateEvidence<'_>, si: bool) -> Vec<String> {
    let mut failed = Vec::new();
    let base = Base::from_parameters(fit.fitted.parameters.values());
    let near_si: Matrix3<f64> = base.t / fit.scale;
    if fit.rms > LOST {
        failed.push(format!(
            "the gyroscope misses gravity by {:.1}° rms after the fit: is a sensor mounted or logged \
             with other axes, or the time stamps not those of the samples?",
            fit.rms.to_degrees()
        ));
    }
    if near_si.determinant() < 0.0 {
        failed.push(match is_left_handed(&near_si) {
            true => format!(
                "the gyroscope's axes are left-handed against the accelerometer's: {}{}",
                mounting(&near_si),
                flip_in_words(&near_si)
            ),
            // No axis is turned or flipped so: the matrix is none of a sensor.
            false => "the gyroscope's matrix is that of no sensor (det T < 0, and no axis is flipped): the turns do not \
                      show its axes; turn the device about each of them between static intervals"
                .into(),
        });
    }
    let ratio = base.t.trace() / 3.0;
    if si && fit.rms <= LOST && COMMON_SCALES.contains(&ratio) && all_off(&base.t) {
        failed.push(format!(
            "the gyroscope's scale is {ratio:.3} on all axes: a wrong time base (nominal rate) or \
             unit rather than a sensor error"
        ));
    }
    failed
}

fn all_off(t: &Matrix3<f64>) -> bool {
    let off: Vec<f64> = (0..3).map(|k| t[(k, k)] - 1.0).collect();
    off.iter().all(|v| *v > COMMON_SCALE) || off.iter().all(|v| *v < -COMMON_SCALE)
}

/// A gyroscope mounted or logged with other axes than the accelerometer.
pub(in crate::calibrate) fn turned_axes(fit: &RateEvidence<'_>) -> Option<String> {
    let base = Base::from_parameters(fit.fitted.parameters.values());
    let near_si: Matrix3<f64> = base.t / fit.scale;
    let largest = (0..9)
        .map(|k| near_si[(k / 3, k % 3)] - if k % 4 == 0 { 1.0 } else { 0.0 })
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    (fit.rms <= LOST && near_si.determinant() > 0.0 && largest > TURNED).then(|| {
        format!(
            "the gyroscope's axes are turned against the accelerometer's: {}; the matrix T of the calibration turns them back",
            mounting(&near_si)
        )
    })
}

/// `; read it with --flip gy`, where one axis alone is flipped.
fn flip_in_words(t: &Matrix3<f64>) -> String {
    let flipped: Vec<&str> = ["gx", "gy", "gz"]
        .into_iter()
        .enumerate()
        .filter(|&(k, _)| t[(k, k)] < -TURNED)
        .map(|(_, axis)| axis)
        .collect();
    match flipped.as_slice() {
        [axis] => format!("; read it with --flip {axis}"),
        _ => String::new(),
    }
}

/// The sensor's axis nearest to each of the body's, and whether it points the other way.
fn nearest(t: &Matrix3<f64>) -> [(usize, bool); 3] {
    [0, 1, 2].map(|row| {
        let column = (0..3).fold(0, |best, k| {
            if t[(row, k)].abs() > t[(row, best)].abs() {
                k
            } else {
                best
            }
        });
        (column, t[(row, column)] < 0.0)
    })
}

/// Whether the nearest axes are a mirror of the body's: each once, and an odd number of exchanges and flips.
fn is_left_handed(t: &Matrix3<f64>) -> bool {
    let mut mirrored = Matrix3::zeros();
    for (row, (column, negative)) in nearest(t).into_iter().enumerate() {
        mirrored[(row, column)] = if negative { -1.0 } else { 1.0 };
    }
    mirrored.determinant() < 0.0
}

/// `its y is flipped`, or which axis of the sensor lies on which of the body.
fn mounting(t: &Matrix3<f64>) -> String {
    let axes = ["x", "y", "z"];
    let rows = nearest(t);
    let in_order = rows
        .iter()
        .enumerate()
        .all(|(row, (column, _))| row == *column);
    if in_order {
        let flipped: Vec<&str> = (0..3).filter(|&k| rows[k].1).map(|k| axes[k]).collect();
        if !flipped.is_empty() {
            let verb = if flipped.len() > 1 { "are" } else { "is" };
            return format!("{} {verb} flipped", flipped.join(" and "));
        }
    }
    rows.iter()
        .enumerate()
        .map(|(row, (column, negative))| {
            let sign = if *negative { "-" } else { "" };
            format!("{} is its {sign}{}", axes[row], axes[*column])
        })
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_axes_that_are_flipped_or_exchanged_are_left_handed() {
        let flipped = Matrix3::new(1.0, 0.01, 0.0, 0.0, -1.0, 0.0, 0.02, 0.0, 1.0);
        assert!(is_left_handed(&flipped));
        let exchanged = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        assert!(is_left_handed(&exchanged));
        let undetermined = Matrix3::new(1.0, 0.9, 0.8, 0.9, 1.0, 0.95, -0.5, 0.9, 1.0);
        assert!(!is_left_handed(&undetermined));
    }
}
