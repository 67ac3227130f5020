//! Elimination of the blocks by orthogonal transformations, one block after the other.

use super::jacobian::BlockJacobian;
use super::stack::Stack;
use crate::linear::Factor;
use crate::vector::dot;

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

/// The triangle that is left after the last block, and the way back.
pub(crate) struct Reduced {
    /// `[R S T d]` of every block, `R y_block + S y_next + T y_shared = d`, row after row.
    rows: Vec<f64>,
    blocks: Vec<Eliminated>,
    /// Triangle of the shared parameters with the right side as last column.
    pub shared: Stack,
}

/// Where the rows of an eliminated block lie.
struct Eliminated {
    first: usize,
    next: usize,
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
    pub fn reduce(&self, b: &[f64], lambda: f64) -> Reduced {
        let shared = self.jacobian.shared;
        let count = self.first_term.len() - 1;
        let mut reduced = Reduced {
            rows: Vec::new(),
            blocks: Vec::with_capacity(count),
            shared: Stack::default(),
        };
        let (mut stack, mut passed_on) = (Stack::default(), Stack::default());
        passed_on.clear(0, shared + 1);
        for block in 0..count {
            let (own, next) = self.stack(block, &passed_on, b, lambda, &mut stack);
            stack.triangularise();
            reduced.blocks.push(Eliminated {
                first: reduced.rows.len(),
                next,
            });
            stack.copy_rows(own, &mut reduced.rows);
            stack.copy_corner(own, &mut passed_on);
        }
        let rest = passed_on.rows();
        reduced.shared.clear(rest + shared, shared + 1);
        for k in 0..=shared {
            let column = reduced.shared.column_mut(k);
            column[..rest].copy_from_slice(passed_on.column(k));
            if k < shared {
                column[rest + k] = lambda.sqrt();
            }
        }
        reduced.shared.triangularise();
        reduced
    }

    /// Lays out what is left of the blocks before, the block's terms and its damping; returns how
    /// many columns are the block's own and how many the next block's.
    fn stack(
        &self,
        block: usize,
        passed_on: &Stack,
        b: &[f64],
        lambda: f64,
        stack: &mut Stack,
    ) -> (usize, usize) {
        let j = self.jacobian;
        let terms = &j.terms[self.first_term[block]..self.first_term[block + 1]];
        let own = j.width(block);
        let coupled = terms.iter().any(|t| t.coupled);
        let next = if coupled { j.width(block + 1) } else { 0 };
        let last = own + next + j.shared;
        let rows: usize = terms.iter().map(|t| t.rows).sum();
        let mut at = passed_on.rows();
        stack.clear(at + rows + own, last + 1);
        // Without the columns of this block if nothing couples it to those before.
        let width = passed_on.columns() - (j.shared + 1);
        for k in 0..passed_on.columns() {
            let place = if k < width { k } else { own + next + k - width };
            stack.column_mut(place)[..at].copy_from_slice(passed_on.column(k));
        }
        for term in terms {
            let rows = at..at + term.rows;
            for (k, column) in j.term_columns(term) {
                let place = match k.checked_sub(j.offsets[block]) {
                    Some(place) => place,
                    None => own + next + k,
                };
                let stacked = &mut stack.column_mut(place)[rows.clone()];
                for (stacked, value) in stacked.iter_mut().zip(column) {
                    *stacked = value / self.scale[k];
                }
            }
            let right = &mut stack.column_mut(last)[rows.clone()];
            for (stacked, value) in right.iter_mut().zip(&b[term.first_row..]) {
                *stacked = -value;
            }
            at = rows.end;
        }
        for k in 0..own {
            stack.column_mut(k)[at + k] = lambda.sqrt();
        }
        (own, next)
    }

    /// The step from the shared parameters back to the first block; `None` where a triangle is
    /// singular.
    fn back(&self, reduced: &Reduced) -> Option<Vec<f64>> {
        let j = self.jacobian;
        let s = j.shared;
        let mut rows = Vec::new();
        reduced.shared.copy_rows(s, &mut rows);
        let mut y = vec![0.0; j.columns()];
        let (shared, blocks) = y.split_at_mut(s);
        back_substitute(&rows, shared, &[], &[])?;
        for (block, eliminated) in reduced.blocks.iter().enumerate().rev() {
            let start = j.offsets[block] - s;
            let (before, after) = blocks.split_at_mut(start + j.width(block));
            let rows = &reduced.rows[eliminated.first..];
            back_substitute(
                rows,
                &mut before[start..],
                &after[..eliminated.next],
                shared,
            )?;
        }
        for (y, scale) in y.iter_mut().zip(&self.scale) {
            *y /= scale;
        }
        y.iter().all(|v| v.is_finite()).then_some(y)
    }
}

impl Factor for Elimination<'_> {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        self.back(&self.reduce(b, lambda))
    }

    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        self.damped(b, 0.0)
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        let j = self.jacobian;
        let reduced = self.reduce(b, 0.0);
        let last = reduced.shared.column(j.shared);
        let mut square: f64 = last.iter().take(j.shared).map(|d| d * d).sum();
        for (block, eliminated) in reduced.blocks.iter().enumerate() {
            let columns = j.width(block) + eliminated.next + j.shared + 1;
            let rows = reduced.rows[eliminated.first..].chunks_exact(columns);
            square += rows
                .take(j.width(block))
                .map(|row| row[columns - 1].powi(2))
                .sum::<f64>();
        }
        square.sqrt()
    }
}

/// Solves `R y + S next + T shared = d` for `y`, given the rows `[R S T d]` one after the other;
/// `None` where `R` is singular.
fn back_substitute(rows: &[f64], y: &mut [f64], next: &[f64], shared: &[f64]) -> Option<()> {
    let n = y.len();
    let columns = n + next.len() + shared.len() + 1;
    let row = |i: usize| &rows[i * columns..(i + 1) * columns];
    let largest = (0..n).map(|i| row(i)[i].abs()).fold(0.0, f64::max);
    for i in (0..n).rev() {
        let (own, others) = row(i).split_at(n);
        let (of_next, others) = others.split_at(next.len());
        let pivot = own[i].abs();
        if pivot <= SINGULAR * largest || pivot.is_nan() {
            return None;
        }
        let known = dot(&own[i + 1..], &y[i + 1..]) + dot(of_next, next) + dot(others, shared);
        y[i] = (others[shared.len()] - known) / own[i];
    }
    Some(())
}
