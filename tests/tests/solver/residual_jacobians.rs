//! Every residual of a calibration differentiates as central differences do.

use calib::residuals::{
    GravityNorm, Integrator, OwnBias, PropagatedGravity, StaticMean, StaticRate, TurnData,
};
use nalgebra::Vector3;
use sensor::{Kinematics, Model};
use solver::Problem;

/// Central differences lose half the digits to rounding: with a step of the cube root of the
/// rounding error about ten remain, relative to the largest entry of a column.
const AGREEMENT: f64 = 1e-7;

/// Base parameters of a plain bad sensor.
const BASE: [f64; 12] = [
    1.02, 0.97, 1.01, 0.01, -0.02, 0.005, 0.015, -0.008, 0.012, 0.2, -0.1, 0.05,
];

fn parameters(model: &Model) -> Vec<f64> {
    let mut x = BASE.to_vec();
    let parameters = model.parameters();
    let more = &parameters.values()[x.len()..];
    let near = |(k, nominal): (usize, &f64)| nominal + 1e-4 * (1.0 + k as f64);
    x.extend(more.iter().enumerate().map(near));
    x
}

fn assert_derivatives(problem: &dyn Problem, x: &[f64]) {
    let free: Vec<usize> = (0..x.len()).collect();
    let mut residuals = Vec::new();
    let jacobian = problem.linearize(x, &free, &mut residuals);
    for &k in &free {
        let h = 3e-6 * x[k].abs().max(0.3);
        let at = |sign: f64| {
            let mut moved = x.to_vec();
            moved[k] += sign * h;
            let mut out = Vec::new();
            problem.values(&moved, &mut out);
            out
        };
        let (plus, minus) = (at(1.0), at(-1.0));
        let largest = (0..residuals.len())
            .map(|i| jacobian[(i, k)].abs())
            .fold(1e-9, f64::max);
        for i in 0..residuals.len() {
            let difference = (plus[i] - minus[i]) / (2.0 * h);
            let error = (jacobian[(i, k)] - difference).abs();
            assert!(
                error <= AGREEMENT * largest,
                "row {i}, parameter {k}: {} against {difference}",
                jacobian[(i, k)]
            );
        }
    }
}

fn placements() -> Vec<StaticMean> {
    [
        [9.7, 0.3, -0.2],
        [0.1, -9.9, 1.0],
        [5.0, 6.0, -6.1],
        [-3.0, 2.0, 9.0],
    ]
    .map(|raw| StaticMean {
        raw: Vector3::from(raw),
        rest: Kinematics::at_rest(Vector3::new(1.0, 2.0, 9.0)),
        white: 0.0,
    })
    .to_vec()
}

fn turns() -> Vec<TurnData> {
    let turn = |phase: f64| {
        let t: Vec<f64> = (0..120)
            .map(|k| 0.01 * k as f64 + 1e-4 * (k % 3) as f64)
            .collect();
        let wave = |a: f64, t: f64| (a * t + phase).sin() * 2.0;
        let readings: Vec<_> = t
            .iter()
            .map(|&t| Vector3::new(wave(1.3, t), wave(2.1, t), wave(0.7, t)))
            .collect();
        let rest = readings
            .iter()
            .map(|w| Kinematics::at_rest(Vector3::new(w.y, 9.0 + w.x, 2.0 * w.z)))
            .collect();
        TurnData {
            t,
            readings,
            rest,
            before: Vector3::new(0.6, 0.0, 0.8),
            after: Vector3::new(0.0, 0.6, 0.8),
        }
    };
    vec![turn(0.3), turn(1.1), turn(2.5)]
}

/// Base model with and without every effect of the catalogue.
fn models(base: Model) -> Vec<Model> {
    let mut models = vec![base.clone()];
    let catalogue = calib::effects::catalogue_of(base.sensor());
    models.extend(catalogue.map(|effect| base.clone().with(effect)));
    models
}

#[test]
fn gravity_norm_differentiates_with_every_effect() {
    for model in models(accelerometer::model()) {
        let problem = GravityNorm {
            model: &model,
            means: &placements(),
            gravity: 9.8,
        };
        assert_derivatives(&problem, &parameters(&model));
    }
}

#[test]
fn static_rate_differentiates_with_every_effect() {
    for model in models(gyroscope::model()) {
        let problem = StaticRate {
            model: &model,
            means: &placements(),
            sigma: 0.1,
        };
        assert_derivatives(&problem, &parameters(&model));
    }
}

#[test]
fn propagated_gravity_differentiates_through_every_integrator_and_effect() {
    let turns = turns();
    for integrator in [
        Integrator::Exponential,
        Integrator::FirstOrderNormalized,
        Integrator::FirstOrder,
    ] {
        for model in models(gyroscope::model()) {
            let problem = PropagatedGravity {
                model: &model,
                turns: &turns,
                integrator,
                sigma: 0.01,
            };
            assert_derivatives(&problem, &parameters(&model));
        }
    }
}

#[test]
fn biases_of_their_own_differentiate() {
    let model = accelerometer::model();
    let means = placements();
    let part = GravityNorm {
        model: &model,
        means: &means,
        gravity: 9.8,
    };
    let problem = OwnBias {
        parts: vec![part; 3],
        shared: 12,
        own_bias: true,
    };
    let mut x = parameters(&model);
    x.extend([0.3, 0.1, -0.2, 0.05, -0.15, 0.25]);
    assert_derivatives(&problem, &x);
}
