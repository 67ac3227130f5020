//! The functions of the angle that a rotation by `exp(φ)` needs, as power series in `θ² = |φ|²`.
//!
//! | symbol | closed form | series |
//! |---|---|---|
//! | `S` | `sin θ / θ` | `1 − θ²/3! + θ⁴/5! − …` |
//! | `C` | `(1 − cos θ) / θ²` | `1/2! − θ²/4! + θ⁴/6! − …` |
//! | `D` | `(θ − sin θ) / θ³` | `1/3! − θ²/5! + θ⁴/7! − …` |
//!
//! The series have no branch at zero and need no root. How many terms are wanted is known before
//! the turns are looked at, from the longest step.

use pulp::Simd;

use super::lanes::{minus, plus};

/// Terms of the series, and the largest `θ²` for which what is left out is below the last digit: the
/// first term left out of `C` is `θ²ᴺ / (2N + 2)!`.
const TERMS: [(usize, f64); 3] = [(5, 0.03), (7, 0.25), (12, 4.0)];

/// Number of terms that the longest step of a recording needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Degree {
    /// Steps up to 0.17 rad: hand motion at 100 Hz.
    Short,
    /// Steps up to half a radian.
    Medium,
    /// Steps up to two radians.
    Long,
}

/// Terms for [`Degree::Short`].
pub(super) const SHORT: usize = TERMS[0].0;
/// Terms for [`Degree::Medium`].
pub(super) const MEDIUM: usize = TERMS[1].0;
/// Terms for [`Degree::Long`].
pub(super) const LONG: usize = TERMS[2].0;

impl Degree {
    /// For steps whose angle is at most `angle` (rad); `None` beyond two radians, and where the angle
    /// is not a number.
    pub fn for_angle(angle: f64) -> Option<Self> {
        let square = angle * angle;
        [Self::Short, Self::Medium, Self::Long]
            .into_iter()
            .zip(TERMS)
            .find_map(|(degree, (_, limit))| (square <= limit).then_some(degree))
    }
}

/// The coefficients of `Σ (−1)ⁿ xⁿ / (2n + first)!`.
const fn coefficients<const N: usize>(first: usize) -> [f64; N] {
    let mut all = [0.0; N];
    let mut factorial = 1.0;
    let mut k = 2;
    while k <= first {
        factorial *= k as f64;
        k += 1;
    }
    let mut sign = 1.0;
    let mut n = 0;
    while n < N {
        all[n] = sign / factorial;
        sign = -sign;
        factorial *= ((2 * n + first + 1) * (2 * n + first + 2)) as f64;
        n += 1;
    }
    all
}

/// The series with `N` terms.
pub(super) struct Series<const N: usize>;

impl<const N: usize> Series<N> {
    /// Coefficients of `C`, the constant first.
    pub const C: [f64; N] = coefficients(2);
    /// Coefficients of `D`, the constant first.
    pub const D: [f64; N] = coefficients(3);

    /// `S = 1 − θ² D`: one term more than `C` has, as it multiplies `φ` and `C` the square.
    #[inline(always)]
    pub fn s<S: Simd>(simd: S, square: S::f64s) -> S::f64s {
        minus(simd, simd.splat_f64s(1.0), square, Self::d(simd, square))
    }

    /// `C`.
    #[inline(always)]
    pub fn c<S: Simd>(simd: S, square: S::f64s) -> S::f64s {
        horner(simd, square, &Self::C)
    }

    /// `D`.
    #[inline(always)]
    pub fn d<S: Simd>(simd: S, square: S::f64s) -> S::f64s {
        horner(simd, square, &Self::D)
    }
}

#[inline(always)]
fn horner<S: Simd, const N: usize>(simd: S, x: S::f64s, coefficients: &[f64; N]) -> S::f64s {
    let mut sum = simd.splat_f64s(coefficients[N - 1]);
    for &coefficient in coefficients[..N - 1].iter().rev() {
        sum = plus(simd, simd.splat_f64s(coefficient), sum, x);
    }
    sum
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;

    /// The closed forms, which lose digits below a tenth of a radian.
    fn closed(angle: f64) -> [f64; 3] {
        let square = angle * angle;
        [
            angle.sin() / angle,
            2.0 * (0.5 * angle).sin().powi(2) / square,
            (angle - angle.sin()) / (angle * square),
        ]
    }

    fn series<const N: usize>(angle: f64) -> [f64; 3] {
        let x = angle * angle;
        [
            Series::<N>::s(Scalar, x),
            Series::<N>::c(Scalar, x),
            Series::<N>::d(Scalar, x),
        ]
    }

    fn assert_close(a: [f64; 3], b: [f64; 3], tolerance: [f64; 3]) {
        for k in 0..3 {
            assert!((a[k] - b[k]).abs() < tolerance[k], "{a:?} {b:?}");
        }
    }

    /// `D` by its closed form loses `1/θ²` of its digits.
    #[test]
    fn the_series_meet_the_closed_forms_at_the_longest_step_of_their_degree() {
        let digits = 1e-15;
        assert_close(series::<SHORT>(0.17), closed(0.17), [digits, digits, 1e-13]);
        assert_close(series::<MEDIUM>(0.5), closed(0.5), [digits, digits, 1e-14]);
        assert_close(series::<LONG>(2.0), closed(2.0), [digits; 3]);
    }

    #[test]
    fn a_step_too_long_or_not_a_number_has_no_degree() {
        assert_eq!(Degree::for_angle(0.17), Some(Degree::Short));
        assert_eq!(Degree::for_angle(1.9), Some(Degree::Long));
        assert_eq!(Degree::for_angle(2.1), None);
        assert_eq!(Degree::for_angle(f64::NAN), None);
    }
}
