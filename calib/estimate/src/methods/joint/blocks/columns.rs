//! Columns cut into the rows of the recordings.

use faer::{Mat, MatMut};

use super::column::Column;
use super::groups::RowGroups;

/// Columns (`m × n`), of which every group of rows keeps those that may differ from zero there: all groups share a few, the
/// others, as directions and biases, belong to one.
#[derive(Clone, Debug)]
pub struct Columns {
    groups: RowGroups,
    count: usize,
    parts: Vec<Part>,
}

/// The columns in one group of rows.
#[derive(Clone, Debug)]
pub struct Part {
    /// The rows, in ascending order.
    pub rows: Vec<usize>,
    /// The columns that may differ from zero here, in ascending order.
    pub columns: Vec<usize>,
    /// Their values (`rows × columns`).
    pub values: Mat<f64>,
}

impl Part {
    /// No entries.
    pub fn zeros(rows: &[usize], columns: &[usize]) -> Self {
        Self {
            values: Mat::zeros(rows.len(), columns.len()),
            rows: rows.to_vec(),
            columns: columns.to_vec(),
        }
    }

    /// The place of a column here.
    pub fn place(&self, column: usize) -> Option<usize> {
        self.columns.binary_search(&column).ok()
    }

    /// The places of columns that are here.
    pub fn places(&self, columns: &[usize]) -> Vec<usize> {
        columns.iter().filter_map(|&k| self.place(k)).collect()
    }

    /// Some of the columns here, by their places.
    fn keep(&self, places: &[(usize, usize)]) -> Self {
        let columns = places.iter().map(|(_, column)| *column).collect();
        let values = Mat::from_fn(self.rows.len(), places.len(), |i, k| {
            self.values[(i, places[k].0)]
        });
        Self {
            rows: self.rows.clone(),
            columns,
            values,
        }
    }

    /// The columns that no other part has.
    pub fn own_columns(&self, parts_of: &[usize]) -> Mat<f64> {
        let (own, _) = self.own_and_shared(parts_of);
        Mat::from_fn(self.rows.len(), own.len(), |i, k| self.values[(i, own[k])])
    }

    /// Places of the columns that no other part has, then of those that others have as well.
    pub fn own_and_shared(&self, parts_of: &[usize]) -> (Vec<usize>, Vec<usize>) {
        (0..self.columns.len()).partition(|&k| parts_of[self.columns[k]] == 1)
    }
}

impl Columns {
    /// No entries: `of_group` are the columns that may differ from zero in each, in ascending order.
    pub fn zeros(groups: &RowGroups, count: usize, of_group: Vec<Vec<usize>>) -> Self {
        let parts = groups.iter().zip(of_group);
        let parts = parts.map(|(rows, columns)| Part::zeros(rows, &columns));
        Self {
            count,
            parts: parts.collect(),
            groups: groups.clone(),
        }
    }

    /// No columns at all.
    pub fn none(groups: &RowGroups) -> Self {
        Self::zeros(groups, 0, vec![Vec::new(); groups.iter().len()])
    }

    /// Builds columns from sparse ones, each with entries in one group only.
    pub fn sparse(groups: &RowGroups, columns: &[&Column]) -> Self {
        let mut of_group = vec![Vec::new(); groups.iter().len()];
        for (k, column) in columns.iter().enumerate() {
            let group = column
                .entries()
                .first()
                .map_or(0, |(row, _)| groups.of(*row));
            if let Some(own) = of_group.get_mut(group) {
                own.push(k);
            }
        }
        let mut all = Self::zeros(groups, columns.len(), of_group);
        for (k, column) in columns.iter().enumerate() {
            for &(row, value) in column.entries() {
                all.set(row, k, value);
            }
        }
        all
    }

