//! The Cholesky factor of a block-sparse matrix of little fill: block after block.
//!
//! A supernodal factorisation spends more on its bookkeeping than on arithmetic while columns have only a
//! few blocks below them, as in a chain of poses with some loops. The last columns, where all rows meet,
//! are one dense matrix.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::cholesky::llt::solve::{solve_in_place, solve_in_place_scratch};
use faer::{MatMut, MatRef, Par};
use pulp::{Arch, Simd, WithSimd};

use super::blocks::{Column, Layout};
use super::panel::{Below, Product, factor_panel};

/// A lower triangle whose pattern has its fill, then its factor in the same place.
///
/// Every column of blocks is one piece: all its rows of numbers, column after column. The last columns
/// are one dense matrix.
pub(crate) struct BlockCholesky {
    panels: Vec<Panel>,
    /// Blocks below the diagonals, panel after panel.
    below: Vec<Below>,
    /// Place of the product of two blocks of a panel, in the order in which they are formed.
    targets: Vec<u32>,
    /// For every unknown its entry on the diagonal of a panel's first block, and how far columns are apart.
    starts: Vec<(u32, u32)>,
    values: Vec<f64>,
    /// Number of panels before the dense matrix.
    tail: usize,
    /// First unknown of the dense matrix, its first entry and its size.
    dense: Dense,
    memory: MemBuffer,
    /// The width of all blocks, if they have the same.
    width: Option<usize>,
}

/// The dense matrix at the end.
#[derive(Clone, Copy, Debug)]
struct Dense {
    first: usize,
    start: usize,
    size: usize,
}

/// A column of blocks.
#[derive(Clone, Copy, Debug)]
struct Panel {
    /// First of its entries.
    start: usize,
    /// First unknown.
    first: usize,
    width: usize,
    /// Distance of its columns: its rows of numbers, in the dense matrix all of that.
    height: usize,
    /// End of its blocks below the diagonal.
    end: usize,
}

impl BlockCholesky {
    /// Room for a matrix laid out with its fill; `None` where indices are too long.
    pub fn new(layout: &Layout, tail: usize) -> Option<Self> {
        let n = layout.unknowns;
        let (mut panels, mut below) = (Vec::with_capacity(layout.columns.len()), Vec::new());
        let mut starts = Vec::with_capacity(n);
        let mut start = 0;
        let first = layout.columns.get(tail).map_or(n, |column| column.first);
        let size = n - first;
        for (k, &Column { first, width, .. }) in layout.columns.iter().enumerate() {
            let mut height = 0;
            layout.of_column(k, |row, offset, _| {
                let Column { first, width, .. } = layout.columns[row];
                height = offset + width;
                if row > k && k < tail {
                    below.push(Below {
                        offset: offset as u32,
                        first: first as u32,
                        position: row as u32,
                        width: width as u32,
                    });
                }
            });
            let stride = if k < tail { height } else { size };
            let panel = Panel {
                start,
                first,
                width,
                height: stride,
                end: below.len(),
            };
            panels.push(panel);
            let place = (u32::try_from(start).ok()?, u32::try_from(stride).ok()?);
            starts.extend(std::iter::repeat_n(place, width));
            // Within the dense matrix down the diagonal.
            start += width * stride + if k < tail { 0 } else { width };
        }
        let dense = Dense {
            first,
            start: panels.get(tail).map_or(start, |panel| panel.start),
            size,
        };
        let width = panels.first().map_or(0, |panel| panel.width);
        let same = panels.iter().all(|panel| panel.width == width);
        let need = cholesky_in_place_scratch::<f64>(size, Par::Seq, Default::default())
            .or(solve_in_place_scratch::<f64>(size, 1, Par::Seq));
        let mut made = Self {
            panels,
            below,
            targets: Vec::new(),
            starts,
            values: vec![0.0; dense.start + size * size],
            tail,
            dense,
            memory: MemBuffer::try_new(need).ok()?,
            width: same.then_some(width),
        };
        made.find_targets();
        Some(made)
    }

