//! Normal equations of groups of rows that share a few columns.

use std::sync::Arc;

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatRef, Par, Side};

use super::columns::Columns;

findings::tuning! {
    /// Share of a column's square that is added to it in normal equations whose columns may be dependent.
    RIDGE: f64 = 1e-12;
}

/// `AᵀA` of columns of which each belongs to one group of rows or is shared by many: a block for every group, a border,
/// and a block of what is shared. Its factor fills nothing in between.
#[derive(Clone, Debug)]
pub struct Arrow {
    places: Arc<Places>,
    parts: Vec<Wing>,
    /// Block of the shared columns (`s × s`), the lower triangle.
    last: Mat<f64>,
}

/// Places of the columns in the blocks.
#[derive(Clone, Debug)]
pub struct Places {
    /// The columns of every group, and of all groups.
    own: Vec<Vec<usize>>,
    shared: Vec<usize>,
    /// The place of every column: in its group, or after all of any group among the shared ones.
    of_column: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Own(usize),
    Shared(usize),
}

#[derive(Clone, Debug)]
struct Wing {
    /// Block of the group's own columns (`k × k`), the lower triangle.
    own: Mat<f64>,
    /// Block of the own columns with the shared ones (`k × s`).
    border: Mat<f64>,
}

impl Places {
    /// Sorts columns into those of one group of rows and the shared ones.
    pub fn of(columns: &Columns) -> Self {
        let parts_of = columns.parts_of();
        let shared: Vec<usize> = (0..columns.ncols()).filter(|&k| parts_of[k] != 1).collect();
        let mut of_column = vec![Place::Own(0); columns.ncols()];
        for (place, &k) in shared.iter().enumerate() {
            of_column[k] = Place::Shared(place);
        }
        let own = columns.parts().iter().map(|part| {
            let own = part.columns.iter().copied();
            let own: Vec<usize> = own.filter(|&k| parts_of[k] == 1).collect();
            for (place, &k) in own.iter().enumerate() {
                of_column[k] = Place::Own(place);
            }
            own
        });
        Self {
            own: own.collect(),
            shared,
            of_column,
        }
    }
}

impl Arrow {
    /// Nothing yet.
    pub fn zeros(places: &Arc<Places>) -> Self {
        let s = places.shared.len();
        let wings = places.own.iter().map(|own| Wing {
            own: Mat::zeros(own.len(), own.len()),
            border: Mat::zeros(own.len(), s),
        });
        Self {
            parts: wings.collect(),
            last: Mat::zeros(s, s),
            places: places.clone(),
        }
    }

    /// `AᵀA`.
    pub fn gram(columns: &Columns) -> Self {
        let mut arrow = Self::zeros(&Arc::new(Places::of(columns)));
        for (group, part) in columns.parts().iter().enumerate() {
            arrow.add(group, &part.columns, &lower_gram(part.values.as_ref()));
        }
        arrow
    }

    /// Adds what some rows of a group give: the lower triangle of `gram` (`c × c` or larger) of these columns.
    pub fn add(&mut self, group: usize, columns: &[usize], gram: &Mat<f64>) {
        let wing = &mut self.parts[group];
        let of_column = &self.places.of_column;
        for (k, &b) in columns.iter().enumerate() {
            for (i, &a) in columns.iter().enumerate().skip(k) {
                let entry = match (of_column[a], of_column[b]) {
                    (Place::Own(a), Place::Own(b)) => &mut wing.own[(a, b)],
                    (Place::Own(own), Place::Shared(shared))
                    | (Place::Shared(shared), Place::Own(own)) => &mut wing.border[(own, shared)],
                    (Place::Shared(a), Place::Shared(b)) => &mut self.last[(a, b)],
                };
                *entry += gram[(i, k)];
            }
        }
    }

