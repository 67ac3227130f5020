//! The solution of the normal equations: blocks eliminated one by one, then what is left.

pub(crate) mod accumulate;
pub(crate) mod block_cholesky;
pub(crate) mod blocks;
pub(crate) mod equations;
pub(crate) mod fill;
pub(crate) mod neighbours;
pub(crate) mod normal;
pub(crate) mod order;
pub(crate) mod outer;
pub(crate) mod panel;
pub(crate) mod product;
pub(crate) mod reduced;
pub(crate) mod structure;
pub(crate) mod update;

use std::sync::Arc;

use pulp::{Arch, Simd, WithSimd};

use crate::error::Error;
use crate::graph::elimination::reduced::Reduced;
use crate::graph::elimination::structure::{Pattern, Structure};
use crate::graph::elimination::update::{Eliminated, Update};
use crate::linear::vector::dot;

/// `H + diag`, factored.
///
/// For every eliminated block `e` with neighbours `i`: `V_e = H_ee = L Lᵀ`, `W_i = H_ie`, and what
/// is left is `S = H_rr − Σ_e W V⁻¹ Wᵀ`.
///
/// Source: Triggs, McLauchlan, Hartley and Fitzgibbon, "Bundle adjustment: a modern synthesis", 2000,
/// section 6.1.
pub(crate) struct Factored {
    structure: Arc<Structure>,
    reduced: Reduced,
    /// `L` of every eliminated block, column after column.
    triangles: Vec<f64>,
    /// Begin of each.
    triangle: Vec<usize>,
    update: Update,
}

impl Factored {
    /// Room for a structure; nothing factored yet.
    pub fn new(structure: &Arc<Structure>) -> Result<Self, Error> {
        let mut triangle = Vec::with_capacity(structure.eliminated + 1);
        let mut entries = 0;
        for position in 0..structure.eliminated {
            triangle.push(entries);
            entries += structure.width(position).pow(2);
        }
        triangle.push(entries);
        let reduced = Reduced::new(structure)?;
        Ok(Self {
            structure: Arc::clone(structure),
            update: Update::new(reduced.layout.entries()),
            reduced,
            triangles: vec![0.0; entries],
            triangle,
        })
    }

    /// Factors `H + diag(more)`, given the blocks of `H`, and solves for `b` (unknowns) in place;
    /// `false` where the sum is not positive definite.
    pub fn factor_and_solve(&mut self, h: &[f64], more: &[f64], b: &mut [f64]) -> bool {
        if !self.eliminate(h, more, b) || !self.reduced.factor() {
            return false;
        }
        let split = self.structure.split();
        self.reduced.solve(&mut b[split..]);
        self.back(h, b);
        b.iter().all(|v| v.is_finite())
    }

    /// Eliminates blocks from the matrix and from `b`.
    fn eliminate(&mut self, h: &[f64], more: &[f64], b: &mut [f64]) -> bool {
        let s = &*self.structure;
        self.reduced.load(s, h, more);
        if s.eliminated == 0 {
            return true;
        }
        let (own, left) = b.split_at_mut(s.split());
        let positive = Arch::new().dispatch(Elimination {
            structure: s,
            reduced: &mut self.reduced,
            triangles: &mut self.triangles,
            triangle: &self.triangle,
            update: &mut self.update,
            h,
            more,
            own,
            left,
        });
        let Reduced { layout, blocks, .. } = &mut self.reduced;
        self.update.flush(layout, blocks.entries());
        self.reduced.assemble(s, more);
        positive
    }

    /// From what is left (solved) back to the eliminated blocks, whose `b` is `L⁻¹ b`.
    fn back(&self, h: &[f64], b: &mut [f64]) {
        Arch::new().dispatch(Return {
            factored: self,
            h,
            b,
        });
    }

