//! Functions of [`Wide`] numbers: `f(x + ε) = f(x) + f′(x) ε`.

use num_dual::{DualNum, DualStruct, Mappable};
use num_traits::Inv;

use super::wide::Wide;

impl<const N: usize> DualStruct for Wide<N> {
    type Real = f64;
    type Inner = f64;
    #[inline(always)]
    fn re(&self) -> f64 {
        self.re
    }
    #[inline(always)]
    fn from_inner(inner: &f64) -> Self {
        Self::constant(*inner)
    }
}

impl<const N: usize> Mappable<Self> for Wide<N> {
    type Output<O> = O;
    #[inline(always)]
    fn map_dual<M: Fn(Self) -> O, O>(self, f: M) -> O {
        f(self)
    }
}

/// Functions of one number by their value and their derivative.
macro_rules! by_derivative {
    ($($name:ident |$x:ident, $value:ident| $derivative:expr;)*) => {$(
        #[inline(always)]
        fn $name(&self) -> Self {
            let $x = self.re;
            let $value = DualNum::$name(&$x);
            self.chain($value, $derivative)
        }
    )*};
}

impl<const N: usize> DualNum for Wide<N> {
    type Primitive = f64;
    type InnerDual = f64;
    const NDERIV: usize = 1;

    #[inline(always)]
    fn from_re(re: f64) -> Self {
        Self::constant(re)
    }

    #[inline(always)]
    fn scale(self, factor: &f64) -> Self {
        self * *factor
    }

    #[inline(always)]
    fn recip(&self) -> Self {
        self.inv()
    }

    #[inline(always)]
    fn powi(&self, n: i32) -> Self {
        match n {
            0 => Self::constant(1.0),
            1 => *self,
            2 => *self * *self,
            _ => {
                let before = self.re.powi(n - 1);
                self.chain(before * self.re, f64::from(n) * before)
            }
        }
    }

    #[inline(always)]
    fn powf(&self, n: f64) -> Self {
        if n == 0.0 {
            return Self::constant(1.0);
        }
        if n == 1.0 {
            return *self;
        }
        self.chain(self.re.powf(n), n * self.re.powf(n - 1.0))
    }

    #[inline(always)]
    fn log(&self, base: f64) -> Self {
        self.chain(self.re.log(base), 1.0 / (self.re * base.ln()))
    }

    #[inline(always)]
    fn sin_cos(&self) -> (Self, Self) {
        let (sine, cosine) = self.re.sin_cos();
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }

    #[inline(always)]
    fn sin(&self) -> Self {
        let (sine, cosine) = self.re.sin_cos();
        self.chain(sine, cosine)
    }

    #[inline(always)]
    fn cos(&self) -> Self {
        let (sine, cosine) = self.re.sin_cos();
        self.chain(cosine, -sine)
    }

    #[inline(always)]
    fn atan2(&self, other: Self) -> Self {
        let square = self.re * self.re + other.re * other.re;
        let mut angle = *self * (other.re / square) - other * (self.re / square);
        angle.re = self.re.atan2(other.re);
        angle
    }

    by_derivative! {
        sqrt |_x, root| 0.5 / root;
        cbrt |_x, root| 1.0 / (3.0 * root * root);
        exp |_x, value| value;
        exp2 |_x, value| value * std::f64::consts::LN_2;
        exp_m1 |_x, value| value + 1.0;
        ln |x, _value| 1.0 / x;
        log2 |x, _value| 1.0 / (x * std::f64::consts::LN_2);
        log10 |x, _value| 1.0 / (x * std::f64::consts::LN_10);
        ln_1p |x, _value| 1.0 / (1.0 + x);
        tan |_x, value| 1.0 + value * value;
        asin |x, _value| 1.0 / (1.0 - x * x).sqrt();
        acos |x, _value| -1.0 / (1.0 - x * x).sqrt();
        atan |x, _value| 1.0 / (1.0 + x * x);
        sinh |x, _value| x.cosh();
        cosh |x, _value| x.sinh();
        tanh |_x, value| 1.0 - value * value;
        asinh |x, _value| 1.0 / (x * x + 1.0).sqrt();
        acosh |x, _value| 1.0 / (x * x - 1.0).sqrt();
        atanh |x, _value| 1.0 / (1.0 - x * x);
        sph_j0 |x, _value| -DualNum::sph_j1(&x);
        sph_j1 |x, value| if x.abs() < f64::EPSILON {
            1.0 / 3.0
        } else {
            DualNum::sph_j0(&x) - 2.0 * value / x
        };
        sph_j2 |x, value| if x.abs() < f64::EPSILON {
            2.0 * x / 15.0
        } else {
            DualNum::sph_j1(&x) - 3.0 * value / x
        };
    }
}
