//! Covariances among rows, most of which share nothing.

use faer::Mat;

use super::columns::Columns;
use super::groups::RowGroups;

/// A symmetric matrix (`m × m`) that is zero outside of blocks.
#[derive(Clone, Debug)]
pub struct Covariance {
    blocks: Vec<Block>,
    /// The block of every row and its place there; `None` where the row is zero.
    of_row: Vec<Option<(usize, usize)>>,
}

/// Rows, in ascending order, and what they share with each other (`k × k`).
pub type Block = (Vec<usize>, Mat<f64>);

impl Covariance {
    /// Builds the covariance of `size` rows from blocks that have no row in common.
    pub fn of_blocks(size: usize, blocks: Vec<Block>) -> Self {
        let mut of_row = vec![None; size];
        for (block, (rows, _)) in blocks.iter().enumerate() {
            for (place, &row) in rows.iter().enumerate() {
                of_row[row] = Some((block, place));
            }
        }
        Self { blocks, of_row }
    }

    /// Builds a covariance of zeros.
    pub fn none(size: usize) -> Self {
        Self::of_blocks(size, Vec::new())
    }

    /// Builds the covariance from any symmetric matrix, as one block.
    pub fn dense(values: Mat<f64>) -> Self {
        let size = values.nrows();
        Self::of_blocks(size, vec![((0..size).collect(), values)])
    }

    /// `U Uᵀ`.
    pub fn of_columns(columns: &Columns) -> Self {
        let columns = columns.with_own_columns_only();
        let of_part = |part: &super::columns::Part| {
            let used: Vec<usize> = (0..part.rows.len())
                .filter(|&i| part.values.row(i).iter().any(|v| *v != 0.0))
                .collect();
            let own = Mat::from_fn(used.len(), part.values.ncols(), |i, k| {
                part.values[(used[i], k)]
            });
            let rows = used.iter().map(|&i| part.rows[i]).collect();
            (rows, &own * own.transpose())
        };
        let blocks = columns.parts().iter().map(of_part);
        Self::of_blocks(columns.nrows(), blocks.collect())
    }

    /// Number of rows `m`.
    pub fn size(&self) -> usize {
        self.of_row.len()
    }

    /// The blocks: rows, in ascending order, and what they share.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The rows of every block.
    pub fn rows_of_blocks(&self) -> impl Iterator<Item = &[usize]> {
        self.blocks.iter().map(|(rows, _)| rows.as_slice())
    }

    /// The diagonal where it may differ from zero.
    pub fn diagonal(&self) -> impl Iterator<Item = f64> {
        self.blocks
            .iter()
            .flat_map(|(rows, c)| (0..rows.len()).map(|k| c[(k, k)]))
    }

    /// The same blocks of rows, each changed.
    pub fn map(&self, of_block: impl Fn(&[usize], &Mat<f64>) -> Mat<f64>) -> Self {
        let blocks = self.blocks.iter();
        let changed = blocks.map(|(rows, c)| (rows.clone(), of_block(rows, c)));
        Self::of_blocks(self.size(), changed.collect())
    }

    /// Returns the covariance among some rows, given in ascending order; `None` where no block contains any of them.
    pub fn part(&self, rows: &[usize]) -> Option<Mat<f64>> {
        let places: Vec<Option<(usize, usize)>> =
            rows.iter().map(|&row| self.of_row[row]).collect();
        let value = |i: usize, k: usize| match (places[i], places[k]) {
            (Some((block, a)), Some((same, b))) if block == same => self.blocks[block].1[(a, b)],
            _ => 0.0,
        };
        let any = places.iter().any(Option::is_some);
        any.then(|| Mat::from_fn(rows.len(), rows.len(), value))
    }

    /// The whole matrix (`m × m`).
    pub fn to_dense(&self) -> Mat<f64> {
        let mut whole = Mat::zeros(self.size(), self.size());
        for (rows, c) in &self.blocks {
            for (k, &column) in rows.iter().enumerate() {
                for (i, &row) in rows.iter().enumerate() {
                    whole[(row, column)] = c[(i, k)];
                }
            }
        }
        whole
    }