    /// The block of row `a` in the column of row `b`, for any two rows of a panel.
    fn find_targets(&mut self) {
        let mut from = 0;
        for panel in &self.panels[..self.tail] {
            let own = &self.below[from..panel.end];
            from = panel.end;
            for (k, b) in own.iter().enumerate() {
                let column = b.position as usize;
                let target = self.panels[column];
                if column >= self.tail {
                    let rows = own[k..].iter().map(|a| (a.first - b.first) as usize);
                    let places = rows.map(|row| (target.start + row) as u32);
                    self.targets.extend(places);
                    continue;
                }
                let first = column.checked_sub(1).map_or(0, |p| self.panels[p].end);
                let mut there = self.below[first..target.end].iter();
                self.targets.push(target.start as u32);
                for a in &own[k + 1..] {
                    // Ascending, and all are there: the fill is part of the pattern.
                    let found = there.find(|block| block.position == a.position);
                    let offset = found.map_or(0, |block| block.offset);
                    self.targets.push(target.start as u32 + offset);
                }
            }
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// The values of a column of blocks from a row on, so many rows of numbers below its diagonal,
    /// and how far its columns are apart.
    pub fn columns(&mut self, column: &Column, offset: usize) -> (&mut [f64], usize) {
        let (start, stride) = self.starts[column.first];
        (&mut self.values[start as usize + offset..], stride as usize)
    }

    /// Factors the matrix; `false` where it is not positive definite.
    pub fn factor(&mut self) -> bool {
        Arch::new().dispatch(Factorisation(self)) && self.factor_dense()
    }

    fn factor_dense(&mut self) -> bool {
        let Dense { start, size, .. } = self.dense;
        let values = &mut self.values[start..];
        let factored = cholesky_in_place(
            MatMut::from_column_major_slice_mut(values, size, size),
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        factored.is_ok() && (0..size).all(|k| values[k * (size + 1)].is_finite())
    }

    /// Solves for as many right sides as `b` has columns of unknowns, in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.starts.len();
        if n == 0 {
            return;
        }
        let Dense { first, start, size } = self.dense;
        for b in b.chunks_exact_mut(n) {
            for forward in [true, false] {
                Arch::new().dispatch(Solution {
                    factor: self,
                    b,
                    forward,
                });
                if forward && size > 0 {
                    solve_in_place(
                        MatRef::from_column_major_slice(&self.values[start..], size, size),
                        MatMut::from_column_major_slice_mut(&mut b[first..], size, 1),
                        Par::Seq,
                        MemStack::new(&mut self.memory),
                    );
                }
            }
        }
    }

    /// `ln det` of the matrix, from its factor.
    pub fn log_determinant(&self) -> f64 {
        let mut sum = 0.0;
        for panel in &self.panels {
            let diagonal = (0..panel.width).map(|k| panel.start + k * (panel.height + 1));
            sum += diagonal.map(|at| self.values[at].ln()).sum::<f64>();
        }
        2.0 * sum
    }

    /// Entries of the factor.
    pub fn size(&self) -> usize {
        self.values.len()
    }
}

/// The factorisation, compiled for the vector instructions that the machine has.
struct Factorisation<'a>(&'a mut BlockCholesky);

impl WithSimd for Factorisation<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let BlockCholesky {
            panels,
            below,
            targets,
            values,
            width,
            tail,
            ..
        } = self.0;
        let (mut from, mut targets) = (0, &targets[..]);
        for panel in &panels[..*tail] {
            let end = panel.start + panel.width * panel.height;
            let (own, later) = values.split_at_mut(end);
            let own = &mut own[panel.start..];
            if !factor_panel(own, panel.width, panel.height) {
                return false;
            }
            let blocks = &below[from..panel.end];
            from = panel.end;
            for (k, b) in blocks.iter().enumerate() {
                let others = &blocks[k..];
                let (places, further) = targets.split_at(others.len());
                targets = further;
                let stride = panels[b.position as usize].height;
                let product = Product {
                    panel: own,
                    height: panel.height,
                    b: b.offset as usize,
                    others,
                    places,
                    before: end,
                    stride,
                };
                match width {
                    Some(2) => product.subtract::<S, 2>(simd, later),
                    Some(3) => product.subtract::<S, 3>(simd, later),
                    Some(6) => product.subtract::<S, 6>(simd, later),
                    _ => product.subtract_any(panel.width, b.width as usize, later),
                }
            }
        }
        true
    }
}

/// A half of the solution for one right side before the dense matrix, compiled for the vector
/// instructions that the machine has.
struct Solution<'a> {
    factor: &'a BlockCholesky,
    b: &'a mut [f64],
    /// True for `L`, false for `Lᵀ`.
    forward: bool,
}

impl WithSimd for Solution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        match (self.factor.width, self.forward) {
            (Some(2), true) => self.forward(|_| 2),
            (Some(3), true) => self.forward(|_| 3),
            (Some(6), true) => self.forward(|_| 6),
            (_, true) => self.forward(|width| width),
            (Some(2), false) => self.backward(|_| 2),
            (Some(3), false) => self.backward(|_| 3),
            (Some(6), false) => self.backward(|_| 6),
            (_, false) => self.backward(|width| width),
        }
    }
}

