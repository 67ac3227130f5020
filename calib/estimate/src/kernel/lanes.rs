//! Vectors of three whose components are registers: as many turns side by side as one holds.
//!
//! Everything here and in the loops over the steps is an `#[inline(always)]` function: only what ends up
//! inside the function that the instruction set is chosen for is compiled for it. A closure may not be,
//! and then every instruction becomes a call, thirty times slower.

use pulp::Simd;

/// Turns that lie side by side in the packed samples: the doubles of an AVX2 register. Machines with
/// narrower ones take several goes.
pub(super) const WIDTH: usize = 4;

/// A vector of three in every lane.
pub(super) type Vector<S> = [<S as Simd>::f64s; 3];

/// `x + y·z`, fused where the machine does it.
#[inline(always)]
pub(super) fn plus<S: Simd>(simd: S, x: S::f64s, y: S::f64s, z: S::f64s) -> S::f64s {
    simd.mul_add_e_f64s(y, z, x)
}

/// `x − y·z`, fused where the machine does it.
#[inline(always)]
pub(super) fn minus<S: Simd>(simd: S, x: S::f64s, y: S::f64s, z: S::f64s) -> S::f64s {
    simd.negate_mul_add_e_f64s(y, z, x)
}

/// `a · b`.
#[inline(always)]
pub(super) fn dot<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>) -> S::f64s {
    plus(
        simd,
        plus(simd, simd.mul_f64s(a[0], b[0]), a[1], b[1]),
        a[2],
        b[2],
    )
}

/// `a × b`.
#[inline(always)]
pub(super) fn cross<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [
        minus(simd, simd.mul_f64s(a[1], b[2]), a[2], b[1]),
        minus(simd, simd.mul_f64s(a[2], b[0]), a[0], b[2]),
        minus(simd, simd.mul_f64s(a[0], b[1]), a[1], b[0]),
    ]
}

/// `c − a × b`.
#[inline(always)]
pub(super) fn minus_cross<S: Simd>(
    simd: S,
    c: &Vector<S>,
    a: &Vector<S>,
    b: &Vector<S>,
) -> Vector<S> {
    [
        plus(simd, minus(simd, c[0], a[1], b[2]), a[2], b[1]),
        plus(simd, minus(simd, c[1], a[2], b[0]), a[0], b[2]),
        plus(simd, minus(simd, c[2], a[0], b[1]), a[1], b[0]),
    ]
}

/// `a + s b`.
#[inline(always)]
pub(super) fn add_scaled<S: Simd>(simd: S, a: &Vector<S>, s: S::f64s, b: &Vector<S>) -> Vector<S> {
    [
        plus(simd, a[0], s, b[0]),
        plus(simd, a[1], s, b[1]),
        plus(simd, a[2], s, b[2]),
    ]
}

/// The same vector in every lane.
#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, v: [f64; 3]) -> Vector<S> {
    [
        simd.splat_f64s(v[0]),
        simd.splat_f64s(v[1]),
        simd.splat_f64s(v[2]),
    ]
}

/// The vector at `field`, `field + 1`, `field + 2` of a record of `WIDTH` turns, for the register
/// `part` of each field.
#[inline(always)]
pub(super) fn vector<S: Simd>(record: &[S::f64s], field: usize, part: usize) -> Vector<S> {
    let parts = WIDTH / S::F64_LANES;
    [
        record[field * parts + part],
        record[(field + 1) * parts + part],
        record[(field + 2) * parts + part],
    ]
}
