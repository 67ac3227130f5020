//! Update of the other blocks by the elimination of one: `S −= Y Yᵀ`, `Y = W L⁻ᵀ`.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::blocks::{Layout, body};
use super::neighbours::{Neighbour, Neighbours};
use super::product::{add_multiple, add_products};
use super::structure::Structure;

/// Blocks that were eliminated and whose products are still to be added.
///
/// The products of many of them are added block after block of `S`: each stays in registers while
/// what is added to it is read, and `S` as a whole fits in no cache. Every sum has its terms in the
/// same order as if the blocks were taken one by one.
#[derive(Debug, Default)]
pub(crate) struct Update {
    /// `Y` of every neighbour, column after column, and room for more.
    y: Vec<f64>,
    /// Entries of it that are used.
    used: usize,
    neighbours: Neighbours,
    /// Entries from which they are added.
    waiting: usize,
    /// Columns of `Y`: the width of the blocks that wait.
    width: usize,
    panel: Vec<f64>,
    /// Position of the neighbour of the columns (less the number eliminated).
    wide: Option<usize>,
}

/// Width from which a single neighbour's columns are collected for a matrix product.
const WIDE: usize = 16;

/// Columns collected.
const COLUMNS: usize = 96;

/// Entries of `Y` that wait, by the root of those of `S`: the more there are, the more often a block of
/// `S` is used once it is at hand, and the farther `Y` is. Measured with 20, 50 and 100 cameras.
const WAITING: f64 = 128.0;

/// Most entries of `Y` that wait: a megabyte.
const MOST_WAITING: usize = 1 << 17;

/// A block being eliminated.
pub(crate) struct Eliminated<'a> {
    pub structure: &'a Structure,
    /// Blocks of `H`.
    pub h: &'a [f64],
    /// Its position.
    pub e: usize,
    /// `L` of `V = L Lᵀ`.
    pub l: &'a [f64],
    /// `L⁻¹ b`.
    pub y: &'a [f64],
}

impl Update {
    /// Nothing waits; products go to blocks of so many entries.
    pub fn new(entries: usize) -> Self {
        Self {
            waiting: ((WAITING * (entries as f64).sqrt()) as usize).min(MOST_WAITING),
            ..Self::default()
        }
    }

    /// Takes `W V⁻¹ b` of a block from what is left of `b`, and adds its products to the blocks of
    /// `−S`, now or later.
    #[inline(always)]
    pub fn eliminate<S: Simd>(
        &mut self,
        simd: S,
        own: &Eliminated<'_>,
        layout: &Layout,
        blocks: &mut [f64],
        left: &mut [f64],
    ) {
        if self.width != own.y.len() {
            self.add_products(simd, layout, blocks);
            self.width = own.y.len();
        }
        let from = self.used;
        self.solve_neighbours(simd, own, left);
        if let Some(only) = self.neighbours.take_single(WIDE) {
            self.collect(layout, blocks, only.position as usize, from);
            return;
        }
        self.neighbours.close();
        if self.used >= self.waiting {
            self.add_products(simd, layout, blocks);
        }
    }

    /// Adds the products of the neighbours of the blocks that wait.
    #[inline(always)]
    pub fn add_products<S: Simd>(&mut self, simd: S, layout: &Layout, blocks: &mut [f64]) {
        self.neighbours.sort(layout.columns.len());
        for column in 0..layout.columns.len() {
            self.neighbours.pair(column);
            self.neighbours.order_rows(column);
            let reach = layout.reach(column);
            let columns = reach.column.width;
            while let Some((row, pairs)) = self.neighbours.next_row() {
                let rows = row.width as usize;
                let Some((place, _)) = reach.place(row.position, row.first as usize) else {
                    continue;
                };
                let block = &mut blocks[place..place + rows * columns];
                add_products(simd, block, (rows, columns, self.width), &self.y, pairs);
            }
        }
        self.forget();
    }

    /// Drops what waits.
    pub fn forget(&mut self) {
        self.neighbours.clear();
        self.used = 0;
    }