impl Solution<'_> {
    /// By `L`; `known` replaces a width by that of all blocks.
    #[inline(always)]
    fn forward(self, known: impl Fn(usize) -> usize + Copy) {
        let Self { factor, b, .. } = self;
        let mut from = 0;
        for panel in &factor.panels[..factor.tail] {
            let values = &factor.values[panel.start..];
            let below = &factor.below[from..panel.end];
            from = panel.end;
            let width = known(panel.width);
            for k in 0..width {
                let column = &values[k * panel.height..][..panel.height];
                let value = b[panel.first + k] / column[k];
                b[panel.first + k] = value;
                for r in k + 1..width {
                    b[panel.first + r] -= column[r] * value;
                }
                for block in below {
                    let width = known(block.width as usize);
                    let own = &column[block.offset as usize..][..width];
                    let out = &mut b[block.first as usize..][..width];
                    for r in 0..width {
                        out[r] -= own[r] * value;
                    }
                }
            }
        }
    }

    /// By `Lᵀ`.
    #[inline(always)]
    fn backward(self, known: impl Fn(usize) -> usize + Copy) {
        let Self { factor, b, .. } = self;
        for (p, panel) in factor.panels[..factor.tail].iter().enumerate().rev() {
            let values = &factor.values[panel.start..];
            let first = p.checked_sub(1).map_or(0, |p| factor.panels[p].end);
            let below = &factor.below[first..panel.end];
            let width = known(panel.width);
            for k in (0..width).rev() {
                let column = &values[k * panel.height..][..panel.height];
                let mut sum = b[panel.first + k];
                for r in k + 1..width {
                    sum -= column[r] * b[panel.first + r];
                }
                for block in below {
                    let width = known(block.width as usize);
                    let own = &column[block.offset as usize..][..width];
                    let other = &b[block.first as usize..][..width];
                    for r in 0..width {
                        sum -= own[r] * other[r];
                    }
                }
                b[panel.first + k] = sum / column[k];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::equations::{Equations, Normal};
    use super::super::structure::{Pattern, Structure};
    use crate::graph::elimination::Factored;
    use crate::graph::{Euclidean, Graph};
    use crate::residual::Residual;
    use crate::scalar::Scalar;

    /// One sum for every number.
    struct Sums(usize);

    impl<D: Scalar> Residual<D> for Sums {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            for row in 0..x.len() {
                let terms = x.iter().enumerate().map(|(k, value)| {
                    let seed = (self.0 * 31 + row * 7 + k * 13) % 101;
                    *value * (seed as f64 / 50.0 - 1.0)
                });
                out.push(terms.fold(D::from(1.0), |sum, term| sum + term));
            }
        }
    }

    /// A chain of blocks with loops.
    fn chain(width: impl Fn(usize) -> usize) -> Graph<'static> {
        let mut graph = Graph::new();
        let blocks: Vec<_> = (0..150)
            .map(|k| {
                let manifold = Euclidean(width(k));
                graph.add(format!("b{k}"), manifold, &vec![0.0; width(k)])
            })
            .collect::<Result<_, _>>()
            .unwrap();
        for k in 1..blocks.len() {
            graph.add_factor(&[blocks[k - 1], blocks[k]], Sums(k));
            if k % 5 == 0 {
                graph.add_factor(&[blocks[k], blocks[k * k * 7 % k]], Sums(k + 500));
            }
            if k % 3 == 0 {
                graph.add_factor(&[blocks[k], blocks[k * 37 % k.min(29)]], Sums(k + 900));
            }
            // The last ones all meet.
            for j in 90..k {
                graph.add_factor(&[blocks[k], blocks[j]], Sums(k + 7 * j));
            }
        }
        graph
    }

    #[test]
    fn block_after_block_is_what_supernodes_give() {
        let widths: [&dyn Fn(usize) -> usize; 4] = [&|_| 2, &|_| 3, &|_| 6, &|k| 1 + k % 4];
        for width in widths {
            let graph = chain(width);
            let own = Structure::new(&graph).unwrap();
            let mut other = Structure::new(&graph).unwrap();
            let Pattern::Filled(filled) = other.reduced else {
                panic!("the fill is little");
            };
            assert!((1..149).contains(&filled.tail), "{}", filled.tail);
            other.reduced = Pattern::Sparse(filled.rows);
            let found = [own, other].map(|structure| {
                let structure = Arc::new(structure);
                let mut normal = Normal::default();
                let values = graph.values();
                Equations::start(&graph, &structure, 1, values, &mut normal).unwrap();
                let n = structure.unknowns();
                let more: Vec<f64> = (0..n).map(|k| 0.5 + (k % 3) as f64).collect();
                let mut factored = Factored::new(&structure).unwrap();
                let mut b: Vec<f64> = (0..n).map(|k| (k as f64).sin()).collect();
                assert!(factored.factor_and_solve(&normal.h, &more, &mut b));
                let mut two: Vec<f64> = (0..2 * n).map(|k| (k as f64).cos()).collect();
                factored.solve(&normal.h, &mut two);
                b.extend(two);
                (b, factored.log_determinant())
            });
            let [(own, own_log), (other, other_log)] = found;
            assert!((own_log - other_log).abs() < 1e-12 * other_log.abs());
            let size = other.iter().map(|v| v.abs()).fold(0.0, f64::max);
            for (own, other) in own.iter().zip(&other) {
                assert!((own - other).abs() < 1e-12 * size, "{own} {other}");
            }
        }
    }
}
