//! Readings against gravity and turns without a fit of the whole: for commands that do not calibrate, and methods that fit less.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use recording::Recording;
use recording::intervals::Segmentation;
use sensor::{Base, Sensor, inverse};

use super::apart::{ForceFit, RateFit};
use super::columns::Columns;
use super::{Said, force, rate};
use crate::calibrate::checks::determined::LOST;
use crate::calibrate::part_way::gyroscope_by_turns;
use crate::calibration::Calibration;
use crate::methods::{RawUnit, accelerometer_unit};

findings::tuning! {
    /// Unknowns of an ellipsoid along the axes.
    UNKNOWNS: usize = 6;
    /// Placements determine it where the smallest singular value is this share of the largest.
    DETERMINED: f64 = 0.1;
}
/// Least error of a placement's square by misalignments, as a share: readings as they are, and corrected ones.
const MISFIT: [f64; 2] = [0.02, 0.004];

/// Everything that gravity at rest and the turns between say against the readings of a recording, corrected by a calibration where there is
/// one.
///
/// # Examples
/// ```
/// use stillpoint_estimate::calibrate::implausible;
/// use recording::intervals::{Detector, segment};
/// use simulate::Spec;
///
/// let mut recording = Spec::hand_held(1).run()?.recording;
/// let cut = segment(&recording, &Detector::default())?;
/// assert!(implausible(&recording, &cut, None, 9.80665).gates.is_empty());
/// for force in &mut recording.accelerometer.as_mut().unwrap().values {
///     force.z *= 2.0;
/// }
/// let cut = segment(&recording, &Detector::default())?;
/// let said = implausible(&recording, &cut, None, 9.80665);
/// let words = said.gates[0].text(findings::Front::Plain);
/// assert!(words.contains("az=az*0.5"));
/// # Ok::<(), recording::Error>(())
/// ```
pub fn implausible(
    recording: &Recording,
    segmentation: &Segmentation,
    calibration: Option<&Calibration>,
    gravity: f64,
) -> Said {
    let mut said = Said::default();
    let own = calibration.map(|c| c.of_recording(recording));
    let triads = own.as_ref().map(|c| (&c.accelerometer, &c.gyroscope));
    let force_base = triads.and_then(|(force, _)| Some(force.as_ref()?.base()));
    let rate_base = triads.and_then(|(_, rate)| Some(rate.as_ref()?.base()));
    let corrected = |raw: Vector3<f64>| force_base.map_or(raw, |base| base.correct(&raw));
    let forces: Vec<Option<Vector3<f64>>> = segmentation
        .statics
        .iter()
        .map(|rest| Some(corrected(rest.accelerometer?.mean)))
        .collect();
    let known: Vec<Vector3<f64>> = forces.iter().flatten().copied().collect();
    let misfit = MISFIT[usize::from(force_base.is_some())];
    let Some((base, std)) = ellipsoid(&known, gravity, misfit) else {
        return said;
    };
    let recordings = [recording];
    let columns = |sensor, is_corrected| {
        let columns = Columns::of(&recordings, sensor);
        if is_corrected {
            columns.of_corrected()
        } else {
            columns
        }
    };
    let force_columns = columns(Sensor::Accelerometer, force_base.is_some());
    let unit = match force_base {
        Some(_) => RawUnit::SI,
        None => accelerometer_unit(&known, gravity).unwrap_or(RawUnit::SI),
    };
    let force_fit = ForceFit {
        base,
        std,
        unit,
        gravity,
        recordings: &recordings,
    };
    let found = force::said(&force_fit, &force_columns);
    said.append(found);
    let up = forces
        .iter()
        .map(|f| f.map(|f| base.correct(&f).normalize()));
    let up: Vec<Option<Vector3<f64>>> = up.collect();
    let rate = by_turns(recording, segmentation, &up, rate_base);
    let rate = rate.filter(|(_, missed, _)| *missed <= LOST.get());
    if let Some((t, missed, std)) = rate {
        let rate_fit = RateFit {
            base: Base {
                t,
                bias: Vector3::zeros(),
            },
            std: [Some(std); 3],
            scale: unit_scale(&t),
            missed,
            force_is_si: unit.is_si(),
            recordings: &recordings,
        };
        let own = columns(Sensor::Gyroscope, rate_base.is_some());
        let found = rate::said(&rate_fit, &own, &force_columns);
        said.append(found);
    }
    said
}

/// Everything that gravity says against an accelerometer's base that was found otherwise, `base` taking the readings to m/s².
pub fn implausible_base(base: Base<f64>, recordings: &[&Recording], gravity: f64) -> Said {
    let size = base.t.determinant().abs().cbrt();
    let unit = RawUnit {
        scale: if (0.5..2.0).contains(&size) {
            1.0
        } else {
            size
        },
        zero: base.bias,
    };
    let fit = ForceFit {
        base,
        std: [None; 3],
        unit,
        gravity,
        recordings,
    };
    fit.said()
}

