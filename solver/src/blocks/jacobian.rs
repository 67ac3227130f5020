//! The Jacobian of a block problem: only the columns that each term touches.

use faer::MatRef;

use super::elimination::Elimination;
use crate::vector::{add_to, dot, norm};

/// Columns in the order shared parameters, block 0, block 1, …; terms in the order of blocks.
///
/// The entries of all terms lie in one piece: a matrix allocated for every term costs more to place
/// in memory, the more of them there are, than to compute with.
#[derive(Clone, Debug)]
pub(crate) struct BlockJacobian {
    /// Number of shared columns `s`.
    pub shared: usize,
    /// First column of every block, and the number of columns.
    pub offsets: Vec<usize>,
    /// The rows, term by term, ascending in their block.
    pub terms: Vec<TermRows>,
    /// Derivatives of the terms by the shared parameters, the block's and the next block's; term
    /// after term, column after column.
    entries: Vec<f64>,
}

/// Where the rows of one term lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TermRows {
    /// Block of the term.
    pub block: usize,
    /// Whether the next block's columns follow.
    pub coupled: bool,
    /// Place of the term's first residual.
    pub first_row: usize,
    /// Number of residuals.
    pub rows: usize,
    first_entry: usize,
}

impl BlockJacobian {
    /// No terms yet.
    pub fn new(shared: usize, offsets: Vec<usize>, terms: usize) -> Self {
        Self {
            shared,
            offsets,
            terms: Vec::with_capacity(terms),
            entries: Vec::new(),
        }
    }

    /// Appends a term, which is of the last block so far or of one after it.
    pub fn push(&mut self, block: usize, coupled: bool, matrix: MatRef<'_, f64>) {
        let first_row = self.rows();
        self.terms.push(TermRows {
            block,
            coupled,
            first_row,
            rows: matrix.nrows(),
            first_entry: self.entries.len(),
        });
        for column in matrix.col_iter() {
            self.entries.extend(column.iter());
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.terms.last().map_or(0, |t| t.first_row + t.rows)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.offsets.last().copied().unwrap_or(self.shared)
    }

    /// Number of parameters of a block.
    pub fn width(&self, block: usize) -> usize {
        self.offsets[block + 1] - self.offsets[block]
    }

    /// The columns of a term (`rows` each): where in the whole each is, and its entries.
    pub fn term_columns(&self, term: &TermRows) -> impl Iterator<Item = (usize, &[f64])> {
        let last = self.offsets[term.block + 1 + usize::from(term.coupled)];
        let places = (0..self.shared).chain(self.offsets[term.block]..last);
        let (first, rows) = (term.first_entry, term.rows);
        places.enumerate().map(move |(own, place)| {
            let entries = &self.entries[first + own * rows..first + (own + 1) * rows];
            (place, entries)
        })
    }

    /// `‖J_k‖` of every column.
    pub fn column_norms(&self) -> Vec<f64> {
        let mut norms = vec![0.0f64; self.columns()];
        for term in &self.terms {
            for (place, column) in self.term_columns(term) {
                norms[place] = norms[place].hypot(norm(column));
            }
        }
        norms
    }

    /// `J p`.
    pub fn multiply(&self, p: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.rows()];
        for term in &self.terms {
            let rows = &mut out[term.first_row..term.first_row + term.rows];
            for (place, column) in self.term_columns(term) {
                add_to(rows, p[place], column);
            }
        }
        out
    }

    /// `Jᵀ b`.
    pub fn transpose_multiply(&self, b: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.columns()];
        for term in &self.terms {
            let rows = &b[term.first_row..term.first_row + term.rows];
            for (place, column) in self.term_columns(term) {
                out[place] += dot(column, rows);
            }
        }
        out
    }

    /// Scales row `i` by `factors[i]`.
    pub fn scale_rows(&mut self, factors: &[f64]) {
        for t in 0..self.terms.len() {
            let term = self.terms[t];
            let next = self.terms.get(t + 1);
            let end = next.map_or(self.entries.len(), |next| next.first_entry);
            let factors = &factors[term.first_row..term.first_row + term.rows];
            for column in self.entries[term.first_entry..end].chunks_exact_mut(term.rows.max(1)) {
                for (value, factor) in column.iter_mut().zip(factors) {
                    *value *= factor;
                }
            }
        }
    }

    /// Row and column of the first entry that is not finite.
    pub fn not_finite(&self) -> Option<(usize, usize)> {
        if self.entries.iter().all(|v| v.is_finite()) {
            return None;
        }
        self.terms.iter().find_map(|term| {
            self.term_columns(term).find_map(|(place, column)| {
                let row = column.iter().position(|v| !v.is_finite())?;
                Some((term.first_row + row, place))
            })
        })
    }

    /// Prepares the elimination of the blocks.
    pub fn eliminate(&self, scale: &[f64]) -> Elimination<'_> {
        Elimination::new(self, scale)
    }
}
