//! Elimination of the blocks by orthogonal transformations, one block after the other.

use faer::{Mat, MatRef};

use super::jacobian::BlockJacobian;
use crate::linear::Factor;

/// Smallest diagonal entry of a triangle, relative to its largest, that an undamped step divides by.
const SINGULAR: f64 = 1e-14;

/// The Schur complement in square-root form.
///
/// The rows of block `i` (its terms, its damping, what is left of the blocks before) are brought to
/// triangular form in the column order block `i`, block `i + 1`, shared, right side. The first rows
/// give block `i` from what follows; the rest is passed on. The normal equations are never formed.
pub(crate) struct Elimination<'a> {
    jacobian: &'a BlockJacobian,
    scale: Vec<f64>,
    /// Number of terms before each block's first.
    first_term: Vec<usize>,
}

/// `R y_block + S y_next + T y_shared = d`, kept for back substitution.
struct Eliminated {
    rows: Mat<f64>,
    next: usize,
}

/// The rows that are left after the last block, `(shared + 1)` columns wide, and the way back.
pub(crate) struct Reduced {
    blocks: Vec<Eliminated>,
    /// Triangle of the shared parameters with the right side as last column.
    pub shared: Mat<f64>,
}

impl<'a> Elimination<'a> {
    /// For `J D⁻¹`.
    pub fn new(jacobian: &'a BlockJacobian, scale: &[f64]) -> Self {
        let count = jacobian.offsets.len().saturating_sub(1);
        let mut first_term = vec![0; count + 1];
        for term in &jacobian.terms {
            first_term[term.block + 1] += 1;
        }
        for i in 0..count {
            first_term[i + 1] += first_term[i];
        }
        Self {
            jacobian,
            scale: scale.to_vec(),
            first_term,
        }
    }

    /// Eliminates every block from `‖J D⁻¹ y + b‖² + λ ‖y‖²`.
    pub fn reduce(&self, b: &[f64], lambda: f64) -> Option<Reduced> {
        let s = self.jacobian.shared;
        let count = self.first_term.len() - 1;
        let mut blocks = Vec::with_capacity(count);
        let mut carry = Carry {
            width: 0,
            rows: Mat::zeros(0, s + 1),
        };
        for block in 0..count {
            let (eliminated, rest) = self.eliminate(block, &carry, b, lambda)?;
            blocks.push(eliminated);
            carry = rest;
        }
        let m = carry.rows.nrows();
        let root = lambda.sqrt();
        let stacked = Mat::from_fn(m + s, s + 1, |i, k| match i {
            i if i < m => carry.rows[(i, k)],
            i if i - m == k => root,
            _ => 0.0,
        });
        Some(Reduced {
            blocks,
            shared: triangle(stacked.as_ref()),
        })
    }

    fn eliminate(
        &self,
        block: usize,
        carry: &Carry,
        b: &[f64],
        lambda: f64,
    ) -> Option<(Eliminated, Carry)> {
        let j = self.jacobian;
        let terms = &j.terms[self.first_term[block]..self.first_term[block + 1]];
        let own = j.width(block);
        let coupled = terms.iter().any(|t| t.coupled);
        let next = if coupled { j.width(block + 1) } else { 0 };
        let columns = own + next + j.shared + 1;
        let rows = carry.rows.nrows() + terms.iter().map(|t| t.matrix.nrows()).sum::<usize>() + own;
        let mut stacked = Mat::zeros(rows, columns);
        let mut at = carry.copy_into(&mut stacked, own, next);
        for term in terms {
            for (k, column) in term.matrix.col_iter().enumerate() {
                let (place, scale) = if k < j.shared {
                    (own + next + k, self.scale[k])
                } else {
                    (k - j.shared, self.scale[j.column(term, k)])
                };
                for (i, value) in column.iter().enumerate() {
                    stacked[(at + i, place)] = value / scale;
                }
            }
            for i in 0..term.matrix.nrows() {
                stacked[(at + i, columns - 1)] = -b[term.first_row + i];
            }
            at += term.matrix.nrows();
        }
        for k in 0..own {
            stacked[(at + k, k)] = lambda.sqrt();
        }
        let r = triangle(stacked.as_ref());
        if r.nrows() < own {
            return None;
        }
        let rest = Mat::from_fn(r.nrows() - own, columns - own, |i, k| r[(own + i, own + k)]);
        let kept = Mat::from_fn(own, columns, |i, k| r[(i, k)]);
        Some((
            Eliminated { rows: kept, next },
            Carry {
                width: next,
                rows: rest,
            },
        ))
    }

