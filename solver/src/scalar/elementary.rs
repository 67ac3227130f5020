//! Functions of scalars with the derivatives they have at corners and poles.

use crate::scalar::Scalar;

/// `abs`, `min`, `max`, `clamp`, `atan2` and `hypot` of every [`Scalar`]; to be imported where they are used.
///
/// At a corner the derivative is that of one side: a solver needs a number, not the lack of one.
///
/// ```
/// use stillpoint_solver::{Elementary, Jet, scalar::{derivatives, variable}};
/// let y = variable(1.0, 0);
/// let x = Jet::from(0.0); // where y / x is infinite
/// assert_eq!(y.atan2(x).re, std::f64::consts::FRAC_PI_2);
/// assert_eq!(derivatives(&y.atan2(x))[0], 0.0);
/// ```
pub trait Elementary: Scalar {
    /// `|x|`, with derivative 1 at 0.
    fn abs(self) -> Self {
        if self.re() < 0.0 { -self } else { self }
    }

    /// The smaller; this one where they are equal.
    fn min(self, other: Self) -> Self {
        if other.re() < self.re() { other } else { self }
    }

    /// The larger; this one where they are equal.
    fn max(self, other: Self) -> Self {
        if other.re() > self.re() { other } else { self }
    }

    /// Held between two numbers.
    fn clamp(self, lower: f64, upper: f64) -> Self {
        Elementary::min(Elementary::max(self, Self::from(lower)), Self::from(upper))
    }

    /// The angle of the point (`x`, this) from the x axis, in (−π, π], smooth across the y axis.
    fn atan2(self, x: Self) -> Self {
        let value = self.re().atan2(x.re());
        let slopes = if x.re().abs() >= self.re().abs() {
            (self / x).atan()
        } else {
            -(x / self).atan()
        };
        // The branch shifts the angle by a constant, which has no derivative.
        slopes + (value - slopes.re())
    }

    /// `√(x² + y²)` without overflow, with derivative 0 at the origin.
    fn hypot(self, other: Self) -> Self {
        let size = self.re().abs().max(other.re().abs());
        if size == 0.0 || !size.is_finite() {
            return Self::from(size);
        }
        let (a, b) = (self / size, other / size);
        (a * a + b * b).sqrt() * size
    }
}

impl<D: Scalar> Elementary for D {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Jet, derivatives, variable};

    #[test]
    fn angles_have_the_derivatives_of_the_circle_all_around() {
        for k in 0..16 {
            let angle = f64::from(k) * std::f64::consts::PI / 8.0 - 3.0;
            let (y, x) = (variable(angle.sin(), 0), variable(angle.cos(), 1));
            let found: Jet = Elementary::atan2(y, x);
            let [by_y, by_x, ..] = derivatives(&found);
            // ∂θ/∂y = x, ∂θ/∂x = −y on the unit circle.
            assert!((found.re - angle).abs() < 1e-15, "{angle}");
            assert!((by_y - angle.cos()).abs() < 1e-15, "{angle}");
            assert!((by_x + angle.sin()).abs() < 1e-15, "{angle}");
        }
    }

    #[test]
    fn corners_take_one_side() {
        let x = variable(0.0, 0);
        assert_eq!(derivatives(&Elementary::abs(x))[0], 1.0);
        assert_eq!(derivatives(&Elementary::max(x, Jet::from(0.0)))[0], 1.0);
        assert_eq!(
            derivatives(&Elementary::clamp(variable(2.0, 0), 0.0, 1.0))[0],
            0.0
        );
        let far = Elementary::hypot(variable(3e200, 0), Jet::from(4e200));
        assert!((far.re / 5e200 - 1.0).abs() < 1e-15);
        assert_eq!(derivatives(&Elementary::hypot(x, x))[0], 0.0);
    }
}
