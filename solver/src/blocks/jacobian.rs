//! The Jacobian of a block problem: only the columns that each term touches.

use faer::Mat;

use super::elimination::Elimination;
use crate::linear;

/// Columns in the order shared parameters, block 0, block 1, …; terms in the order of blocks.
#[derive(Clone, Debug)]
pub(crate) struct BlockJacobian {
    /// Number of shared columns `s`.
    pub shared: usize,
    /// First column of every block, and the number of columns.
    pub offsets: Vec<usize>,
    /// The rows, term by term, ascending in their block.
    pub terms: Vec<TermJacobian>,
}

/// The rows of one term.
#[derive(Clone, Debug)]
pub(crate) struct TermJacobian {
    /// Block of the term.
    pub block: usize,
    /// Whether the next block's columns follow.
    pub coupled: bool,
    /// Place of the term's first residual.
    pub first_row: usize,
    /// Derivatives by the shared parameters, the block's and the next block's.
    pub matrix: Mat<f64>,
}

impl BlockJacobian {
    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.offsets.last().copied().unwrap_or(self.shared)
    }

    /// Number of parameters of a block.
    pub fn width(&self, block: usize) -> usize {
        self.offsets[block + 1] - self.offsets[block]
    }

    /// Column of the whole that a term's own column is.
    pub fn column(&self, term: &TermJacobian, own: usize) -> usize {
        if own < self.shared {
            own
        } else {
            self.offsets[term.block] + own - self.shared
        }
    }

    /// `‖J_k‖` of every column.
    pub fn column_norms(&self) -> Vec<f64> {
        let mut norms = vec![0.0f64; self.columns()];
        for term in &self.terms {
            for (own, column) in term.matrix.col_iter().enumerate() {
                let place = self.column(term, own);
                norms[place] = norms[place].hypot(column.norm_l2());
            }
        }
        norms
    }

    /// `J p`.
    pub fn multiply(&self, p: &[f64]) -> Vec<f64> {
        let mut out = Vec::new();
        for term in &self.terms {
            let own: Vec<f64> = (0..term.matrix.ncols())
                .map(|k| p[self.column(term, k)])
                .collect();
            out.extend(linear::multiply(term.matrix.as_ref(), &own));
        }
        out
    }

    /// `Jᵀ b`.
    pub fn transpose_multiply(&self, b: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.columns()];
        for term in &self.terms {
            let rows = &b[term.first_row..term.first_row + term.matrix.nrows()];
            for (own, value) in linear::transpose_multiply(term.matrix.as_ref(), rows)
                .into_iter()
                .enumerate()
            {
                out[self.column(term, own)] += value;
            }
        }
        out
    }

    /// Scales row `i` by `factors[i]`.
    pub fn scale_rows(&mut self, factors: &[f64]) {
        for term in &mut self.terms {
            for column in term.matrix.col_iter_mut() {
                for (value, factor) in column.iter_mut().zip(&factors[term.first_row..]) {
                    *value *= factor;
                }
            }
        }
    }

    /// Row and column of the first entry that is not finite.
    pub fn not_finite(&self) -> Option<(usize, usize)> {
        self.terms.iter().find_map(|term| {
            let (row, own) = linear::not_finite(&term.matrix)?;
            Some((term.first_row + row, self.column(term, own)))
        })
    }

    /// Prepares the elimination of the blocks.
    pub fn eliminate(&self, scale: &[f64]) -> Elimination<'_> {
        Elimination::new(self, scale)
    }
}
