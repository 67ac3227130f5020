//! Elimination of the blocks by orthogonal transformations, one block after the other.

use std::cell::OnceCell;
use std::ops::Range;

use super::jacobian::BlockJacobian;
use super::stack::Stack;
use crate::linear::Factor;
use crate::vector::{dot, norm};

/// What is left of a column, relative to its length, at which it counts as a combination of those
/// eliminated before it.
const DEPENDENT: f64 = 1e-13;

/// The Schur complement in square-root form.
///
/// The rows of block `i` (its terms, its damping, what is left of the blocks before) are brought to
/// triangular form in the column order block `i`, block `i + 1`, shared, right side. The first rows
/// give block `i` from what follows; the rest is passed on. The normal equations are never formed.
/// Parameters that the rows do not determine take no row and stay where they are.
pub(crate) struct Elimination<'a> {
    jacobian: &'a BlockJacobian,
    scale: Vec<f64>,
    /// Number of terms before each block's first.
    first_term: Vec<usize>,
    /// Length of every column of `J D⁻¹` below which it counts as dependent.
    floors: Vec<f64>,
    /// The first right side without damping, eliminated: its length and its step are asked together.
    undamped: OnceCell<(Vec<f64>, Reduced)>,
}

/// The triangle that is left after the last block, and the way back.
pub(crate) struct Reduced {
    /// `[R S T d]` of every block, `R y_block + S y_next + T y_shared = d`, row after row.
    rows: Vec<f64>,
    /// The block's own parameter in which each row of every block begins, row after row.
    pivots: Vec<usize>,
    blocks: Vec<Eliminated>,
    /// Triangle of the shared parameters with the right side as last column.
    pub shared: Stack,
    /// The shared parameters in which its rows begin.
    shared_pivots: Vec<usize>,
}

/// Where the rows of an eliminated block lie.
struct Eliminated {
    first_entry: usize,
    pivots: Range<usize>,
    next: usize,
}

