//! The group lasso by descent from group to group.

use std::ops::Range;

use faer::{Mat, Side};

findings::tuning! {
    /// A gradient that exceeds its bound by less than this share is within it.
    SLACK: f64 = 1e-5;

    /// Sweeps over the groups end where no coefficient moves by more than this share of the largest.
    SETTLED: f64 = 1e-7;

    /// Sweeps at most: groups that share 98 % of their directions settle in some hundred.
    SWEEPS: usize = 2000;

    /// Rounds of taking in groups that violate their bound.
    ROUNDS: usize = 12;

    /// Newton steps for the length of one group: from below they double the digits.
    STEPS: usize = 50;
}

/// `min ½ ‖y − X β‖² + λ Σ_g √p_g ‖β_g‖` over groups of `p_g` columns, from its normal equations.
///
/// Each group in turn is put to its own minimum, the others being held: of `G_g = V D Vᵀ` and the pull `c = Vᵀ (X_gᵀ y − Σ_h G_gh β_h)`
/// of the others the length `s` solves `Σ c_i² / (d_i s + λ √p_g)² = 1`, and `β_g = V (c_i s / (d_i s + λ √p_g))`.
///
/// Sources: Yuan and Lin, Model selection and estimation in regression with grouped variables, 2006; Friedman, Hastie and Tibshirani,
/// A note on the group lasso and a sparse group lasso, 2010, for groups that are not orthonormal.
#[derive(Clone, Debug)]
pub struct GroupLasso {
    /// `XᵀX` (`p × p`).
    gram: Mat<f64>,
    /// `Xᵀy` (`p`).
    moved: Vec<f64>,
    /// The groups.
    groups: Vec<Group>,
}

/// The columns of a group, with the eigenvalues `D` and eigenvectors `V` of their part of `XᵀX`.
#[derive(Clone, Debug)]
struct Group {
    range: Range<usize>,
    curvatures: Vec<f64>,
    directions: Mat<f64>,
}

impl GroupLasso {
    /// The problem of `XᵀX`, `Xᵀy` and the columns of every group; `None` where these are no numbers.
    pub fn new(gram: Mat<f64>, moved: Vec<f64>, groups: &[Range<usize>]) -> Option<Self> {
        let group = |range: &Range<usize>| {
            let own = gram.submatrix(range.start, range.start, range.len(), range.len());
            let eigen = own.self_adjoint_eigen(Side::Lower).ok()?;
            Some(Group {
                range: range.clone(),
                curvatures: eigen
                    .S()
                    .column_vector()
                    .iter()
                    .map(|d| d.max(0.0))
                    .collect(),
                directions: eigen.U().to_owned(),
            })
        };
        let groups = groups.iter().map(group).collect::<Option<_>>()?;
        Some(Self {
            gram,
            moved,
            groups,
        })
    }

    /// The least `λ` at which nothing is selected.
    pub fn largest(&self) -> f64 {
        let nothing = vec![0.0; self.moved.len()];
        let pulls = (0..self.groups.len()).map(|g| self.pull(g, &nothing));
        pulls.fold(0.0, f64::max)
    }

    /// The groups that are not zero at the minimum for `lambda`, where `beta` is put, from where it is.
    pub fn solve(&self, lambda: f64, beta: &mut [f64]) -> Vec<usize> {
        self.descend(lambda, &self.active(beta), beta);
        for _ in 0..ROUNDS.get() {
            let mut tried = self.active(beta);
            let enters = |g: &usize| self.pull(*g, beta) > lambda * (1.0 + SLACK.get());
            let apart = (0..self.groups.len()).filter(|g| !tried.contains(g));
            let entering: Vec<usize> = apart.filter(enters).collect();
            if entering.is_empty() {
                break;
            }
            tried.extend(entering);
            self.descend(lambda, &tried, beta);
        }
        self.active(beta)
    }

    /// The groups that are not zero.
    fn active(&self, beta: &[f64]) -> Vec<usize> {
        let is_in = |g: &usize| {
            beta[self.groups[*g].range.clone()]
                .iter()
                .any(|b| *b != 0.0)
        };
        (0..self.groups.len()).filter(is_in).collect()
    }

