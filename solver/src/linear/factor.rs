//! Questions that every way to solve the damped linear problem answers.

/// A factorisation that solves damped linear least squares for many dampings and right sides.
pub trait Factor {
    /// `argmin ‖J p + b‖² + λ ‖D p‖²`; `None` where that is not finite.
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>>;

    /// `argmin ‖J p + b‖²`, of minimum `‖D p‖` where the rank is short.
    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>>;

    /// Length of the part of `b` in the column space of `J`.
    fn tangential(&self, b: &[f64]) -> f64;
}
