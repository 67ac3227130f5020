//! Least squares with coefficients that must not be negative.

use faer::{Mat, MatRef};

use crate::linear::vector::{add, dot, norm};
use crate::linear::{Factor, QrFactor, multiply};

/// Pull of a column on what is left of the target that is rounding, relative to the terms of which
/// it is left.
const PULL: f64 = 8.0 * f64::EPSILON;

/// Length of a unit column off the span of those in use below which it depends on them.
const DEPENDENT: f64 = 1e-12;

/// `argmin ‖b − A x‖` with `xⱼ ≥ 0`, except where `free[j]`.
///
/// The coefficients that are not zero belong to independent columns, apart from free ones. With unit
/// columns the answer is good to rounding; data that are not finite give zeros.
///
/// Source: Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23 (NNLS).
pub(crate) fn nonnegative(a: MatRef<'_, f64>, b: &[f64], free: &[bool]) -> Vec<f64> {
    let columns = a.ncols();
    let mut state = Passive::new(a, b, free);
    // A column enters once or twice in practice; the bound is against rounding that goes in circles.
    for _ in 0..3 * columns + 3 {
        let Some(j) = state.most_pulling() else { break };
        state.enter(j);
    }
    state.x
}

/// The columns in use and their coefficients.
struct Passive<'a> {
    a: MatRef<'a, f64>,
    b: &'a [f64],
    free: &'a [bool],
    columns: Vec<usize>,
    /// Zero off the columns in use.
    x: Vec<f64>,
    /// Columns whose pull turned out to be rounding.
    refused: Vec<usize>,
}

impl<'a> Passive<'a> {
    /// The free columns alone.
    fn new(a: MatRef<'a, f64>, b: &'a [f64], free: &'a [bool]) -> Self {
        let mut state = Self {
            a,
            b,
            free,
            columns: (0..a.ncols()).filter(|&j| free[j]).collect(),
            x: vec![0.0; a.ncols()],
            refused: Vec::new(),
        };
        if let Some(x) = state.unrestricted() {
            state.x = x;
        }
        state
    }

