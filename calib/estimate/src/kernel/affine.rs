//! A sensor that is affine in features of the sample: `ω = T (x − b) − F p`.

use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use sensor::{BASE_PARAMETERS, Base};

use super::features::Features;
use super::lanes::{Vector, WIDTH, add_scaled, dot, minus, plus, splat, vector};
use super::packed::{Bounds, Group, PLAIN_FIELDS};
use super::rotate::{turn_frame, turn_vector};
use super::series::{Degree, LONG, MEDIUM, SHORT};

/// The parameters of an affine sensor, as the kernels want them.
#[derive(Clone, Debug)]
pub(super) struct Affine<'a> {
    pub base: Base<f64>,
    /// Parameters of the effects.
    pub effects: &'a [f64],
    pub features: &'a Features,
}

impl<'a> Affine<'a> {
    /// From the parameters of the model.
    pub fn new(x: &'a [f64], features: &'a Features) -> Self {
        Self {
            base: Base::from_parameters(x),
            effects: &x[BASE_PARAMETERS..],
            features,
        }
    }

    /// The longest rotation of a step within `bounds`, rad.
    pub fn longest_step(&self, bounds: &Bounds) -> f64 {
        let reading = bounds.reading + bounds.time * self.base.bias.norm();
        let base = stretch(&self.base.t) * reading;
        let entries = self.features.entries().iter().zip(&bounds.features);
        base + entries
            .map(|(entry, bound)| self.effects[entry.parameter].abs() * bound)
            .sum::<f64>()
    }

    /// Rows of `T`.
    fn rows(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| self.base.t[(i, j)]))
    }
}

/// No vector grows by more than `√(‖T‖₁ ‖T‖_∞)`, by Hölder's inequality for matrix norms.
fn stretch(t: &Matrix3<f64>) -> f64 {
    let sizes = t.abs();
    let columns = sizes.row_sum().max();
    let rows = sizes.column_sum().max();
    if sizes.iter().all(|v| v.is_finite()) {
        (columns * rows).sqrt()
    } else {
        f64::NAN
    }
}

/// A sensor's parameters in every lane.
pub(super) struct Lanes<'a, S: Simd> {
    t: [Vector<S>; 3],
    pub bias: Vector<S>,
    affine: &'a Affine<'a>,
}

/// One step of all lanes: `ρ = ψ − Δt b`, `Δt` and `φ = T ρ − Ψ p`.
pub(super) struct Step<S: Simd> {
    pub reading: Vector<S>,
    pub time: S::f64s,
    pub rotation: Vector<S>,
}

impl<'a, S: Simd> Lanes<'a, S> {
    /// Spreads the parameters.
    #[inline(always)]
    pub fn new(simd: S, affine: &'a Affine<'a>) -> Self {
        Self {
            t: affine.rows().map(|row| splat(simd, row)),
            bias: splat(simd, affine.base.bias.into()),
            affine,
        }
    }

    /// A step of every turn.
    #[inline(always)]
    pub fn step(&self, simd: S, record: &[S::f64s], part: usize) -> Step<S> {
        let parts = WIDTH / S::F64_LANES;
        let raw = vector::<S>(record, 0, part);
        let time = record[3 * parts + part];
        let reading = [
            minus(simd, raw[0], time, self.bias[0]),
            minus(simd, raw[1], time, self.bias[1]),
            minus(simd, raw[2], time, self.bias[2]),
        ];
        let rotation = self.turned(simd, &reading);
        Step {
            rotation: self.without_features(simd, rotation, record, part),
            reading,
            time,
        }
    }

    /// `T v`.
    #[inline(always)]
    pub fn turned(&self, simd: S, v: &Vector<S>) -> Vector<S> {
        [
            dot(simd, &self.t[0], v),
            dot(simd, &self.t[1], v),
            dot(simd, &self.t[2], v),
        ]
    }

    /// `v − Ψ p`.
    #[inline(always)]
    pub fn without_features(
        &self,
        simd: S,
        mut v: Vector<S>,
        record: &[S::f64s],
        part: usize,
    ) -> Vector<S> {
        let parts = WIDTH / S::F64_LANES;
        let features = record[PLAIN_FIELDS * parts..].chunks_exact(parts);
        for (entry, value) in self.affine.features.entries().iter().zip(features) {
            let coefficient = simd.splat_f64s(self.affine.effects[entry.parameter]);
            v[entry.axis] = minus(simd, v[entry.axis], coefficient, value[part]);
        }
        v
    }
}