    /// Adds to the diagonal.
    pub fn add_diagonal(&mut self, column: usize, value: f64) {
        match self.places.of_column[column] {
            Place::Own(place) => {
                let own = self
                    .places
                    .own
                    .iter()
                    .position(|own| own.get(place) == Some(&column));
                if let Some(group) = own {
                    self.parts[group].own[(place, place)] += value;
                }
            }
            Place::Shared(place) => self.last[(place, place)] += value,
        }
    }

    /// The columns of which those before them, group by group and what is shared last, leave a smaller square than this.
    pub fn dependent(&self, tolerance: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let mut last = self.last.clone();
        for (wing, columns) in self.parts.iter().zip(&self.places.own) {
            let (lower, gone) = lower_without_dependent(&wing.own, tolerance);
            found.extend(gone.iter().map(|&k| columns[k]));
            let mut border = wing.border.clone();
            for &k in &gone {
                border.row_mut(k).fill(0.0);
            }
            solve_lower_triangular_in_place(lower.as_ref(), border.as_mut(), Par::Seq);
            last -= border.transpose() * &border;
        }
        let (_, gone) = lower_without_dependent(&last, tolerance);
        found.extend(gone.iter().map(|&k| self.places.shared[k]));
        found.sort_unstable();
        found
    }

    /// The Cholesky factor, `λ` added to the diagonal; `None` where that is not positive.
    pub fn factor(&self, damping: f64) -> Option<ArrowFactor> {
        let held_up = |matrix: &Mat<f64>| {
            let mut matrix = matrix.clone();
            for k in 0..matrix.nrows() {
                matrix[(k, k)] += damping;
            }
            matrix
        };
        let mut last = held_up(&self.last);
        let mut parts = Vec::new();
        for wing in &self.parts {
            let lower = held_up(&wing.own).llt(Side::Lower).ok()?.L().to_owned();
            let mut border = wing.border.clone();
            solve_lower_triangular_in_place(lower.as_ref(), border.as_mut(), Par::Seq);
            last -= border.transpose() * &border;
            parts.push((lower, border));
        }
        Some(ArrowFactor {
            places: self.places.clone(),
            parts,
            last: last.llt(Side::Lower).ok()?.L().to_owned(),
        })
    }
}

/// The Cholesky factor of a matrix of which columns that leave less than `tolerance` are replaced by unit ones, and these.
fn lower_without_dependent(a: &Mat<f64>, tolerance: f64) -> (Mat<f64>, Vec<usize>) {
    let n = a.nrows();
    let mut lower = Mat::<f64>::zeros(n, n);
    let mut gone = Vec::new();
    // Row by row of `L`, as slices of its transpose.
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
    for i in 0..n {
        let mut row = vec![0.0; i + 1];
        for k in 0..i {
            if gone.binary_search(&k).is_err() {
                let before = row[..k].iter().zip(&rows[k][..k]);
                let sum: f64 = before.map(|(a, b)| a * b).sum();
                row[k] = (a[(i, k)] - sum) / rows[k][k];
            }
        }
        let square = a[(i, i)] - row[..i].iter().map(|v| v * v).sum::<f64>();
        if square > tolerance {
            row[i] = square.sqrt();
        } else {
            gone.push(i);
            row.fill(0.0);
            row[i] = 1.0;
        }
        for (k, value) in row.iter().enumerate() {
            lower[(i, k)] = *value;
        }
        rows.push(row);
    }
    (lower, gone)
}

