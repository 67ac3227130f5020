//! Turns to time the kernel on.

use calib::residuals::{Integrator, PropagatedGravity, TurnData};
use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{EffectRef, Kinematics, Model, Sensor};

/// `count` turns of `samples` samples at 100 Hz: a rate of up to 3 rad/s about changing axes, with
/// everything that an effect may ask for.
pub fn turns(count: usize, samples: usize) -> Vec<TurnData> {
    (0..count).map(|k| turn(k as f64, samples)).collect()
}

fn turn(phase: f64, samples: usize) -> TurnData {
    let t: Vec<f64> = (0..samples).map(|k| 0.01 * k as f64).collect();
    let rate = |t: f64| {
        let wave = |a: f64| 1.7 * (a * t + phase).sin();
        Vector3::new(wave(1.3), wave(2.1), wave(0.7))
    };
    let readings: Vec<Vector3<f64>> = t.iter().map(|&t| rate(t)).collect();
    let rest = t.iter().zip(&readings).map(|(&t, w)| Kinematics {
        time: 60.0 + 10.0 * phase + t,
        temperature: 25.0 + 0.01 * t,
        angular_acceleration: rate(t + 0.005) * 100.0 - rate(t - 0.005) * 100.0,
        attitude: Attitude::exp(w),
        ..Kinematics::at_rest(Vector3::new(w.y, 9.0 + w.x, 2.0 * w.z))
    });
    let rest = rest.collect();
    let before = Vector3::new(phase.cos(), phase.sin(), 0.8).normalize();
    let mut turn = TurnData {
        t,
        readings,
        rest,
        before,
        after: before,
    };
    let model = gyroscope::model();
    turn.after = turn.propagated(&model, Integrator::Exponential, &bad_sensor(&model));
    turn
}

/// Parameters of a plain bad sensor; small ones for the effects.
pub fn bad_sensor(model: &Model) -> Vec<f64> {
    let mut x = vec![
        1.02, 0.97, 1.01, 0.01, -0.02, 0.005, 0.015, -0.008, 0.012, 0.02, -0.01, 0.05,
    ];
    let nominal = model.parameters();
    x.extend(nominal.values()[x.len()..].iter().map(|v| v + 1e-4));
    x
}

/// The residual of `turns`.
pub fn residual<'a>(model: &'a Model, turns: &'a [TurnData]) -> PropagatedGravity<'a> {
    PropagatedGravity {
        model,
        turns,
        integrator: Integrator::Exponential,
        sigma: 1.0,
    }
}

/// The base model with the named effects of the gyroscope.
pub fn with(names: &[&str]) -> Model {
    let named = |effect: &EffectRef| names.contains(&effect.name());
    let effects = calib::effects::catalogue_of(Sensor::Gyroscope).filter(named);
    effects.fold(gyroscope::model(), Model::with)
}
