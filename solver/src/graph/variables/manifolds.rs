//! The manifolds that come with the solver.

use super::manifold::Manifold;
use super::quaternion::{conjugate, exponential, logarithm, multiply, rotate, rotate_back};
use crate::scalar::{Scalar, lit};

/// Below this square of a step its sine and cosine are taken by series.
const SMALL: f64 = 1e-8;

/// A rotation, stored as a unit quaternion `(w, x, y, z)`; a step is a rotation vector in rad in the
/// rotated frame: `q ⊞ φ = q ⊗ exp(φ)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rotation;

impl Manifold for Rotation {
    fn numbers(&self) -> usize {
        4
    }

    fn dimension(&self) -> usize {
        3
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        out.copy_from_slice(&unit(multiply(x, &exponential(step))));
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        out.copy_from_slice(&logarithm(&multiply(&conjugate(x), y)));
    }
}

/// `q / ‖q‖`: keeps rounding from growing over many steps.
fn unit<D: Scalar>(q: [D; 4]) -> [D; 4] {
    let square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    let factor = square.sqrt().recip();
    q.map(|v| v * factor)
}

/// A rigid motion `p ↦ t + R p`, stored as `(t, w, x, y, z)`; a step `(τ, φ)` is taken in the moved
/// frame: `t + R τ`, `R exp(φ)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RigidMotion;

impl Manifold for RigidMotion {
    fn numbers(&self) -> usize {
        7
    }

    fn dimension(&self) -> usize {
        6
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let moved = rotate(&x[3..], &step[..3]);
        for k in 0..3 {
            out[k] = x[k] + moved[k];
        }
        Rotation.retract(&x[3..], &step[3..], &mut out[3..]);
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        let between = [y[0] - x[0], y[1] - x[1], y[2] - x[2]];
        out[..3].copy_from_slice(&rotate_back(&x[3..], &between));
        Rotation.local(&x[3..], &y[3..], &mut out[3..]);
    }
}

/// A motion in the plane, stored as `(x, y, angle in rad)`; a step is taken in the moved frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanarMotion;

impl Manifold for PlanarMotion {
    fn numbers(&self) -> usize {
        3
    }

    fn dimension(&self) -> usize {
        3
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let (sine, cosine) = x[2].sin_cos();
        out[0] = x[0] + cosine * step[0] - sine * step[1];
        out[1] = x[1] + sine * step[0] + cosine * step[1];
        out[2] = x[2] + step[2];
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        let (sine, cosine) = x[2].sin_cos();
        let (east, north) = (y[0] - x[0], y[1] - x[1]);
        out[0] = cosine * east + sine * north;
        out[1] = cosine * north - sine * east;
        out[2] = wrapped(y[2] - x[2]);
    }

    /// The angle.
    fn plain(&self, coordinate: usize) -> Option<usize> {
        (coordinate == 2).then_some(2)
    }
}

/// An angle in rad within −π to π.
pub(crate) fn wrapped<D: Scalar>(angle: D) -> D {
    let turns = (angle.re() / std::f64::consts::TAU).round();
    angle - lit::<D>(turns * std::f64::consts::TAU)
}

/// A direction, stored as a unit 3-vector `u`; a step is an arc in rad along two axes across `u`:
/// `u ⊞ δ = cos ‖δ‖ u + sin ‖δ‖ B δ/‖δ‖`, the columns of `B` being the last two of the reflection
/// that takes `u` to the first axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction;

impl Direction {
    /// The two axes across `u`.
    fn axes<D: Scalar>(u: &[D]) -> [[D; 3]; 2] {
        // H = I − v vᵀ / (1 ± u₀), v = u ± e₀, the sign that does not cancel.
        let sign = if u[0].re() < 0.0 { -1.0 } else { 1.0 };
        let first = u[0] + lit::<D>(sign);
        let factor = (u[0] * sign + lit::<D>(1.0)).recip();
        [1, 2].map(|k| {
            let weight = u[k] * factor;
            let mut axis = [-(first * weight), -(u[1] * weight), -(u[2] * weight)];
            axis[k] += lit::<D>(1.0);
            axis
        })
    }
}

