//! A column with few entries: what a disturbance of one turn or interval does to the rows.

use faer::Mat;

/// A column of which few entries differ from zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column(Vec<(usize, f64)>);

impl Column {
    /// Nothing yet.
    pub const fn none() -> Self {
        Self(Vec::new())
    }

    /// A one in one row.
    pub fn unit(row: usize) -> Self {
        Self(vec![(row, 1.0)])
    }

    /// Adds the entry of a row that has none yet.
    pub fn set(&mut self, row: usize, value: f64) {
        self.0.push((row, value));
    }

    /// Columns of `m` rows side by side (`m × k`).
    pub fn side_by_side(rows: usize, columns: &[&Self]) -> Mat<f64> {
        let mut whole = Mat::zeros(rows, columns.len());
        for (k, column) in columns.iter().enumerate() {
            column
                .0
                .iter()
                .for_each(|&(row, value)| whole[(row, k)] = value);
        }
        whole
    }

    /// Rows and values.
    pub fn entries(&self) -> &[(usize, f64)] {
        &self.0
    }
}
