//! The kernel against dual numbers straight through the integration.

use nalgebra::Vector3;
use sensor::{EffectRef, Kinematics, Model, Sensor};
use solver::Problem;

use super::{Tier, TurnProblem};
use crate::residuals::{Integrator, PropagatedGravity, TurnData};

/// Two ways through a thousand products of rotations: rounding alone parts them by some 1e-14.
const AGREEMENT: f64 = 1e-12;

const BASE: [f64; 12] = [
    1.02, 0.97, 1.01, 0.01, -0.02, 0.005, 0.015, -0.008, 0.012, 0.02, -0.01, 0.05,
];

fn parameters(model: &Model) -> Vec<f64> {
    let mut x = BASE.to_vec();
    let more = model.parameters().len() - x.len();
    x.extend((0..more).map(|k| 1e-4 * (1.0 + k as f64)));
    x
}

/// Turns of different lengths at `rate` rad/s, with uneven steps and everything an effect may ask for.
fn turns(rate: f64) -> Vec<TurnData> {
    [700, 0, 433, 1, 2, 90, 1000, 433, 5]
        .map(|n| turn(n, rate))
        .to_vec()
}

fn turn(samples: usize, rate: f64) -> TurnData {
    let phase = samples as f64;
    let uneven = |k: usize| 0.01 * k as f64 + 1e-3 * ((k * k) as f64 + phase).sin();
    let t: Vec<f64> = (0..samples).map(uneven).collect();
    let wave = |a: f64, t: f64| (a * t + phase).sin() * rate;
    let readings: Vec<_> = t
        .iter()
        .map(|&t| Vector3::new(wave(1.3, t), wave(2.1, t), wave(0.7, t)))
        .collect();
    let rest = t.iter().zip(&readings).map(|(&t, w)| {
        let mut known = Kinematics::at_rest(Vector3::new(w.y, 9.0 + w.x, 2.0 * w.z));
        known.time = 30.0 + t;
        known.temperature = 25.0 + 3.0 * t;
        known.angular_acceleration = w * 0.7;
        known.attitude = sensor::attitude::Attitude::exp(w);
        known
    });
    TurnData {
        rest: rest.collect(),
        t,
        readings,
        before: Vector3::new(phase.cos(), phase.sin(), 0.8).normalize(),
        after: Vector3::new(0.0, 0.6, 0.8),
    }
}

fn residual<'a>(model: &'a Model, turns: &'a [TurnData]) -> PropagatedGravity<'a> {
    PropagatedGravity {
        model,
        turns,
        integrator: Integrator::Exponential,
        sigma: 1.0,
    }
}

