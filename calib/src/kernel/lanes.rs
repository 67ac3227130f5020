//! Vectors of three whose components are registers: as many turns side by side as one holds.

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
    let component = |i: usize, j: usize| minus(simd, simd.mul_f64s(a[i], b[j]), a[j], b[i]);
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// `c − a × b`.
#[inline(always)]
pub(super) fn minus_cross<S: Simd>(
    simd: S,
    c: &Vector<S>,
    a: &Vector<S>,
    b: &Vector<S>,
) -> Vector<S> {
    let component =
        |k: usize, i: usize, j: usize| plus(simd, minus(simd, c[k], a[i], b[j]), a[j], b[i]);
    [component(0, 1, 2), component(1, 2, 0), component(2, 0, 1)]
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
    v.map(|x| simd.splat_f64s(x))
}

/// The vector at `fields`, `fields + 1`, `fields + 2` of a record of `WIDTH` turns, for the register
/// `part` of each field.
#[inline(always)]
pub(super) fn vector<S: Simd>(record: &[S::f64s], field: usize, part: usize) -> Vector<S> {
    let parts = WIDTH / S::F64_LANES;
    std::array::from_fn(|i| record[(field + i) * parts + part])
}
