//! Singular values and right vectors of a small matrix.

use faer::{Mat, MatRef};

use crate::linear::vector::dot;

/// Cosine between two columns at which they count as orthogonal, per root of their length: the
/// rounding of their product.
const ORTHOGONAL: f64 = 2.0 * f64::EPSILON;

/// Length of a column, relative to the whole matrix, below which it is rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Share of the square of a column's length below which it is measured again and not updated.
const CANCELLED: f64 = 1e-2;

/// Least ratio of singular values at which the directions of all rotated columns are resolved.
const RESOLVED: f64 = 1e-10;

/// Most sweeps over all pairs; four to six are usual.
const SWEEPS: usize = 40;

/// Singular values, descending, with the right vectors as the columns of `V` (`n × n`).
pub(crate) struct Singular {
    /// One for every column; zeros where the matrix has fewer rows.
    pub values: Vec<f64>,
    /// Orthonormal.
    pub vectors: Mat<f64>,
}

/// The singular values and all right vectors. `None` where the rotations do not come to an end
/// (entries that are not finite).
///
/// The rows of a square matrix of full rank become the right vectors themselves, times the singular
/// values; in general the product of the rotations of the columns holds them.
pub(crate) fn singular(a: MatRef<'_, f64>) -> Option<Singular> {
    let n = a.ncols();
    if a.nrows() == n {
        let rows = Columns::of(a.transpose(), 0).orthogonal()?;
        let found = rows.sorted(0, |k| 1.0 / rows.unscaled_length(k));
        let ends = (found.values.first(), found.values.last());
        if matches!(ends, (Some(most), Some(least)) if *least > RESOLVED * most) {
            return Some(found);
        }
    }
    let columns = Columns::of(a, n).orthogonal()?;
    Some(columns.sorted(columns.rows, |_| 1.0))
}

/// Columns one after the other, `rows` entries of the matrix and then what rotates along with them.
///
/// Source of the method: Hestenes, "Inversion of matrices by biorthogonalization and related
/// results", 1958.
struct Columns {
    entries: Vec<f64>,
    rows: usize,
    stride: usize,
    count: usize,
    /// Largest entry of the matrix; the entries are relative to it.
    unit: f64,
}

impl Columns {
    /// The columns of a matrix, with as many of the unit matrix below it.
    fn of(a: MatRef<'_, f64>, identity: usize) -> Self {
        let (rows, count) = a.shape();
        let stride = rows + identity;
        let largest = a.norm_max();
        let unit = if largest == 0.0 { 1.0 } else { largest };
        let mut entries = vec![0.0; stride * count];
        for k in 0..count {
            let column = &mut entries[k * stride..(k + 1) * stride];
            for (value, original) in column.iter_mut().zip(a.col(k).iter()) {
                *value = original / unit;
            }
            if identity > 0 {
                column[rows + k] = 1.0;
            }
        }
        Self {
            entries,
            rows,
            stride,
            count,
            unit,
        }
    }

    fn column(&self, k: usize) -> &[f64] {
        &self.entries[k * self.stride..][..self.rows]
    }

    fn square(&self, k: usize) -> f64 {
        dot(self.column(k), self.column(k))
    }

    fn unscaled_length(&self, k: usize) -> f64 {
        self.square(k).sqrt()
    }

    fn length(&self, k: usize) -> f64 {
        self.unit * self.unscaled_length(k)
    }

    /// Rotates pairs of columns until all are orthogonal: their lengths are the singular values.
    fn orthogonal(mut self) -> Option<Self> {
        let mut squares = vec![0.0; self.count];
        for _ in 0..SWEEPS {
            for (k, square) in squares.iter_mut().enumerate() {
                *square = self.square(k);
            }
            if !squares.iter().all(|v| v.is_finite()) {
                return None;
            }
            if !self.sweep(&mut squares) {
                return Some(self);
            }
        }
        None
    }

    /// Visits every pair once; whether one had to be rotated.
    ///
    /// In turns of pairs that share no column, so that the square roots of one need not wait for
    /// those of the pair before.
    fn sweep(&mut self, squares: &mut [f64]) -> bool {
        let floor = ROUNDING * ROUNDING * squares.iter().sum::<f64>();
        let orthogonal = ORTHOGONAL * ORTHOGONAL * self.rows as f64;
        let mut rotated = false;
        for turn in 0..self.count {
            for i in 0..self.count {
                let k = if i <= turn {
                    turn - i
                } else {
                    self.count + turn - i
                };
                if i >= k {
                    continue;
                }
                let (aa, bb) = (squares[i], squares[k]);
                let ab = dot(self.column(i), self.column(k));
                if aa.min(bb) <= floor || ab * ab <= orthogonal * aa * bb {
                    continue;
                }
                let tangent = tangent(aa, bb, ab);
                self.rotate(i, k, tangent);
                rotated = true;
                for (j, square) in [(i, aa - tangent * ab), (k, bb + tangent * ab)] {
                    squares[j] = if square > CANCELLED * squares[j] {
                        square
                    } else {
                        self.square(j)
                    };
                }
            }
        }
        rotated
    }

