//! The pattern of a Cholesky factor of little fill, and where its dense end begins.

/// Multiplications up to which the columns before the dense ones are taken block after block; of
/// pose graphs those of 3,000 poses in space are half of it.
const MOST: usize = 200_000_000;

/// Blocks of the factor above which its pattern is not looked for here.
const MOST_BLOCKS: usize = 400_000;

/// Share of the last columns' blocks from which those columns are one dense matrix.
const FULL: f64 = 0.9;

/// Least unknowns of that.
const DENSE: usize = 96;

/// The pattern of a factor of little fill.
#[derive(Debug)]
pub(crate) struct Filled {
    /// The rows of every column, ascending, the diagonal first.
    pub rows: Vec<Vec<u32>>,
    /// The columns from this one on have all rows: one dense matrix.
    pub tail: usize,
}

/// The pattern of the factor, given the rows of the lower triangle (by column, the diagonal first) and
/// the width of every position; `None` where the factorisation is large.
pub(crate) fn filled(rows: &[Vec<u32>], width: impl Fn(usize) -> usize) -> Option<Filled> {
    let mut rows = with_fill(rows)?;
    let columns = rows.len();
    let (mut tail, mut blocks) = (columns, 0);
    for column in (0..columns).rev() {
        blocks += rows[column].len();
        let all = (columns - column) * (columns - column + 1) / 2;
        if blocks as f64 >= FULL * all as f64 {
            tail = column;
        }
    }
    if (tail..columns).map(&width).sum::<usize>() < DENSE {
        tail = columns;
    }
    let mut work = 0;
    for (column, own) in rows[..tail].iter().enumerate() {
        let height: usize = own.iter().map(|&row| width(row as usize)).sum();
        work += width(column) * height * (height + 1) / 2;
    }
    for (column, own) in rows.iter_mut().enumerate().skip(tail) {
        *own = (column as u32..columns as u32).collect();
    }
    (work <= MOST).then_some(Filled { rows, tail })
}

/// The rows of every column of the factor; `None` where they are many.
///
/// Source: Davis, "Direct methods for sparse linear systems", 2006, theorem 4.2: below the diagonal a
/// column has its own rows and those of its children in the elimination tree.
fn with_fill(rows: &[Vec<u32>]) -> Option<Vec<Vec<u32>>> {
    let mut all: Vec<Vec<u32>> = Vec::with_capacity(rows.len());
    let mut children = vec![Vec::new(); rows.len()];
    let mut seen = vec![u32::MAX; rows.len()];
    let mut blocks = 0;
    for (column, own) in rows.iter().enumerate() {
        let mut merged = own.clone();
        for &row in own {
            seen[row as usize] = column as u32;
        }
        for &child in &children[column] {
            let of_child: &Vec<u32> = &all[child];
            for &row in &of_child[1..] {
                if seen[row as usize] != column as u32 {
                    seen[row as usize] = column as u32;
                    merged.push(row);
                }
            }
        }
        merged.sort_unstable();
        blocks += merged.len();
        if blocks > MOST_BLOCKS {
            return None;
        }
        if let Some(&parent) = merged.get(1) {
            children[parent as usize].push(column);
        }
        all.push(merged);
    }
    Some(all)
}