/// The lower triangle of `AᵀA` (`n × n`) of `A` (`m × n`).
pub fn lower_gram(a: MatRef<'_, f64>) -> Mat<f64> {
    let mut gram = Mat::zeros(a.ncols(), a.ncols());
    matmul(
        gram.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Replace,
        a.transpose(),
        BlockStructure::Rectangular,
        a,
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
    gram
}

impl Columns {
    /// `x` (`n`) with the least `‖A x − b‖²`, by the normal equations of columns of unit length, of which a share
    /// of `1e-12` of the square is added: what no row sees stays at zero. `None` where a number is not finite.
    pub fn least_squares(&self, b: &[f64]) -> Option<Vec<f64>> {
        let unit_if_zero = |norm: f64| if norm > 0.0 { norm } else { 1.0 };
        let norms: Vec<f64> = self.norms().into_iter().map(unit_if_zero).collect();
        let mut unit = self.clone();
        unit.divide(&norms);
        let factor = Arrow::gram(&unit).factor(RIDGE.get())?;
        let x = factor.solve(&unit.transposed_times(b)).into_iter();
        Some(x.zip(&norms).map(|(x, norm)| x / norm).collect())
    }
}

/// `L` of `A + λ I = L Lᵀ`, what is shared last.
#[derive(Clone, Debug)]
pub struct ArrowFactor {
    places: Arc<Places>,
    parts: Vec<(Mat<f64>, Mat<f64>)>,
    last: Mat<f64>,
}

impl ArrowFactor {
    /// The diagonal of `L`.
    pub fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        let all = self.parts.iter().map(|(own, _)| own);
        all.chain(std::iter::once(&self.last))
            .flat_map(|l| (0..l.nrows()).map(move |k| l[(k, k)]))
    }

    /// `L⁻¹ b` (`n`): the groups one after the other, what is shared last.
    pub fn forward(&self, b: &[f64]) -> (Vec<Mat<f64>>, Mat<f64>) {
        let gather = |columns: &[usize]| Mat::from_fn(columns.len(), 1, |k, _| b[columns[k]]);
        let mut last = gather(&self.places.shared);
        let mut parts = Vec::new();
        for ((lower, border), columns) in self.parts.iter().zip(&self.places.own) {
            let mut own = gather(columns);
            solve_lower_triangular_in_place(lower.as_ref(), own.as_mut(), Par::Seq);
            last -= border.transpose() * &own;
            parts.push(own);
        }
        solve_lower_triangular_in_place(self.last.as_ref(), last.as_mut(), Par::Seq);
        (parts, last)
    }

    /// `E L⁻ᵀ` of rows `E` (`k × n`) that are zero outside of the columns of a group (`g`) and the shared ones (`s`), `rows`
    /// (`k × c`) their entries at some of these; row by row without the zeros of other groups, and their number `g + s`.
    pub fn forward_rows(
        &self,
        group: usize,
        columns: &[usize],
        rows: MatRef<'_, f64>,
    ) -> (Vec<f64>, usize) {
        let (lower, border) = &self.parts[group];
        let (g, s, k) = (lower.nrows(), self.last.nrows(), rows.nrows());
        let mut own = Mat::<f64>::zeros(g, k);
        let mut shared = Mat::<f64>::zeros(s, k);
        for (c, &column) in columns.iter().enumerate() {
            for i in 0..k {
                match self.places.of_column[column] {
                    Place::Own(place) => own[(place, i)] = rows[(i, c)],
                    Place::Shared(place) => shared[(place, i)] = rows[(i, c)],
                }
            }
        }
        solve_lower_triangular_in_place(lower.as_ref(), own.as_mut(), Par::Seq);
        shared -= border.transpose() * &own;
        solve_lower_triangular_in_place(self.last.as_ref(), shared.as_mut(), Par::Seq);
        let mut all = Vec::with_capacity(k * (g + s));
        for i in 0..k {
            all.extend(own.col(i).iter().chain(shared.col(i).iter()));
        }
        (all, g + s)
    }

    /// By how much the diagonal of `(A + λ I)⁻¹` falls short of one at some columns, all together.
    pub fn left_of_unit(&self, columns: std::ops::Range<usize>) -> f64 {
        let mut b = vec![0.0; self.places.of_column.len()];
        let one = |k: usize| {
            b[k] = 1.0;
            let (own, shared) = self.forward(&b);
            b[k] = 0.0;
            let own: f64 = own.iter().map(|own| own.squared_norm_l2()).sum();
            1.0 - own - shared.squared_norm_l2()
        };
        columns.map(one).sum()
    }

    /// The trace of `(A + λ I)⁻¹ = L⁻ᵀ L⁻¹`: the sum of squares of the entries of `L⁻¹`.
    pub fn trace_of_inverse(&self) -> f64 {
        let inverse = |lower: &Mat<f64>| {
            let n = lower.nrows();
            let mut inverse = Mat::<f64>::identity(n, n);
            solve_lower_triangular_in_place(lower.as_ref(), inverse.as_mut(), Par::Seq);
            inverse
        };
        let last = inverse(&self.last);
        let of_part = |(lower, border): &(Mat<f64>, Mat<f64>)| {
            let own = inverse(lower);
            let below = &last * (border.transpose() * &own);
            own.squared_norm_l2() + below.squared_norm_l2()
        };
        last.squared_norm_l2() + self.parts.iter().map(of_part).sum::<f64>()
    }

    /// `(A + λ I)⁻¹ b` (`n`).
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let (parts, mut last) = self.forward(b);
        let mut x = vec![0.0; b.len()];
        let upper = self.last.transpose();
        solve_upper_triangular_in_place(upper, last.as_mut(), Par::Seq);
        for (k, &column) in self.places.shared.iter().enumerate() {
            x[column] = last[(k, 0)];
        }
        let wings = self.parts.iter().zip(&self.places.own).zip(parts);
        for (((lower, border), columns), mut own) in wings {
            own -= border * &last;
            solve_upper_triangular_in_place(lower.transpose(), own.as_mut(), Par::Seq);
            for (k, &column) in columns.iter().enumerate() {
                x[column] = own[(k, 0)];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::{DenseSolveCore, Solve};

    use super::*;
    use crate::methods::joint::blocks::groups::RowGroups;

    #[test]
    fn the_factor_of_the_groups_is_that_of_the_whole() {
        let whole = Mat::from_fn(18, 7, |i, k| {
            let value = ((i * 5 + k * 7 + i * i * (k + 1)) % 13) as f64 - 6.0;
            if k >= 6 || i / 6 == k / 2 { value } else { 0.0 }
        });
        let groups = RowGroups::new((0..18).map(|i| i / 6).collect());
        let columns = Columns::cut(&whole, &groups);
        let mut matrix = whole.transpose() * &whole;
        for k in 0..7 {
            matrix[(k, k)] += 0.5;
        }
        let dense = matrix.llt(Side::Lower).unwrap();
        let arrow = Arrow::gram(&columns);
        let factor = arrow.factor(0.5).unwrap();
        let b: Vec<f64> = (0..7).map(|k| k as f64 - 2.5).collect();
        let x = dense.solve(Mat::from_fn(7, 1, |k, _| b[k]));
        for (k, value) in factor.solve(&b).into_iter().enumerate() {
            assert!((value - x[(k, 0)]).abs() < 1e-12);
        }
        let inverse = dense.inverse();
        let trace: f64 = (0..7).map(|k| inverse[(k, k)]).sum();
        assert!((factor.trace_of_inverse() - trace).abs() < 1e-12);
        let log = |pivots: &mut dyn Iterator<Item = f64>| pivots.map(f64::ln).sum::<f64>();
        let direct = log(&mut (0..7).map(|k| dense.L()[(k, k)]));
        assert!((log(&mut factor.pivots()) - direct).abs() < 1e-12);
    }

    #[test]
    fn the_line_through_three_points_and_a_column_that_nothing_shows() {
        // y = 2 + 3 t at t = 0, 1, 2, one percent of the size of the other column, and a column of zeros.
        let a = Mat::from_fn(3, 3, |i, k| [1.0, 0.01 * i as f64, 0.0][k]);
        let a = Columns::cut(&a, &RowGroups::whole(3));
        let found = a.least_squares(&[2.0, 5.0, 8.0]).unwrap();
        for (found, value) in found.into_iter().zip([2.0, 300.0, 0.0]) {
            // The ridge is worth 1e-12 of a condition of ten.
            assert!((found - value).abs() < 1e-8, "{found}");
        }
    }
}
