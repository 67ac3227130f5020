//! Equations left after the elimination of blocks, and their Cholesky factor: dense or sparse.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::cholesky::llt::solve::{solve_in_place, solve_in_place_scratch};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, MatRef, Par, Side};

use super::block_cholesky::BlockCholesky;
use super::blocks::{Aligned, Column, Layout, pack_negative, unpack_negative};
use super::structure::{Pattern, Structure};
use crate::error::Error;

/// The lower triangle of the matrix that is left (`n × n`), and its factor.
pub(crate) struct Reduced {
    pub layout: Layout,
    /// Blocks of the negative of the matrix, into which others are eliminated; none where none are.
    pub blocks: Aligned,
    matrix: Matrix,
}

/// The matrix, then its factor.
enum Matrix {
    /// All of it, column after column; factored in place.
    Dense {
        n: usize,
        values: Vec<f64>,
        memory: MemBuffer,
    },
    /// Only the blocks that are not zero.
    Sparse(Box<Sparse>),
    /// Those, and the blocks that the factor has besides; factored in place.
    Blocks(Box<BlockCholesky>),
}

/// A block-sparse lower triangle, column after column, and its factor.
struct Sparse {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

impl Reduced {
    /// Room for the pattern of a structure.
    pub fn new(structure: &Structure) -> Result<Self, Error> {
        let n = structure.unknowns() - structure.split();
        let too_large = || Error::TooLarge { unknowns: n };
        let layout = Layout::new(structure).ok_or_else(too_large)?;
        let matrix = match &structure.reduced {
            Pattern::Dense => {
                let need = cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default())
                    .or(solve_in_place_scratch::<f64>(n, 1, Par::Seq));
                Matrix::Dense {
                    n,
                    values: vec![0.0; n * n],
                    memory: MemBuffer::try_new(need).map_err(|_| too_large())?,
                }
            }
            Pattern::Sparse(_) => {
                Matrix::Sparse(Box::new(Sparse::new(&layout).ok_or_else(too_large)?))
            }
            Pattern::Filled(filled) => {
                let blocks = BlockCholesky::new(&layout, filled.tail).ok_or_else(too_large)?;
                Matrix::Blocks(Box::new(blocks))
            }
        };
        let blocks = Aligned::new(match structure.eliminated {
            0 => 0,
            _ => layout.entries(),
        });
        Ok(Self {
            layout,
            blocks,
            matrix,
        })
    }

    /// Writes what `H + diag(more)` has of the blocks that are left: into the matrix where nothing is
    /// eliminated, else, negative, into the blocks.
    pub fn load(&mut self, s: &Structure, h: &[f64], more: &[f64]) {
        let base = s.eliminated;
        if base > 0 {
            self.blocks.entries().fill(0.0);
        } else {
            match &mut self.matrix {
                Matrix::Dense { values, .. } => values.fill(0.0),
                Matrix::Blocks(blocks) => blocks.clear(),
                Matrix::Sparse(_) => {}
            }
        }
        for position in base..s.order.len() {
            let width = s.width(position);
            let reach = self.layout.reach(position - base);
            for slot in s.column[position]..s.column[position + 1] {
                let row = s.row[slot] as usize;
                let rows = s.width(row);
                let own = &h[s.entry[slot]..s.entry[slot + 1]];
                let place = reach.place((row - base) as u32, s.first[row] - s.split());
                let Some((place, offset)) = place else {
                    continue;
                };
                if base > 0 {
                    let block = &mut self.blocks.entries()[place..place + own.len()];
                    pack_negative(block, rows, own);
                    continue;
                }
                let (out, stride) = self.matrix.columns(&reach.column, offset);
                for (c, values) in own.chunks_exact(rows.max(1)).enumerate() {
                    out[c * stride..c * stride + rows].copy_from_slice(values);
                }
            }
            if base == 0 {
                let (out, stride) = self.matrix.columns(&reach.column, 0);
                for c in 0..width {
                    out[c * (stride + 1)] += more[s.first[position] + c];
                }
            }
        }
    }

    /// Writes the blocks, when others have been eliminated into them, into the matrix.
    pub fn assemble(&mut self, s: &Structure, more: &[f64]) {
        for k in 0..self.layout.columns.len() {
            let column = self.layout.columns[k];
            let (blocks, matrix) = (self.blocks.entries(), &mut self.matrix);
            self.layout.of_column(k, |row, offset, from| {
                let rows = s.width(row + s.eliminated);
                let block = &blocks[from..from + rows * column.width];
                let (out, stride) = matrix.columns(&column, offset);
                unpack_negative(block, rows, column.width, out, stride);
            });
            let (out, stride) = self.matrix.columns(&column, 0);
            for c in 0..column.width {
                out[c * (stride + 1)] += more[s.split() + column.first + c];
            }
        }
    }

    /// Factors the matrix; `false` where it is not positive definite.
    pub fn factor(&mut self) -> bool {
        match &mut self.matrix {
            Matrix::Dense { n, values, memory } => {
                let factored = cholesky_in_place(
                    MatMut::from_column_major_slice_mut(values, *n, *n),
                    LltRegularization::default(),
                    Par::Seq,
                    MemStack::new(memory),
                    Default::default(),
                );
                factored.is_ok() && (0..*n).all(|k| values[k * (*n + 1)].is_finite())
            }
            Matrix::Sparse(sparse) => sparse.factor(),
            Matrix::Blocks(blocks) => blocks.factor(),
        }
    }

