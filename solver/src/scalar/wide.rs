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
