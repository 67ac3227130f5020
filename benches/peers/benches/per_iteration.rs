//! Time per iteration (one Jacobian with everything done until the next one) beside the crate
//! levenberg-marquardt, on NIST from start 2 and on the accelerometer fit of nine parameters.

use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use peers::{Named, Solver, accelerometer, regressions};

/// Whole fits, their time divided by the Jacobians that they took.
fn per_jacobian(rounds: u64, problems: &[Named], solver: Solver) -> Duration {
    let (mut spent, mut jacobians) = (Duration::ZERO, 0);
    for _ in 0..rounds {
        let start = Instant::now();
        jacobians += fit_all(problems, solver);
        spent += start.elapsed();
    }
    spent.mul_f64(rounds as f64 / jacobians as f64)
}

fn fit_all(problems: &[Named], solver: Solver) -> usize {
    problems
        .iter()
        .map(|p| solver.fit(&*p.problem, &p.start))
        .sum()
}

fn compare(c: &mut Criterion, name: &str, problems: &[Named]) {
    if problems.is_empty() {
        return;
    }
    for whole in [false, true] {
        let what = if whole { "whole fits" } else { "per iteration" };
        let mut group = c.benchmark_group(format!("{what}, {name}"));
        group.sample_size(20);
        group.measurement_time(Duration::from_secs(2));
        group.warm_up_time(Duration::from_secs(2));
        for solver in Solver::ALL {
            group.bench_function(solver.name(), |b| match whole {
                true => b.iter(|| fit_all(problems, solver)),
                false => b.iter_custom(|n| per_jacobian(n, problems, solver)),
            });
        }
        group.finish();
    }
}

fn benches(c: &mut Criterion) {
    compare(c, "NIST from start 2", &regressions(2));
    compare(c, "accelerometer, 9 parameters", &[accelerometer()]);
}

criterion_group!(per_iteration, benches);
criterion_main!(per_iteration);