    /// Rotates columns `i < k`.
    fn rotate(&mut self, i: usize, k: usize, tangent: f64) {
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        let sine = cosine * tangent;
        let (before, after) = self.entries.split_at_mut(k * self.stride);
        let a = &mut before[i * self.stride..][..self.stride];
        let b = &mut after[..self.stride];
        for j in 0..self.stride {
            (a[j], b[j]) = (cosine * a[j] - sine * b[j], sine * a[j] + cosine * b[j]);
        }
    }

    /// The columns from the longest to the shortest.
    fn order(&self) -> Vec<usize> {
        let squares: Vec<f64> = (0..self.count).map(|k| self.square(k)).collect();
        let mut order: Vec<usize> = (0..self.count).collect();
        order.sort_by(|&i, &k| squares[k].total_cmp(&squares[i]));
        order
    }

    /// Lengths, and the entries from `first` on, times a factor per column, as vectors.
    fn sorted(&self, first: usize, factor: impl Fn(usize) -> f64) -> Singular {
        let order = self.order();
        let mut vectors = Mat::zeros(self.count, self.count);
        for (place, &k) in order.iter().enumerate() {
            let factor = factor(k);
            let entries = &self.entries[k * self.stride + first..];
            for (value, entry) in vectors.col_as_slice_mut(place).iter_mut().zip(entries) {
                *value = factor * entry;
            }
        }
        Singular {
            values: order.iter().map(|&k| self.length(k)).collect(),
            vectors,
        }
    }
}

/// The tangent of the rotation that makes two columns with these products orthogonal.
fn tangent(aa: f64, bb: f64, ab: f64) -> f64 {
    let half = (bb - aa) / (2.0 * ab);
    1f64.copysign(half) / (half.abs() + (1.0 + half * half).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_decomposition_of_faer() {
        for (m, n) in [(1, 1), (9, 9), (4, 3), (2, 5), (20, 6)] {
            let a = Mat::from_fn(m, n, |i, k| ((i * 5 + k * 3 + i * i * k) % 11) as f64 - 4.0);
            let ours = singular(a.as_ref()).unwrap();
            let full = a.singular_values().unwrap();
            for (k, value) in ours.values.iter().enumerate() {
                let oracle = full.get(k).copied().unwrap_or(0.0);
                assert!((value - oracle).abs() < 1e-13 * full[0], "{m} {n} {k}");
            }
            // `A V` has orthogonal columns of the lengths of the singular values.
            let v = &ours.vectors;
            let gram = v.transpose() * a.transpose() * &a * v;
            let identity = v.transpose() * v;
            for i in 0..n {
                for k in 0..n {
                    let (square, one) = match i == k {
                        true => (ours.values[k].powi(2), 1.0),
                        false => (0.0, 0.0),
                    };
                    assert!((gram[(i, k)] - square).abs() < 1e-12 * full[0] * full[0]);
                    assert!((identity[(i, k)] - one).abs() < 1e-14, "{m} {n} {i} {k}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_finite_has_no_singular_values() {
        for bad in [f64::NAN, f64::INFINITY] {
            let a = Mat::from_fn(2, 2, |i, _| bad + i as f64);
            assert!(singular(a.as_ref()).is_none());
        }
    }

    #[test]
    fn lengths_of_every_size_are_resolved_relative_to_themselves() {
        // Orthogonal columns of lengths 1e-140 and 1e140, turned by a right rotation of 30°: one
        // sweep turns them back. What is below rounding of the largest is zero or as it was.
        let (c, s) = (0.75f64.sqrt(), 0.5);
        for (small, large) in [(1e130, 1e140), (1e-140, 1e-131)] {
            let a = Mat::from_fn(2, 2, |i, k| {
                [[c * small, -s * small], [s * large, c * large]][i][k]
            });
            let found = singular(a.as_ref()).unwrap();
            let values = found.values;
            assert!((values[0] / large - 1.0).abs() < 1e-14);
            // Entries near `large` are rounded by 1e-16 of it.
            assert!((values[1] - small).abs() < 1e-15 * large, "{values:?}");
            assert!((found.vectors[(1, 0)].abs() - c).abs() < 1e-14);
        }
    }
}
