//! A turn carried through the gyroscope, with its derivative by every sample in one pass.

use nalgebra::{Matrix3, Vector3};
use sensor::attitude::Attitude;

use super::coning::{Coning, REACH};

/// Windows of still samples kept on either side of a turn for the coning terms.
pub const MARGIN: usize = REACH;

/// The rotation over a turn and what each sample contributes to it.
#[derive(Clone, Debug)]
pub struct Carried {
    /// From the first to the last edge: `v_before = q v_after q*`.
    pub attitude: Attitude<f64>,
    /// `∂δ/∂ω̄_k` (3 × 3, s) of every sample, `δ` the small rotation at the end of the turn, in its body
    /// frame: `q → q · exp(δ)`.
    pub gains: Vec<Matrix3<f64>>,
}

/// Carries the mean rates (rad/s) of windows of the given lengths (s) through a turn.
///
/// The [`MARGIN`] samples at either end are context: they enter the coning terms of their
/// neighbours but are not integrated.
///
/// `δ = Σ_k A_k J_r(φ_k) ∂φ_k`, `A_k` from the frame after window `k` to that at the end, `J_r` the
/// right Jacobian of the exponential map: exact for this integrator, and one backward pass whatever
/// the number of parameters.
pub fn carry(coning: &Coning, rates: &[Vector3<f64>], lengths: &[f64]) -> Carried {
    let angles: Vec<Vector3<f64>> = rates.iter().zip(lengths).map(|(w, h)| w * *h).collect();
    let mut gains = vec![Matrix3::zeros(); angles.len()];
    let mut after = Attitude::identity();
    let inner = MARGIN..angles.len().saturating_sub(MARGIN);
    for k in inner.rev() {
        let (phi, sums) = coning.rotation(&angles, k);
        let carried = turned(&after) * right_jacobian(&phi);
        gains[k] += carried;
        for (c, sum) in sums.iter().enumerate() {
            gains[k + c - REACH] -= times_cross(&carried, sum);
        }
        after = Attitude::exp(&phi).then(&after);
    }
    for (gain, length) in gains.iter_mut().zip(lengths) {
        *gain *= *length;
    }
    Carried {
        attitude: after,
        gains,
    }
}

/// The matrix of `v ↦ q* v q`.
fn turned(q: &Attitude<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[
        q.into_body(&Vector3::x()),
        q.into_body(&Vector3::y()),
        q.into_body(&Vector3::z()),
    ])
}

/// `M [v]×`, of which row `i` is `m_i × v`.
fn times_cross(m: &Matrix3<f64>, v: &Vector3<f64>) -> Matrix3<f64> {
    m * v.cross_matrix()
}

/// `J_r(φ)` with `exp(φ + ∂φ) ≈ exp(φ) exp(J_r ∂φ)`: `I − (1 − cos φ)/φ² [φ]× + (φ − sin φ)/φ³ [φ]×²`.
fn right_jacobian(phi: &Vector3<f64>) -> Matrix3<f64> {
    let square = phi.norm_squared();
    let (a, b) = if square < 1e-4 {
        (
            0.5 - square * (1.0 / 24.0 - square / 720.0),
            1.0 / 6.0 - square * (1.0 / 120.0 - square / 5040.0),
        )
    } else {
        let angle = square.sqrt();
        (
            (1.0 - angle.cos()) / square,
            (angle - angle.sin()) / (square * angle),
        )
    };
    let cross = phi.cross_matrix();
    Matrix3::identity() - cross * a + cross * cross * b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(k: usize) -> Vector3<f64> {
        let t = k as f64 * 0.3;
        Vector3::new(2.0 * t.sin(), 1.5 * (0.7 * t).cos(), -0.8 + 0.2 * t)
    }

    #[test]
    fn gains_are_the_differences_of_the_rotation() {
        let coning = Coning::new();
        let rates: Vec<_> = (0..30).map(wave).collect();
        let lengths = vec![0.02; 30];
        let carried = carry(&coning, &rates, &lengths);
        for k in 0..30 {
            for axis in 0..3 {
                let at = |step: f64| {
                    let mut moved = rates.clone();
                    moved[k][axis] += step;
                    let q = carry(&coning, &moved, &lengths).attitude;
                    let back = Attitude {
                        w: carried.attitude.w,
                        v: -carried.attitude.v,
                    };
                    back.then(&q).v * 2.0
                };
                let difference = (at(1e-4) - at(-1e-4)) / 2e-4;
                let gain = carried.gains[k].column(axis).into_owned();
                // Differences of 1e-4 in attitudes of 16 digits.
                assert!((difference - gain).norm() < 1e-11, "{k}");
            }
        }
    }

    #[test]
    fn window_means_of_a_coning_motion_close_to_rounding() {
        // q(t) = exp(½ a(t)) with a slow rotation vector: the rate is known, its mean by quadrature.
        let angle = |t: f64| {
            Vector3::new(
                (3.0 * t).sin() - 3.0 * t,
                0.4 * (2.0 * t).cos() - 0.4,
                0.7 * t,
            )
        };
        let rate = |t: f64| {
            let d = 1e-5;
            let (before, after) = (Attitude::exp(&angle(t - d)), Attitude::exp(&angle(t + d)));
            let inverse = Attitude {
                w: before.w,
                v: -before.v,
            };
            inverse.then(&after).v / d
        };
        let h = 0.01;
        let points = [-0.774_596_669_241_483_4, 0.0, 0.774_596_669_241_483_4];
        let weights = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];
        let mean = |k: i32| {
            (0..3)
                .map(|i| rate((f64::from(k) + 0.5 + 0.5 * points[i]) * h) * weights[i])
                .sum()
        };
        let rates: Vec<Vector3<f64>> = (-3..203).map(mean).collect();
        let carried = carry(&Coning::new(), &rates, &vec![h; rates.len()]);
        let (start, end) = (Attitude::exp(&angle(0.0)), Attitude::exp(&angle(2.0)));
        let inverse = Attitude {
            w: start.w,
            v: -start.v,
        };
        let truth = inverse.then(&end);
        let error = (carried.attitude.v - truth.v).norm();
        // Central differences of the attitude are good to (1e-5)² · ω‴ ≈ 1e-9.
        assert!(error < 3e-9, "{error}");
    }
}
