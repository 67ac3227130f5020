//! A turn carried through the gyroscope, with its derivative by every sample in one pass.

use nalgebra::{Matrix3, Vector3};
use pulp::{Arch, Simd, WithSimd};

use crate::methods::joint::clock::coning::{Coning, REACH};

/// Windows of still samples kept on either side of a turn for the coning terms.
pub const MARGIN: usize = REACH;

findings::tuning! {
    /// Below this squared angle the series are exact to the last bit.
    SERIES: f64 = 1e-2;
}

/// The rotation over a turn and what each sample contributes to it.
#[derive(Clone, Debug)]
pub struct Carried {
    /// From the first to the last edge (3 × 3): `v_after = R v_before` in body frames.
    pub rotation: Matrix3<f64>,
    /// `∂δ/∂ω̄_k` (3 × 3, s) of every sample, `δ` the small rotation at the end of the turn, in its body
    /// frame: `R → exp(−[δ]×) R`.
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
    let mut gains = vec![Matrix3::zeros(); rates.len()];
    let rotation = backwards(coning, rates, lengths, |k, after, window, sums| {
        let carried = after * window.right_jacobian();
        match coning.direct() {
            Some(direct) => {
                for (gain, weight) in gains[k - REACH..].iter_mut().zip(direct) {
                    *gain += carried * *weight;
                }
            }
            None => gains[k] += carried,
        }
        for (gain, sum) in gains[k - REACH..].iter_mut().zip(sums) {
            subtract_cross(gain, &carried, sum);
        }
    });
    for (gain, length) in gains.iter_mut().zip(lengths) {
        *gain *= *length;
    }
    Carried { rotation, gains }
}

/// The rotation alone.
pub fn rotation(coning: &Coning, rates: &[Vector3<f64>], lengths: &[f64]) -> Matrix3<f64> {
    backwards(coning, rates, lengths, |_, _, _, _| ())
}

/// The product of the windows' rotations from the last to the first; `visit` sees each with what comes
/// after it.
fn backwards(
    coning: &Coning,
    rates: &[Vector3<f64>],
    lengths: &[f64],
    visit: impl FnMut(usize, &Matrix3<f64>, &Window, &[Vector3<f64>]),
) -> Matrix3<f64> {
    Arch::new().dispatch(Backwards {
        coning,
        angles: rates.iter().zip(lengths).map(|(w, h)| w * *h).collect(),
        visit,
    })
}

/// The same in the widest vectors of the machine: no product is fused with a sum, so that the bits are those of any other.
struct Backwards<'a, V> {
    coning: &'a Coning,
    angles: Vec<Vector3<f64>>,
    visit: V,
}

impl<V: FnMut(usize, &Matrix3<f64>, &Window, &[Vector3<f64>])> WithSimd for Backwards<'_, V> {
    type Output = Matrix3<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _simd: S) -> Matrix3<f64> {
        let mut after = Matrix3::identity();
        for k in (MARGIN..self.angles.len().saturating_sub(MARGIN)).rev() {
            let Some(around) = self.angles[k - REACH..].first_chunk() else {
                continue;
            };
            let (phi, sums) = self.coning.rotation(around);
            let window = Window::new(phi);
            (self.visit)(k, &after, &window, &sums);
            after *= window.rotation();
        }
        after
    }
}

/// A window's rotation vector `φ` with `sin φ/φ`, `(1 − cos φ)/φ²` and `(φ − sin φ)/φ³`.
struct Window {
    phi: Vector3<f64>,
    square: f64,
    sine: f64,
    cosine: f64,
    rest: f64,
}

impl Window {
    #[inline(always)]
    fn new(phi: Vector3<f64>) -> Self {
        let x = phi.norm_squared();
        let (sine, cosine, rest) = if x < SERIES.get() {
            (
                1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0))),
                0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0))),
                (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0)))) / 6.0,
            )
        } else {
            let angle = x.sqrt();
            let (sin, cos) = angle.sin_cos();
            (sin / angle, (1.0 - cos) / x, (angle - sin) / (x * angle))
        };
        Self {
            phi,
            square: x,
            sine,
            cosine,
            rest,
        }
    }

    /// `exp(−[φ]×) = I − sin φ/φ [φ]× + (1 − cos φ)/φ² [φ]×²`.
    #[inline(always)]
    fn rotation(&self) -> Matrix3<f64> {
        self.blend(self.sine, self.cosine)
    }

    /// `J_r(φ)` with `exp(φ + ∂φ) ≈ exp(φ) exp(J_r ∂φ)`: `I − (1 − cos φ)/φ² [φ]× + (φ − sin φ)/φ³ [φ]×²`.
    #[inline(always)]
    fn right_jacobian(&self) -> Matrix3<f64> {
        self.blend(self.cosine, self.rest)
    }

    /// `I − a [φ]× + b [φ]×²`, `[φ]×² = φφᵀ − φ² I`.
    #[inline(always)]
    fn blend(&self, a: f64, b: f64) -> Matrix3<f64> {
        let (v, s) = (self.phi * a, self.phi * b);
        let d = 1.0 - b * self.square;
        let p = &self.phi;
        Matrix3::new(
            d + s.x * p.x,
            s.x * p.y + v.z,
            s.x * p.z - v.y,
            s.x * p.y - v.z,
            d + s.y * p.y,
            s.y * p.z + v.x,
            s.x * p.z + v.y,
            s.y * p.z - v.x,
            d + s.z * p.z,
        )
    }
}

/// `gain −= M [v]×`, of which row `i` is `m_i × v`.
#[inline(always)]
fn subtract_cross(gain: &mut Matrix3<f64>, m: &Matrix3<f64>, v: &Vector3<f64>) {
    for i in 0..3 {
        let (a, b, c) = (m[(i, 0)], m[(i, 1)], m[(i, 2)]);
        gain[(i, 0)] -= b * v.z - c * v.y;
        gain[(i, 1)] -= c * v.x - a * v.z;
        gain[(i, 2)] -= a * v.y - b * v.x;
    }
}

#[cfg(test)]
mod tests {
    use sensor::attitude::Attitude;

    use super::*;

    fn wave(k: usize) -> Vector3<f64> {
        let t = k as f64 * 0.3;
        Vector3::new(2.0 * t.sin(), 1.5 * (0.7 * t).cos(), -0.8 + 0.2 * t)
    }

    #[test]
    fn gains_are_the_differences_of_the_rotation() {
        for coning in [Coning::new(), Coning::at_instants()] {
            gains_are_differences(&coning);
        }
    }

    fn gains_are_differences(coning: &Coning) {
        let rates: Vec<_> = (0..30).map(wave).collect();
        let lengths = vec![0.02; 30];
        let carried = carry(coning, &rates, &lengths);
        for k in 0..30 {
            for axis in 0..3 {
                let at = |step: f64| {
                    let mut moved = rates.clone();
                    moved[k][axis] += step;
                    // exp(−[δ]×) = R' Rᵀ
                    let q = rotation(coning, &moved, &lengths) * carried.rotation.transpose();
                    Vector3::new(
                        q[(1, 2)] - q[(2, 1)],
                        q[(2, 0)] - q[(0, 2)],
                        q[(0, 1)] - q[(1, 0)],
                    ) * 0.5
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
        let carried = carried.rotation * Vector3::new(0.3, -0.5, 0.8);
        let error = (carried - truth.into_body(&Vector3::new(0.3, -0.5, 0.8))).norm();
        // Central differences of the attitude are good to (1e-5)² · ω‴ ≈ 1e-9 in half angles.
        assert!(error < 6e-9, "{error}");
    }
}
