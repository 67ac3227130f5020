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
