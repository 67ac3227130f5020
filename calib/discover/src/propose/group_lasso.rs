//! The group lasso as a second-order cone program.

use std::ops::Range;

use faer::Mat;
use solver::SupportedConeT::SecondOrderConeT;
use solver::{ConeProgram, CscMatrix};

/// A gradient that exceeds its bound by less than this share is within it: what the interior point leaves.
const SLACK: f64 = 1e-5;

/// A group whose norm is below this share of the largest is out: the interior point stops short of zero.
const OUT: f64 = 1e-4;

/// Rounds of taking in groups that violate their bound.
const ROUNDS: usize = 12;

/// `min ½ ‖y − X β‖² + λ Σ_g √p_g ‖β_g‖` over groups of `p_g` columns, from its normal equations.
///
/// Source: Yuan and Lin, Model selection and estimation in regression with grouped variables, 2006.
#[derive(Clone, Debug)]
pub struct GroupLasso {
    /// `XᵀX` (`p × p`).
    pub gram: Mat<f64>,
    /// `Xᵀy` (`p`).
    pub moved: Vec<f64>,
    /// The columns of every group.
    pub groups: Vec<Range<usize>>,
}

impl GroupLasso {
    /// The least `λ` at which nothing is selected.
    pub fn largest(&self) -> f64 {
        let nothing = vec![0.0; self.moved.len()];
        let pulls = (0..self.groups.len()).map(|g| self.pull(g, &nothing));
        pulls.fold(0.0, f64::max)
    }

    /// `β` at `lambda`, the program being solved over `active` groups first and over those that would
    /// enter until none would; `active` holds the groups that are not zero afterwards. `None` where the interior
    /// point fails.
    pub fn solve(&self, lambda: f64, active: &mut Vec<usize>) -> Option<Vec<f64>> {
        let mut beta = vec![0.0; self.moved.len()];
        for _ in 0..ROUNDS {
            let entering: Vec<usize> = (0..self.groups.len())
                .filter(|g| !active.contains(g) && self.pull(*g, &beta) > lambda * (1.0 + SLACK))
                .collect();
            if entering.is_empty() && beta.iter().any(|b| *b != 0.0) {
                break;
            }
            active.extend(entering);
            if active.is_empty() {
                return Some(beta);
            }
            beta = self.over(active, lambda)?;
        }
        let norm = |g: &usize| norm(&beta[self.groups[*g].clone()]);
        let largest = active.iter().map(norm).fold(0.0, f64::max);
        active.retain(|g| norm(g) > OUT * largest);
        Some(beta)
    }

    /// `‖X_gᵀ (y − X β)‖ / √p_g`: at most `λ` at the minimum, `λ` where the group is not zero.
    pub fn pull(&self, group: usize, beta: &[f64]) -> f64 {
        let range = self.groups[group].clone();
        let count = range.len() as f64;
        let gradient: Vec<f64> = range
            .map(|i| {
                let taken = beta.iter().enumerate().filter(|(_, b)| **b != 0.0);
                self.moved[i] - taken.map(|(k, b)| self.gram[(i, k)] * b).sum::<f64>()
            })
            .collect();
        norm(&gradient) / count.sqrt()
    }

    /// The minimum with all other groups at zero: variables `(s_g, β_g)`, each in a cone `‖β_g‖ ≤ s_g`.
    fn over(&self, active: &[usize], lambda: f64) -> Option<Vec<f64>> {
        // The place of each variable among the columns; `None` for a bound.
        let mut places = Vec::new();
        let mut linear = Vec::new();
        let mut cones = Vec::new();
        for &g in active {
            let range = self.groups[g].clone();
            cones.push(SecondOrderConeT(range.len() + 1));
            places.push(None);
            linear.push((range.len() as f64).sqrt());
            for i in range {
                places.push(Some(i));
                linear.push(-self.moved[i] / lambda);
            }
        }
        let n = places.len();
        let quadratic = upper_triangle(n, |i, k| match (places[i], places[k]) {
            (Some(i), Some(k)) => self.gram[(i, k)],
            _ => 0.0,
        });
        let negative = CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), vec![-1.0; n]);
        let program = ConeProgram {
            curvature: &quadratic,
            slope: &linear,
            matrix: &negative,
            limits: &vec![0.0; n],
            cones: &cones,
        };
        let found = program.solve()?;
        let mut beta = vec![0.0; self.moved.len()];
        for (place, value) in places.iter().zip(&found.x) {
            if let Some(i) = place {
                beta[*i] = lambda * value;
            }
        }
        found.solved.then_some(beta)
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The upper triangle of a matrix, column-compressed, without its zeros.
fn upper_triangle(n: usize, entry: impl Fn(usize, usize) -> f64) -> CscMatrix<f64> {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for k in 0..n {
        for i in 0..=k {
            let value = entry(i, k);
            if value != 0.0 {
                rows.push(i);
                values.push(value);
            }
        }
        starts.push(rows.len());
    }
    CscMatrix::new(n, n, starts, rows, values)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn of_orthonormal_columns_every_group_is_shrunk_by_the_same_length() {
        let problem = GroupLasso {
            gram: Mat::identity(5, 5),
            moved: vec![3.0, 4.0, 0.5, -1.0, 2.0],
            groups: vec![0..2, 2..4, 4..5],
        };
        assert!((problem.largest() - 5.0 / 2.0_f64.sqrt()).abs() < 1e-15);
        let mut active = Vec::new();
        let beta = problem.solve(1.0, &mut active).unwrap();
        // β_g = (1 − λ √p_g / ‖c_g‖)₊ c_g (Yuan and Lin 2006): norms 5 and 2 less √2 and 1; 1.1 is below √2.
        let share = 1.0 - 2.0_f64.sqrt() / 5.0;
        active.sort_unstable();
        assert_eq!(active, [0, 2]);
        for (found, expected) in beta.iter().zip([3.0 * share, 4.0 * share, 0.0, 0.0, 1.0]) {
            // The interior point stops at 1e-8 of the cost.
            assert!((found - expected).abs() < 1e-4, "{beta:?}");
        }
    }

    #[test]
    fn at_the_minimum_the_groups_that_are_in_pull_by_lambda_and_the_others_by_less() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let x = Mat::from_fn(30, 60, |_, _| random.random_range(-1.0..1.0));
        let y = Mat::from_fn(30, 1, |i, _| x[(i, 4)] - 2.0 * x[(i, 5)] + x[(i, 40)]);
        let moved = x.transpose() * &y;
        let problem = GroupLasso {
            gram: x.transpose() * &x,
            moved: moved.col(0).iter().copied().collect(),
            groups: (0..20).map(|g| 3 * g..3 * g + 3).collect(),
        };
        let lambda = 0.3 * problem.largest();
        let mut active = Vec::new();
        let beta = problem.solve(lambda, &mut active).unwrap();
        assert!(active.contains(&1) && active.len() < 20, "{active:?}");
        for g in 0..20 {
            let pull = problem.pull(g, &beta) / lambda;
            assert!(pull < 1.0 + 1e-4, "{g}: {pull}");
            if active.contains(&g) {
                assert!(pull > 1.0 - 1e-3, "{g}: {pull}");
            }
        }
        assert!(
            problem
                .solve(problem.largest() * 1.01, &mut vec![])
                .unwrap()
                == vec![0.0; 60]
        );
    }
}