    /// Solves for further right sides, each of all unknowns, one after the other, in place; `h` is
    /// what was factored.
    pub fn solve(&mut self, h: &[f64], b: &mut [f64]) {
        let s = &*self.structure;
        let (n, split) = (s.unknowns(), s.split());
        if n == 0 {
            return;
        }
        let left = n - split;
        let mut right = Vec::with_capacity(left * (b.len() / n));
        for b in b.chunks_exact_mut(n) {
            self.forward_right_side(h, b);
            right.extend_from_slice(&b[split..]);
        }
        if left > 0 {
            self.reduced.solve(&mut right);
        }
        for (k, b) in b.chunks_exact_mut(n).enumerate() {
            b[split..].copy_from_slice(&right[k * left..(k + 1) * left]);
            self.back(h, b);
        }
    }

    fn forward_right_side(&self, h: &[f64], b: &mut [f64]) {
        let s = &*self.structure;
        let (own, left) = b.split_at_mut(s.split());
        for e in 0..s.eliminated {
            let d = s.width(e);
            let l = &self.triangles[self.triangle[e]..self.triangle[e + 1]];
            let y = &mut own[s.first[e]..s.first[e + 1]];
            forward(l, d, y);
            if y.iter().all(|&v| v == 0.0) {
                continue;
            }
            let mut u = [0.0; 24];
            let u = &mut u[..d];
            u.copy_from_slice(y);
            backward(l, d, u);
            for slot in s.column[e] + 1..s.column[e + 1] {
                let row = s.row[slot] as usize;
                let rows = s.width(row);
                let out = &mut left[s.first[row] - s.split()..][..rows];
                let w = &h[s.entry[slot]..s.entry[slot + 1]];
                for (column, u) in w.chunks_exact(rows).zip(&*u) {
                    out.iter_mut().zip(column).for_each(|(o, w)| *o -= w * u);
                }
            }
        }
    }

    /// `ln det` of what was factored.
    pub fn log_determinant(&self) -> f64 {
        let mut sum = 0.0;
        for e in 0..self.structure.eliminated {
            let d = self.structure.width(e);
            let l = &self.triangles[self.triangle[e]..self.triangle[e + 1]];
            sum += (0..d).map(|k| l[k * (d + 1)].ln()).sum::<f64>();
        }
        2.0 * sum + self.reduced.log_determinant()
    }

    /// Method by which the matrix is solved, in words.
    pub fn method(&self) -> Method {
        Method {
            eliminated: self.structure.eliminated,
            left: self.structure.unknowns() - self.structure.split(),
            dense: matches!(self.structure.reduced, Pattern::Dense),
            factor_entries: self.reduced.size(),
        }
    }
}

/// The elimination of all blocks, compiled for the vector instructions that the machine has.
struct Elimination<'a> {
    structure: &'a Structure,
    reduced: &'a mut Reduced,
    triangles: &'a mut [f64],
    triangle: &'a [usize],
    update: &'a mut Update,
    h: &'a [f64],
    more: &'a [f64],
    own: &'a mut [f64],
    left: &'a mut [f64],
}

impl WithSimd for Elimination<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let s = self.structure;
        for e in 0..s.eliminated {
            let d = s.width(e);
            let l = &mut self.triangles[self.triangle[e]..self.triangle[e + 1]];
            let diagonal = s.column[e];
            l.copy_from_slice(&self.h[s.entry[diagonal]..s.entry[diagonal + 1]]);
            for k in 0..d {
                l[k * (d + 1)] += self.more[s.first[e] + k];
            }
            if !cholesky(l, d) {
                self.update.forget();
                return false;
            }
            let y = &mut self.own[s.first[e]..s.first[e + 1]];
            forward(l, d, y);
            let own = Eliminated {
                structure: s,
                h: self.h,
                e,
                l,
                y,
            };
            let Reduced { layout, blocks, .. } = &mut *self.reduced;
            self.update
                .eliminate(simd, &own, layout, blocks.entries(), self.left);
        }
        let Reduced { layout, blocks, .. } = self.reduced;
        self.update.add_products(simd, layout, blocks.entries());
        true
    }
}

