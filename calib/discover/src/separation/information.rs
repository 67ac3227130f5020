//! Information of a recording on the parameters that all recordings of a device share.

use estimate::methods::joint::{Basis, BiasNoise, Columns, Whitening};
use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::{Sensor, base_names};
use serde::{Deserialize, Serialize};

use crate::state::State;

findings::tuning! {
    /// A direction of scaled information below this share is rounding.
    ROUNDING: f64 = 1e-10;
}

/// `XᵀV⁻¹X` of scale factors, misalignments and coefficients of effects; directions, biases and all else that is a
/// recording's own are taken out, so that recordings of one device add up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Information {
    /// Names, in SI units.
    pub parameters: Vec<String>,
    /// In their order.
    pub matrix: Vec<Vec<f64>>,
}

impl Information {
    /// Computes it from a fitted session and named columns (`m × k`, white-whitened), under the noise of the biases.
    pub(super) fn of(state: &State, noise: BiasNoise, names: &[String], own: &Mat<f64>) -> Self {
        let fit = &state.fit;
        let all = fit.parameters.names();
        let is_common = |k: &usize| is_common(&all[fit.free[*k]]);
        let (common, others): (Vec<usize>, Vec<usize>) = (0..fit.free.len()).partition(is_common);
        let white = fit.whitening.white.clone();
        let whitening = Whitening::new(white, &fit.components, &noise.levels());
        let jacobian = whitening.finish_columns(fit.white_jacobian.clone());
        let own = Columns::cut(own, fit.whitening.white.groups());
        let own = whitening.finish_columns(own);
        let kept = jacobian.select(&common).beside(&own);
        let kept = Basis::of(&jacobian.select(&others))
            .without(&kept)
            .to_dense();
        let square = kept.transpose() * &kept;
        let of_base = common.iter().map(|k| all[fit.free[*k]].clone());
        Self {
            parameters: of_base.chain(names.iter().cloned()).collect(),
            matrix: (0..square.nrows())
                .map(|i| (0..square.ncols()).map(|k| square[(i, k)]).collect())
                .collect(),
        }
    }

    /// Adds the information of another recording.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        for name in &other.parameters {
            if !sum.parameters.contains(name) {
                sum.parameters.push(name.clone());
                sum.matrix.iter_mut().for_each(|row| row.push(0.0));
                sum.matrix.push(vec![0.0; sum.parameters.len()]);
            }
        }
        let place = |name: &String| sum.parameters.iter().position(|own| own == name);
        let places: Vec<Option<usize>> = other.parameters.iter().map(place).collect();
        for (i, a) in places.iter().enumerate() {
            for (k, b) in places.iter().enumerate() {
                if let (Some(a), Some(b)) = (a, b) {
                    sum.matrix[*a][*b] += other.at(i, k);
                }
            }
        }
        sum
    }

    fn at(&self, i: usize, k: usize) -> f64 {
        let row = self.matrix.get(i);
        row.and_then(|row| row.get(k)).copied().unwrap_or(0.0)
    }

    /// `βᵀ (M_ss − M_sn M_nn⁻¹ M_ns) β`: how far the values `β` of some parameters `s` stand out of what the `nuisance` `n` can
    /// take of them, in χ².
    pub(super) fn left_of(&self, signal: &[(usize, f64)], nuisance: &[usize]) -> f64 {
        let scale: Vec<f64> = nuisance
            .iter()
            .map(|k| self.at(*k, *k))
            .map(|v| if v > 0.0 { v.sqrt().recip() } else { 0.0 })
            .collect();
        let n = nuisance.len();
        let inner = DMatrix::from_fn(n, n, |i, k| {
            scale[i] * scale[k] * self.at(nuisance[i], nuisance[k])
        });
        let moved = DVector::from_fn(n, |i, _| {
            let row = signal.iter().map(|(k, v)| self.at(nuisance[i], *k) * v);
            scale[i] * row.sum::<f64>()
        });
        let whole: f64 = signal
            .iter()
            .flat_map(|(i, a)| signal.iter().map(move |(k, b)| (*i, *k, a * b)))
            .map(|(i, k, product)| product * self.at(i, k))
            .sum();
        if inner.iter().chain(moved.iter()).any(|v| !v.is_finite()) {
            return 0.0;
        }
        let eigen = inner.symmetric_eigen();
        let taken: f64 = eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
            .filter(|(value, _)| **value > ROUNDING.get())
            .map(|(value, vector)| vector.dot(&moved).powi(2) / value)
            .sum();
        (whole - taken).max(0.0)
    }
}

/// Returns true if all recordings of a device share this parameter: a scale factor or a misalignment.
pub(super) fn is_common(name: &str) -> bool {
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
    let matrices = sensors.map(|sensor| base_names(sensor).into_iter().take(9));
    matrices.into_iter().flatten().any(|own| own == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_out_is_the_square_less_the_correlation() {
        // Columns of length 2 and 3 with a correlation of 0.8: 9 · 4 · (1 − 0.64) of a coefficient of 3.
        let information = Information {
            parameters: vec!["a".into(), "b".into()],
            matrix: vec![vec![4.0, 4.8], vec![4.8, 9.0]],
        };
        let left = information.left_of(&[(0, 3.0)], &[1]);
        assert!((left - 36.0 * 0.36).abs() < 1e-12, "{left}");
        let doubled = information.plus(&information);
        assert!((doubled.left_of(&[(0, 3.0)], &[1]) - 72.0 * 0.36).abs() < 1e-12);
    }

    #[test]
    fn a_recording_that_sees_the_other_alone_tells_them_apart() {
        let tied = Information {
            parameters: vec!["a".into(), "b".into()],
            matrix: vec![vec![1.0, 1.0], vec![1.0, 1.0]],
        };
        let other = Information {
            parameters: vec!["b".into()],
            matrix: vec![vec![1e6]],
        };
        assert!(tied.left_of(&[(0, 5.0)], &[1]) < 1e-9);
        assert!((tied.plus(&other).left_of(&[(0, 5.0)], &[1]) - 25.0).abs() < 1e-3);
    }
}
