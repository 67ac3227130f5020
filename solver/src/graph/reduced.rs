//! What is left after the elimination of blocks, and its Cholesky factor: dense or sparse.

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

use super::structure::{Pattern, Structure};
use crate::error::Error;

/// The lower triangle of the matrix that is left (`n × n`), and its factor.
pub(crate) enum Reduced {
    /// All of it, column after column; factored in place.
    Dense {
        /// Number of unknowns.
        n: usize,
        /// The blocks of the lower triangle, each in one piece: what is added up there again and again
        /// touches few pages.
        blocks: Vec<f64>,
        /// Where the blocks of every column begin, and its first unknown and width.
        columns: Vec<(usize, usize, usize)>,
        /// The matrix, or its factor, column after column.
        matrix: Vec<f64>,
        /// Room to work.
        memory: MemBuffer,
    },
    /// Only the blocks that are not zero.
    Sparse(Box<Sparse>),
}

/// A block-sparse lower triangle, and its factor.
pub(crate) struct Sparse {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    /// First unknown of every position.
    first: Vec<usize>,
    /// Rows' positions of every column, ascending, from the diagonal on.
    pattern: Vec<Vec<u32>>,
    /// Where in the first column of a block column each of them begins.
    offset: Vec<Vec<u32>>,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

/// Where the columns of a block lie: column `c` begins at `base + c · stride`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub base: usize,
    pub stride: usize,
}

impl Reduced {
    /// Room for the pattern of a structure.
    pub fn new(structure: &Structure) -> Result<Self, Error> {
        let unknowns = structure.unknowns() - structure.split();
        let too_large = Error::TooLarge { unknowns };
        match &structure.reduced {
            Pattern::Dense => {
                let need = cholesky_in_place_scratch::<f64>(unknowns, Par::Seq, Default::default())
                    .or(solve_in_place_scratch::<f64>(unknowns, 1, Par::Seq));
                let mut columns = Vec::new();
                let mut entries = 0;
                for position in structure.eliminated..structure.order.len() {
                    let first = structure.first[position] - structure.split();
                    let width = structure.width(position);
                    columns.push((entries, first, width));
                    entries += (unknowns - first) * width;
                }
                Ok(Self::Dense {
                    n: unknowns,
                    blocks: vec![0.0; entries],
                    columns,
                    matrix: vec![0.0; unknowns * unknowns],
                    memory: MemBuffer::try_new(need).map_err(|_| too_large)?,
                })
            }
            Pattern::Sparse(pattern) => {
                let first = structure.first[structure.eliminated..]
                    .iter()
                    .map(|f| f - structure.split())
                    .collect();
                let sparse = Sparse::new(pattern, first).ok_or(too_large)?;
                Ok(Self::Sparse(Box::new(sparse)))
            }
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        match self {
            Self::Dense { blocks, .. } => blocks.fill(0.0),
            Self::Sparse(sparse) => sparse.values.fill(0.0),
        }
    }

    /// The entries, among which a [`Place`] points.
    pub fn entries(&mut self) -> &mut [f64] {
        match self {
            Self::Dense { blocks, .. } => blocks,
            Self::Sparse(sparse) => &mut sparse.values,
        }
    }

    /// Where the block of two positions lies (both less the number eliminated, `row ≥ column`), whose unknowns begin at `row_first` and `column_first`; `None` where the pattern
    /// has none.
    #[inline(always)]
    pub fn place(&self, row: u32, column: u32, row_first: usize, rows: usize) -> Option<Place> {
        match self {
            Self::Dense { columns, .. } => {
                let (base, first, width) = columns[column as usize];
                Some(Place {
                    base: base + (row_first - first) * width,
                    stride: rows,
                })
            }
            Self::Sparse(sparse) => sparse.place(row, column),
        }
    }

    /// Factors the matrix; `false` where it is not positive definite.
    pub fn factor(&mut self) -> bool {
        match self {
            Self::Dense {
                n,
                blocks,
                columns,
                matrix,
                memory,
            } => {
                spread(blocks, columns, *n, matrix);
                let a = MatMut::from_column_major_slice_mut(matrix, *n, *n);
                let factored = cholesky_in_place(
                    a,
                    LltRegularization::default(),
                    Par::Seq,
                    MemStack::new(memory),
                    Default::default(),
                );
                factored.is_ok() && (0..*n).all(|k| matrix[k * (*n + 1)].is_finite())
            }
            Self::Sparse(sparse) => sparse.factor(),
        }
    }

    /// Solves for as many right sides as `b` has columns of `n`, in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense { n, matrix, .. } => {
                if *n == 0 {
                    return;
                }
                let columns = b.len() / *n;
                let right = MatMut::from_column_major_slice_mut(b, *n, columns);
                let factor = MatRef::from_column_major_slice(matrix, *n, *n);
                let need = solve_in_place_scratch::<f64>(*n, columns, Par::Seq);
                let mut more = MemBuffer::new(need);
                solve_in_place(factor, right, Par::Seq, MemStack::new(&mut more));
            }
            Self::Sparse(sparse) => sparse.solve(b),
        }
    }

    /// `ln det` of the matrix, from its factor.
    pub fn log_determinant(&self) -> f64 {
        match self {
            Self::Dense { n, matrix, .. } => {
                2.0 * (0..*n).map(|k| matrix[k * (n + 1)].ln()).sum::<f64>()
            }
            Self::Sparse(sparse) => sparse.log_determinant(),
        }
    }

    /// Entries of the factor.
    pub fn size(&self) -> usize {
        match self {
            Self::Dense { n, .. } => n * (n + 1) / 2,
            Self::Sparse(sparse) => sparse.factor.len(),
        }
    }
}

/// Writes blocks into the lower triangle of a matrix.
fn spread(blocks: &[f64], columns: &[(usize, usize, usize)], n: usize, matrix: &mut [f64]) {
    for (k, &(base, first, width)) in columns.iter().enumerate() {
        let mut at = base;
        for &(_, row_first, rows) in &columns[k..] {
            for c in 0..width {
                let to = (first + c) * n + row_first;
                matrix[to..to + rows].copy_from_slice(&blocks[at..at + rows]);
                at += rows;
            }
        }
    }
}

impl Sparse {
    /// Lays out the blocks and works out the pattern of the factor.
    fn new(pattern: &[Vec<u32>], mut first: Vec<usize>) -> Option<Self> {
        if first.is_empty() {
            first.push(0);
        }
        let n = first[first.len() - 1];
        let width = |position: u32| first[position as usize + 1] - first[position as usize];
        let (mut starts, mut rows) = (vec![0u32], Vec::<u32>::new());
        let mut offset = Vec::with_capacity(pattern.len());
        for (column, below) in pattern.iter().enumerate() {
            let mut at = 0;
            let mut own = Vec::with_capacity(below.len());
            for &row in below {
                own.push(at);
                at += u32::try_from(width(row)).ok()?;
            }
            offset.push(own);
            for _ in 0..width(column as u32) {
                // The block on the diagonal as a whole; the factorisation skips what is above.
                for &row in below {
                    let own = first[row as usize]..first[row as usize + 1];
                    rows.extend(own.map(|r| r as u32));
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
            first,
            pattern: pattern.to_vec(),
            offset,
            symbolic,
        })
    }

    #[inline]
    fn place(&self, row: u32, column: u32) -> Option<Place> {
        let column = column as usize;
        let k = self.pattern[column].binary_search(&row).ok()?;
        let start = self.starts[self.first[column]] as usize;
        let rows = self.starts[self.first[column] + 1] as usize - start;
        let base = start + self.offset[column][k] as usize;
        Some(Place { base, stride: rows })
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
