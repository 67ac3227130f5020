//! Whitening of numbers in which a bias walks: a Kalman filter, in time and memory linear in their number.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::methods::joint::orientation::interval::Oriented;

/// `L⁻¹` of `L Lᵀ = I + W` with `W[i,k] = q min(|tᵢ|, |t_k|) hᵢ·h_k` of two numbers of one recording on the same side of
/// its reference time and 0 of all others: a bias (3) that walks away from that time, seen along `hᵢ` in noise of unit
/// variance. Rows stay where they were; each is what the ones nearer the reference time leave of it.
#[derive(Clone, Debug)]
pub struct WalkFilter {
    steps: Vec<Step>,
    /// `ln det (I + W)`.
    pub log_determinant: f64,
}

/// Step of the filter at one number.
#[derive(Clone, Copy, Debug)]
struct Step {
    row: usize,
    /// True if the walk begins anew.
    begins: bool,
    /// Derivative of the number by the bias, in its standard deviations.
    sees: Vector3<f64>,
    /// Kalman gain: change of the estimated bias per unit of innovation.
    gain: Vector3<f64>,
    /// Standard deviation of what is left of the number.
    std: f64,
}

impl WalkFilter {
    /// For a walk of density `q` (variance per second); `None` where something is not a number.
    pub fn new(rows: &[(Oriented, Vector3<f64>)], sigma: &DVector<f64>, q: f64) -> Option<Self> {
        let side = |row: &usize| {
            let at = &rows[*row].0;
            (at.recording, at.time > 0.0)
        };
        let away = |row: &usize| rows[*row].0.time.abs();
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| side(a).cmp(&side(b)).then(away(a).total_cmp(&away(b))));
        let mut steps: Vec<Step> = Vec::with_capacity(rows.len());
        let (mut spread, mut log_determinant) = (Matrix3::zeros(), 0.0);
        let mut before = None;
        for row in order {
            let since = match before {
                Some(last) if side(&last) == side(&row) => away(&row) - away(&last),
                _ => {
                    spread = Matrix3::zeros();
                    away(&row)
                }
            };
            let begins = before.is_none_or(|last| side(&last) != side(&row));
            spread += Matrix3::from_diagonal_element(q * since);
            let sees = rows[row].1 / sigma[row];
            let moved = spread * sees;
            let variance = sees.dot(&moved) + 1.0;
            if !variance.is_finite() {
                return None;
            }
            spread -= moved * moved.transpose() / variance;
            log_determinant += variance.ln();
            steps.push(Step {
                row,
                begins,
                sees,
                gain: moved / variance,
                std: variance.sqrt(),
            });
            before = Some(row);
        }
        Some(Self {
            steps,
            log_determinant,
        })
    }

    /// `L⁻¹ A` in place (`n` rows).
    pub fn whiten(&self, a: &mut DMatrix<f64>) {
        for mut column in a.column_iter_mut() {
            let mut bias = Vector3::zeros();
            for step in &self.steps {
                if step.begins {
                    bias = Vector3::zeros();
                }
                let left = column[step.row] - step.sees.dot(&bias);
                bias += step.gain * left;
                column[step.row] = left / step.std;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_filter_whitens_as_the_factor_of_the_covariance_does() {
        let n = 40;
        let wave = |k: usize, c: f64| (c * (k as f64 + 0.3)).sin();
        let rows: Vec<_> = (0..n)
            .map(|k| {
                let at = Oriented {
                    direction: Vector3::x(),
                    last_change: Vector3::zeros(),
                    time: 7.0 * ((k * 17 % 23) as f64 - 11.0),
                    recording: k / 25,
                };
                (at, Vector3::new(wave(k, 1.1), wave(k, 2.3), wave(k, 3.7)))
            })
            .collect();
        let sigma = DVector::from_fn(n, |k, _| 1.0 + 0.5 * wave(k, 5.1));
        let a = DMatrix::from_fn(n, 4, |i, k| wave(i, 0.7 + k as f64));
        for q in [0.0, 1e-3, 1.0, 1e4] {
            let covariance = DMatrix::from_fn(n, n, |i, k| {
                let ((a, along_a), (b, along_b)) = (&rows[i], &rows[k]);
                let white = f64::from(u8::from(i == k));
                if a.recording != b.recording || a.time * b.time <= 0.0 {
                    return white;
                }
                let common = a.time.abs().min(b.time.abs());
                white + q * common * along_a.dot(along_b) / (sigma[i] * sigma[k])
            });
            let factor = covariance.cholesky().unwrap();
            let log: f64 = 2.0 * factor.l().diagonal().iter().map(|d| d.ln()).sum::<f64>();
            let gram = a.transpose() * factor.solve(&a);
            let filter = WalkFilter::new(&rows, &sigma, q).unwrap();
            let mut own = a.clone();
            filter.whiten(&mut own);
            assert!((filter.log_determinant - log).abs() < 1e-9 * (1.0 + log.abs()));
            assert!((own.transpose() * own - &gram).amax() < 1e-9 * gram.amax());
        }
    }
}
