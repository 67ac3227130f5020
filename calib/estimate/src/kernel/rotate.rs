//! One step of a turn on vectors side by side.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `φ` | rotation vector of the step | rad |
//! | `u` | gravity, body frame | 1 |
//! | `a₁, a₂` | vectors at rest in the frame before the turn, seen from the body | 1 |
//! | `b` | `J_l(φ)ᵀ a`, with the left Jacobian of the rotation group | 1 |
//!
//! `R(φ)ᵀ = I − S [φ]× + C [φ]×²` and `J_l(φ)ᵀ = I − C [φ]× + D [φ]×²` with the series of
//! [`super::series`]; since `S = 1 − θ² D`, `R(φ)ᵀ a = a − φ × J_l(φ)ᵀ a`.

use pulp::Simd;

use super::lanes::{Vector, cross, dot, minus, minus_cross, plus};
use super::series::Series;

/// `R(φ)ᵀ u`.
#[inline(always)]
pub(super) fn turn_vector<S: Simd, const N: usize>(
    simd: S,
    u: &Vector<S>,
    phi: &Vector<S>,
) -> Vector<S> {
    let square = dot(simd, phi, phi);
    let s = Series::<N>::s(simd, square);
    let c = Series::<N>::c(simd, square);
    let once = cross(simd, phi, u);
    let twice = cross(simd, phi, &once);
    [
        plus(simd, minus(simd, u[0], s, once[0]), c, twice[0]),
        plus(simd, minus(simd, u[1], s, once[1]), c, twice[1]),
        plus(simd, minus(simd, u[2], s, once[2]), c, twice[2]),
    ]
}

/// Replaces both `a` by `R(φ)ᵀ a` and returns their `b`.
#[inline(always)]
pub(super) fn turn_frame<S: Simd, const N: usize>(
    simd: S,
    a: &mut [Vector<S>; 2],
    phi: &Vector<S>,
) -> [Vector<S>; 2] {
    let square = dot(simd, phi, phi);
    let c = Series::<N>::c(simd, square);
    let d = Series::<N>::d(simd, square);
    let first = adjoint(simd, &a[0], phi, c, d);
    let second = adjoint(simd, &a[1], phi, c, d);
    *a = [
        minus_cross(simd, &a[0], phi, &first),
        minus_cross(simd, &a[1], phi, &second),
    ];
    [first, second]
}

/// `b = a − φ × (C a − D φ × a)`.
#[inline(always)]
fn adjoint<S: Simd>(simd: S, a: &Vector<S>, phi: &Vector<S>, c: S::f64s, d: S::f64s) -> Vector<S> {
    let once = cross(simd, phi, a);
    let inner = [
        minus(simd, simd.mul_f64s(c, a[0]), d, once[0]),
        minus(simd, simd.mul_f64s(c, a[1]), d, once[1]),
        minus(simd, simd.mul_f64s(c, a[2]), d, once[2]),
    ];
    minus_cross(simd, a, phi, &inner)
}