    /// Cuts a dense matrix (`m × n`) into the rows of the groups.
    pub fn cut(whole: &Mat<f64>, groups: &RowGroups) -> Self {
        let alone = groups.iter().len() == 1;
        let of_group = |rows: &Vec<usize>| {
            let is_used = |k: &usize| alone || rows.iter().any(|&i| whole[(i, *k)] != 0.0);
            (0..whole.ncols()).filter(is_used).collect()
        };
        let used = groups.iter().map(of_group).collect();
        let mut cut = Self::zeros(groups, whole.ncols(), used);
        for part in &mut cut.parts {
            let (rows, columns) = (&part.rows, &part.columns);
            part.values = Mat::from_fn(rows.len(), columns.len(), |i, k| {
                whole[(rows[i], columns[k])]
            });
        }
        cut
    }

    /// Number of rows `m`.
    pub fn nrows(&self) -> usize {
        self.groups.rows()
    }

    /// Number of columns `n`.
    pub fn ncols(&self) -> usize {
        self.count
    }

    /// The groups of rows.
    pub fn groups(&self) -> &RowGroups {
        &self.groups
    }

    /// The columns of every group of rows.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The columns that may differ from zero in a row.
    pub fn columns_of_row(&self, row: usize) -> &[usize] {
        &self.parts[self.groups.of(row)].columns
    }

    /// The part of a group of rows, to be filled.
    pub fn part_mut(&mut self, group: usize) -> &mut Part {
        &mut self.parts[group]
    }

