//! Elimination of blocks against the dense solution.

#![allow(clippy::unwrap_used)]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{
    BlockProblem, Mask, Options, Parameters, Residual, Scalar, lit, solve, solve_blocks,
};

const SHARED: usize = 3;
const OWN: usize = 2;

/// Slightly nonlinear random rows in the shared parameters and those of one or two blocks.
#[derive(Clone)]
struct Rows {
    coefficients: Vec<Vec<f64>>,
    targets: Vec<f64>,
}

impl<D: Scalar> Residual<D> for Rows {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (row, target) in self.coefficients.iter().zip(&self.targets) {
            let linear = row
                .iter()
                .zip(x)
                .fold(lit::<D>(0.0), |sum, (&c, &x)| sum + x * c);
            out.push(linear + linear.sin() * 0.1 - lit::<D>(*target));
        }
    }
}

/// The same terms as one dense problem.
struct Dense(Vec<(usize, Rows)>);

impl<D: Scalar> Residual<D> for Dense {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (block, rows) in &self.0 {
            let own = rows.coefficients[0].len() - SHARED;
            let first = SHARED + OWN * block;
            let mut local = x[..SHARED].to_vec();
            local.extend_from_slice(&x[first..first + own]);
            rows.residuals(&local, out);
        }
    }
}

fn random_rows(rng: &mut ChaCha8Rng, own: usize) -> Rows {
    let row = |rng: &mut ChaCha8Rng| {
        (0..SHARED + own)
            .map(|_| rng.random_range(-1.0..1.0))
            .collect()
    };
    let count = rng.random_range(OWN + 1..OWN + 4);
    Rows {
        coefficients: (0..count).map(|_| row(rng)).collect(),
        targets: (0..count).map(|_| rng.random_range(-0.5..0.5)).collect(),
    }
}

#[test]
fn five_hundred_random_block_problems_agree_with_the_dense_solution() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut checked, mut trial) = (0, 0);
    while checked < 500 {
        trial += 1;
        assert!(trial < 1000, "only {checked} are well conditioned");
        let count = rng.random_range(2..7);
        let mut terms: Vec<(usize, Rows)> = (0..count)
            .map(|b| (b, random_rows(&mut rng, OWN)))
            .collect();
        if trial % 2 == 1 {
            terms.extend((0..count - 1).map(|b| (b, random_rows(&mut rng, 2 * OWN))));
            terms.sort_by_key(|(block, _)| *block);
        }
        let mut problem = BlockProblem::new(Parameters::unnamed(&[0.0; SHARED]));
        for _ in 0..count {
            problem.add_block(&[0.0; OWN]);
        }
        for (block, rows) in &terms {
            if rows.coefficients[0].len() > SHARED + OWN {
                problem.add_coupled_term(*block, rows.clone());
            } else {
                problem.add_term(*block, rows.clone());
            }
        }
        let blocks = solve_blocks(&problem, &Mask::all(SHARED), &Options::default()).unwrap();
        let n = SHARED + OWN * count;
        let dense = solve(
            &Dense(terms),
            &Parameters::unnamed(&vec![0.0; n]),
            &Mask::all(n),
            &Options::default(),
        )
        .unwrap();
        // A problem of short rank or bad condition has no one solution to agree on.
        if dense.uncertainty.rank < n || dense.uncertainty.condition > 1e3 {
            continue;
        }
        checked += 1;
        let all: Vec<f64> = blocks
            .shared
            .parameters
            .values()
            .iter()
            .copied()
            .chain(blocks.blocks.into_iter().flatten())
            .collect();
        for (a, b) in all.iter().zip(dense.parameters.values()) {
            assert!(
                (a - b).abs() < 1e-10 * (1.0 + b.abs()),
                "trial {trial}: {a} {b}"
            );
        }
        for i in 0..SHARED {
            for k in 0..SHARED {
                let (a, b) = (
                    blocks.shared.uncertainty.covariance[i][k],
                    dense.uncertainty.covariance[i][k],
                );
                assert!(
                    (a - b).abs() < 1e-8 * dense.uncertainty.covariance[i][i].max(1.0),
                    "trial {trial}: {a} {b}"
                );
            }
        }
    }
}

#[test]
fn a_masked_shared_parameter_stays_and_a_missing_block_is_an_error() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut problem = BlockProblem::new(Parameters::unnamed(&[0.1; SHARED]));
    problem.add_block(&[0.0; OWN]);
    problem.add_term(0, random_rows(&mut rng, OWN));
    let mask = Mask::all(SHARED).without(1);
    let report = solve_blocks(&problem, &mask, &Options::default()).unwrap();
    assert_eq!(report.shared.parameters.values()[1], 0.1);
    problem.add_coupled_term(0, random_rows(&mut rng, 2 * OWN));
    assert!(solve_blocks(&problem, &mask, &Options::default()).is_err());
}

/// `y = x₀ t + x₁ + x₂ + …` at `t = 0 … 3`; parameters beyond `used` are not looked at.
#[derive(Clone)]
struct Group {
    offset: f64,
    used: usize,
}

