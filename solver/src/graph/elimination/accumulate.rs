//! The sum of what the factors add to the normal equations.

use pulp::{Arch, Simd, WithSimd};

use super::equations::{Equations, Normal};
use super::outer::{Panel, Places, add_gradient, add_outer, add_two_rows};
use super::structure::{FIRST, NONE, Structure, pair};
use crate::graph::reweight::{cost_of, rewrite};

/// Normal equations being added up.
pub(crate) struct Sum<'a> {
    equations: &'a Equations<'a>,
    normal: &'a mut Normal,
    next_pair: usize,
    panel: Panel,
    arch: Arch,
}

impl<'a> Sum<'a> {
    /// Nothing added yet; the gradient is zero.
    pub fn new(equations: &'a Equations<'a>, normal: &'a mut Normal) -> Self {
        (normal.cost, normal.square) = (0.0, 0.0);
        Self {
            equations,
            normal,
            next_pair: 0,
            panel: Panel::default(),
            arch: Arch::new(),
        }
    }

    /// Adds the next factor, given its residuals and the free columns of its Jacobian.
    pub fn add(&mut self, factor: usize, residuals: &mut [f64], jacobian: &mut [f64]) {
        let loss = self.equations.loss_of(factor);
        self.normal.cost += cost_of(loss.as_ref(), residuals);
        let structure = self.equations.structure;
        let n = structure.free[factor] as usize;
        let width = jacobian.len() / residuals.len().max(1);
        if let Some(loss) = loss {
            rewrite(&loss, residuals, jacobian, width);
        }
        self.normal.square += residuals.iter().map(|r| r * r).sum::<f64>();
        if n == 0 {
            return;
        }
        let own = self.next_pair..self.next_pair + n * (n + 1) / 2;
        self.next_pair = own.end;
        self.arch.dispatch(Products {
            sum: self,
            pairs: &structure.pairs[own],
            factor,
            residuals,
            jacobian,
        });
    }

    /// Adds what is still collected.
    pub fn finish(&mut self) {
        let structure = self.equations.structure;
        self.panel.flush(&mut self.normal.h, structure);
    }
}

/// The products of a factor's blocks, compiled for the vector instructions that the machine has.
struct Products<'s, 'a, 'f> {
    sum: &'s mut Sum<'a>,
    pairs: &'s [u32],
    factor: usize,
    residuals: &'f [f64],
    jacobian: &'f [f64],
}

impl WithSimd for Products<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Equations {
            graph, structure, ..
        } = self.sum.equations;
        let (normal, panel) = (&mut *self.sum.normal, &mut self.sum.panel);
        let width = self.jacobian.len() / self.residuals.len().max(1);
        let n = structure.free[self.factor] as usize;
        let blocks = graph.blocks_of(self.factor);
        if let Some(pair) = Two::of(structure, blocks, self.residuals, self.jacobian) {
            pair.add(simd, normal, structure, self.pairs);
            return;
        }
        let mut first_a = 0;
        let mut place_a = 0;
        for (a, &block_a) in blocks.iter().enumerate() {
            let position_a = structure.position[block_a as usize];
            if position_a == NONE {
                continue;
            }
            let width_a = structure.width(position_a as usize);
            let gradient = &mut normal.gradient[structure.first[position_a as usize]..][..width_a];
            add_gradient(gradient, self.jacobian, self.residuals, width, first_a);
            let (mut first_b, mut place_b) = (first_a, place_a);
            for &block_b in &blocks[a..] {
                let position_b = structure.position[block_b as usize];
                if position_b == NONE {
                    continue;
                }
                let width_b = structure.width(position_b as usize);
                let mark = self.pairs[pair(place_a, place_b, n)];
                let slot = (mark & !FIRST) as usize;
                let out = &mut normal.h[structure.entry[slot]..structure.entry[slot + 1]];
                let (row, column) = if position_a >= position_b {
                    ((first_a, width_a), (first_b, width_b))
                } else {
                    ((first_b, width_b), (first_a, width_a))
                };
                let places = Places { width, row, column };
                if panel.takes(row.1, column.1) {
                    if mark & FIRST != 0 {
                        out.fill(0.0);
                    }
                    panel.push(&mut normal.h, structure, slot, self.jacobian, &places);
                } else {
                    add_outer(simd, out, mark & FIRST != 0, self.jacobian, &places);
                }
                first_b += width_b;
                place_b += 1;
            }
            first_a += width_a;
            place_a += 1;
        }
    }
}

/// A factor of two residuals over a camera of nine numbers and a point: of these a bundle adjustment
/// has nothing else, so that what is asked of factors in general is asked once.
struct Two<'a> {
    positions: [usize; 2],
    residuals: [f64; 2],
    camera: [&'a [f64; 9]; 2],
    point: [&'a [f64; 3]; 2],
}

impl<'a> Two<'a> {
    /// `None` for any other factor.
    #[inline(always)]
    fn of(
        structure: &Structure,
        blocks: &[u32],
        residuals: &[f64],
        jacobian: &'a [f64],
    ) -> Option<Self> {
        let (&[camera, point], &[r, s]) = (blocks, residuals) else {
            return None;
        };
        let ([one, two], []) = jacobian.as_chunks::<12>() else {
            return None;
        };
        let positions = [camera, point].map(|block| structure.position[block as usize]);
        if positions[1] >= positions[0] || positions[0] == NONE {
            return None;
        }
        let positions = positions.map(|position| position as usize);
        let widths = positions.map(|position| structure.width(position));
        let ((one, two), (first, second)) = (
            (one.first_chunk()?, two.first_chunk()?),
            (one.last_chunk()?, two.last_chunk()?),
        );
        (widths == [9, 3]).then_some(Self {
            positions,
            residuals: [r, s],
            camera: [one, two],
            point: [first, second],
        })
    }

    #[inline(always)]
    fn add<S: Simd>(self, simd: S, normal: &mut Normal, structure: &Structure, pairs: &[u32]) {
        let &[camera, mixed, point] = pairs else {
            return;
        };
        let h = &mut normal.h;
        let place = |mark: u32| structure.entry[(mark & !FIRST) as usize];
        let is_first = |mark: u32| mark & FIRST != 0;
        let own = &mut h[place(camera)..][..81];
        add_two_rows(simd, own, is_first(camera), self.camera, self.camera);
        let own = &mut h[place(mixed)..][..27];
        add_two_rows(simd, own, is_first(mixed), self.camera, self.point);
        let own = &mut h[place(point)..][..9];
        add_two_rows(simd, own, is_first(point), self.point, self.point);
        let [r, s] = self.residuals;
        let [camera, point] = self.positions.map(|position| structure.first[position]);
        for (k, gradient) in normal.gradient[camera..][..9].iter_mut().enumerate() {
            *gradient = *gradient + self.camera[0][k] * r + self.camera[1][k] * s;
        }
        for (k, gradient) in normal.gradient[point..][..3].iter_mut().enumerate() {
            *gradient = *gradient + self.point[0][k] * r + self.point[1][k] * s;
        }
    }
}