    /// The unused column whose part off the span of those in use points most along the residual.
    ///
    /// The whole column's pull is lost in rounding where it lies close to the span.
    fn most_pulling(&self) -> Option<usize> {
        let left = add(self.b, -1.0, &multiply(self.a, &self.x));
        let terms = norm(self.b) + self.x.iter().map(|x| x.abs()).sum::<f64>();
        let factor = self.factor();
        let pull = |j: usize| {
            let part = self.off_span(j, factor.as_ref())?;
            let size = norm(&part);
            let pull = dot(&part, &left) / size;
            let floor = PULL * (terms + norm(&left) / size);
            (size > DEPENDENT && pull > floor).then_some((j, pull))
        };
        (0..self.x.len())
            .filter(|j| !self.columns.contains(j) && !self.refused.contains(j))
            .filter_map(pull)
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(j, _)| j)
    }

    /// The part of a column off the span of those in use.
    fn off_span(&self, j: usize, factor: Option<&QrFactor>) -> Option<Vec<f64>> {
        let column: Vec<f64> = self.a.col(j).iter().copied().collect();
        let within = multiply(self.a, &self.least_squares(factor, &column)?);
        Some(add(&column, -1.0, &within))
    }

    /// Takes a column in, and out what it makes negative.
    fn enter(&mut self, entering: usize) {
        self.columns.push(entering);
        let mut first = true;
        while let Some(next) = self.unrestricted() {
            if first && next[entering] <= 0.0 {
                break;
            }
            first = false;
            let negative = |j: &usize| !self.free[*j] && next[*j] <= 0.0;
            if !self.columns.iter().any(negative) {
                self.x = next;
                self.refused.clear();
                return;
            }
            self.move_towards(&next);
        }
        if first {
            self.columns.retain(|&j| j != entering);
            self.refused.push(entering);
        }
    }

    /// Goes towards coefficients until the first becomes zero, and drops what is zero then.
    fn move_towards(&mut self, next: &[f64]) {
        let reach = |&j: &usize| self.x[j] / (self.x[j] - next[j]);
        let negative = self
            .columns
            .iter()
            .filter(|&&j| !self.free[j] && next[j] <= 0.0);
        let Some(&blocking) = negative.min_by(|i, j| reach(i).total_cmp(&reach(j))) else {
            return;
        };
        let way = reach(&blocking);
        for &j in &self.columns {
            self.x[j] += way * (next[j] - self.x[j]);
        }
        self.x[blocking] = 0.0;
        for j in (0..self.x.len()).filter(|&j| !self.free[j]) {
            self.x[j] = self.x[j].max(0.0);
        }
        let (x, free) = (&self.x, self.free);
        self.columns.retain(|&j| free[j] || x[j] > 0.0);
    }

    /// The target's best coefficients on the columns in use.
    fn unrestricted(&self) -> Option<Vec<f64>> {
        self.least_squares(self.factor().as_ref(), self.b)
    }

    /// The columns in use factored, if there are any.
    fn factor(&self) -> Option<QrFactor> {
        let used = Mat::from_fn(self.a.nrows(), self.columns.len(), |i, k| {
            self.a[(i, self.columns[k])]
        });
        let factored = || QrFactor::new(used.as_ref(), &vec![1.0; self.columns.len()]);
        (!self.columns.is_empty()).then(factored)
    }

    /// `argmin ‖b − A x‖` on the columns in use.
    fn least_squares(&self, factor: Option<&QrFactor>, b: &[f64]) -> Option<Vec<f64>> {
        let mut x = vec![0.0; self.a.ncols()];
        let Some(factor) = factor else { return Some(x) };
        let opposite: Vec<f64> = b.iter().map(|b| -b).collect();
        for (&j, value) in self.columns.iter().zip(factor.undamped(&opposite)?) {
            x[j] = value;
        }
        Some(x)
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    fn left(a: &Mat<f64>, b: &[f64], x: &[f64]) -> f64 {
        norm(&add(b, -1.0, &multiply(a.as_ref(), x)))
    }

    /// The least residual over every set of columns in use.
    fn brute_force(a: &Mat<f64>, b: &[f64], free: &[bool]) -> f64 {
        let sets = 0..1_u32 << a.ncols();
        let each = sets.filter_map(|set| {
            let columns = (0..a.ncols()).filter(|j| set >> j & 1 == 1).collect();
            let state = Passive {
                a: a.as_ref(),
                b,
                free,
                columns,
                x: Vec::new(),
                refused: Vec::new(),
            };
            let x = state.unrestricted()?;
            let allowed = x.iter().zip(free).all(|(x, free)| *free || *x >= 0.0);
            allowed.then(|| left(a, b, &x))
        });
        each.fold(f64::INFINITY, f64::min)
    }

    /// Unit columns, some of which are combinations or copies of others.
    fn columns(random: &mut ChaCha8Rng, rows: usize, count: usize) -> Mat<f64> {
        let mut a = Mat::from_fn(rows, count, |_, _| random.random_range(-1.0..1.0));
        for j in 2..count {
            let weight = [0.0, 0.5][random.random_range(0..2)];
            if random.random_range(0..2) == 0 {
                for i in 0..rows {
                    a[(i, j)] = a[(i, j - 2)] + weight * a[(i, j - 1)];
                }
            }
        }
        let size: Vec<f64> = (0..count).map(|j| norm(a.col_as_slice(j))).collect();
        Mat::from_fn(rows, count, |i, j| a[(i, j)] / size[j])
    }

    #[test]
    fn no_set_of_columns_comes_nearer_than_the_one_found() {
        for seed in 0..500 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let (rows, count) = (random.random_range(1..=4), random.random_range(1..=7));
            let a = columns(random, rows, count);
            let b: Vec<f64> = (0..rows).map(|_| random.random_range(-1.0..1.0)).collect();
            let free: Vec<bool> = (0..count).map(|_| random.random_range(0..5) == 0).collect();
            let x = nonnegative(a.as_ref(), &b, &free);
            assert!(x.iter().zip(&free).all(|(x, free)| *free || *x >= 0.0));
            let (found, least) = (left(&a, &b, &x), brute_force(&a, &b, &free));
            // Unit columns: the residual is as good as the pulls, each below 1e-13.
            assert!((found - least).abs() < 1e-11, "{seed}: {found} {least}");
        }
    }

    #[test]
    fn of_copies_of_a_column_one_is_used() {
        let a = Mat::from_fn(2, 5, |i, _| if i == 0 { 0.6 } else { 0.8 });
        let x = nonnegative(a.as_ref(), &[0.6, 0.8], &[false; 5]);
        assert_eq!(x.iter().filter(|x| **x != 0.0).count(), 1);
        assert!((x.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn data_that_are_not_finite_give_zeros() {
        for odd in [f64::NAN, f64::INFINITY] {
            let a = Mat::from_fn(2, 3, |i, k| if i == k { odd } else { 0.5 });
            assert_eq!(
                nonnegative(a.as_ref(), &[1.0, 1.0], &[false; 3])[..2],
                [0.0; 2]
            );
            let unit = Mat::<f64>::identity(2, 2);
            assert_eq!(
                nonnegative(unit.as_ref(), &[odd, 1.0], &[true, false]),
                [0.0; 2]
            );
        }
    }
}