    /// Solves for as many right sides as `b` has columns of `n`, in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        match &mut self.matrix {
            Matrix::Dense { n: 0, .. } => {}
            Matrix::Dense { n, values, .. } => {
                let columns = b.len() / *n;
                let right = MatMut::from_column_major_slice_mut(b, *n, columns);
                let factor = MatRef::from_column_major_slice(values, *n, *n);
                let need = solve_in_place_scratch::<f64>(*n, columns, Par::Seq);
                let mut more = MemBuffer::new(need);
                solve_in_place(factor, right, Par::Seq, MemStack::new(&mut more));
            }
            Matrix::Sparse(sparse) => sparse.solve(b),
            Matrix::Blocks(blocks) => blocks.solve(b),
        }
    }

    /// `ln det` of the matrix, from its factor.
    pub fn log_determinant(&self) -> f64 {
        match &self.matrix {
            Matrix::Dense { n, values, .. } => {
                2.0 * (0..*n).map(|k| values[k * (n + 1)].ln()).sum::<f64>()
            }
            Matrix::Sparse(sparse) => sparse.log_determinant(),
            Matrix::Blocks(blocks) => blocks.log_determinant(),
        }
    }

    /// Entries of the factor.
    pub fn size(&self) -> usize {
        match &self.matrix {
            Matrix::Dense { n, .. } => n * (n + 1) / 2,
            Matrix::Sparse(sparse) => sparse.factor.len(),
            Matrix::Blocks(blocks) => blocks.size(),
        }
    }
}

impl Matrix {
    /// The values of a column of blocks from a row on, so many rows of numbers below its diagonal,
    /// and how far its columns are apart.
    #[inline]
    fn columns(&mut self, column: &Column, offset: usize) -> (&mut [f64], usize) {
        match self {
            Self::Dense { n, values, .. } => {
                let from = column.first * (*n + 1) + offset;
                (&mut values[from..], *n)
            }
            Self::Blocks(blocks) => blocks.columns(column, offset),
            Self::Sparse(sparse) => {
                let start = sparse.starts[column.first] as usize;
                let stride = sparse.starts[column.first + 1] as usize - start;
                (&mut sparse.values[start + offset..], stride)
            }
        }
    }
}

impl Sparse {
    /// Lays out the blocks and works out the pattern of the factor.
    fn new(layout: &Layout) -> Option<Self> {
        let n = layout.unknowns;
        let (mut starts, mut rows) = (vec![0u32], Vec::<u32>::new());
        for (k, column) in layout.columns.iter().enumerate() {
            let from = rows.len();
            // The block on the diagonal as a whole; the factorisation skips what is above.
            layout.of_column(k, |row, _, _| {
                let Column { first, width, .. } = layout.columns[row];
                rows.extend((first..first + width).map(|r| r as u32));
            });
            let height = rows.len() - from;
            for c in 0..column.width {
                if c > 0 {
                    rows.extend_from_within(from..from + height);
                }
                starts.push(u32::try_from(rows.len()).ok()?);
            }
        }
        let symbolic = symbolic(n, &starts, &rows)?;
        let need = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Some(Self {
            values: vec![0.0; rows.len()],
            factor: vec![0.0; symbolic.len_val()],
            memory: MemBuffer::try_new(need).ok()?,
            starts,
            rows,
            symbolic,
        })
    }

    fn factor(&mut self) -> bool {
        // Infinite entries are no error to every path of the factorisation.
        if !self.values.iter().all(|v| v.is_finite()) {
            return false;
        }
        let n = self.starts.len() - 1;
        let matrix = SparseColMatRef::new(
            SymbolicSparseColMatRef::new_checked(n, n, &self.starts, None, &self.rows),
            &self.values[..],
        );
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .is_ok()
    }

    fn solve(&mut self, b: &mut [f64]) {
        let n = self.starts.len() - 1;
        if n == 0 {
            return;
        }
        let columns = b.len() / n;
        let factor = LltRef::new(&self.symbolic, &self.factor);
        let right = MatMut::from_column_major_slice_mut(b, n, columns);
        let need = self
            .symbolic
            .solve_in_place_scratch::<f64>(columns, Par::Seq);
        let mut more;
        let memory = if columns > 1 {
            more = MemBuffer::new(need);
            &mut more
        } else {
            &mut self.memory
        };
        factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(memory));
    }

    fn log_determinant(&self) -> f64 {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            return f64::NAN;
        };
        let factor = faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef::new(
            symbolic,
            &self.factor[..],
        );
        let mut sum = 0.0;
        for s in 0..symbolic.n_supernodes() {
            let values = factor.supernode(s).val();
            sum += (0..values.ncols())
                .map(|k| values[(k, k)].ln())
                .sum::<f64>();
        }
        2.0 * sum
    }
}

/// The pattern of the factor of a lower triangle whose order is final. The symbolic step reads the
/// upper triangle.
fn symbolic(n: usize, starts: &[u32], rows: &[u32]) -> Option<SymbolicCholesky<u32>> {
    let lower = |column: usize| {
        let own = &rows[starts[column] as usize..starts[column + 1] as usize];
        own.iter().filter(move |&&row| row as usize >= column)
    };
    let mut upper_starts = vec![0u32; n + 1];
    for column in 0..n {
        lower(column).for_each(|&row| upper_starts[row as usize + 1] += 1);
    }
    for k in 0..n {
        upper_starts[k + 1] += upper_starts[k];
    }
    let mut next = upper_starts.clone();
    let mut upper = vec![0u32; upper_starts[n] as usize];
    for column in 0..n {
        for &row in lower(column) {
            upper[next[row as usize] as usize] = column as u32;
            next[row as usize] += 1;
        }
    }
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &upper_starts, None, &upper);
    let params = CholeskySymbolicParams {
        // The choice by flops takes the scalar method for small blocks, 3 to 6 times slower.
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    factorize_symbolic_cholesky(pattern, Side::Upper, SymmetricOrdering::Identity, params).ok()
}