impl Manifold for Direction {
    fn numbers(&self) -> usize {
        3
    }

    fn dimension(&self) -> usize {
        2
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let [a, b] = Self::axes(x);
        let square = step[0] * step[0] + step[1] * step[1];
        let (cosine, factor) = if square.re() < SMALL {
            let s = square;
            (
                s * s * (1.0 / 24.0) - s * 0.5 + lit::<D>(1.0),
                s * s * (1.0 / 120.0) - s * (1.0 / 6.0) + lit::<D>(1.0),
            )
        } else {
            let angle = square.sqrt();
            let (sine, cosine) = angle.sin_cos();
            (cosine, sine / angle)
        };
        for k in 0..3 {
            out[k] = x[k] * cosine + (a[k] * step[0] + b[k] * step[1]) * factor;
        }
        let length = (out[0] * out[0] + out[1] * out[1] + out[2] * out[2]).sqrt();
        out.iter_mut().for_each(|v| *v /= length);
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        let dot = |a: &[D], b: &[D]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let axes = Self::axes(x);
        let (p, q) = (dot(&axes[0], y), dot(&axes[1], y));
        let (square, cosine) = (p * p + q * q, dot(x, y));
        let factor = if square.re() < SMALL && cosine.re() > 0.0 {
            // atan(u)/u over cos, u = tan of the arc.
            let u2 = square / (cosine * cosine);
            (u2 * u2 * 0.2 - u2 * (1.0 / 3.0) + lit::<D>(1.0)) / cosine
        } else if square.re() == 0.0 {
            lit::<D>(0.0)
        } else {
            let sine = square.sqrt();
            sine.atan2(cosine) / sine
        };
        out[0] = p * factor;
        out[1] = q * factor;
    }
}

#[cfg(test)]
mod tests {
    use super::super::manifold::{Euclidean, check_manifold};
    use super::*;

    fn check(manifold: &impl Manifold, points: &[&[f64]]) {
        for point in points {
            for size in [0.0, 1e-9, 1e-4, 0.3, 1.4] {
                let step: Vec<f64> = (0..manifold.dimension())
                    .map(|k| size * (1.0 + k as f64).sin())
                    .collect();
                let worst = check_manifold(manifold, point, &step);
                assert!(worst < 2e-9, "{manifold:?} {point:?} {size}: {worst:e}");
            }
        }
    }

    #[test]
    fn retract_and_local_undo_each_other_and_their_derivatives_hold_at_zero() {
        let r = 0.5f64.sqrt();
        check(&Euclidean(3), &[&[1.0, 2.0, -3.0]]);
        check(
            &Rotation,
            &[
                &[1.0, 0.0, 0.0, 0.0],
                &[r, 0.0, -r, 0.0],
                &[0.0, 0.6, 0.0, 0.8],
            ],
        );
        check(&RigidMotion, &[&[1.0, -2.0, 0.5, 0.5, 0.5, -0.5, 0.5]]);
        check(&PlanarMotion, &[&[1.0, 2.0, 3.1]]);
        check(
            &Direction,
            &[
                &[1.0, 0.0, 0.0],
                &[-1.0, 0.0, 0.0],
                &[0.0, 0.0, 1.0],
                &[0.6, -0.8, 0.0],
            ],
        );
    }

    #[test]
    fn half_a_turn_about_z_turns_x_to_minus_x() {
        let q = exponential(&[0.0, 0.0, std::f64::consts::PI]);
        let turned = rotate(&q, &[1.0, 0.0, 0.0]);
        assert!((turned[0] + 1.0).abs() < 1e-15 && turned[1].abs() < 1e-15);
    }
}