    /// `‖X_gᵀ (y − X β)‖ / √p_g`: at most `λ` at the minimum, `λ` where the group is not zero.
    fn pull(&self, group: usize, beta: &[f64]) -> f64 {
        let range = &self.groups[group].range;
        norm(&self.gradient(range, beta)) / (range.len() as f64).sqrt()
    }

    /// `X_gᵀ (y − X β)`.
    fn gradient(&self, range: &Range<usize>, beta: &[f64]) -> Vec<f64> {
        let mut gradient = self.moved[range.clone()].to_vec();
        for (k, b) in beta.iter().enumerate().filter(|(_, b)| **b != 0.0) {
            let column = self.gram.col(k);
            for (own, i) in gradient.iter_mut().zip(range.clone()) {
                *own -= column[i] * b;
            }
        }
        gradient
    }

    /// Puts one group after the other to its minimum until none moves.
    fn descend(&self, lambda: f64, groups: &[usize], beta: &mut [f64]) {
        for _ in 0..SWEEPS.get() {
            let mut moved = 0.0_f64;
            for g in groups {
                let group = &self.groups[*g];
                let before = beta[group.range.clone()].to_vec();
                beta[group.range.clone()].fill(0.0);
                let pull = self.gradient(&group.range, beta);
                let own = group.minimum(&pull, lambda);
                for (b, a) in own.iter().zip(&before) {
                    moved = moved.max((b - a).abs());
                }
                beta[group.range.clone()].copy_from_slice(&own);
            }
            if moved <= SETTLED.get() * beta.iter().fold(0.0, |most: f64, b| most.max(b.abs())) {
                break;
            }
        }
    }
}

impl Group {
    /// `β_g` at its minimum, the others being held, whose residual pulls it.
    fn minimum(&self, pull: &[f64], lambda: f64) -> Vec<f64> {
        let count = pull.len();
        let shrunk = lambda * (count as f64).sqrt();
        if norm(pull) <= shrunk {
            return vec![0.0; count];
        }
        let along = |k: usize| (0..count).map(|i| self.directions[(i, k)] * pull[i]).sum();
        let pulls: Vec<f64> = (0..count).map(along).collect();
        let length = self.length(&pulls, shrunk);
        let taken = pulls.iter().zip(&self.curvatures);
        let taken: Vec<f64> = taken
            .map(|(c, d)| c * length / (d * length + shrunk))
            .collect();
        let of = |i: usize| (0..count).map(|k| self.directions[(i, k)] * taken[k]).sum();
        (0..count).map(of).collect()
    }

