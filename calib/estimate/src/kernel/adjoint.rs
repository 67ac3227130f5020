//! Derivatives of the gravity after a turn by a small rotation in each of its steps.

use nalgebra::Vector3;
use pulp::{Arch, Simd, WithSimd};

use super::affine::{Affine, Lanes, records};
use super::lanes::{Vector, WIDTH, vector};
use super::packed::Group;
use super::rotate::turn_frame;
use super::series::{Degree, LONG, MEDIUM, SHORT};

/// The two adjoint vectors of a turn.
#[derive(Clone, Debug)]
pub(super) struct Adjoints {
    /// The frame after the turn.
    pub frame: [Vector3<f64>; 2],
    /// `b` of each step: what the two gradients gain per radian of rotation in it.
    steps: Vec<[Vector3<f64>; 2]>,
}

impl Adjoints {
    /// Returns the derivatives of the two gradients by the rate at a sample, per rad/s, which has a half of the step before
    /// it and of the one after it.
    pub fn of_sample(&self, t: &[f64], sample: usize) -> [Vector3<f64>; 2] {
        let mut sum = [Vector3::zeros(); 2];
        let before = sample.checked_sub(1);
        for step in before.into_iter().chain([sample]) {
            let (Some(b), Some([from, to])) = (self.steps.get(step), t.get(step..step + 2)) else {
                continue;
            };
            let half = 0.5 * (to - from);
            for k in 0..2 {
                sum[k] += b[k] * half;
            }
        }
        sum
    }
}

/// The adjoint vectors of the turns of a group.
pub(super) fn adjoints(
    group: &Group,
    affine: &Affine<'_>,
    degree: Degree,
) -> Vec<(usize, Adjoints)> {
    let count = group.samples() / WIDTH;
    let mut out = vec![0.0; 6 * WIDTH * (count + 1)];
    let arch = Arch::new();
    let all = &mut out;
    match degree {
        Degree::Short => arch.dispatch(Kernel::<SHORT> {
            group,
            affine,
            out: all,
        }),
        Degree::Medium => arch.dispatch(Kernel::<MEDIUM> {
            group,
            affine,
            out: all,
        }),
        Degree::Long => arch.dispatch(Kernel::<LONG> {
            group,
            affine,
            out: all,
        }),
    }
    let pair = |record: &[f64], lane: usize| {
        [0, 3].map(|from| Vector3::from_fn(|i, _| record[(from + i) * WIDTH + lane]))
    };
    let lanes = group.turns.iter().enumerate();
    lanes
        .map(|(lane, &turn)| {
            let mut records = out.chunks_exact(6 * WIDTH).map(|record| pair(record, lane));
            let frame = records.next().unwrap_or_default();
            let steps = records.collect();
            (turn, Adjoints { frame, steps })
        })
        .collect()
}

/// Writes the frame after the turn, then `b` of each step (6 each).
struct Kernel<'a, const N: usize> {
    group: &'a Group,
    affine: &'a Affine<'a>,
    out: &'a mut [f64],
}

impl<const N: usize> WithSimd for Kernel<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let parts = WIDTH / S::F64_LANES;
        let sensor = Lanes::new(simd, self.affine);
        let (starts, _) = S::as_simd_f64s(&self.group.starts);
        let (out, _) = S::as_mut_simd_f64s(self.out);
        let (frame, steps) = out.split_at_mut(6 * parts);
        for part in 0..parts {
            let mut a = [vector::<S>(starts, 3, part), vector::<S>(starts, 6, part)];
            let steps = steps.chunks_exact_mut(6 * parts);
            for (record, out) in records::<S>(self.group).zip(steps) {
                let step = sensor.step(simd, record, part);
                let b = turn_frame::<S, N>(simd, &mut a, &step.rotation);
                store::<S>(&b, out, part);
            }
            store::<S>(&a, frame, part);
        }
    }
}

#[inline(always)]
fn store<S: Simd>(pair: &[Vector<S>; 2], out: &mut [S::f64s], part: usize) {
    let parts = WIDTH / S::F64_LANES;
    for (field, value) in pair.iter().flatten().enumerate() {
        out[field * parts + part] = *value;
    }
}