    /// `Nᵀ C N` (`q × q`) for some rows, in ascending order.
    pub fn both_sides_of(&self, rows: &[usize], null: &Mat<f64>) -> Mat<f64> {
        let is_used = |i: &usize| {
            let place = self.of_row[rows[*i]];
            place.is_some_and(|(block, k)| self.blocks[block].1[(k, k)] != 0.0)
        };
        let used: Vec<usize> = (0..rows.len()).filter(is_used).collect();
        let part = Mat::from_fn(used.len(), null.ncols(), |i, k| null[(used[i], k)]);
        let used: Vec<usize> = used.into_iter().map(|i| rows[i]).collect();
        match self.part(&used) {
            Some(own) => part.transpose() * (own * &part),
            None => Mat::zeros(null.ncols(), null.ncols()),
        }
    }
}

impl RowGroups {
    /// Groups that a covariance connects as one.
    pub fn connected_by<'a>(&self, covariances: impl Iterator<Item = &'a Covariance>) -> Self {
        self.connected(covariances.flat_map(Covariance::rows_of_blocks))
    }
}

/// The groups of rows that the nonzero entries of covariances connect, each in ascending order; every row that shares
/// nothing is one.
pub fn independent(covariances: &[&Covariance], rows: usize) -> Vec<Vec<usize>> {
    let mut seen = vec![false; rows];
    let mut groups = Vec::new();
    for first in 0..rows {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut group = vec![first];
        let mut next = 0;
        while let Some(&row) = group.get(next) {
            for c in covariances {
                let Some((block, place)) = c.of_row[row] else {
                    continue;
                };
                let (own, values) = &c.blocks[block];
                for (&other, value) in own.iter().zip(values.col(place).iter()) {
                    if *value != 0.0 && !seen[other] {
                        seen[other] = true;
                        group.push(other);
                    }
                }
            }
            next += 1;
        }
        group.sort_unstable();
        groups.push(group);
    }
    groups
}

/// `d I + Σ s C`; `None` where there is no `C`.
pub fn combined(size: usize, diagonal: f64, parts: &[(f64, &Covariance)]) -> Option<Covariance> {
    if parts.is_empty() {
        return None;
    }
    let all: Vec<&Covariance> = parts.iter().map(|(_, c)| *c).collect();
    let of_rows = |rows: Vec<usize>| {
        let mut sum = Mat::zeros(rows.len(), rows.len());
        sum.diagonal_mut().column_vector_mut().fill(diagonal);
        for (scale, c) in parts {
            if let Some(own) = c.part(&rows) {
                sum += faer::Scale(*scale) * own;
            }
        }
        (rows, sum)
    };
    let groups = independent(&all, size).into_iter();
    Some(Covariance::of_blocks(size, groups.map(of_rows).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_a_third_connects_are_one_group() {
        let mut c = Mat::<f64>::identity(5, 5);
        for (i, k) in [(0, 3), (3, 4)] {
            c[(i, k)] = 0.5;
            c[(k, i)] = 0.5;
        }
        let groups = independent(&[&Covariance::dense(c)], 5);
        assert_eq!(groups, [vec![0, 3, 4], vec![1], vec![2]]);
    }

    #[test]
    fn a_part_is_that_of_the_whole_and_sums_have_the_unit_matrix_once() {
        let block = Mat::from_fn(2, 2, |i, k| (1 + i + k) as f64);
        let one = Covariance::of_blocks(4, vec![(vec![1, 3], block.clone())]);
        let part = one.part(&[0, 1, 3]).unwrap();
        for (i, row) in [0, 1, 3].into_iter().enumerate() {
            for (k, column) in [0, 1, 3].into_iter().enumerate() {
                assert_eq!(part[(i, k)], one.to_dense()[(row, column)]);
            }
        }
        assert!(one.part(&[0, 2]).is_none());
        let sum = combined(4, 1.0, &[(2.0, &one), (1.0, &one)]);
        let sum = sum.unwrap().to_dense();
        let direct = Mat::<f64>::identity(4, 4) + faer::Scale(3.0) * one.to_dense();
        assert_eq!(sum, direct);
        let null = Mat::from_fn(4, 2, |i, k| (i + 2 * k) as f64);
        let both = null.transpose() * (one.to_dense() * &null);
        assert!((one.both_sides_of(&[0, 1, 2, 3], &null) - both).norm_max() < 1e-12);
    }
}
