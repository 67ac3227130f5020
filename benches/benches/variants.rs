//! Which variant is fastest? Whole fits of NIST, Moré–Garbow–Hillstrom and a calibration.
#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use solver::{Mask, Options, Parameters, Problem, Residual, Scalar, Variant, lit, solve};
use stillpoint_tests::problems::{mgh, nist};

/// `‖T (m − b)‖ − g`: nine parameters from the means of static intervals.
struct Accelerometer(Vec<[f64; 3]>);

impl<D: Scalar> Residual<D> for Accelerometer {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for m in &self.0 {
            let [a, b, c] = [0, 1, 2].map(|k| -x[6 + k] + m[k]);
            let f = [
                x[0] * a + x[3] * b + x[4] * c,
                x[1] * b + x[5] * c,
                x[2] * c,
            ];
            out.push((f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt() - lit::<D>(9.79));
        }
    }
}

/// Means of 23 placements on a spiral over the sphere, distorted by a known sensor.
fn placements() -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / 23.0;
        let (angle, radius) = (2.4 * i as f64, (1.0 - z * z).sqrt());
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    (0..23)
        .map(place)
        .map(|u| [9.8 * u[0] + 0.04, 9.79 * u[1] + 0.004, 9.81 * u[2] - 0.02])
        .collect()
}

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