    /// The length `s` with `Σ c_i² / (d_i s + μ)² = 1`: the sum falls and is convex, so that Newton's steps from zero stay below.
    fn length(&self, pulls: &[f64], shrunk: f64) -> f64 {
        let mut length = 0.0;
        for _ in 0..STEPS.get() {
            let (mut sum, mut slope) = (0.0, 0.0);
            for (c, d) in pulls.iter().zip(&self.curvatures) {
                let below = d * length + shrunk;
                sum += (c / below).powi(2);
                slope -= 2.0 * d * (c / below).powi(2) / below;
            }
            let step = (1.0 - sum) / slope;
            if !step.is_finite() || step <= f64::EPSILON * length {
                break;
            }
            length += step;
        }
        length
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use solver::SupportedConeT::SecondOrderConeT;
    use solver::{ConeProgram, CscMatrix};

    use super::*;

    #[test]
    fn of_orthonormal_columns_every_group_is_shrunk_by_the_same_length() {
        let moved = vec![3.0, 4.0, 0.5, -1.0, 2.0];
        let problem = GroupLasso::new(Mat::identity(5, 5), moved, &[0..2, 2..4, 4..5]).unwrap();
        assert!((problem.largest() - 5.0 / 2.0_f64.sqrt()).abs() < 1e-15);
        let mut beta = vec![0.0; 5];
        // β_g = (1 − λ √p_g / ‖c_g‖)₊ c_g (Yuan and Lin 2006): norms 5 and 2 less √2 and 1; 1.1 is below √2.
        let share = 1.0 - 2.0_f64.sqrt() / 5.0;
        assert_eq!(problem.solve(1.0, &mut beta), [0, 2]);
        for (found, expected) in beta.iter().zip([3.0 * share, 4.0 * share, 0.0, 0.0, 1.0]) {
            assert!((found - expected).abs() < 1e-12, "{beta:?}");
        }
    }

    /// 20 groups of three columns, two of which explain the data.
    fn problem() -> GroupLasso {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let x = Mat::from_fn(30, 60, |_, _| random.random_range(-1.0..1.0));
        let y = Mat::from_fn(30, 1, |i, _| x[(i, 4)] - 2.0 * x[(i, 5)] + x[(i, 40)]);
        let moved = x.transpose() * &y;
        let moved = moved.col(0).iter().copied().collect();
        let groups: Vec<_> = (0..20).map(|g| 3 * g..3 * g + 3).collect();
        GroupLasso::new(x.transpose() * &x, moved, &groups).unwrap()
    }

    #[test]
    fn at_the_minimum_the_groups_that_are_in_pull_by_lambda_and_the_others_by_less() {
        let problem = problem();
        let mut beta = vec![0.0; 60];
        for share in [0.8, 0.5, 0.3] {
            let lambda = share * problem.largest();
            let active = problem.solve(lambda, &mut beta);
            assert!(active.contains(&1) && active.len() < 20, "{active:?}");
            for g in 0..20 {
                let pull = problem.pull(g, &beta) / lambda;
                assert!(pull < 1.0 + 1e-4, "{g}: {pull}");
                assert!(!active.contains(&g) || pull > 1.0 - 1e-4, "{g}: {pull}");
            }
        }
        beta.fill(0.0);
        assert!(
            problem
                .solve(problem.largest() * 1.01, &mut beta)
                .is_empty()
        );
        assert_eq!(beta, [0.0; 60]);
    }

    /// Variables `(s_g, β_g)`, each in a cone `‖β_g‖ ≤ s_g`.
    fn as_a_cone_program(problem: &GroupLasso, lambda: f64) -> Vec<f64> {
        let (mut places, mut linear) = (Vec::new(), Vec::new());
        for group in &problem.groups {
            places.push(None);
            linear.push((group.range.len() as f64).sqrt());
            places.extend(group.range.clone().map(Some));
            linear.extend(group.range.clone().map(|i| -problem.moved[i] / lambda));
        }
        let n = places.len();
        let entry = |i: usize, k: usize| match (places[i], places[k]) {
            (Some(i), Some(k)) => problem.gram[(i, k)],
            _ => 0.0,
        };
        let upper = |k: usize| (0..=k).map(move |i| (i, k, entry(i, k)));
        let (mut rows, mut columns, mut values) = (vec![], vec![], vec![]);
        for (i, k, value) in (0..n).flat_map(upper) {
            rows.push(i);
            columns.push(k);
            values.push(value);
        }
        let curvature = CscMatrix::new_from_triplets(n, n, rows, columns, values);
        let groups = problem.groups.iter();
        let cones: Vec<_> = groups
            .map(|group| SecondOrderConeT(group.range.len() + 1))
            .collect();
        let program = ConeProgram {
            curvature: &curvature,
            slope: &linear,
            matrix: &CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), vec![-1.0; n]),
            limits: &vec![0.0; n],
            cones: &cones,
        };
        let found = program.solve().unwrap();
        let own = places
            .iter()
            .zip(&found.x)
            .filter(|(place, _)| place.is_some());
        own.map(|(_, value)| lambda * value).collect()
    }

    #[test]
    fn the_interior_point_of_the_cone_program_ends_at_the_same_minimum() {
        let problem = problem();
        let mut beta = vec![0.0; 60];
        for share in [0.7, 0.4, 0.2] {
            let lambda = share * problem.largest();
            problem.solve(lambda, &mut beta);
            let other = as_a_cone_program(&problem, lambda);
            // The accuracy that the interior point asks of itself is 1e-8 of the cost.
            for (own, other) in beta.iter().zip(&other) {
                assert!((own - other).abs() < 1e-4, "{share}: {own} {other}");
            }
        }
    }
}