/// The records of a group, step by step.
#[inline(always)]
pub(super) fn records<S: Simd>(group: &Group) -> std::slice::ChunksExact<'_, S::f64s> {
    let (steps, _) = S::as_simd_f64s(&group.steps);
    steps.chunks_exact(group.fields * WIDTH / S::F64_LANES)
}

/// Gravity after each turn of a group (`3 × WIDTH`, turn by turn).
pub(super) fn propagate(group: &Group, affine: &Affine<'_>, degree: Degree, out: &mut [f64]) {
    let arch = Arch::new();
    match degree {
        Degree::Short => arch.dispatch(Propagate::<SHORT> { group, affine, out }),
        Degree::Medium => arch.dispatch(Propagate::<MEDIUM> { group, affine, out }),
        Degree::Long => arch.dispatch(Propagate::<LONG> { group, affine, out }),
    }
}

struct Propagate<'a, const N: usize> {
    group: &'a Group,
    affine: &'a Affine<'a>,
    out: &'a mut [f64],
}

impl<const N: usize> WithSimd for Propagate<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let parts = WIDTH / S::F64_LANES;
        let sensor = Lanes::new(simd, self.affine);
        let (starts, _) = S::as_simd_f64s(&self.group.starts);
        let (out, _) = S::as_mut_simd_f64s(self.out);
        for part in 0..parts {
            let mut u = vector::<S>(starts, 0, part);
            for record in records::<S>(self.group) {
                let step = sensor.step(simd, record, part);
                u = turn_vector::<S, N>(simd, &u, &step.rotation);
            }
            for i in 0..3 {
                out[i * parts + part] = u[i];
            }
        }
    }
}

/// Fields of a vector of the frame in [`differentiate`]'s output before those of the features: the
/// vector (3), `Σ b ⊗ ρ` row by row (9), `Σ Δt b` (3).
pub(super) const FRAME_FIELDS: usize = 15;

/// The frame after each turn of a group and the sums its derivative is made of: for each of the two
/// vectors [`FRAME_FIELDS`], then `Σ bᵢ Ψ` of every feature; turn by turn.
pub(super) fn differentiate(group: &Group, affine: &Affine<'_>, degree: Degree, out: &mut [f64]) {
    let arch = Arch::new();
    match degree {
        Degree::Short => arch.dispatch(Differentiate::<SHORT> { group, affine, out }),
        Degree::Medium => arch.dispatch(Differentiate::<MEDIUM> { group, affine, out }),
        Degree::Long => arch.dispatch(Differentiate::<LONG> { group, affine, out }),
    }
}

struct Differentiate<'a, const N: usize> {
    group: &'a Group,
    affine: &'a Affine<'a>,
    out: &'a mut [f64],
}

impl<const N: usize> WithSimd for Differentiate<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let parts = WIDTH / S::F64_LANES;
        let sensor = Lanes::new(simd, self.affine);
        let entries = self.affine.features.entries();
        let (starts, _) = S::as_simd_f64s(&self.group.starts);
        let (out, _) = S::as_mut_simd_f64s(self.out);
        let (first, second) = out.split_at_mut(parts * (FRAME_FIELDS + entries.len()));
        let frames = [first, second];
        let zero = simd.splat_f64s(0.0);
        for part in 0..parts {
            let mut a = [vector::<S>(starts, 3, part), vector::<S>(starts, 6, part)];
            let mut by_reading = [[[zero; 3]; 3]; 2];
            let mut by_time = [[zero; 3]; 2];
            for record in records::<S>(self.group) {
                let step = sensor.step(simd, record, part);
                let b = turn_frame::<S, N>(simd, &mut a, &step.rotation);
                let integrals = record[PLAIN_FIELDS * parts..].chunks_exact(parts);
                for k in 0..2 {
                    by_time[k] = add_scaled(simd, &by_time[k], step.time, &b[k]);
                    for i in 0..3 {
                        let sum = &mut by_reading[k][i];
                        *sum = add_scaled(simd, sum, b[k][i], &step.reading);
                    }
                }
                for (n, (entry, value)) in entries.iter().zip(integrals).enumerate() {
                    let field = (FRAME_FIELDS + n) * parts + part;
                    for k in 0..2 {
                        frames[k][field] =
                            plus(simd, frames[k][field], b[k][entry.axis], value[part]);
                    }
                }
            }
            for k in 0..2 {
                let sums = by_reading[k].iter().flatten();
                let fields = a[k].iter().chain(sums).chain(&by_time[k]);
                for (field, value) in fields.enumerate() {
                    frames[k][field * parts + part] = *value;
                }
            }
        }
    }
}
