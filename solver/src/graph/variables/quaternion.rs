//! Unit quaternions `(w, x, y, z)` over any scalar, with derivatives that hold at zero rotation.

use crate::scalar::{Scalar, lit};

/// `½ ‖φ‖²`-series are used below this square of an angle, in rad².
const SMALL: f64 = 1e-8;

/// `p ⊗ q`.
#[inline(always)]
pub fn multiply<D: Scalar>(p: &[D], q: &[D]) -> [D; 4] {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// `q⁻¹` of a unit quaternion.
#[inline(always)]
pub fn conjugate<D: Scalar>(q: &[D]) -> [D; 4] {
    [q[0], -q[1], -q[2], -q[3]]
}

/// The vector `v` turned by `q`.
#[inline(always)]
pub fn rotate<D: Scalar>(q: &[D], v: &[D]) -> [D; 3] {
    let u = [q[1], q[2], q[3]];
    let t = cross(&u, v).map(|t| t + t);
    let c = cross(&u, &t);
    [
        v[0] + q[0] * t[0] + c[0],
        v[1] + q[0] * t[1] + c[1],
        v[2] + q[0] * t[2] + c[2],
    ]
}

/// The vector `v` turned by `q⁻¹`.
#[inline(always)]
pub fn rotate_back<D: Scalar>(q: &[D], v: &[D]) -> [D; 3] {
    rotate(&conjugate(q), v)
}

/// The quaternion of a rotation vector `φ`, in rad: `(cos ‖φ‖/2, sin(‖φ‖/2) φ/‖φ‖)`.
pub fn exponential<D: Scalar>(phi: &[D]) -> [D; 4] {
    let square = phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2];
    let (w, factor) = if square.re() < SMALL {
        // cos(√s/2) and sin(√s/2)/√s to s²; the next terms are below rounding.
        let s = square;
        (
            s * s * (1.0 / 384.0) - s * 0.125 + lit::<D>(1.0),
            s * s * (1.0 / 3840.0) - s * (1.0 / 48.0) + lit::<D>(0.5),
        )
    } else {
        let angle = square.sqrt();
        let (sine, cosine) = (angle * 0.5).sin_cos();
        (cosine, sine / angle)
    };
    [w, phi[0] * factor, phi[1] * factor, phi[2] * factor]
}

/// The rotation vector of a unit quaternion, in rad, of length at most π.
#[inline(always)]
pub fn logarithm<D: Scalar>(q: &[D]) -> [D; 3] {
    // Of q and −q, the same rotation, the one with w ≥ 0.
    let sign = if q[0].re() < 0.0 { -1.0 } else { 1.0 };
    let w = q[0] * sign;
    let v = [q[1] * sign, q[2] * sign, q[3] * sign];
    let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let factor = if square.re() < SMALL {
        // 2 atan(u)/u of u² = ‖v‖²/w², over w.
        let u2 = square / (w * w);
        (u2 * u2 * 0.4 - u2 * (2.0 / 3.0) + lit::<D>(2.0)) / w
    } else {
        let sine = square.sqrt();
        sine.atan2(w) * 2.0 / sine
    };
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

/// `a × b`.
#[inline(always)]
pub fn cross<D: Scalar>(a: &[D], b: &[D]) -> [D; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