    /// An entry.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let part = &self.parts[self.groups.of(row)];
        match (part.rows.binary_search(&row), part.place(column)) {
            (Ok(i), Some(k)) => part.values[(i, k)],
            _ => 0.0,
        }
    }

    /// Writes an entry of a column that its group of rows has.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        let part = &mut self.parts[self.groups.of(row)];
        if let (Ok(i), Some(k)) = (part.rows.binary_search(&row), part.place(column)) {
            part.values[(i, k)] = value;
        }
    }

    /// Counts the groups that hold each column.
    pub fn parts_of(&self) -> Vec<usize> {
        let mut count = vec![0; self.count];
        for part in &self.parts {
            part.columns.iter().for_each(|&k| count[k] += 1);
        }
        count
    }

    /// Some columns, in this order.
    pub fn select(&self, which: &[usize]) -> Self {
        let mut place = vec![None; self.count];
        for (new, &old) in which.iter().enumerate() {
            place[old] = Some(new);
        }
        let of_part = |part: &Part| {
            let places = part.columns.iter().enumerate();
            let kept = places.filter_map(|(k, &old)| Some((k, place[old]?)));
            let mut kept: Vec<(usize, usize)> = kept.collect();
            kept.sort_unstable_by_key(|(_, new)| *new);
            part.keep(&kept)
        };
        Self {
            groups: self.groups.clone(),
            count: which.len(),
            parts: self.parts.iter().map(of_part).collect(),
        }
    }

    /// These columns, then others in the same groups of rows.
    pub fn beside(&self, others: &Self) -> Self {
        Self::side_by_side(&self.groups, &[self, others])
    }

    /// The same with so many rows of zeros below, in a group of their own.
    pub fn above_zeros(mut self, count: usize) -> Self {
        let from = self.groups.rows();
        let rows: Vec<usize> = (from..from + count).collect();
        self.groups = self.groups.with_group(count);
        self.parts.push(Part::zeros(&rows, &[]));
        self
    }

    /// These columns beside `errors` of unit variance, which rows below that expect each to be zero hold: what they leave of
    /// residuals with zeros below is what these columns alone leave under noise that contains the errors (Theil & Goldberger
    /// 1961, mixed estimation).
    pub fn beside_errors(&self, errors: &Self) -> Self {
        let (first, count, above) = (self.count, errors.count, self.nrows());
        let mut whole = self.beside(errors);
        let columns: Vec<usize> = (first..first + count).collect();
        let rows: Vec<usize> = (above..above + count).collect();
        let mut held = Part::zeros(&rows, &columns);
        held.values.diagonal_mut().column_vector_mut().fill(1.0);
        whole.groups = whole.groups.with_group(count);
        whole.parts.push(held);
        whole
    }

    /// Columns in the same groups of rows, one after the other.
    pub fn side_by_side(groups: &RowGroups, all: &[&Self]) -> Self {
        let mut of_group = vec![Vec::new(); groups.iter().len()];
        let mut count = 0;
        for columns in all {
            for (own, part) in of_group.iter_mut().zip(&columns.parts) {
                own.extend(part.columns.iter().map(|k| count + k));
            }
            count += columns.count;
        }
        let mut whole = Self::zeros(groups, count, of_group);
        for (group, to) in whole.parts.iter_mut().enumerate() {
            let mut first = 0;
            for from in all.iter().map(|columns| &columns.parts[group].values) {
                let place = to.values.as_mut().subcols_mut(first, from.ncols());
                { place }.copy_from(from);
                first += from.ncols();
            }
        }
        whole
    }

    /// The same in groups of rows that consist of whole ones of these.
    pub fn regrouped(self, groups: &RowGroups) -> Self {
        if self.groups == *groups {
            return self;
        }
        let mut of_group = vec![Vec::new(); groups.iter().len()];
        for part in self.parts.iter().filter(|part| !part.rows.is_empty()) {
            of_group[groups.of(part.rows[0])].extend(&part.columns);
        }
        for columns in &mut of_group {
            columns.sort_unstable();
            columns.dedup();
        }
        let mut whole = Self::zeros(groups, self.count, of_group);
        for part in self.parts.iter().filter(|part| !part.rows.is_empty()) {
            let to = &mut whole.parts[groups.of(part.rows[0])];
            for (k, column) in part.columns.iter().enumerate() {
                let Some(place) = to.place(*column) else {
                    continue;
                };
                for (i, row) in part.rows.iter().enumerate() {
                    if let Ok(at) = to.rows.binary_search(row) {
                        to.values[(at, place)] = part.values[(i, k)];
                    }
                }
            }
        }
        whole
    }

    /// The same columns, of which each group keeps these and no others.
    pub fn spread_over(&self, of_group: Vec<Vec<usize>>) -> Self {
        let mut wider = Self::zeros(&self.groups, self.count, of_group);
        for (to, from) in wider.parts.iter_mut().zip(&self.parts) {
            for (k, column) in from.columns.iter().enumerate() {
                if let Some(place) = to.place(*column) {
                    to.values.col_mut(place).copy_from(from.values.col(k));
                }
            }
        }
        wider
    }

    /// The same in the groups that every column leaves independent: no column is shared.
    pub fn with_own_columns_only(&self) -> Self {
        let parts_of = self.parts_of();
        if parts_of.iter().all(|&count| count <= 1) {
            return self.clone();
        }
        let shared: Vec<Vec<usize>> = (0..self.count)
            .filter(|&k| parts_of[k] > 1)
            .map(|k| {
                let with = self.parts.iter().filter(|part| part.place(k).is_some());
                with.filter_map(|part| part.rows.first().copied()).collect()
            })
            .collect();
        let groups = self.groups.connected(shared.iter().map(Vec::as_slice));
        self.clone().regrouped(&groups)
    }

    /// Changes the values in every group of rows.
    pub fn apply(&mut self, change: impl Fn(&[usize], MatMut<'_, f64>)) {
        for part in &mut self.parts {
            change(&part.rows, part.values.as_mut());
        }
    }

    /// Multiplies all values.
    pub fn scale(&mut self, by: f64) {
        for part in &mut self.parts {
            part.values *= faer::Scale(by);
        }
    }

    /// Divides every column by a number of its own.
    pub fn divide(&mut self, by: &[f64]) {
        for part in &mut self.parts {
            for (k, column) in part.values.col_iter_mut().enumerate() {
                let divisor = by[part.columns[k]];
                column.iter_mut().for_each(|v| *v /= divisor);
            }
        }
    }

    /// The length of every column.
    pub fn norms(&self) -> Vec<f64> {
        if let [part] = self.parts.as_slice() {
            return part.values.col_iter().map(|c| c.norm_l2()).collect();
        }
        let mut squares = vec![0.0; self.count];
        for part in &self.parts {
            for (&k, column) in part.columns.iter().zip(part.values.col_iter()) {
                squares[k] += column.squared_norm_l2();
            }
        }
        squares.into_iter().map(f64::sqrt).collect()
    }

    /// `A x` (`m`).
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.nrows()];
        for part in &self.parts {
            let own = Mat::from_fn(part.columns.len(), 1, |k, _| x[part.columns[k]]);
            let moved = &part.values * own;
            for (i, &row) in part.rows.iter().enumerate() {
                product[row] = moved[(i, 0)];
            }
        }
        product
    }

    /// `Aᵀ r` (`n`).
    pub fn transposed_times(&self, r: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.count];
        for part in &self.parts {
            let own = Mat::from_fn(part.rows.len(), 1, |i, _| r[part.rows[i]]);
            let sums = part.values.transpose() * own;
            for (k, &column) in part.columns.iter().enumerate() {
                product[column] += sums[(k, 0)];
            }
        }
        product
    }

    /// The first `end` rows.
    pub fn first_rows(&self, end: usize) -> Self {
        let of_part = |part: &Part| {
            let count = part.rows.partition_point(|&row| row < end);
            Part {
                rows: part.rows[..count].to_vec(),
                columns: part.columns.clone(),
                values: part.values.as_ref().subrows(0, count).to_owned(),
            }
        };
        Self {
            groups: self.groups.before(end),
            count: self.count,
            parts: self.parts.iter().map(of_part).collect(),
        }
    }

    /// The whole matrix (`m × n`).
    pub fn to_dense(&self) -> Mat<f64> {
        let mut whole = Mat::zeros(self.nrows(), self.count);
        for part in &self.parts {
            for (k, &column) in part.columns.iter().enumerate() {
                for (i, &row) in part.rows.iter().enumerate() {
                    whole[(row, column)] = part.values[(i, k)];
                }
            }
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three recordings of two rows, the last column shared, the others their own.
    fn example() -> (Mat<f64>, Columns) {
        let groups = RowGroups::new(vec![0, 1, 2, 0, 1, 2]);
        let whole = Mat::from_fn(6, 4, |i, k| {
            if k == 3 || i % 3 == k {
                (2 * i + k) as f64 + 1.0
            } else {
                0.0
            }
        });
        let cut = Columns::cut(&whole, &groups);
        (whole, cut)
    }

    #[test]
    fn what_is_cut_is_put_together_again() {
        let (whole, cut) = example();
        assert_eq!(cut.to_dense(), whole);
        assert_eq!(cut.parts_of(), [1, 1, 1, 3]);
        assert_eq!(
            cut.clone().regrouped(&RowGroups::whole(6)).to_dense(),
            whole
        );
        let some = cut.select(&[1, 3]);
        assert_eq!(
            some.to_dense(),
            Mat::from_fn(6, 2, |i, k| whole[(i, [1, 3][k])])
        );
        let turned = cut.select(&[3, 0]);
        assert_eq!(
            (turned.get(4, 0), turned.get(0, 1)),
            (whole[(4, 3)], whole[(0, 0)])
        );
        let twice = some.beside(&cut);
        assert_eq!((twice.ncols(), twice.get(4, 0)), (6, whole[(4, 1)]));
        assert_eq!(cut.first_rows(4).to_dense(), whole.as_ref().subrows(0, 4));
    }

    #[test]
    fn products_and_norms_are_those_of_the_whole() {
        let (whole, cut) = example();
        let x = Mat::from_fn(4, 1, |k, _| k as f64 - 1.5);
        let r = Mat::from_fn(6, 1, |i, _| 1.0 / (1.0 + i as f64));
        let column = |a: &Mat<f64>| a.col(0).iter().copied().collect::<Vec<_>>();
        let error = |a: Vec<f64>, b: Mat<f64>| {
            let pairs = a.iter().zip(b.col(0).iter());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        assert!(error(cut.times(&column(&x)), &whole * &x) < 1e-12);
        assert!(error(cut.transposed_times(&column(&r)), whole.transpose() * &r) < 1e-12);
        for (k, norm) in cut.norms().into_iter().enumerate() {
            assert!((norm - whole.col(k).norm_l2()).abs() < 1e-12);
        }
    }
}
