//! Devices and places: grades, drifts, gravity, the earth, effects that the base model lacks.

use calib::simulate::Spec;
use std::collections::BTreeMap;

use super::condition::{Condition, by_hand, row};
use crate::conditions::Kind;

/// Random walk of the biases of a consumer-grade device, m/s²/√s and rad/s/√s: over five minutes the
/// accelerometer's bias moves by 1.7 mm/s² and the gyroscope's by 18 °/h.
const WALK: [f64; 2] = [1e-4, 5e-6];

/// One thousandth of standard gravity, m/s².
const MG: f64 = 9.80665e-3;
/// 1 °/h, rad/s.
const DEGREE_PER_HOUR: f64 = 4.848_137e-6;

fn walks(spec: &mut Spec, size: f64) {
    spec.accelerometer.random_walk = size * WALK[0];
    spec.gyroscope.random_walk = size * WALK[1];
}

/// Both gravity and what is said of it: 9.764 to 9.834 m/s², the range on the earth.
fn somewhere(spec: &mut Spec) {
    let share = (spec.seed as f64 * 0.618_033_988_75).fract();
    spec.gravity = 9.764 + 0.07 * share;
}

/// An effect of the accelerometer that is off by `mg` at 1 g, of alternating sign on the axes; `power` of the
/// specific force in it.
fn effect(spec: &mut Spec, name: &str, mg: f64, power: i32) {
    let size = mg * MG / 9.80665_f64.powi(power);
    let axes = [("x", size), ("y", -size), ("z", size)];
    let parameters: BTreeMap<String, f64> =
        axes.into_iter().map(|(a, v)| (a.to_owned(), v)).collect();
    spec.effects.insert(name.to_owned(), parameters);
}

const MISFIT: &[Kind] = &[Kind::Misfit];
const EARTH: &[Kind] = &[Kind::Earth];
const DRIFT: &[Kind] = &[Kind::Drift, Kind::Misfit];
const DRIFT_OF_FEW: &[Kind] = &[Kind::Drift, Kind::Misfit, Kind::Geometry];

pub(super) const ROWS: &[Condition] = &[
    row("clean", "consumer grade, white noise", |_| {}).bounded(),
    row("clean-tactical", "tactical grade, white noise", |_| {})
        .tactical()
        .bounded(),
    row("walk", "biases walk", |s| walks(s, 1.0)).right(DRIFT),
    row("walk-tactical", "biases walk, tactical", |s| walks(s, 0.1))
        .tactical()
        .right(DRIFT),
    row("walk-13", "biases walk, thirteen placements", |s| {
        walks(s, 1.0);
        by_hand(s, |hand| hand.placements = Some(13));
    })
    .right(DRIFT_OF_FEW),
    row("counts", "16-bit counts around 32768", |s| {
        s.accelerometer.counts = true;
        s.accelerometer.step = 1.2e-3;
        s.gyroscope.counts = true;
        s.gyroscope.step = 1.1e-3;
    }),
    row("no-gravity", "nobody says what gravity is", somewhere)
        .right(EARTH)
        .ask(|_, request| {
            request.gravity = calib::calibrate::STANDARD_GRAVITY;
            request.gravity_source = calib::gravity::GravitySource::Assumed;
        }),
    row("earth", "the earth turns, no latitude given", |s| {
        s.latitude = Some(47.0);
    })
    .right(EARTH),
    row("earth-latitude", "the earth turns, latitude given", |s| {
        s.latitude = Some(47.0);
    })
    .right(EARTH)
    .ask(|spec, request| {
        if request.method == calib::calibrate::Method::Joint {
            request.latitude = spec.latitude;
        }
    }),
    row("thermal-drift", "biases drift by 1 mg and 20 deg/h", |s| {
        s.accelerometer.thermal_drift = MG;
        s.gyroscope.thermal_drift = 20.0 * DEGREE_PER_HOUR;
    })
    .right(DRIFT),
    row("flicker", "flicker of 1 mm/s2 and 15 deg/h", |s| {
        s.accelerometer.instability = 1e-3;
        s.gyroscope.instability = 15.0 * DEGREE_PER_HOUR;
    })
    .right(DRIFT),
    row("quadratic-0.3", "quadratic effect of .3 mg", |s| {
        effect(s, "accel_quadratic", 0.3, 2);
    })
    .beyond_the_model()
    .right(MISFIT),
    row("quadratic-1", "quadratic effect of 1 mg", |s| {
        effect(s, "accel_quadratic", 1.0, 2);
    })
    .beyond_the_model()
    .right(MISFIT),
    row("cubic-0.3", "cubic effect of .3 mg", |s| {
        effect(s, "accel_cubic", 0.3, 3)
    })
    .beyond_the_model()
    .right(MISFIT),
    row("cubic-1", "cubic effect of 1 mg", |s| {
        effect(s, "accel_cubic", 1.0, 3)
    })
    .beyond_the_model()
    .right(MISFIT),
    row("hysteresis-0.3", "hysteresis of .3 mg", |s| {
        effect(s, "accel_hysteresis", 0.3, 0);
    })
    .beyond_the_model()
    .right(MISFIT),
    row("hysteresis-1", "hysteresis of 1 mg", |s| {
        effect(s, "accel_hysteresis", 1.0, 0)
    })
    .beyond_the_model()
    .right(MISFIT),
    row("asymmetry-0.3", "asymmetry of .3 mg", |s| {
        effect(s, "accel_asymmetry", 0.3, 1);
    })
    .beyond_the_model()
    .right(MISFIT),
    row("asymmetry-1", "asymmetry of 1 mg", |s| {
        effect(s, "accel_asymmetry", 1.0, 1)
    })
    .beyond_the_model()
    .right(MISFIT),
];
