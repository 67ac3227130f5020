//! The blocks of the matrix that is left, each in one piece, while others are eliminated into them.

use super::structure::Structure;

/// Rows of a block that are stored column after column; the others follow, each in one piece. So
/// both parts fill vectors: of 9 × 9 it is 8 × 9 and a row of 9.
pub(crate) const fn body(rows: usize) -> usize {
    match rows {
        9 => 8,
        6 | 7 => 4,
        _ => rows,
    }
}

/// A column of blocks: its first entry, first unknown and width.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    pub base: usize,
    pub first: usize,
    pub width: usize,
}

/// Places of the blocks of the lower triangle.
#[derive(Debug)]
pub(crate) struct Layout {
    pub columns: Vec<Column>,
    /// Rows of every column one after the other; of a dense matrix none.
    rows: Option<Rows>,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Number of entries of all blocks.
    entries: usize,
    /// Entries after every block that are not used, where all have the same shape: each then begins
    /// with a line of the cache.
    pad: usize,
}

/// Entries of a line of the cache.
const LINE: usize = 8;

/// Numbers that begin with a line of the cache.
#[derive(Debug)]
pub(crate) struct Aligned {
    all: Vec<f64>,
    first: usize,
    length: usize,
}

impl Aligned {
    /// So many zeros.
    pub fn new(length: usize) -> Self {
        let all = vec![0.0; length + LINE - 1];
        let first = all.as_ptr().align_offset(LINE * size_of::<f64>());
        Self {
            first: first.min(LINE - 1),
            all,
            length,
        }
    }

    /// The numbers.
    pub fn entries(&mut self) -> &mut [f64] {
        &mut self.all[self.first..self.first + self.length]
    }
}

/// The rows of a block-sparse lower triangle.
#[derive(Debug)]
struct Rows {
    /// First row of every column, and their number.
    start: Vec<u32>,
    /// Position of every row, ascending within a column from the diagonal on.
    position: Vec<u32>,
    /// Rows of numbers before it in its column.
    offset: Vec<u32>,
}

/// A column and the rows in it.
#[derive(Clone, Copy)]
pub(crate) struct Reach<'a> {
    pub column: Column,
    position: usize,
    pad: usize,
    rows: Option<(&'a [u32], &'a [u32])>,
}

impl Layout {
    /// The layout of what a structure leaves; `None` where there are too many entries.
    pub fn new(structure: &Structure) -> Option<Self> {
        let split = structure.split();
        let positions = structure.eliminated..structure.order.len();
        let unknowns = structure.unknowns() - split;
        let pattern = structure.reduced.rows();
        let mut rows = pattern.map(|all| Rows {
            start: Vec::with_capacity(positions.len() + 1),
            position: Vec::with_capacity(all.iter().map(Vec::len).sum()),
            offset: Vec::with_capacity(all.iter().map(Vec::len).sum()),
        });
        let mut columns = Vec::with_capacity(positions.len());
        let mut entries = 0;
        let mut widths = positions.clone().map(|p| structure.width(p));
        let width = widths.next().unwrap_or(0);
        let pad = match widths.all(|other| other == width) {
            true => (width * width).next_multiple_of(LINE) - width * width,
            false => 0,
        };
        let last = positions.end;
        for position in positions {
            let first = structure.first[position] - split;
            let width = structure.width(position);
            columns.push(Column {
                base: entries,
                first,
                width,
            });
            let mut height = unknowns - first;
            let mut blocks = last - position;
            if let (Some(rows), Some(all)) = (&mut rows, pattern) {
                rows.start.push(u32::try_from(rows.position.len()).ok()?);
                height = 0;
                blocks = all[position - structure.eliminated].len();
                for &row in &all[position - structure.eliminated] {
                    rows.position.push(row);
                    rows.offset.push(u32::try_from(height).ok()?);
                    height += structure.width(row as usize + structure.eliminated);
                }
            }
            entries += height * width + blocks * pad;
        }
        if let Some(rows) = &mut rows {
            rows.start.push(u32::try_from(rows.position.len()).ok()?);
        }
        Some(Self {
            columns,
            rows,
            unknowns,
            entries,
            pad,
        })
    }