impl<D: Scalar> Residual<D> for Group {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for i in 0..4 {
            let t = f64::from(i);
            let y = 2.0 * t + self.offset + 0.1 * (5.0 * t * t + self.offset).sin();
            let sum = x[1..self.used].iter().fold(x[0] * t, |sum, &x| sum + x);
            out.push(sum - lit::<D>(y));
        }
    }
}

/// Three groups of a common slope, each with a block of its own.
fn groups(start: &[f64], used: usize) -> BlockProblem<'static> {
    let mut shared = Parameters::new();
    shared.push("slope", "", 0.0);
    let mut problem = BlockProblem::new(shared);
    for offset in [1.0, 5.0, 7.0] {
        let block = problem.add_block(start);
        problem.add_term(block, Group { offset, used });
    }
    problem
}

#[test]
fn what_the_rows_of_a_block_do_not_determine_takes_nothing_from_the_shared_parameters() {
    let (mask, options) = (Mask::all(1), Options::default());
    let plain = solve_blocks(&groups(&[0.0], 2), &mask, &options).unwrap();
    let mut idle = groups(&[0.0], 2);
    idle.add_block(&[3.0, 4.0]);
    let cases = [
        ("a block without a term", idle),
        ("a parameter not used", groups(&[0.0, 9.0], 2)),
        ("two that act alike", groups(&[0.0, 0.0], 3)),
    ];
    for (name, problem) in cases {
        let report = solve_blocks(&problem, &mask, &options).unwrap();
        let (found, wanted) = (&report.shared, &plain.shared);
        assert!(
            found.termination.converged(),
            "{name}: {}",
            found.termination
        );
        let slope = |r: &stillpoint_solver::Report| r.parameters.values()[0];
        assert!((slope(found) - slope(wanted)).abs() < 1e-12, "{name}");
        let variance = |r: &stillpoint_solver::Report| r.uncertainty.covariance[0][0];
        assert!(
            (variance(found) - variance(wanted)).abs() < 1e-14,
            "{name}: {}",
            variance(found)
        );
        assert_eq!((found.uncertainty.rank, found.rank), (1, 4), "{name}");
    }
}

#[test]
fn parameters_of_blocks_count_as_fitted() {
    let report = solve_blocks(&groups(&[0.0], 2), &Mask::all(1), &Options::default()).unwrap();
    // Twelve residuals, one slope and three offsets.
    let wanted = 2.0 * report.shared.cost / (12.0 - 4.0);
    assert!((report.shared.reduced_chi2().unwrap() / wanted - 1.0).abs() < 1e-14);
}

#[test]
fn a_shared_parameter_that_acts_like_those_of_the_blocks_is_named() {
    /// An offset common to all groups on top of each group's own.
    struct Shifted(f64);
    impl<D: Scalar> Residual<D> for Shifted {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.extend((0..4).map(|i| x[0] * f64::from(i) + x[1] + x[2] - lit::<D>(self.0)));
        }
    }
    let mut shared = Parameters::new();
    shared.push("slope", "", 0.3);
    shared.push("shift", "", 0.0);
    let mut problem = BlockProblem::new(shared);
    for offset in [1.0, 5.0] {
        let block = problem.add_block(&[0.0]);
        problem.add_term(block, Shifted(offset));
    }
    let report = solve_blocks(&problem, &Mask::all(2), &Options::default()).unwrap();
    assert!(report.shared.termination.converged());
    assert_eq!(report.shared.uncertainty.unobservable, ["shift"]);
}

#[test]
fn a_chain_that_floats_converges() {
    /// The difference of two consecutive blocks.
    struct Difference(f64);
    impl<D: Scalar> Residual<D> for Difference {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            let difference = x[2] - x[1];
            out.push(difference - x[0] - lit::<D>(self.0));
            out.push(difference * 0.5 + x[0] - lit::<D>(0.3));
        }
    }
    let mut problem = BlockProblem::new(Parameters::unnamed(&[0.0]));
    for block in 0..40 {
        problem.add_block(&[0.0]);
        if block < 39 {
            problem.add_coupled_term(block, Difference(f64::from(block as u32 % 3)));
        }
    }
    let report = solve_blocks(&problem, &Mask::all(1), &Options::default()).unwrap();
    assert!(
        report.shared.termination.converged(),
        "{}",
        report.shared.termination
    );
    // 39 differences and the shared parameter; the place of the whole is free.
    assert_eq!(report.shared.rank, 40);
}

#[test]
fn a_start_that_is_not_finite_names_the_block() {
    struct Root;
    impl<D: Scalar> Residual<D> for Root {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.push(x[0] + x[1] + x[2].sqrt());
        }
    }
    let mut problem = BlockProblem::new(Parameters::unnamed(&[0.0]));
    for start in [1.0, 0.0] {
        let block = problem.add_block(&[7.0, start]);
        problem.add_term(block, Root);
    }
    let error = solve_blocks(&problem, &Mask::all(1), &Options::default()).unwrap_err();
    assert!(
        error.to_string().contains("parameter 1 of block 1"),
        "{error}"
    );
    problem.add_coupled_term(usize::MAX, Root);
    let error = solve_blocks(&problem, &Mask::all(1), &Options::default()).unwrap_err();
    assert!(matches!(
        error,
        stillpoint_solver::Error::UnknownBlock { .. }
    ));
}
