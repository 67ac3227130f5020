//! Time per iteration (one Jacobian and the steps tried from it) beside the crate
//! levenberg-marquardt, on NIST from start 2 and on the accelerometer fit of nine parameters.
//!
//! Both work on the same residuals and the same dual-number Jacobian.

use std::cell::Cell;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use solver::{Damping, Mask, Options, Parameters, Problem, Residual, Scalar, Variant, lit, solve};
use stillpoint_tests::problems::nist::{Regression, default_folder};

/// `‖T (m − b)‖ − g`: nine parameters from the means of static intervals.
struct Accelerometer(Vec<[f64; 3]>);

impl<D: Scalar> Residual<D> for Accelerometer {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for m in &self.0 {
            let [a, b, c] = [0, 1, 2].map(|k| -x[6 + k] + m[k]);
            let f = [x[0] * a + x[3] * b + x[4] * c, x[1] * b + x[5] * c, x[2] * c];
            out.push((f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt() - lit::<D>(9.79));
        }
    }
}

/// Means of 23 placements on a spiral over the sphere, distorted and rounded.
fn placements() -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / 23.0;
        let (angle, radius) = (2.4 * i as f64, (1.0 - z * z).sqrt());
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let distort = |u: [f64; 3]| [9.8 * u[0] + 0.04, 9.79 * u[1] + 0.004, 9.81 * u[2] - 0.02];
    (0..23).map(place).map(|u| distort(u).map(|v| (v * 100.0).round() / 100.0)).collect()
}

/// A problem in the peer's terms.
struct Peer<'a> {
    problem: &'a dyn Problem,
    x: Vec<f64>,
    /// Number of residuals seen last: room for the next ones, as the solver has it.
    rows: Cell<usize>,
    jacobians: &'a Cell<usize>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Peer<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from_slice(x.as_slice());
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.x)
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut out = Vec::with_capacity(self.rows.get());
        self.problem.values(&self.x, &mut out);
        self.rows.set(out.len());
        Some(DVector::from_vec(out))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.jacobians.set(self.jacobians.get() + 1);
        let free: Vec<usize> = (0..self.x.len()).collect();
        let mut residuals = Vec::with_capacity(self.rows.get());
        let j = self.problem.linearize(&self.x, &free, &mut residuals);
        Some(DMatrix::from_fn(residuals.len(), free.len(), |i, k| j[(i, k)]))
    }
}

fn peer(problem: &dyn Problem, start: &Parameters) -> usize {
    let jacobians = Cell::new(0);
    let peer = Peer { problem, x: start.values().to_vec(), rows: Cell::new(0), jacobians: &jacobians };
    black_box(LevenbergMarquardt::new().minimize(peer));
    jacobians.get()
}

fn ours(problem: &dyn Problem, start: &Parameters, variant: Variant) -> usize {
    let options = Options { variant, ..Options::default() };
    let report = black_box(solve(problem, start, &Mask::all(start.len()), &options));
    report.map_or(1, |report| report.jacobian_evaluations)
}

/// Whole fits, their time divided by the Jacobians that they took.
fn per_jacobian(rounds: u64, mut fit: impl FnMut() -> usize) -> Duration {
    let (mut spent, mut jacobians) = (Duration::ZERO, 0);
    for _ in 0..rounds {
        let start = Instant::now();
        jacobians += fit();
        spent += start.elapsed();
    }
    spent.mul_f64(rounds as f64 / jacobians as f64)
}

fn compare(c: &mut Criterion, name: &str, problems: &[(&dyn Problem, Parameters)]) {
    let plain = Variant::LevenbergMarquardt { damping: Damping::DelayedGratification, geodesic: false };
    let mut group = c.benchmark_group(format!("per iteration, {name}"));
    group.sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    for (label, variant) in [("stillpoint default", Variant::default()), ("stillpoint without geodesic", plain)] {
        group.bench_function(label, |b| {
            b.iter_custom(|n| {
                per_jacobian(n, || problems.iter().map(|(p, start)| ours(*p, start, variant)).sum())
            });
        });
    }
    group.bench_function("levenberg-marquardt", |b| {
        b.iter_custom(|n| per_jacobian(n, || problems.iter().map(|(p, start)| peer(*p, start)).sum()));
    });
    group.finish();
}

fn whole(c: &mut Criterion, name: &str, problems: &[(&dyn Problem, Parameters)]) {
    let mut group = c.benchmark_group(format!("whole fits, {name}"));
    group.sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    group.bench_function("stillpoint default", |b| {
        b.iter(|| problems.iter().map(|(p, start)| ours(*p, start, Variant::default())).sum::<usize>());
    });
    group.bench_function("levenberg-marquardt", |b| {
        b.iter(|| problems.iter().map(|(p, start)| peer(*p, start)).sum::<usize>());
    });
    group.finish();
}

fn benches(c: &mut Criterion) {
    if let Ok(nist) = Regression::all(&default_folder()) {
        let problems: Vec<(&dyn Problem, Parameters)> =
            nist.iter().map(|p| (p as &dyn Problem, p.start(2))).collect();
        compare(c, "NIST from start 2", &problems);
        whole(c, "NIST from start 2", &problems);
    }
    let accelerometer = Accelerometer(placements());
    let start = Parameters::unnamed(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    compare(c, "accelerometer, 9 parameters", &[(&accelerometer, start.clone())]);
    whole(c, "accelerometer, 9 parameters", &[(&accelerometer, start)]);
}

criterion_group!(per_iteration, benches);
criterion_main!(per_iteration);
