//! Which variant is fastest? Whole fits of NIST, Moré–Garbow–Hillstrom and a calibration.
#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use solver::{Mask, Options, Parameters, Problem, Variant, solve};
use stillpoint_tests::problems::accelerometer::{Accelerometer, placements};
use stillpoint_tests::problems::{mgh, nist};

fn fits(c: &mut Criterion, name: &str, problems: &[(&dyn Problem, Parameters)]) {
    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    for variant in Variant::all() {
        let options = Options {
            variant,
            ..Options::default()
        };
        group.bench_function(variant.name(), |b| {
            b.iter(|| {
                for (problem, start) in problems {
                    let _ = black_box(solve(*problem, start, &Mask::all(start.len()), &options));
                }
            });
        });
    }
    group.finish();
}

fn variants(c: &mut Criterion) {
    if let Ok(nist) = nist::Regression::all(&nist::default_folder()) {
        let second: Vec<(&dyn Problem, Parameters)> = nist
            .iter()
            .map(|p| (p as &dyn Problem, p.start(2)))
            .collect();
        fits(c, "nist from start 2", &second);
    }
    let cases = mgh::nineteen();
    let standard: Vec<(&dyn Problem, Parameters)> = cases
        .iter()
        .map(|case| (&*case.problem as &dyn Problem, case.parameters(1.0)))
        .collect();
    fits(c, "more-garbow-hillstrom", &standard);
    let accelerometer = Accelerometer(placements());
    let start = Parameters::unnamed(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    fits(c, "accelerometer, 9 parameters", &[(&accelerometer, start)]);
}

criterion_group!(benches, variants);
criterion_main!(benches);