impl Reduced {
    /// How many parameters of all blocks the rows determine, given the shared ones.
    pub fn rank_of_blocks(&self) -> usize {
        self.pivots.len()
    }
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
        let norms = jacobian.column_norms();
        let floors = norms.iter().zip(scale).map(|(n, s)| DEPENDENT * n / s);
        Self {
            jacobian,
            scale: scale.to_vec(),
            first_term,
            floors: floors.collect(),
            undamped: OnceCell::new(),
        }
    }

    /// Eliminates every block from `‖J D⁻¹ y + b‖² + λ ‖y‖²`.
    pub fn reduce(&self, b: &[f64], lambda: f64) -> Reduced {
        let shared = self.jacobian.shared;
        let count = self.first_term.len() - 1;
        let mut reduced = Reduced {
            rows: Vec::new(),
            pivots: Vec::new(),
            blocks: Vec::with_capacity(count),
            shared: Stack::default(),
            shared_pivots: Vec::new(),
        };
        let (mut floors, mut pivots) = (Vec::new(), Vec::new());
        let (mut stack, mut passed_on) = (Stack::default(), Stack::default());
        passed_on.clear(0, shared + 1);
        for block in 0..count {
            let (own, next) = self.stack(block, &passed_on, b, lambda, &mut stack);
            self.floors_of(block, own + next, &mut floors);
            stack.triangularise(&floors, &mut pivots);
            let rank = pivots.iter().take_while(|&&column| column < own).count();
            let first = reduced.pivots.len();
            reduced.pivots.extend_from_slice(&pivots[..rank]);
            reduced.blocks.push(Eliminated {
                first_entry: reduced.rows.len(),
                pivots: first..first + rank,
                next,
            });
            stack.copy_rows(rank, &mut reduced.rows);
            stack.copy_corner(rank..pivots.len(), own, &mut passed_on);
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
        self.floors_of(count, 0, &mut floors);
        reduced.shared.triangularise(&floors, &mut pivots);
        pivots.retain(|&column| column < shared);
        reduced.shared_pivots = pivots;
        reduced
    }

    /// The floors of a stack's columns: `width` from the first of a block on, then the shared ones
    /// and the right side.
    fn floors_of(&self, block: usize, width: usize, floors: &mut Vec<f64>) {
        let first = self.jacobian.offsets[block];
        floors.clear();
        floors.extend_from_slice(&self.floors[first..first + width]);
        floors.extend_from_slice(&self.floors[..self.jacobian.shared]);
        floors.push(0.0);
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

    /// The step from the shared parameters back to the first block; `None` where it is not finite.
    fn back(&self, reduced: &Reduced) -> Option<Vec<f64>> {
        let j = self.jacobian;
        let s = j.shared;
        let mut rows = Vec::new();
        reduced
            .shared
            .copy_rows(reduced.shared_pivots.len(), &mut rows);
        let mut y = vec![0.0; j.columns()];
        let (shared, blocks) = y.split_at_mut(s);
        back_substitute(&rows, &reduced.shared_pivots, shared, &[], &[]);
        for (block, eliminated) in reduced.blocks.iter().enumerate().rev() {
            let start = j.offsets[block] - s;
            let (before, after) = blocks.split_at_mut(start + j.width(block));
            back_substitute(
                &reduced.rows[eliminated.first_entry..],
                &reduced.pivots[eliminated.pivots.clone()],
                &mut before[start..],
                &after[..eliminated.next],
                shared,
            );
        }
        for (y, scale) in y.iter_mut().zip(&self.scale) {
            *y /= scale;
        }
        y.iter().all(|v| v.is_finite()).then_some(y)
    }

    /// What is asked of the undamped elimination of a right side.
    fn without_damping<T>(&self, b: &[f64], ask: impl Fn(&Reduced) -> T) -> T {
        let eliminated = || (b.to_vec(), self.reduce(b, 0.0));
        let (first, reduced) = self.undamped.get_or_init(eliminated);
        if first == b {
            ask(reduced)
        } else {
            ask(&self.reduce(b, 0.0))
        }
    }

    /// Length of the rotated right side in the rows that begin in a parameter.
    fn length_within(&self, reduced: &Reduced) -> f64 {
        let j = self.jacobian;
        let last = reduced.shared.column(j.shared);
        let mut rotated = last[..reduced.shared_pivots.len()].to_vec();
        for (block, eliminated) in reduced.blocks.iter().enumerate() {
            let columns = j.width(block) + eliminated.next + j.shared + 1;
            let rows = reduced.rows[eliminated.first_entry..].chunks_exact(columns);
            rotated.extend(
                rows.take(eliminated.pivots.len())
                    .map(|row| row[columns - 1]),
            );
        }
        norm(&rotated)
    }
}

impl Factor for Elimination<'_> {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        self.back(&self.reduce(b, lambda))
    }

    /// Where the rank is short, not the shortest but the one that leaves the parameters that depend
    /// on others where they are.
    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        self.without_damping(b, |reduced| self.back(reduced))
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        self.without_damping(b, |reduced| self.length_within(reduced))
    }
}

/// Solves `R y + S next + T shared = d` for `y`, given the rows `[R S T d]` one after the other and
/// the columns in which they begin; a parameter in which none begins stays zero.
fn back_substitute(rows: &[f64], pivots: &[usize], y: &mut [f64], next: &[f64], shared: &[f64]) {
    let n = y.len();
    let columns = n + next.len() + shared.len() + 1;
    for (&pivot, row) in pivots.iter().zip(rows.chunks_exact(columns)).rev() {
        let (own, others) = row.split_at(n);
        let (of_next, others) = others.split_at(next.len());
        let from = pivot + 1;
        let known = dot(&own[from..], &y[from..]) + dot(of_next, next) + dot(others, shared);
        y[pivot] = (others[shared.len()] - known) / own[pivot];
    }
}
