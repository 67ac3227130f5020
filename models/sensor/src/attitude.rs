//! Attitude quaternions over any scalar, with a derivative at zero rotation.
//!
//! nalgebra's quaternions want a `RealField`, and their exponential branches at a zero rotation
//! vector and loses the derivative there; this one uses a series near zero instead.

use nalgebra::Vector3;
use solver::{Scalar, lit};

/// Below this squared half-angle the series is exact to the last bit.
const SERIES: f64 = 1e-4;

/// The quaternion `w + x i + y j + z k` that carries body vectors into the reference frame:
/// `v_reference = q v_body q*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude<D> {
    /// Scalar part.
    pub w: D,
    /// Vector part.
    pub v: Vector3<D>,
}

impl<D: Scalar> Attitude<D> {
    /// No rotation.
    pub fn identity() -> Self {
        Self {
            w: lit(1.0),
            v: Vector3::from_element(lit(0.0)),
        }
    }

    /// `exp(½ φ) = [cos ½|φ|, sin ½|φ| φ/|φ|]` of the rotation vector `φ` (rad).
    pub fn exp(phi: &Vector3<D>) -> Self {
        let half = phi * lit::<D>(0.5);
        let (cos, sinc) = cos_sinc(half.dot(&half));
        Self {
            w: cos,
            v: half * sinc,
        }
    }

    /// The product `self · next`: first `self`, then `next` about the rotated axes.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            w: self.w * next.w - self.v.dot(&next.v),
            v: next.v * self.w + self.v * next.w + self.v.cross(&next.v),
        }
    }

    /// The quaternion of unit length in the same direction.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let scale = (self.w * self.w + self.v.dot(&self.v)).sqrt().recip();
        Self {
            w: self.w * scale,
            v: self.v * scale,
        }
    }

    /// `q* v q`: the reference vector `v` seen from the body. Without unit length the result
    /// carries the square of the length.
    pub fn into_body(&self, v: &Vector3<D>) -> Vector3<D> {
        let twice = lit::<D>(2.0);
        let square = self.w * self.w - self.v.dot(&self.v);
        v * square + self.v * (self.v.dot(v) * twice) - self.v.cross(v) * (self.w * twice)
    }

    /// `q v q*`: the body vector `v` seen from the reference frame.
    pub fn into_reference(&self, v: &Vector3<D>) -> Vector3<D> {
        Self {
            w: self.w,
            v: -self.v,
        }
        .into_body(v)
    }
}

impl Attitude<f64> {
    /// The same attitude over another scalar, as a constant.
    pub fn lift<D: Scalar>(&self) -> Attitude<D> {
        Attitude {
            w: lit(self.w),
            v: self.v.map(lit),
        }
    }
}

/// `cos θ` and `sin θ / θ` as functions of `θ²`.
fn cos_sinc<D: Scalar>(square: D) -> (D, D) {
    if square.re() < SERIES {
        let s = square;
        let cos = ((s / 40320.0 - 1.0 / 720.0) * s + 1.0 / 24.0) * s - 0.5;
        let sinc = ((s / 362_880.0 - 1.0 / 5040.0) * s + 1.0 / 120.0) * s - 1.0 / 6.0;
        (cos * s + 1.0, sinc * s + 1.0)
    } else {
        let angle = square.sqrt();
        let (sin, cos) = angle.sin_cos();
        (cos, sin / angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use solver::scalar::{derivatives, variable};

    #[test]
    fn a_quarter_turn_about_z_carries_x_to_minus_y_of_the_body() {
        let q = Attitude::exp(&Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
        assert!((q.into_body(&Vector3::x()) + Vector3::y()).norm() < 1e-15);
        assert!((q.into_reference(&Vector3::x()) - Vector3::y()).norm() < 1e-15);
    }

    #[test]
    fn two_turns_compose_like_their_matrices() {
        let a = Attitude::exp(&Vector3::new(0.3, -1.1, 0.4));
        let b = Attitude::exp(&Vector3::new(-0.8, 0.2, 2.0));
        let v = Vector3::new(1.0, 2.0, -3.0);
        let both = a.then(&b).into_reference(&v);
        assert!((both - a.into_reference(&b.into_reference(&v))).norm() < 1e-14);
    }

    #[test]
    fn the_derivative_at_zero_rotation_is_half_the_direction() {
        let phi = Vector3::new(variable(0.0, 0), variable(0.0, 1), variable(0.0, 2));
        let q = Attitude::exp(&phi);
        for k in 0..3 {
            let mut half = [0.0; solver::LANES];
            half[k] = 0.5;
            assert_eq!(derivatives(&q.v[k]), half);
        }
        assert_eq!(derivatives(&q.w), [0.0; solver::LANES]);
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let square = SERIES * 0.999_999_f64;
        let (cos, sinc) = cos_sinc(square);
        let angle = square.sqrt();
        assert!((cos - angle.cos()).abs() < 2e-16);
        assert!((sinc - angle.sin() / angle).abs() < 2e-16);
    }
}
