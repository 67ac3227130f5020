//! Many decays `y = a exp(−b t)` at twenty instants: `solve_batch` beside a loop over `solve` and a loop over the crate
//! levenberg-marquardt, one thread each, in turns of one run.
//!
//! ```text
//! cargo run --release --bin batch [COUNT [ROUNDS]]
//! ```
//! The peer has matrices of fixed size, which it puts on no heap, once with the Jacobian by hand and once, as the two others, by dual
//! numbers of the same residual. Printed are microseconds of the processor per problem, medians, the medians of the ratios
//! within a turn, and how many problems end within 1e-6 of the least cost that the three found.

use std::hint::black_box;
use std::time::Duration;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{Matrix, Owned, SMatrix, SVector, U2, U20, Vector};
use rustix::time::{ClockId, clock_gettime};
use solver::scalar::derivatives;
use solver::{
    BatchOptions, Jet, Mask, Options, Parameters, Residual, Scalar, scalar::variable, solve,
    solve_batch,
};

const INSTANTS: usize = 20;

/// Problems and turns if none are asked for.
const COUNT: usize = 100_000;
const ROUNDS: usize = 5;

/// A cost this near the least found counts as that.
const SAME: f64 = 1e-6;

type Failure = Box<dyn std::error::Error>;

/// Measured values.
struct Decay([f64; INSTANTS]);

fn instant(k: usize) -> f64 {
    0.2 * k as f64
}

impl<D: Scalar> Residual<D> for Decay {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (k, y) in self.0.iter().enumerate() {
            out.push(x[0] * (-x[1] * instant(k)).exp() - *y);
        }
    }
}

/// A decay in the terms of the peer.
struct Peer<'a> {
    decay: &'a Decay,
    x: SVector<f64, 2>,
    by_hand: bool,
}

impl LeastSquaresProblem<f64, U20, U2> for Peer<'_> {
    type ResidualStorage = Owned<f64, U20>;
    type JacobianStorage = Owned<f64, U20, U2>;
    type ParameterStorage = Owned<f64, U2>;

    fn set_params(&mut self, x: &Vector<f64, U2, Self::ParameterStorage>) {
        self.x = *x;
    }

    fn params(&self) -> Vector<f64, U2, Self::ParameterStorage> {
        self.x
    }

    fn residuals(&self) -> Option<Vector<f64, U20, Self::ResidualStorage>> {
        let mut out = SVector::<f64, INSTANTS>::zeros();
        for (k, (r, y)) in out.iter_mut().zip(&self.decay.0).enumerate() {
            *r = self.x[0] * (-self.x[1] * instant(k)).exp() - y;
        }
        Some(out)
    }

    fn jacobian(&self) -> Option<Matrix<f64, U20, U2, Self::JacobianStorage>> {
        let mut out = SMatrix::<f64, INSTANTS, 2>::zeros();
        if self.by_hand {
            for k in 0..INSTANTS {
                let t = instant(k);
                let e = (-self.x[1] * t).exp();
                out[(k, 0)] = e;
                out[(k, 1)] = -self.x[0] * t * e;
            }
            return Some(out);
        }
        let x = [variable(self.x[0], 0), variable(self.x[1], 1)];
        let mut rows: Vec<Jet> = Vec::with_capacity(INSTANTS);
        self.decay.residuals(&x, &mut rows);
        for (k, row) in rows.iter().enumerate() {
            let slopes = derivatives(row);
            (out[(k, 0)], out[(k, 1)]) = (slopes[0], slopes[1]);
        }
        Some(out)
    }
}

/// Costs at the ends, and seconds of the processor.
struct Run {
    costs: Vec<f64>,
    seconds: f64,
}

fn processor_seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    Duration::try_from(now).unwrap_or_default().as_secs_f64()
}

fn timed(run: impl FnOnce() -> Result<Vec<f64>, Failure>) -> Result<Run, Failure> {
    let begin = processor_seconds();
    let costs = black_box(run()?);
    Ok(Run {
        costs,
        seconds: processor_seconds() - begin,
    })
}

fn together(problems: &[Decay]) -> Result<Vec<f64>, Failure> {
    let starts = vec![1.0; 2 * problems.len()];
    let batch = solve_batch(problems, 2, &starts, &BatchOptions::default())?;
    Ok(black_box(batch).costs)
}

fn one_by_one(problems: &[Decay]) -> Result<Vec<f64>, Failure> {
    let start = Parameters::unnamed(&[1.0, 1.0]);
    let (mask, options) = (Mask::all(2), Options::default());
    let costs = problems
        .iter()
        .map(|problem| Ok(solve(problem, &start, &mask, &options)?.cost));
    costs.collect()
}

fn by_the_peer(problems: &[Decay], by_hand: bool) -> Vec<f64> {
    let solver = LevenbergMarquardt::new();
    let costs = problems.iter().map(|decay| {
        let x = SVector::<f64, 2>::new(1.0, 1.0);
        let (end, report) = solver.minimize(Peer { decay, x, by_hand });
        black_box(end.x);
        report.objective_function
    });
    costs.collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Decays whose numbers and errors come from a small generator.
fn decays(count: usize) -> Vec<Decay> {
    let mut state = 1u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let one = |_| {
        let (a, b) = (2.0 + noise(), 0.8 + noise());
        Decay(std::array::from_fn(|k| {
            a * (-b * instant(k)).exp() + 0.05 * noise()
        }))
    };
    (0..count).map(one).collect()
}

fn main() -> Result<(), Failure> {
    let mut words = std::env::args().skip(1);
    let count = words.next().map_or(Ok(COUNT), |word| word.parse())?;
    let rounds = words.next().map_or(Ok(ROUNDS), |word| word.parse())?;
    let problems = decays(count);
    let mut turns: Vec<[Run; 4]> = Vec::new();
    for _ in 0..rounds {
        turns.push([
            timed(|| together(&problems))?,
            timed(|| one_by_one(&problems))?,
            timed(|| Ok(by_the_peer(&problems, true)))?,
            timed(|| Ok(by_the_peer(&problems, false)))?,
        ]);
    }
    let Some(first) = turns.first() else {
        return Err("at least one round".into());
    };
    let least: Vec<f64> = (0..count)
        .map(|k| {
            first
                .iter()
                .map(|run| run.costs[k])
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    println!("{count} decays of 20 values and 2 parameters, one thread, medians of {rounds} turns");
    println!("| solver | µs a problem | batch / it | at the least cost |");
    println!("|---|---|---|---|");
    let names = [
        "solve_batch",
        "loop over solve",
        "levenberg-marquardt, Jacobian by hand",
        "levenberg-marquardt, dual numbers",
    ];
    for (place, name) in names.iter().enumerate() {
        let micros = median(
            turns
                .iter()
                .map(|t| 1e6 * t[place].seconds / count as f64)
                .collect(),
        );
        let ratio = median(
            turns
                .iter()
                .map(|t| t[0].seconds / t[place].seconds)
                .collect(),
        );
        let costs = &first[place].costs;
        let same =
            (costs.iter().zip(&least)).filter(|(cost, least)| **cost <= **least * (1.0 + SAME));
        println!("| {name} | {micros:.2} | {ratio:.3} | {} |", same.count());
    }
    Ok(())
}
