//! What does the Jacobian of propagated gravity cost, tier by tier? Straight dual numbers, the
//! oracle, are in every group, and the value-only kernel is the floor.

#![allow(missing_docs)]

use calib::kernel::{Tier, TurnProblem};
use calib::methods::{GyroscopeData, GyroscopeRequest, fit_gyroscope};
use calib::residuals::Integrator;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::Vector3;
use sensor::Model;
use solver::Problem;
use stillpoint_benches::turns::{bad_sensor, residual, turns, with};

const TURNS: usize = 40;
const SAMPLES: usize = 1500;

/// Values, and Jacobians of all parameters, of `model` in each of `tiers`.
fn compare(criterion: &mut Criterion, name: &str, model: &Model, tiers: &[Tier]) {
    let turns = turns(TURNS, SAMPLES);
    let x = bad_sensor(model);
    let free: Vec<usize> = (0..x.len()).collect();
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements((TURNS * SAMPLES) as u64));
    for &tier in tiers {
        let Some(problem) = TurnProblem::at(residual(model, &turns), tier) else {
            continue;
        };
        let mut rows = Vec::new();
        group.bench_function(BenchmarkId::new("values", format!("{tier:?}")), |b| {
            b.iter(|| problem.values(&x, &mut rows));
        });
        group.bench_function(BenchmarkId::new("jacobian", format!("{tier:?}")), |b| {
            b.iter(|| problem.linearize(&x, &free, &mut rows));
        });
    }
    group.finish();
}

fn base_model(criterion: &mut Criterion) {
    let tiers = [Tier::Affine, Tier::General, Tier::Straight];
    compare(criterion, "turns, 12 parameters", &with(&[]), &tiers);
}

fn effect_that_is_not_affine(criterion: &mut Criterion) {
    let tiers = [Tier::General, Tier::Straight];
    let model = with(&["gyro_quadratic"]);
    compare(criterion, "turns, one effect not affine", &model, &tiers);
}

/// Cost against the number of parameters: linear effects, then any.
fn more_parameters(criterion: &mut Criterion) {
    let two = ["gyro_g_sensitivity", "gyro_drift"];
    let tiers = [Tier::Affine, Tier::General, Tier::Straight];
    compare(criterion, "turns, 24 parameters", &with(&two), &tiers);
    let all = gyroscope::EFFECTS.iter().map(|e| e.name());
    let most: Vec<&str> = all
        .filter(|name| !["gyro_warmup", "gyro_step"].contains(name))
        .collect();
    compare(criterion, "turns, 48 parameters", &with(&most), &tiers[1..]);
}

/// The whole fit of a gyroscope, all iterations: 37 turns of 480 samples.
fn gyroscope_stage(criterion: &mut Criterion) {
    let turns = turns(37, 480);
    let data = GyroscopeData {
        name: "turns".into(),
        turn_bias: vec![Vector3::new(0.02, -0.01, 0.05); turns.len()],
        turns,
        moved: Vec::new(),
        statics: Vec::new(),
    };
    let request = GyroscopeRequest {
        recordings: vec![data],
        model: gyroscope::model(),
        integrator: Integrator::Exponential,
    };
    let mut group = criterion.benchmark_group("gyroscope stage, 37 turns of 480 samples");
    group.bench_function("fit", |b| b.iter(|| fit_gyroscope(&request)));
    group.finish();
}

criterion_group!(
    benches,
    gyroscope_stage,
    base_model,
    effect_that_is_not_affine,
    more_parameters
);
criterion_main!(benches);