/// The way back to the eliminated blocks, compiled for the vector instructions that the machine has.
struct Return<'a> {
    factored: &'a Factored,
    h: &'a [f64],
    b: &'a mut [f64],
}

impl WithSimd for Return<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Factored {
            structure: s,
            triangles,
            triangle,
            ..
        } = self.factored;
        let (own, left) = self.b.split_at_mut(s.split());
        for e in 0..s.eliminated {
            let d = s.width(e);
            let l = &triangles[triangle[e]..triangle[e + 1]];
            let x = &mut own[s.first[e]..s.first[e + 1]];
            backward(l, d, x);
            // x = V⁻¹ (b − Σ Wᵀ x_i).
            let mut sum = [0.0; 24];
            let sum = &mut sum[..d];
            let mut products = [[0.0; 9]; 3];
            for slot in s.column[e] + 1..s.column[e + 1] {
                let row = s.row[slot] as usize;
                let rows = s.width(row);
                let of_row = &left[s.first[row] - s.split()..][..rows];
                let w = &self.h[s.entry[slot]..s.entry[slot + 1]];
                if (rows, d) == (9, 3) {
                    add_by_row(&mut products, w, of_row);
                    continue;
                }
                for (sum, column) in sum.iter_mut().zip(w.chunks_exact(rows)) {
                    *sum += dot(column, of_row);
                }
            }
            for (sum, products) in sum.iter_mut().zip(&products) {
                *sum += products.iter().sum::<f64>();
            }
            forward(l, d, sum);
            backward(l, d, sum);
            x.iter_mut().zip(&*sum).for_each(|(x, sum)| *x -= sum);
        }
    }
}

/// Adds `w_rc x_r` to the products of every row and column: sums over the rows, which no vector
/// instruction forms, are left to the end.
#[inline(always)]
fn add_by_row<const R: usize, const E: usize>(products: &mut [[f64; R]; E], w: &[f64], x: &[f64]) {
    let (w, _) = w.as_chunks::<R>();
    let (Some(w), Some(x)) = (w.first_chunk::<E>(), x.first_chunk::<R>()) else {
        return;
    };
    for c in 0..E {
        for r in 0..R {
            products[c][r] += w[c][r] * x[r];
        }
    }
}

/// Method by which the linear equations of a graph are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Method {
    /// Blocks eliminated one by one.
    pub eliminated: usize,
    /// Unknowns that are left.
    pub left: usize,
    /// True where what is left is stored dense.
    pub dense: bool,
    /// Entries of the Cholesky factor of what is left.
    pub factor_entries: usize,
}

/// Cholesky factor `L` of a small matrix (`d × d`, column after column) in place of its lower half.
fn cholesky(a: &mut [f64], d: usize) -> bool {
    for k in 0..d {
        let mut pivot = a[k * (d + 1)];
        for j in 0..k {
            pivot -= a[j * d + k] * a[j * d + k];
        }
        if !(pivot > 0.0 && pivot.is_finite()) {
            return false;
        }
        let root = pivot.sqrt();
        a[k * (d + 1)] = root;
        for i in k + 1..d {
            let mut sum = a[k * d + i];
            for j in 0..k {
                sum -= a[j * d + i] * a[j * d + k];
            }
            a[k * d + i] = sum / root;
        }
    }
    true
}

/// `L⁻¹ b` in place.
#[inline]
fn forward(l: &[f64], d: usize, b: &mut [f64]) {
    for k in 0..d {
        b[k] /= l[k * (d + 1)];
        for i in k + 1..d {
            b[i] -= l[k * d + i] * b[k];
        }
    }
}

/// `L⁻ᵀ b` in place.
#[inline]
fn backward(l: &[f64], d: usize, b: &mut [f64]) {
    for k in (0..d).rev() {
        for i in k + 1..d {
            b[k] -= l[k * d + i] * b[i];
        }
        b[k] /= l[k * (d + 1)];
    }
}
