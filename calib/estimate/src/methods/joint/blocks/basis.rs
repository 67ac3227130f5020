//! Orthonormal basis of columns, and the part of the rows outside their space.

use faer::{Mat, MatRef};

use super::columns::{Columns, Part};
use super::groups::RowGroups;

findings::tuning! {
    /// Diagonal of a pivoted triangle below this share of the length of a column is rank lost.
    pub RANK_TOLERANCE: f64 = 1e-10;

    /// Columns of which those before them leave more than this share of their length are independent in any order, and a decomposition
    /// without pivots, which works in blocks and takes a fraction of the time, does.
    CLEARLY_LEFT: f64 = 1e-5;
}

/// An orthonormal basis of the space of columns: of every group of rows first what is its own, then what the
/// groups share and their own columns leave.
#[derive(Clone, Debug)]
pub struct Basis {
    groups: RowGroups,
    parts: Vec<Own>,
    /// Number of vectors that all groups share.
    shared: usize,
    log_volume: f64,
    /// `Σ B_ik²` of every row.
    leverages: Vec<f64>,
    /// The group of every row, and its place there.
    place_of_row: Vec<(usize, usize)>,
}

/// The basis in one group of rows.
#[derive(Clone, Debug)]
struct Own {
    rows: Vec<usize>,
    /// Vectors that are zero in all other groups (`rows × k`).
    own: Mat<f64>,
    /// The rows of the vectors that are shared (`rows × s`).
    shared: Mat<f64>,
}

impl Basis {
    /// Builds the basis of the columns, each scaled to unit length first.
    pub fn of(columns: &Columns) -> Self {
        Self::with_tolerance(columns, RANK_TOLERANCE.get())
    }

    /// The same where a column of which others leave less than `tolerance` of its length depends on them.
    pub fn with_tolerance(columns: &Columns, tolerance: f64) -> Self {
        let norms = columns.norms();
        let parts_of = columns.parts_of();
        let scale = |part: &Part, places: &[usize]| {
            Mat::from_fn(part.rows.len(), places.len(), |i, k| {
                let norm = norms[part.columns[places[k]]];
                if norm > 0.0 {
                    part.values[(i, places[k])] / norm
                } else {
                    0.0
                }
            })
        };
        let shared: Vec<usize> = (0..columns.ncols()).filter(|&k| parts_of[k] > 1).collect();
        let mut pivots = Vec::new();
        let mut parts = Vec::new();
        let mut left = Mat::<f64>::zeros(columns.nrows(), shared.len());
        let mut above = 0;
        for part in columns.parts() {
            let (own, others) = part.own_and_shared(&parts_of);
            let own = orthonormal_with_pivots(&scale(part, &own), tolerance, &mut pivots);
            let mut rest = scale(part, &others);
            // Twice is enough: what the first projection leaves of rounding, the second takes.
            for _ in 0..2 {
                rest = &rest - &own * (own.transpose() * &rest);
            }
            for (k, place) in others.iter().enumerate() {
                let Ok(to) = shared.binary_search(&part.columns[*place]) else {
                    continue;
                };
                for i in 0..part.rows.len() {
                    left[(above + i, to)] = rest[(i, k)];
                }
            }
            above += part.rows.len();
            parts.push(Own {
                rows: part.rows.clone(),
                own,
                shared: Mat::zeros(0, 0),
            });
        }
        let common = orthonormal_with_pivots(&left, tolerance, &mut pivots);
        let mut above = 0;
        for part in &mut parts {
            let count = part.rows.len();
            part.shared = common.as_ref().subrows(above, count).to_owned();
            above += count;
        }
        let lengths = norms.iter().copied().filter(|norm| *norm > 0.0);
        Self {
            groups: columns.groups().clone(),
            leverages: leverages(&parts, columns.nrows()),
            place_of_row: places(&parts, columns.nrows()),
            shared: common.ncols(),
            log_volume: pivots.into_iter().chain(lengths).map(f64::ln).sum(),
            parts,
        }
    }