    /// The step from the shared parameters back to the first block; `None` where a triangle is
    /// singular.
    fn back(&self, reduced: &Reduced) -> Option<Vec<f64>> {
        let j = self.jacobian;
        let s = j.shared;
        let mut y = vec![0.0; j.columns()];
        let shared = back_substitute(reduced.shared.as_ref(), s, &[])?;
        y[..s].copy_from_slice(&shared);
        for (block, eliminated) in reduced.blocks.iter().enumerate().rev() {
            let (own, start) = (j.width(block), j.offsets[block]);
            let mut known = y[start + own..start + own + eliminated.next].to_vec();
            known.extend_from_slice(&shared);
            let part = back_substitute(eliminated.rows.as_ref(), own, &known)?;
            y[start..start + own].copy_from_slice(&part);
        }
        let p: Vec<f64> = y.iter().zip(&self.scale).map(|(y, s)| y / s).collect();
        p.iter().all(|v| v.is_finite()).then_some(p)
    }
}

impl Factor for Elimination<'_> {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        self.back(&self.reduce(b, lambda)?)
    }

    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        self.damped(b, 0.0)
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        let Some(reduced) = self.reduce(b, 0.0) else {
            return f64::INFINITY;
        };
        let square = |rows: MatRef<'_, f64>, n: usize| -> f64 {
            let last = rows.ncols() - 1;
            (0..n.min(rows.nrows()))
                .map(|i| rows[(i, last)].powi(2))
                .sum()
        };
        let blocks: f64 = reduced
            .blocks
            .iter()
            .map(|e| square(e.rows.as_ref(), e.rows.nrows()))
            .sum();
        (blocks + square(reduced.shared.as_ref(), self.jacobian.shared)).sqrt()
    }
}

/// Rows passed on to the next block: its columns (`width`, none if not coupled), shared, right side.
struct Carry {
    width: usize,
    rows: Mat<f64>,
}

impl Carry {
    /// Writes the rows on top of the next block's and returns how many there are.
    fn copy_into(&self, stacked: &mut Mat<f64>, own: usize, next: usize) -> usize {
        for k in 0..self.rows.ncols() {
            let place = if k < self.width {
                k
            } else {
                own + next + k - self.width
            };
            for i in 0..self.rows.nrows() {
                stacked[(i, place)] = self.rows[(i, k)];
            }
        }
        self.rows.nrows()
    }
}

/// The upper triangle of a QR, zeros below.
fn triangle(a: MatRef<'_, f64>) -> Mat<f64> {
    let qr = a.qr();
    let r = qr.thin_R();
    Mat::from_fn(
        r.nrows(),
        r.ncols(),
        |i, k| if i <= k { r[(i, k)] } else { 0.0 },
    )
}

/// Solves `R y + S known = d` for the first `n` unknowns of rows `[R S d]`.
fn back_substitute(rows: MatRef<'_, f64>, n: usize, known: &[f64]) -> Option<Vec<f64>> {
    if rows.nrows() < n {
        return None;
    }
    let last = rows.ncols() - 1;
    let largest = (0..n).map(|i| rows[(i, i)].abs()).fold(0.0, f64::max);
    let mut y = vec![0.0; n];
    for i in (0..n).rev() {
        let pivot = rows[(i, i)].abs();
        if pivot <= SINGULAR * largest || pivot.is_nan() {
            return None;
        }
        let own: f64 = (i + 1..n).map(|k| rows[(i, k)] * y[k]).sum();
        let others: f64 = known
            .iter()
            .enumerate()
            .map(|(k, v)| rows[(i, n + k)] * v)
            .sum();
        y[i] = (rows[(i, last)] - own - others) / rows[(i, i)];
    }
    Some(y)
}
