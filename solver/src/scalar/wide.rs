//! Dual numbers of many lanes, on which the factors of a graph are evaluated.

use std::cmp::Ordering;
use std::fmt;

/// A value with `N` first derivatives: what the factors of a graph are evaluated on.
///
/// All lanes are always there, so that the operations on them fill vectors without a branch; they
/// are inlined, so that they take the vector instructions of the function they stand in. The dual
/// numbers of num-dual ask in every operation whether there are derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Wide<const N: usize> {
    /// The value.
    pub re: f64,
    /// Its derivatives.
    pub slopes: [f64; N],
}

impl<const N: usize> Wide<N> {
    /// A constant.
    #[inline(always)]
    pub const fn constant(re: f64) -> Self {
        Self {
            re,
            slopes: [0.0; N],
        }
    }

    /// A function's value here, given its derivative. A lane without derivative has none after it,
    /// wherever the function is infinitely steep: `√(0²)` of what is held.
    #[inline(always)]
    pub(super) fn chain(&self, re: f64, slope: f64) -> Self {
        if !slope.is_finite() {
            return self.chain_steep(re, slope);
        }
        let mut slopes = self.slopes;
        for own in &mut slopes {
            *own *= slope;
        }
        Self { re, slopes }
    }

    #[cold]
    fn chain_steep(&self, re: f64, slope: f64) -> Self {
        let slopes = self.slopes.map(|own| match own {
            0.0 => 0.0,
            own => own * slope,
        });
        Self { re, slopes }
    }
}

impl<const N: usize> From<f64> for Wide<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::constant(value)
    }
}

impl<const N: usize> fmt::Display for Wide<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} + {:?}ε", self.re, self.slopes)
    }
}

/// By value, as all comparisons.
impl<const N: usize> PartialEq for Wide<N> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.re == other.re
    }
}

impl<const N: usize> PartialEq<f64> for Wide<N> {
    #[inline(always)]
    fn eq(&self, other: &f64) -> bool {
        self.re == *other
    }
}

impl<const N: usize> PartialOrd for Wide<N> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.re.partial_cmp(&other.re)
    }
}

impl<const N: usize> PartialOrd<f64> for Wide<N> {
    #[inline(always)]
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.re.partial_cmp(other)
    }
}

#[cfg(test)]
mod tests {
    use num_dual::{Derivative, DualNum, DualSVec64};

    use super::*;
    use crate::scalar::Scalar;

    /// Every function of a scalar, at `x` (in (0, 1)) and `y`.
    fn all<D: Scalar>(x: D, y: D) -> Vec<D> {
        let sum: D = [x, y, x].into_iter().sum();
        let product: D = [x, y, x].into_iter().product();
        let mut changed = x;
        changed += y;
        changed *= y;
        changed -= x;
        changed /= y;
        changed += 2.0;
        changed *= 3.0;
        changed -= 0.5;
        changed /= 7.0;
        let (sine, cosine) = x.sin_cos();
        vec![
            x + y,
            x - y,
            x * y,
            x / y,
            x + 2.0,
            x - 2.0,
            x * 2.0,
            x / 2.0,
            -x,
            sum,
            product,
            changed,
            sine,
            cosine,
            x.recip(),
            x.powi(-3),
            x.powi(0),
            x.powi(1),
            x.powi(2),
            x.powi(5),
            x.powf(2.5),
            x.powf(0.0),
            x.powf(1.0),
            x.powf(2.0),
            x.powd(y),
            x.sqrt(),
            x.cbrt(),
            x.exp(),
            x.exp2(),
            x.exp_m1(),
            x.ln(),
            x.log(3.0),
            x.log2(),
            x.log10(),
            x.ln_1p(),
            x.sin(),
            x.cos(),
            x.tan(),
            x.asin(),
            x.acos(),
            x.atan(),
            DualNum::atan2(&x, y),
            x.sinh(),
            x.cosh(),
            x.tanh(),
            x.asinh(),
            (x + 1.0).acosh(),
            x.atanh(),
            x.sph_j0(),
            x.sph_j1(),
            x.sph_j2(),
            x.mul_add(y, x),
            num_traits::Signed::abs(&-x),
            num_traits::Signed::signum(&-x),
            num_traits::Signed::abs_sub(&x, &y),
        ]
    }

    #[test]
    fn every_function_is_that_of_num_dual() {
        for (x, y) in [(0.3, 1.7), (0.8, -0.4), (0.05, 0.02)] {
            let wide = |re, slopes| Wide::<2> { re, slopes };
            let known = |re, slopes: [f64; 2]| {
                DualSVec64::<2>::new(re, Derivative::some(slopes.into()))
            };
            let found = all(wide(x, [1.0, 0.25]), wide(y, [-0.5, 1.0]));
            let wanted = all(known(x, [1.0, 0.25]), known(y, [-0.5, 1.0]));
            for (k, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                let slopes = wanted.eps.0.map_or([0.0; 2], Into::into);
                let pairs = [(found.re, wanted.re)].into_iter();
                for (a, b) in pairs.chain(found.slopes.into_iter().zip(slopes)) {
                    let near = (a - b).abs() <= 1e-12 * (1.0 + b.abs());
                    assert!(near || a.is_nan() && b.is_nan(), "{k}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn what_is_held_has_no_derivative_where_a_function_is_steep() {
        let x = Wide::<2> {
            re: 0.0,
            slopes: [0.0, 1.0],
        };
        assert_eq!(x.sqrt().slopes, [0.0, f64::INFINITY]);
    }
}
