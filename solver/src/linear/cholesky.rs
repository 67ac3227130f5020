//! Damped least squares by Cholesky of the normal equations.

use std::cell::OnceCell;

use faer::linalg::solvers::SolveCore;
use faer::{Conj, Mat, MatRef, Side};

use super::factor::Factor;
use super::product::{multiply, transpose_multiply};
use super::qr::QrFactor;
use crate::linear::vector::{dot, norm};

/// Smallest ratio of squared pivots at which the normal equations keep half the digits.
const SAFE_PIVOT: f64 = 1e-8;

/// `D⁻¹ JᵀJ D⁻¹`, formed once; QR takes over where it is close to singular.
pub(crate) struct CholeskyFactor<'a> {
    jacobian: MatRef<'a, f64>,
    scale: Vec<f64>,
    normal: Mat<f64>,
    qr: OnceCell<QrFactor>,
}

impl<'a> CholeskyFactor<'a> {
    /// Forms the scaled normal equations of `J` (`m × n`).
    pub fn new(jacobian: MatRef<'a, f64>, scale: &[f64]) -> Self {
        let scaled = Mat::from_fn(jacobian.nrows(), jacobian.ncols(), |i, k| {
            jacobian[(i, k)] / scale[k]
        });
        let normal = scaled.transpose() * &scaled;
        Self {
            jacobian,
            scale: scale.to_vec(),
            normal,
            qr: OnceCell::new(),
        }
    }

    fn qr(&self) -> &QrFactor {
        self.qr
            .get_or_init(|| QrFactor::new(self.jacobian, &self.scale))
    }

    /// The step by Cholesky; `None` where a pivot is too small to trust.
    fn safely(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        let n = self.scale.len();
        let damped = Mat::from_fn(n, n, |i, k| {
            self.normal[(i, k)] + if i == k { lambda } else { 0.0 }
        });
        let factor = damped.llt(Side::Lower).ok()?;
        let pivots = (0..n).map(|k| factor.L()[(k, k)].powi(2));
        let (least, most) = pivots.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        if least <= SAFE_PIVOT * most || least.is_nan() {
            return None;
        }
        let gradient = transpose_multiply(self.jacobian, b);
        let mut p = Mat::from_fn(n, 1, |k, _| -gradient[k] / self.scale[k]);
        factor.solve_in_place_with_conj(Conj::No, p.as_mut());
        let step: Vec<f64> = (0..n).map(|k| p[(k, 0)] / self.scale[k]).collect();
        step.iter().all(|v| v.is_finite()).then_some(step)
    }
}

impl Factor for CholeskyFactor<'_> {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        self.safely(b, lambda)
            .or_else(|| self.qr().damped(b, lambda))
    }

    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        self.safely(b, 0.0).or_else(|| self.qr().undamped(b))
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        // ‖Q₁ᵀ b‖² = −bᵀ J p for the undamped step p; cancellation sets in only near convergence,
        // where QR takes over.
        match self.safely(b, 0.0) {
            Some(p) => {
                let square = -dot(&multiply(self.jacobian, &p), b);
                if square > 1e-8 * dot(b, b) {
                    square.sqrt()
                } else {
                    self.qr().tangential(b)
                }
            }
            None if norm(b) == 0.0 => 0.0,
            None => self.qr().tangential(b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_qr_and_survives_a_singular_matrix() {
        let b = [1.0, -2.0, 0.5, 4.0, 1.0];
        let good = Mat::from_fn(5, 2, |i, k| ((i * 5 + k * 3 + i * i * k) % 7) as f64 - 3.0);
        let singular = Mat::from_fn(5, 2, |i, _| i as f64);
        for j in [&good, &singular] {
            let scale = [1.0, 2.0];
            let (c, q) = (
                CholeskyFactor::new(j.as_ref(), &scale),
                QrFactor::new(j.as_ref(), &scale),
            );
            for lambda in [0.0, 1e-3, 10.0] {
                let step = |f: &dyn Factor| {
                    if lambda == 0.0 {
                        f.undamped(&b)
                    } else {
                        f.damped(&b, lambda)
                    }
                };
                for (a, b) in step(&c).unwrap().iter().zip(&step(&q).unwrap()) {
                    assert!((a - b).abs() < 1e-9);
                }
            }
        }
    }
}
