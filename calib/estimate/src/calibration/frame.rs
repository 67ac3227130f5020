//! From the triangular to the symmetric frame.

use nalgebra::Matrix3;
use sensor::{BasePart, PLACES, Sensor, base_names, inverse};
use solver::{Problem, Residual, Scalar, lit};

use super::{Calibration, Triad};

/// Newton steps to the polar factor; each squares the error, and a sensor starts within a few
/// percent of a rotation.
const POLAR_STEPS: usize = 30;

/// The calibration with a symmetric accelerometer matrix: `S = R T` with the rotation `R` that makes
/// it so; the gyroscope turns with it.
///
/// The covariance follows by the exact derivative of that map.
pub fn in_symmetric_frame(mut calibration: Calibration) -> Calibration {
    let Some(accelerometer) = &calibration.accelerometer else {
        return calibration;
    };
    let mut names: Vec<String> = base_names(Sensor::Accelerometer)[..9].to_vec();
    let mut values = matrix_elements(accelerometer);
    if let Some(gyroscope) = &calibration.gyroscope {
        names.extend_from_slice(&base_names(Sensor::Gyroscope)[..9]);
        values.extend(matrix_elements(gyroscope));
    }
    let free: Vec<usize> = (0..values.len()).collect();
    let mut turned = Vec::new();
    let slopes = ToSymmetric.linearize(&values, &free, &mut turned);
    let place = |name: &str| names.iter().position(|n| n == name);
    let old = calibration.parameters.clone();
    let mut new = names.clone();
    new.extend(old.iter().filter(|name| place(name).is_none()).cloned());
    let slope = |to: &str, from: &str| match (place(to), place(from)) {
        (Some(i), Some(j)) => slopes[(i, j)],
        (None, None) if to == from => 1.0,
        _ => 0.0,
    };
    let jacobian: Vec<Vec<f64>> = new
        .iter()
        .map(|to| old.iter().map(|from| slope(to, from)).collect())
        .collect();
    calibration.covariance = sandwich(&jacobian, &calibration.covariance);
    let std = |k: usize| Some(calibration.covariance[k][k].max(0.0).sqrt());
    if let Some(triad) = &mut calibration.accelerometer {
        set(triad, &turned[..9], std);
    }
    if let Some(triad) = &mut calibration.gyroscope {
        set(triad, &turned[9..], |k| std(9 + k));
    }
    calibration.parameters = new;
    // What an effect adds to a misalignment is not known in this frame.
    calibration
        .left_out
        .retain(|own| !BasePart::Misalignment.has(&own.parameter));
    calibration
}

/// The elements of both matrices in the symmetric frame, in the order of [`PLACES`].
struct ToSymmetric;

impl<D: Scalar> Residual<D> for ToSymmetric {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let t = matrix(&x[..9]);
        let Some(rotation) = polar_rotation(&t) else {
            out.extend_from_slice(x);
            return;
        };
        for elements in x.chunks_exact(9) {
            let turned = rotation.transpose() * matrix(elements);
            out.extend(PLACES.iter().map(|place| turned[*place]));
        }
    }
}

/// The rotation `R` of `T = R S`, `S` symmetric, by Newton's iteration `X ← ½ (X + X⁻ᵀ)` on `T`
/// brought to unit size (Higham 1986, Computing the polar decomposition).
fn polar_rotation<D: Scalar>(t: &Matrix3<D>) -> Option<Matrix3<D>> {
    let size = t.iter().map(|v| v.re() * v.re()).sum::<f64>().sqrt();
    let mut x = t * lit::<D>(3f64.sqrt() / size);
    for _ in 0..POLAR_STEPS {
        x = (x + inverse(&x)?.transpose()) * lit::<D>(0.5);
    }
    Some(x)
}

fn matrix<D: Scalar>(elements: &[D]) -> Matrix3<D> {
    let mut t = Matrix3::from_element(lit(0.0));
    for (place, value) in PLACES.iter().zip(elements) {
        t[*place] = *value;
    }
    t
}

fn matrix_elements(triad: &Triad) -> Vec<f64> {
    PLACES.iter().map(|&(i, j)| triad.t[i][j]).collect()
}

fn set(triad: &mut Triad, elements: &[f64], std: impl Fn(usize) -> Option<f64>) {
    for (k, &(i, j)) in PLACES.iter().enumerate() {
        triad.t[i][j] = elements[k];
        triad.t_std[i][j] = std(k);
    }
}

/// `J C Jᵀ`.
fn sandwich(jacobian: &[Vec<f64>], covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let times: Vec<Vec<f64>> = jacobian
        .iter()
        .map(|row| {
            (0..covariance.len())
                .map(|j| row.iter().zip(covariance).map(|(a, c)| a * c[j]).sum())
                .collect()
        })
        .collect();
    times
        .iter()
        .map(|left| {
            jacobian
                .iter()
                .map(|row| left.iter().zip(row).map(|(a, b)| a * b).sum())
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn the_symmetric_factor_is_symmetric_and_keeps_every_norm() {
        let x = [1.01, 0.98, 1.02, 0.01, -0.02, 0.0, 0.015, 0.0, 0.0];
        let mut turned = Vec::new();
        Residual::<f64>::residuals(&ToSymmetric, &x, &mut turned);
        let (t, s) = (matrix::<f64>(&x), matrix::<f64>(&turned));
        assert!((s - s.transpose()).norm() < 1e-15);
        let v = Vector3::new(3.0, -5.0, 7.0);
        assert!(((t * v).norm() - (s * v).norm()).abs() < 1e-14);
    }
}
