//! The second derivative of gravity after a turn along a direction of the parameters, by truncated
//! Taylor series `x₀ + x₁ t + x₂ t²` in every lane.

use pulp::{Arch, Simd, WithSimd};

use super::affine::{Affine, Lanes, records};
use super::lanes::{WIDTH, add_scaled, minus, plus, vector};
use super::packed::Group;
use super::series::{Degree, LONG, MEDIUM, SHORT, Series};

/// Coefficients of a truncated series.
type Taylor<S> = [<S as Simd>::f64s; 3];

/// A vector of them.
type Path<S> = [Taylor<S>; 3];

/// `d²/dt²` of gravity after each turn of a group at `affine + t · direction` (`3 × WIDTH`, turn by
/// turn).
pub(super) fn curvature(
    group: &Group,
    affine: &Affine<'_>,
    direction: &Affine<'_>,
    degree: Degree,
    out: &mut [f64],
) {
    let arch = Arch::new();
    match degree {
        Degree::Short => arch.dispatch(Kernel::<SHORT>(group, affine, direction, out)),
        Degree::Medium => arch.dispatch(Kernel::<MEDIUM>(group, affine, direction, out)),
        Degree::Long => arch.dispatch(Kernel::<LONG>(group, affine, direction, out)),
    }
}

struct Kernel<'a, const N: usize>(&'a Group, &'a Affine<'a>, &'a Affine<'a>, &'a mut [f64]);

impl<const N: usize> WithSimd for Kernel<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(group, affine, direction, out) = self;
        let parts = WIDTH / S::F64_LANES;
        let at = Lanes::new(simd, affine);
        let along = Lanes::new(simd, direction);
        let (starts, _) = S::as_simd_f64s(&group.starts);
        let (out, _) = S::as_mut_simd_f64s(out);
        let zero = simd.splat_f64s(0.0);
        for part in 0..parts {
            let start = vector::<S>(starts, 0, part);
            let mut u = [
                [start[0], zero, zero],
                [start[1], zero, zero],
                [start[2], zero, zero],
            ];
            for record in records::<S>(group) {
                let phi = rotation(simd, &at, &along, record, part);
                u = turn_path::<S, N>(simd, &u, &phi);
            }
            let twice = simd.splat_f64s(2.0);
            for i in 0..3 {
                out[i * parts + part] = simd.mul_f64s(twice, u[i][2]);
            }
        }
    }
}

/// `φ(t) = (T + t δT)(ψ − Δt (b + t δb)) − Ψ (p + t δp)`.
#[inline(always)]
fn rotation<S: Simd>(
    simd: S,
    at: &Lanes<'_, S>,
    along: &Lanes<'_, S>,
    record: &[S::f64s],
    part: usize,
) -> Path<S> {
    let step = at.step(simd, record, part);
    let zero = simd.splat_f64s(0.0);
    let back = simd.sub_f64s(zero, step.time);
    let shift = add_scaled(simd, &[zero; 3], back, &along.bias);
    let turned = along.turned(simd, &step.reading);
    let shifted = at.turned(simd, &shift);
    let first = [
        simd.add_f64s(turned[0], shifted[0]),
        simd.add_f64s(turned[1], shifted[1]),
        simd.add_f64s(turned[2], shifted[2]),
    ];
    let first = along.without_features(simd, first, record, part);
    let second = along.turned(simd, &shift);
    [
        [step.rotation[0], first[0], second[0]],
        [step.rotation[1], first[1], second[1]],
        [step.rotation[2], first[2], second[2]],
    ]
}

/// `R(φ)ᵀ u = u − S φ × u + C φ × (φ × u)`.
#[inline(always)]
fn turn_path<S: Simd, const N: usize>(simd: S, u: &Path<S>, phi: &Path<S>) -> Path<S> {
    let square = product(simd, &phi[0], &phi[0]);
    let square = add_product(simd, &square, &phi[1], &phi[1]);
    let square = add_product(simd, &square, &phi[2], &phi[2]);
    let c = horner(simd, &square, &Series::<N>::C);
    let d = horner(simd, &square, &Series::<N>::D);
    let one = constant(simd, 1.0);
    let s = subtract_product(simd, &one, &square, &d);
    let once = cross(simd, phi, u);
    let twice = cross(simd, phi, &once);
    let once = [
        subtract_product(simd, &u[0], &s, &once[0]),
        subtract_product(simd, &u[1], &s, &once[1]),
        subtract_product(simd, &u[2], &s, &once[2]),
    ];
    [
        add_product(simd, &once[0], &c, &twice[0]),
        add_product(simd, &once[1], &c, &twice[1]),
        add_product(simd, &once[2], &c, &twice[2]),
    ]
}

#[inline(always)]
fn constant<S: Simd>(simd: S, value: f64) -> Taylor<S> {
    let zero = simd.splat_f64s(0.0);
    [simd.splat_f64s(value), zero, zero]
}

#[inline(always)]
fn horner<S: Simd, const N: usize>(simd: S, x: &Taylor<S>, coefficients: &[f64; N]) -> Taylor<S> {
    let mut sum = constant(simd, coefficients[N - 1]);
    for &coefficient in coefficients[..N - 1].iter().rev() {
        sum = add_product(simd, &constant(simd, coefficient), &sum, x);
    }
    sum
}

#[inline(always)]
fn product<S: Simd>(simd: S, a: &Taylor<S>, b: &Taylor<S>) -> Taylor<S> {
    add_product(simd, &constant(simd, 0.0), a, b)
}

/// `c + a b`.
#[inline(always)]
fn add_product<S: Simd>(simd: S, c: &Taylor<S>, a: &Taylor<S>, b: &Taylor<S>) -> Taylor<S> {
    let first = plus(simd, plus(simd, c[1], a[0], b[1]), a[1], b[0]);
    let second = plus(simd, plus(simd, c[2], a[0], b[2]), a[1], b[1]);
    [
        plus(simd, c[0], a[0], b[0]),
        first,
        plus(simd, second, a[2], b[0]),
    ]
}

/// `c − a b`.
#[inline(always)]
fn subtract_product<S: Simd>(simd: S, c: &Taylor<S>, a: &Taylor<S>, b: &Taylor<S>) -> Taylor<S> {
    let first = minus(simd, minus(simd, c[1], a[0], b[1]), a[1], b[0]);
    let second = minus(simd, minus(simd, c[2], a[0], b[2]), a[1], b[1]);
    [
        minus(simd, c[0], a[0], b[0]),
        first,
        minus(simd, second, a[2], b[0]),
    ]
}

/// `a × b`.
#[inline(always)]
fn cross<S: Simd>(simd: S, a: &Path<S>, b: &Path<S>) -> Path<S> {
    [
        difference(simd, &a[1], &b[2], &a[2], &b[1]),
        difference(simd, &a[2], &b[0], &a[0], &b[2]),
        difference(simd, &a[0], &b[1], &a[1], &b[0]),
    ]
}

/// `a b − c d`.
#[inline(always)]
fn difference<S: Simd>(
    simd: S,
    a: &Taylor<S>,
    b: &Taylor<S>,
    c: &Taylor<S>,
    d: &Taylor<S>,
) -> Taylor<S> {
    subtract_product(simd, &product(simd, a, b), c, d)
}
