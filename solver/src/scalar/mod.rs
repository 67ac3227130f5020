//! The scalars a residual is evaluated on: the only place that names num-dual.

pub(crate) mod elementary;

use num_dual::{Derivative, Dual2_64, DualSVec64};

mod functions;
mod operators;
mod wide;

pub use wide::Wide;

/// The functions of a [`Scalar`]; to be imported where a closure over [`Jet`] calls `exp` or `sqrt`.
pub use num_dual::DualNum;

/// `f64`, [`Jet`], [`Jet2`] or [`Wide`]: the number a residual or a sensor model is written over.
///
/// The usual operators and `sqrt`, `exp`, `ln`, `sin`, `powi` … are there. Write constants with
/// [`lit`] or on the right (`x * 2.0`).
pub trait Scalar: DualNum<Primitive = f64> + Copy + Send + Sync {}
impl<T: DualNum<Primitive = f64> + Copy + Send + Sync> Scalar for T {}

/// Derivatives carried by one [`Jet`]; a Jacobian of `n` columns takes `⌈n / LANES⌉` passes.
pub const LANES: usize = 4;

/// A value with [`LANES`] first derivatives.
pub type Jet = DualSVec64<LANES>;

/// A value with its first and second derivative along one direction.
pub type Jet2 = Dual2_64;

/// A constant.
pub fn lit<D: Scalar>(value: f64) -> D {
    D::from(value)
}

/// A variable: `value` with derivative 1 in `lane`.
pub fn variable(value: f64, lane: usize) -> Jet {
    Jet::from_re(value).derivative(lane)
}

/// The derivatives of a [`Jet`], zero where it carries none.
pub fn derivatives(x: &Jet) -> [f64; LANES] {
    match x.eps.0 {
        Some(column) => column.into(),
        None => [0.0; LANES],
    }
}

/// A [`Jet`] from its value and derivatives.
pub fn jet(value: f64, derivatives: [f64; LANES]) -> Jet {
    Jet::new(value, Derivative::some(derivatives.into()))
}

/// The point `value + t·direction` at `t = 0`.
pub fn along(value: f64, direction: f64) -> Jet2 {
    Jet2::new(value, direction, 0.0)
}

/// The second derivative along the direction.
pub fn second_derivative(x: &Jet2) -> f64 {
    x.v2
}