    /// `Y` of all neighbours.
    #[inline(always)]
    fn solve_neighbours<S: Simd>(&mut self, simd: S, own: &Eliminated<'_>, left: &mut [f64]) {
        let (s, e, d) = (own.structure, own.e, own.y.len());
        let slots = s.column[e] + 1..s.column[e + 1];
        let from = self.used;
        let before = s.entry[slots.start];
        self.used += s.entry[slots.end] - before;
        if self.y.len() < self.used {
            self.y.resize(self.used, 0.0);
        }
        for slot in slots {
            let row = s.row[slot] as usize;
            let rows = s.width(row);
            let first = s.first[row] - s.split();
            let at = from + s.entry[slot] - before;
            self.neighbours.push(Neighbour {
                position: (row - s.eliminated) as u32,
                width: rows as u32,
                first: first as u32,
                at: at as u32,
            });
            let w = &own.h[s.entry[slot]..s.entry[slot + 1]];
            let y = &mut self.y[at..at + rows * d];
            let left = &mut left[first..first + rows];
            match (rows, d) {
                (2, 2) => right_solve_fixed::<2, 2>(w, y, own, left),
                (9, 3) => right_solve_fixed::<9, 3>(w, y, own, left),
                (6, 3) => right_solve_fixed::<6, 3>(w, y, own, left),
                _ => right_solve(simd, w, y, own, left),
            }
        }
    }

    /// Keeps the columns of a wide neighbour; a product takes many at once.
    fn collect(&mut self, layout: &Layout, blocks: &mut [f64], position: usize, from: usize) {
        if self.wide.is_some_and(|other| other != position) {
            self.flush(layout, blocks);
        }
        self.wide = Some(position);
        self.panel.extend_from_slice(&self.y[from..self.used]);
        self.used = from;
        if self.panel.len() >= COLUMNS * layout.columns[position].width {
            self.flush(layout, blocks);
        }
    }

    /// Adds the products of the columns that were collected.
    pub fn flush(&mut self, layout: &Layout, blocks: &mut [f64]) {
        let Some(position) = self.wide.take() else {
            return;
        };
        let column = layout.columns[position];
        let width = column.width;
        debug_assert_eq!(body(width), width);
        let y = MatRef::from_column_major_slice(&self.panel, width, self.panel.len() / width);
        let out = &mut blocks[column.base..column.base + width * width];
        matmul(
            MatMut::from_column_major_slice_mut(out, width, width),
            BlockStructure::TriangularLower,
            Accum::Add,
            y,
            BlockStructure::Rectangular,
            y.transpose(),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
        self.panel.clear();
    }
}

/// `Y = W L⁻ᵀ` (`R × E`), and `left −= Y y`.
#[inline(always)]
fn right_solve_fixed<const R: usize, const E: usize>(
    w: &[f64],
    out: &mut [f64],
    own: &Eliminated<'_>,
    left: &mut [f64],
) {
    let (w, _) = w.as_chunks::<R>();
    let (out, _) = out.as_chunks_mut::<R>();
    let (l, _) = own.l.as_chunks::<E>();
    let (Some(w), Some(out)) = (w.first_chunk::<E>(), out.first_chunk_mut::<E>()) else {
        return;
    };
    let (Some(l), Some(b)) = (l.first_chunk::<E>(), own.y.first_chunk::<E>()) else {
        return;
    };
    let Some(left) = left.first_chunk_mut::<R>() else {
        return;
    };
    for c in 0..E {
        let inverse = 1.0 / l[c][c];
        let mut own = w[c];
        for k in 0..c {
            for r in 0..R {
                own[r] -= out[k][r] * l[k][c];
            }
        }
        for r in 0..R {
            own[r] *= inverse;
            left[r] -= own[r] * b[c];
        }
        out[c] = own;
    }
}

/// Like [`right_solve_fixed`], of any size.
#[inline(always)]
fn right_solve<S: Simd>(
    simd: S,
    w: &[f64],
    out: &mut [f64],
    own: &Eliminated<'_>,
    left: &mut [f64],
) {
    let (rows, d) = (left.len(), own.y.len());
    out.copy_from_slice(w);
    for c in 0..d {
        let (before, column) = out.split_at_mut(c * rows);
        let column = &mut column[..rows];
        for k in 0..c {
            let known = &before[k * rows..(k + 1) * rows];
            add_multiple(simd, column, known, -own.l[k * d + c]);
        }
        let inverse = 1.0 / own.l[c * (d + 1)];
        for own in &mut *column {
            *own *= inverse;
        }
        add_multiple(simd, left, column, -own.y[c]);
    }
}
