//! Remaining errors of the calibration of accelerometer and gyroscope.

use nalgebra::{DMatrix, Matrix3, SymmetricEigen, Vector3};
use sensor::{BASE_PARAMETERS, PLACES, Sensor, base_names};

use crate::calibration::Calibration;

findings::tuning! {
    /// An eigenvalue of the correlations below this is rounding.
    NOTHING: f64 = 1e-12;
}

/// Errors of all parameters of a calibration as independent numbers of variance 1: `δp = L z`.
#[derive(Clone, Debug)]
pub struct Inertial {
    names: Vec<String>,
    /// `L` (parameters × errors).
    root: DMatrix<f64>,
}

impl Inertial {
    /// Builds it from a calibration with its covariance.
    pub fn of(calibration: &Calibration) -> Self {
        let n = calibration.parameters.len();
        let c = &calibration.covariance;
        let std = |k: usize| c[k][k].max(0.0).sqrt();
        let correlation = DMatrix::from_fn(n, n, |i, j| {
            let scale = std(i) * std(j);
            if scale > 0.0 && scale.is_finite() {
                0.5 * (c[i][j] + c[j][i]) / scale
            } else {
                0.0
            }
        });
        let eigen = SymmetricEigen::new(correlation);
        let kept: Vec<usize> = (0..n)
            .filter(|&k| eigen.eigenvalues[k] > NOTHING.get())
            .collect();
        let root = DMatrix::from_fn(n, kept.len(), |i, j| {
            std(i) * eigen.eigenvectors[(i, kept[j])] * eigen.eigenvalues[kept[j]].sqrt()
        });
        Self {
            names: calibration.parameters.clone(),
            root,
        }
    }

    /// Number of independent errors.
    pub fn errors(&self) -> usize {
        self.root.ncols()
    }

    /// `L`, its rows in the order of the calibration's parameters.
    pub fn root(&self) -> &DMatrix<f64> {
        &self.root
    }

    /// The change of the corrected signal `T (x − b)` of a reading by each error, in the recording of that name.
    pub fn by_error(
        &self,
        sensor: Sensor,
        recording: &str,
        t: &Matrix3<f64>,
        unbiased: &Vector3<f64>,
    ) -> Vec<Vector3<f64>> {
        let mut all = vec![Vector3::zeros(); self.errors()];
        for (k, row) in self.rows(sensor, recording) {
            let slope = match PLACES.get(k) {
                Some(&(i, j)) => Vector3::ith(i, 1.0) * unbiased[j],
                None => -t.column(k - PLACES.len()),
            };
            for (sum, weight) in all.iter_mut().zip(self.root.row(row).iter()) {
                *sum += slope * *weight;
            }
        }
        all
    }

    /// The change of `Σ hᵀ T (x − x₀)` by each error, from `Σ h (x − x₀)ᵀ`: biases cancel.
    pub fn by_difference(&self, sensor: Sensor, sums: &Matrix3<f64>) -> Vec<f64> {
        let mut all = vec![0.0; self.errors()];
        for (k, row) in self.rows(sensor, "") {
            let Some(place) = PLACES.get(k) else { continue };
            for (sum, weight) in all.iter_mut().zip(self.root.row(row).iter()) {
                *sum += sums[*place] * *weight;
            }
        }
        all
    }

    /// Base parameters of a sensor by their number, with the row that they have here; biases of a recording's own before
    /// those of all.
    fn rows(&self, sensor: Sensor, recording: &str) -> Vec<(usize, usize)> {
        let place = |name: &str| self.names.iter().position(|n| n == name);
        let names = base_names(sensor).into_iter().enumerate();
        let row = |(k, name): (usize, String)| {
            let own = (PLACES.len()..BASE_PARAMETERS).contains(&k);
            let own = own
                .then(|| place(&format!("{name}[{recording}]")))
                .flatten();
            Some((k, own.or_else(|| place(&name))?))
        };
        names.filter_map(row).collect()
    }
}