/// Values and Jacobian of `tier` are those of the straight way, relative to the largest entry of a
/// column.
fn assert_agrees(model: &Model, turns: &[TurnData], tier: Tier, free: &[usize]) {
    let straight = residual(model, turns);
    let fast = TurnProblem::at(straight, tier).expect("the tier can express the model");
    let x = parameters(model);
    let (mut r, mut s, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let got = fast.linearize(&x, free, &mut r);
    let wanted = straight.linearize(&x, free, &mut s);
    fast.values(&x, &mut values);
    assert_eq!((got.nrows(), got.ncols()), (s.len(), free.len()));
    for row in 0..s.len() {
        assert!((r[row] - s[row]).abs() < AGREEMENT, "row {row}");
        assert!((values[row] - s[row]).abs() < AGREEMENT, "row {row}");
    }
    for (column, k) in free.iter().enumerate() {
        let size = |row: usize| wanted[(row, column)].abs();
        let largest = (0..s.len()).map(size).fold(1.0, f64::max);
        for row in 0..s.len() {
            let error = (got[(row, column)] - wanted[(row, column)]).abs();
            assert!(
                error < AGREEMENT * largest,
                "row {row}, parameter {k}: {error:e}"
            );
        }
    }
}

fn all(model: &Model) -> Vec<usize> {
    (0..model.parameters().len()).collect()
}

fn effects() -> impl Iterator<Item = EffectRef> {
    effects::catalogue_of(Sensor::Gyroscope)
}

fn with(effects: impl Iterator<Item = EffectRef>) -> Model {
    effects.fold(gyroscope::model(), Model::with)
}

#[test]
fn the_affine_tier_is_the_straight_way_for_slow_fast_and_violent_turns() {
    let model = gyroscope::model();
    for rate in [1.0, 8.0, 40.0, 150.0] {
        assert_agrees(&model, &turns(rate), Tier::Affine, &all(&model));
    }
}

#[test]
fn a_step_of_several_radians_is_left_to_the_straight_way() {
    let model = gyroscope::model();
    assert_agrees(&model, &turns(900.0), Tier::Affine, &all(&model));
}

#[test]
fn the_general_tier_is_the_straight_way_with_every_effect() {
    for effect in effects() {
        let model = with(std::iter::once(effect));
        assert_agrees(&model, &turns(2.0), Tier::General, &all(&model));
    }
}

#[test]
fn the_general_tier_is_the_straight_way_with_all_effects_together() {
    let model = with(effects());
    assert_agrees(&model, &turns(1.0), Tier::General, &all(&model));
}

#[test]
fn linear_effects_are_in_the_affine_tier_alone_and_together() {
    let linear = || effects().filter(|e| e.is_linear());
    for effect in linear() {
        let model = with(std::iter::once(effect));
        assert_agrees(&model, &turns(2.0), Tier::Affine, &all(&model));
    }
    let model = with(linear());
    assert!(model.parameters().len() > 30);
    assert_agrees(&model, &turns(2.0), Tier::Affine, &all(&model));
}

#[test]
fn a_mask_removes_columns_and_changes_no_other() {
    let model = with(effects());
    let free = [1, 5, 11, 14, 20, 21, 30];
    assert_agrees(&model, &turns(2.0), Tier::General, &free);
    let model = with(effects().filter(|e| e.is_linear()));
    assert_agrees(&model, &turns(2.0), Tier::Affine, &free);
    assert_agrees(&model, &turns(2.0), Tier::Affine, &[]);
}

#[test]
fn second_derivatives_along_a_direction_are_those_of_the_straight_way() {
    let linear = || effects().filter(|e| e.is_linear());
    for model in [gyroscope::model(), with(linear())] {
        let turns = turns(2.0);
        let straight = residual(&model, &turns);
        let fast = TurnProblem::at(straight, Tier::Affine).expect("all effects are linear");
        let x = parameters(&model);
        let v: Vec<f64> = (0..x.len()).map(|k| 0.1 * (k as f64).sin()).collect();
        let (mut got, mut wanted) = (Vec::new(), Vec::new());
        assert!(fast.second_derivative(&x, &v, &mut got));
        assert!(straight.second_derivative(&x, &v, &mut wanted));
        let largest = wanted.iter().fold(0.0f64, |m, w| m.max(w.abs()));
        assert!(largest > 1e-2);
        for (got, wanted) in got.iter().zip(&wanted) {
            assert!((got - wanted).abs() < AGREEMENT * largest.max(1.0));
        }
    }
}

#[test]
fn each_model_gets_the_fastest_tier_that_can_express_it() {
    let turns = turns(1.0);
    let tier = |model: &Model, integrator: Integrator| {
        let residual = PropagatedGravity {
            integrator,
            ..residual(model, &turns)
        };
        TurnProblem::new(residual).tier()
    };
    let base = gyroscope::model();
    let named = |name| with(effects().filter(move |e| e.name() == name));
    let (drift, cubic) = (named("gyro_drift"), named("gyro_cubic"));
    assert_eq!(tier(&base, Integrator::Exponential), Tier::Affine);
    assert_eq!(tier(&drift, Integrator::Exponential), Tier::Affine);
    assert_eq!(tier(&cubic, Integrator::Exponential), Tier::General);
    assert_eq!(tier(&base, Integrator::FirstOrder), Tier::Straight);
}

#[test]
fn a_reading_that_is_not_a_number_spoils_its_turn_and_no_other() {
    let mut turns = turns(1.0);
    turns[0].readings[3].x = f64::NAN;
    let model = gyroscope::model();
    let problem = TurnProblem::new(residual(&model, &turns));
    let mut r = Vec::new();
    problem.values(&parameters(&model), &mut r);
    assert!(r[..3].iter().all(|v| v.is_nan()));
    assert!(r[3..].iter().all(|v| v.is_finite()));
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let many: Vec<TurnData> = (0..120).map(|k| turn(900 + k, 2.0)).collect();
    let few = turns(2.0);
    let base = gyroscope::model();
    let all_effects = with(effects());
    let cases = [
        (&base, &many, Tier::Affine),
        (&all_effects, &few, Tier::General),
    ];
    for (model, turns, tier) in cases {
        let problem = TurnProblem::at(residual(model, turns), tier).expect("the tier fits");
        let (x, free) = (parameters(model), all(model));
        let rows = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let mut rows = Vec::new();
            let jacobian = pool
                .build()
                .expect("threads can be started")
                .install(|| problem.linearize(&x, &free, &mut rows));
            (rows, jacobian)
        };
        assert_eq!(rows(1), rows(3));
    }
}
