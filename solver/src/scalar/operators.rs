//! Arithmetic of [`Wide`] numbers.

use std::iter::{Product, Sum};
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_traits::{FromPrimitive, Inv, Num, One, Signed, Zero};

use super::wide::Wide;

impl<const N: usize> Add for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for k in 0..N {
            self.slopes[k] += other.slopes[k];
        }
        self.re += other.re;
        self
    }
}

impl<const N: usize> Sub for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for k in 0..N {
            self.slopes[k] -= other.slopes[k];
        }
        self.re -= other.re;
        self
    }
}

impl<const N: usize> Mul for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, other: Self) -> Self {
        for k in 0..N {
            self.slopes[k] = self.slopes[k] * other.re + other.slopes[k] * self.re;
        }
        self.re *= other.re;
        self
    }
}

impl<const N: usize> Div for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn div(mut self, other: Self) -> Self {
        let inverse = 1.0 / other.re;
        let re = self.re / other.re;
        for k in 0..N {
            self.slopes[k] = (self.slopes[k] - other.slopes[k] * re) * inverse;
        }
        self.re = re;
        self
    }
}

/// The remainder; its slope is that of the dividend less whole multiples of the divisor's.
impl<const N: usize> Rem for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn rem(self, other: Self) -> Self {
        self - other * (self.re / other.re).trunc()
    }
}

impl<const N: usize> Add<f64> for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: f64) -> Self {
        self.re += other;
        self
    }
}

impl<const N: usize> Sub<f64> for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: f64) -> Self {
        self.re -= other;
        self
    }
}

impl<const N: usize> Mul<f64> for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, other: f64) -> Self {
        for own in &mut self.slopes {
            *own *= other;
        }
        self.re *= other;
        self
    }
}

impl<const N: usize> Div<f64> for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn div(mut self, other: f64) -> Self {
        for own in &mut self.slopes {
            *own /= other;
        }
        self.re /= other;
        self
    }
}

impl<const N: usize> Rem<f64> for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn rem(mut self, other: f64) -> Self {
        self.re %= other;
        self
    }
}

impl<const N: usize> Neg for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for own in &mut self.slopes {
            *own = -*own;
        }
        self.re = -self.re;
        self
    }
}

/// The operator over references, and with assignment, from that over values.
macro_rules! derived {
    ($($operator:ident $apply:ident $assign:ident $change:ident),*) => {$(
        impl<const N: usize> $operator<&Self> for Wide<N> {
            type Output = Self;
            #[inline(always)]
            fn $apply(self, other: &Self) -> Self {
                $operator::$apply(self, *other)
            }
        }
        impl<const N: usize> $assign for Wide<N> {
            #[inline(always)]
            fn $change(&mut self, other: Self) {
                *self = $operator::$apply(*self, other);
            }
        }
        impl<const N: usize> $assign<&Self> for Wide<N> {
            #[inline(always)]
            fn $change(&mut self, other: &Self) {
                *self = $operator::$apply(*self, *other);
            }
        }
        impl<const N: usize> $assign<f64> for Wide<N> {
            #[inline(always)]
            fn $change(&mut self, other: f64) {
                *self = $operator::$apply(*self, other);
            }
        }
    )*};
}

derived!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign,
    Rem rem RemAssign rem_assign
);

impl<const N: usize> Sum for Wide<N> {
    #[inline(always)]
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::constant(0.0), Add::add)
    }
}

impl<const N: usize> Product for Wide<N> {
    #[inline(always)]
    fn product<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::constant(1.0), Mul::mul)
    }
}

impl<const N: usize> Zero for Wide<N> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0)
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.re == 0.0
    }
}

impl<const N: usize> One for Wide<N> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0)
    }
}

impl<const N: usize> Num for Wide<N> {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self::constant)
    }
}

impl<const N: usize> Inv for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn inv(self) -> Self {
        let inverse = 1.0 / self.re;
        self.chain(inverse, -inverse * inverse)
    }
}

impl<const N: usize> Signed for Wide<N> {
    #[inline(always)]
    fn abs(&self) -> Self {
        if self.re > 0.0 { *self } else { -*self }
    }
    #[inline(always)]
    fn abs_sub(&self, other: &Self) -> Self {
        if self.re > other.re {
            *self - *other
        } else {
            Self::constant(0.0)
        }
    }
    #[inline(always)]
    fn signum(&self) -> Self {
        Self::constant(Signed::signum(&self.re))
    }
    #[inline(always)]
    fn is_positive(&self) -> bool {
        self.re > 0.0
    }
    #[inline(always)]
    fn is_negative(&self) -> bool {
        self.re < 0.0
    }
}

impl<const N: usize> FromPrimitive for Wide<N> {
    fn from_i64(n: i64) -> Option<Self> {
        f64::from_i64(n).map(Self::constant)
    }
    fn from_u64(n: u64) -> Option<Self> {
        f64::from_u64(n).map(Self::constant)
    }
    fn from_f64(n: f64) -> Option<Self> {
        Some(Self::constant(n))
    }
}