    /// Number of entries of all blocks.
    pub fn entries(&self) -> usize {
        self.entries
    }

    /// A column by its position (less the number eliminated).
    #[inline(always)]
    pub fn reach(&self, column: usize) -> Reach<'_> {
        Reach {
            column: self.columns[column],
            position: column,
            pad: self.pad,
            rows: self.rows.as_ref().map(|rows| {
                let own = rows.start[column] as usize..rows.start[column + 1] as usize;
                (&rows.position[own.clone()], &rows.offset[own])
            }),
        }
    }

    /// Shows every block of a column: position of the row, rows of numbers before it counted from
    /// the diagonal (as they are stored), and its first entry.
    pub fn of_column(&self, column: usize, mut see: impl FnMut(usize, usize, usize)) {
        let reach = self.reach(column);
        let Column { base, first, width } = reach.column;
        match reach.rows {
            Some((positions, offsets)) => {
                for (k, (&row, &offset)) in positions.iter().zip(offsets).enumerate() {
                    let place = base + offset as usize * width + k * self.pad;
                    see(row as usize, offset as usize, place);
                }
            }
            None => {
                for (row, other) in self.columns.iter().enumerate().skip(column) {
                    let offset = other.first - first;
                    let place = base + offset * width + (row - column) * self.pad;
                    see(row, offset, place);
                }
            }
        }
    }
}

impl Reach<'_> {
    /// First entry of the block of a row, given its position and first unknown, and the rows of
    /// numbers before it; `None` where the pattern has none.
    #[inline(always)]
    pub fn place(&self, row: u32, row_first: usize) -> Option<(usize, usize)> {
        let Column { base, first, width } = self.column;
        let (k, offset) = match self.rows {
            None => (row as usize - self.position, row_first - first),
            Some((positions, offsets)) => {
                let k = positions.binary_search(&row).ok()?;
                (k, offsets[k] as usize)
            }
        };
        Some((base + offset * width + k * self.pad, offset))
    }
}

/// Writes the negative of a matrix (`rows` high, column after column) as a block.
pub(crate) fn pack_negative(block: &mut [f64], rows: usize, matrix: &[f64]) {
    let body = body(rows);
    let columns = matrix.len() / rows.max(1);
    let (upper, lower) = block.split_at_mut(body * columns);
    for (c, values) in matrix.chunks_exact(rows.max(1)).enumerate() {
        for (out, value) in upper[c * body..].iter_mut().zip(&values[..body]) {
            *out = -value;
        }
        for (r, value) in values[body..].iter().enumerate() {
            lower[r * columns + c] = -value;
        }
    }
}

/// Writes the negative of a block into columns of a matrix, `stride` apart.
pub(crate) fn unpack_negative(
    block: &[f64],
    rows: usize,
    columns: usize,
    out: &mut [f64],
    stride: usize,
) {
    let body = body(rows);
    let (upper, lower) = block.split_at(body * columns);
    for c in 0..columns {
        let out = &mut out[c * stride..c * stride + rows];
        for (out, value) in out.iter_mut().zip(&upper[c * body..(c + 1) * body]) {
            *out = -value;
        }
        for (r, out) in out[body..].iter_mut().enumerate() {
            *out = -lower[r * columns + c];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_is_unpacked() {
        for rows in 1..12 {
            let matrix: Vec<f64> = (0..rows * 5).map(|k| k as f64).collect();
            let mut block = vec![0.0; rows * 5];
            pack_negative(&mut block, rows, &matrix);
            let mut out = vec![f64::NAN; 5 * (rows + 2)];
            unpack_negative(&block, rows, 5, &mut out, rows + 2);
            for (column, known) in out.chunks(rows + 2).zip(matrix.chunks(rows)) {
                assert_eq!(&column[..rows], known);
            }
        }
    }
}