/// The scale by which a matrix is near a turn: 1 for one in SI units.
fn unit_scale(t: &Matrix3<f64>) -> f64 {
    let size = t.determinant().abs().cbrt();
    if (0.3..3.0).contains(&size) {
        1.0
    } else {
        size
    }
}

/// The matrix that carries the (corrected) rates to rad/s by the turns, by how much they miss gravity, rad, and the error of its elements.
fn by_turns(
    recording: &Recording,
    segmentation: &Segmentation,
    up: &[Option<Vector3<f64>>],
    corrected_by: Option<Base<f64>>,
) -> Option<(Matrix3<f64>, f64, f64)> {
    let by = corrected_by.map_or_else(Matrix3::identity, |base| base.t);
    let found = gyroscope_by_turns(recording, segmentation, up, &by)?;
    let t = found.t * inverse(&by)?;
    Some((t, found.missed, found.std * unit_scale(&t)))
}

/// Scales and zeros of the axes with which all means have the length of gravity, and the standard errors of the scales:
/// `Σ aᵢ xᵢ² + bᵢ xᵢ = 1`, linear least squares. `None` where the placements do not determine them.
fn ellipsoid(
    means: &[Vector3<f64>],
    gravity: f64,
    misfit: f64,
) -> Option<(Base<f64>, [Option<f64>; 3])> {
    let n = means.len();
    if n < UNKNOWNS.get() {
        return None;
    }
    let span = |axis: usize| {
        let column = || means.iter().map(move |mean| mean[axis]);
        let (low, high) = (
            column().fold(f64::MAX, f64::min),
            column().fold(f64::MIN, f64::max),
        );
        (0.5 * (low + high), 0.5 * (high - low))
    };
    let spans = [span(0), span(1), span(2)];
    if spans.iter().any(|(_, half)| !half.is_normal()) {
        return None;
    }
    let near = |k: usize, axis: usize| (means[k][axis] - spans[axis].0) / spans[axis].1;
    let matrix = DMatrix::from_fn(n, UNKNOWNS.get(), |k, c| match c {
        0..3 => near(k, c).powi(2),
        _ => near(k, c - 3),
    });
    let ones = DVector::from_element(n, 1.0);
    let svd = matrix.clone().svd(true, true);
    if svd.singular_values.min() < DETERMINED.get() * svd.singular_values.max() {
        return None;
    }
    let x = svd.solve(&ones, 0.0).ok()?;
    let left = (&matrix * &x - &ones).norm_squared();
    let spare = n.saturating_sub(UNKNOWNS.get()).max(1) as f64;
    let sigma = (left / spare).sqrt().max(misfit);
    let inverse = (matrix.transpose() * &matrix).try_inverse()?;
    let centre = |axis: usize| -0.5 * x[3 + axis] / x[axis];
    let level = 1.0
        + (0..3)
            .map(|axis| x[axis] * centre(axis).powi(2))
            .sum::<f64>();
    let radius = |axis: usize| (level / x[axis]).sqrt() * spans[axis].1;
    let radii = [radius(0), radius(1), radius(2)];
    if radii.iter().any(|radius| !radius.is_normal()) {
        return None;
    }
    let scales = radii.map(|radius| gravity / radius);
    let std = |axis: usize| {
        let relative = 0.5 * sigma * inverse[(axis, axis)].sqrt() / x[axis];
        Some(relative.abs() * scales[axis])
    };
    Some((
        Base {
            t: Matrix3::from_diagonal(&scales.into()),
            bias: Vector3::from_fn(|axis, _| spans[axis].0 + centre(axis) * spans[axis].1),
        },
        [std(0), std(1), std(2)],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_faces_give_the_scales_and_zeros_of_the_axes() {
        let (scale, zero) = (Vector3::new(1.02, 2.0, 0.5), Vector3::new(0.3, -9.8, 1.0));
        let faces = [Vector3::x(), Vector3::y(), Vector3::z()];
        let faces = faces.into_iter().flat_map(|face| [face, -face]);
        let means: Vec<_> = faces
            .map(|face| (face * 9.8).component_mul(&scale) + zero)
            .collect();
        let (base, _) = ellipsoid(&means, 9.8, 0.0).unwrap();
        let found = base.t.diagonal().map(f64::recip);
        assert!((found - scale).norm() < 1e-9 && (base.bias - zero).norm() < 1e-9);
        assert_eq!(ellipsoid(&means[..5], 9.8, 0.0), None);
    }
}