    /// The groups of rows.
    pub fn groups(&self) -> &RowGroups {
        &self.groups
    }

    /// `½ ln |AᵀA|` of the columns `A`, of the part that has rank.
    pub fn log_volume(&self) -> f64 {
        self.log_volume
    }

    /// Number of vectors.
    pub fn rank(&self) -> usize {
        self.shared
            + self
                .parts
                .iter()
                .map(|part| part.own.ncols())
                .sum::<usize>()
    }

    /// The leverage of a row: the share of it that the columns take.
    pub fn leverage(&self, row: usize) -> f64 {
        self.leverages[row]
    }

    /// `(B Bᵀ)_ij` of two rows of one group.
    pub fn row_product(&self, i: usize, j: usize) -> f64 {
        let ((group, a), (_, b)) = (self.place_of_row[i], self.place_of_row[j]);
        let part = &self.parts[group];
        let product = |m: &Mat<f64>| -> f64 {
            let pairs = m.row(a).iter().zip(m.row(b).iter());
            pairs.map(|(a, b)| a * b).sum()
        };
        product(&part.own) + product(&part.shared)
    }

    /// `Bᵀ A` of columns in one group of rows (`k + s × columns`).
    pub fn inside(&self, group: usize, a: MatRef<'_, f64>) -> Mat<f64> {
        let part = &self.parts[group];
        let (own, shared) = (part.own.transpose() * a, part.shared.transpose() * a);
        stacked(&own, &shared)
    }

    /// `A − B Bᵀ A`. Where vectors are shared, the columns reach all groups.
    pub fn without(&self, a: &Columns) -> Columns {
        let mut shared = Mat::<f64>::zeros(self.shared, a.ncols());
        for (part, of) in self.parts.iter().zip(a.parts()) {
            let inside = part.shared.transpose() * &of.values;
            for (k, &column) in of.columns.iter().enumerate() {
                for i in 0..self.shared {
                    shared[(i, column)] += inside[(i, k)];
                }
            }
        }
        let all: Vec<usize> = (0..a.ncols()).collect();
        let mut left = if self.shared > 0 {
            let of_group = vec![all; self.parts.len()];
            a.spread_over(of_group)
        } else {
            a.clone()
        };
        for (group, part) in self.parts.iter().enumerate() {
            let to = left.part_mut(group);
            let inside = part.own.transpose() * &to.values;
            to.values -= &part.own * inside;
            if self.shared > 0 {
                to.values -= &part.shared * &shared;
            }
        }
        left
    }

    /// `r − B Bᵀ r` (`m`).
    pub fn without_column(&self, r: &[f64]) -> Vec<f64> {
        let mut left = r.to_vec();
        let gathered: Vec<Mat<f64>> = self
            .parts
            .iter()
            .map(|part| Mat::from_fn(part.rows.len(), 1, |i, _| r[part.rows[i]]))
            .collect();
        let mut shared = Mat::<f64>::zeros(self.shared, 1);
        for (part, own) in self.parts.iter().zip(&gathered) {
            shared += part.shared.transpose() * own;
        }
        for (part, own) in self.parts.iter().zip(&gathered) {
            let taken = &part.own * (part.own.transpose() * own) + &part.shared * &shared;
            for (i, &row) in part.rows.iter().enumerate() {
                left[row] = own[(i, 0)] - taken[(i, 0)];
            }
        }
        left
    }
}

fn leverages(parts: &[Own], rows: usize) -> Vec<f64> {
    let mut leverages = vec![0.0; rows];
    for part in parts {
        for (i, &row) in part.rows.iter().enumerate() {
            let square = |m: &Mat<f64>| m.row(i).iter().map(|v| v * v).sum::<f64>();
            leverages[row] = square(&part.own) + square(&part.shared);
        }
    }
    leverages
}

fn places(parts: &[Own], rows: usize) -> Vec<(usize, usize)> {
    let mut places = vec![(0, 0); rows];
    for (group, part) in parts.iter().enumerate() {
        for (place, &row) in part.rows.iter().enumerate() {
            places[row] = (group, place);
        }
    }
    places
}

/// `a` above `b`.
pub fn stacked(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    let above = a.nrows();
    Mat::from_fn(above + b.nrows(), a.ncols(), |i, k| {
        if i < above {
            a[(i, k)]
        } else {
            b[(i - above, k)]
        }
    })
}

/// An orthonormal basis of columns of unit length or shorter; the pivots of those that have rank are added.
pub fn orthonormal_with_pivots(
    scaled: &Mat<f64>,
    tolerance: f64,
    pivots: &mut Vec<f64>,
) -> Mat<f64> {
    if scaled.ncols() == 0 || scaled.nrows() == 0 {
        return Mat::zeros(scaled.nrows(), 0);
    }
    let plain = scaled.qr();
    let triangle = plain.thin_R();
    let left = triangle.diagonal().column_vector().iter();
    let left: Vec<f64> = left.map(|pivot| pivot.abs()).collect();
    if left.len() == scaled.ncols() && left.iter().all(|pivot| *pivot > CLEARLY_LEFT.get()) {
        pivots.extend(left);
        return plain.compute_thin_Q();
    }
    let qr = scaled.col_piv_qr();
    let triangle = qr.thin_R();
    let size = triangle.nrows().min(triangle.ncols());
    let rank = (0..size)
        .take_while(|&k| triangle[(k, k)].abs() > tolerance)
        .count();
    pivots.extend((0..rank).map(|k| triangle[(k, k)].abs()));
    qr.compute_thin_Q().as_ref().subcols(0, rank).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::joint::result::marginal::orthonormal;

    /// Two groups of eight rows with three columns of their own and two that both have; one column depends on others.
    fn example() -> Mat<f64> {
        Mat::from_fn(16, 9, |i, k| {
            let value = |k: usize| ((i * 7 + k * 5 + i * k * 3) % 17) as f64 - 8.0;
            match k {
                0..3 if i < 8 => value(k),
                3..6 if i >= 8 => value(k),
                6 | 7 => value(k),
                8 => value(6) + if i < 8 { value(0) } else { 0.0 },
                _ => 0.0,
            }
        })
    }

    #[test]
    fn groups_leave_what_the_whole_leaves() {
        let whole = example();
        let groups = RowGroups::new((0..16).map(|i| i / 8).collect());
        let [cut, one] = [groups, RowGroups::whole(16)].map(|g| Columns::cut(&whole, &g));
        let (basis, dense) = (Basis::of(&cut), orthonormal(&whole));
        assert_eq!((basis.rank(), dense.ncols()), (8, 8));
        assert!((basis.log_volume() - Basis::of(&one).log_volume()).abs() < 1e-11);
        let hat = &dense * dense.transpose();
        for (i, j) in [(0, 0), (3, 5), (9, 15), (12, 12)] {
            assert!((basis.row_product(i, j) - hat[(i, j)]).abs() < 1e-12);
        }
        assert!((basis.leverage(9) - hat[(9, 9)]).abs() < 1e-12);
        let a = Mat::from_fn(16, 2, |i, k| ((i * (k + 2)) % 5) as f64);
        let left = basis.without(&Columns::cut(&a, cut.groups())).to_dense();
        let direct = &a - &hat * &a;
        assert!((&left - &direct).norm_max() < 1e-12);
        let column: Vec<f64> = a.col(1).iter().copied().collect();
        for (i, value) in basis.without_column(&column).into_iter().enumerate() {
            assert!((value - direct[(i, 1)]).abs() < 1e-12);
        }
        let first = a.as_ref().subrows(0, 8);
        let inside = basis.inside(0, first);
        let taken = inside.transpose() * &inside;
        let direct = first.transpose() * (hat.as_ref().submatrix(0, 0, 8, 8) * first);
        assert!((taken - direct).norm_max() < 1e-10);
    }
}
