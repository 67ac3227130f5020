//! Whatever can be estimated can be applied: simulate, calibrate, apply to another recording, and the noise is left.
//!
//! A small version of `truth-study`: a device per effect and 30 placements to judge by; the whole at once is in the band
//! that the study asks of each effect.

use calib::Error;
use calib::calibrate::Method;
use calib::calibration::{Calibration, apply, load, load_with};
use calib::recording::Stream;
use nalgebra::Vector3;
use rayon::prelude::*;
use sensor::{Effect, EffectRef, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;
use stillpoint_tests::one_truth::{Chi2, End, Trial, calibrated, remainder, trials};

const METHODS: [Method; 2] = [Method::Stepwise, Method::Joint];

/// Placements of the recording that is judged.
const PLACEMENTS: usize = 30;

/// What a method cannot know: the effect, the method (both where `None`), and the quantity that the refusal names.
const UNKNOWABLE: [(&str, Option<Method>, &str); 8] = [
    (
        "accel_misalignment_temperature",
        Some(Method::Stepwise),
        "not at its direction",
    ),
    ("accel_room_field", None, "of the device"),
    ("gyro_room_field", None, "of the device"),
    ("accel_step", None, "time (t0)"),
    ("gyro_step", None, "time (t0)"),
    ("time_offset", None, "derivative of the specific force"),
    ("earth_rate", None, "of the device"),
    (
        "accel_cross_axis",
        Some(Method::Stepwise),
        "not at its direction",
    ),
];

fn unknowable(name: &str, method: Method) -> Option<&'static str> {
    let own = |(effect, of, _): &&(&str, Option<Method>, &str)| {
        *effect == name && of.is_none_or(|of| of == method)
    };
    UNKNOWABLE.iter().find(own).map(|(.., quantity)| *quantity)
}

/// Effects that are in the rate at rest and hardly anywhere else: forces and turns do not show them.
const AT_REST: [&str; 5] = [
    "gyro_drift",
    "gyro_g2_sensitivity",
    "gyro_relaxation",
    "gyro_shaken",
    "gyro_vibration_rectification",
];

/// χ² beyond this many standard deviations of its own is no chance: 160 numbers are looked at.
const CHANCE: f64 = 4.5;

#[test]
fn every_effect_leaves_the_noise_on_another_recording_or_is_refused_by_name() {
    let all: Vec<(Trial, Method)> = trials()
        .into_iter()
        .flat_map(|trial| METHODS.map(|method| (trial.clone(), method)))
        .collect();
    assert_eq!(all.len(), 2 * 50);
    let ends: Vec<End> = all
        .par_iter()
        // Another device, motion and noise for each, so that all together say more than one; the same however many there are.
        .map(|(trial, method)| {
            let letters = trial.effect.name().bytes().map(u64::from).sum::<u64>();
            trial.run(*method, letters, PLACEMENTS)
        })
        .collect();
    let mut pooled = [Chi2::default(); 2];
    for ((trial, method), end) in all.iter().zip(ends) {
        let name = trial.effect.name();
        match (end, unknowable(name, *method)) {
            (End::Left { with, without }, None) => {
                for (k, left) in with.iter().enumerate() {
                    let spread = (2.0 / left.dof).sqrt();
                    let off = (left.reduced() - 1.0) / spread;
                    assert!(off.abs() < CHANCE, "{name} {method:?}: {left:?}");
                    pooled[k].sum += left.sum;
                    pooled[k].dof += left.dof;
                }
                // Without the effect the same recording shows that it is there.
                let shown = |k: usize| without[k].sum - with[k].sum;
                let least = (2.0 * with[0].dof).sqrt();
                let seen = shown(0).max(shown(1)) > least || AT_REST.contains(&name);
                // What a magnetic effect leaves of the field is measured in `magnetometer.rs`.
                let seen = seen || trial.effect.sensor() == Sensor::Magnetometer;
                assert!(seen, "{name} {method:?}: {with:?} {without:?}");
            }
            (End::Refused(why), Some(quantity)) => {
                assert!(why.contains(name) && why.contains(quantity), "{why}");
            }
            (end, expected) => panic!("{name} {method:?}: {end:?}, refusal: {expected:?}"),
        }
    }
    for left in pooled {
        assert!((0.9..1.1).contains(&left.reduced()), "{pooled:?}");
    }
}

#[test]
fn counts_and_si_units_give_the_same_corrected_signals() {
    let names = ["accel_hysteresis", "gyro_delay", "gyro_lag_across"];
    for trial in trials() {
        if !names.contains(&trial.effect.name()) {
            continue;
        }
        let [first, second] = trial.sessions(2, 12).unwrap();
        let [mut raw_first, mut raw_second] = [first.clone(), second.clone()];
        for session in [&mut raw_first, &mut raw_second] {
            let recording = &mut session.recording;
            let streams = [
                (&mut recording.accelerometer, 2000.0, 31000.0),
                (&mut recording.gyroscope, 900.0, 33000.0),
            ];
            for (stream, per_unit, zero) in streams {
                let of = |v: &mut Vector3<f64>| *v = v.map(|v| v * per_unit + zero);
                stream.as_mut().unwrap().values.iter_mut().for_each(of);
            }
        }
        for method in METHODS {
            let corrected = |first: &calib::simulate::Session,
                             second: &calib::simulate::Session| {
                let outcome =
                    calibrated(first, method, std::slice::from_ref(&trial.effect)).unwrap();
                apply(&outcome.calibration, &second.recording).unwrap()
            };
            let si = corrected(&first, &second);
            let raw = corrected(&raw_first, &raw_second);
            let name = trial.effect.name();
            let rms = |a: &Option<Stream>, b: &Option<Stream>| {
                let (a, b) = (a.as_ref().unwrap(), b.as_ref().unwrap());
                let squares = a
                    .values
                    .iter()
                    .zip(&b.values)
                    .map(|(a, b)| (a - b).norm_squared());
                (squares.sum::<f64>() / a.len() as f64).sqrt()
            };
            // Fits of the two begin elsewhere and end within a share of the parameters' errors: far below the noise of a
            // mean, 1.8e-3 m/s² and 1.8e-4 rad/s.
            let force = rms(&si.accelerometer, &raw.accelerometer);
            let rate = rms(&si.gyroscope, &raw.gyroscope);
            assert!(
                force < 2e-4 && rate < 2e-5,
                "{name} {method:?}: {force} {rate}"
            );
        }
    }
}

/// An effect of another crate, which declares nothing of what it needs.
#[derive(Debug)]
struct Jolt;

impl Effect for Jolt {
    const NAME: &'static str = "gyro_jolt";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i f_z alpha_i";
    const PARAMS: &'static [Param] = &params("s^3/m", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-4;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let f = truth.specific_force.z;
        Vector3::from_fn(|i, _| p[i] * f * truth.angular_acceleration[i])
    }
}

static JOLT: Jolt = Jolt;

#[test]
fn an_effect_of_another_crate_is_applied_and_reloaded_or_refused_but_never_dropped() {
    let outside = [EffectRef::from(&JOLT)];
    assert_eq!(
        outside[0].needs(),
        [Quantity::SpecificForce, Quantity::AngularAcceleration]
    );
    let trial = trials()
        .into_iter()
        .find(|t| t.effect.name() == "gyro_delay");
    let [first, second] = trial.unwrap().sessions(3, 12).unwrap();
    let outcome = calibrated(&first, Method::Joint, &outside).unwrap();
    let calibration = outcome.calibration;
    assert_eq!(calibration.effects[0].name, "gyro_jolt");
    let here = apply(&calibration, &second.recording).unwrap();
    let mut without = calibration.clone();
    without.effects.clear();
    let base = apply(&without, &second.recording).unwrap();
    assert_ne!(here.gyroscope, base.gyroscope);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cal.json");
    std::fs::write(&path, serde_json::to_string(&calibration).unwrap()).unwrap();
    let again = load_with(&path, &outside).unwrap();
    let there = apply(&again, &second.recording).unwrap();
    assert_eq!(here.gyroscope, there.gyroscope);
    let refused = load(&path).unwrap_err().to_string();
    assert!(refused.contains("gyro_jolt"), "{refused}");
    // Not even past the loader is it dropped.
    let text = std::fs::read_to_string(&path).unwrap();
    let unchecked: Calibration = serde_json::from_str(&text).unwrap();
    let refused = apply(&unchecked, &second.recording).unwrap_err();
    assert!(matches!(refused, Error::NotEnough(_)));
    assert!(refused.to_string().contains("gyro_jolt"), "{refused}");
}

#[test]
fn the_rotation_of_the_earth_is_applied_to_the_recording_it_was_found_in() {
    let trial = trials()
        .into_iter()
        .find(|t| t.effect.name() == "earth_rate");
    let trial = trial.unwrap();
    let [first, second] = trial.sessions(4, 12).unwrap();
    for method in METHODS {
        let calibration = calibrated(&first, method, std::slice::from_ref(&trial.effect))
            .unwrap()
            .calibration;
        remainder(&calibration, &first).unwrap();
        let refused = remainder(&calibration, &second).unwrap_err();
        assert!(refused.to_string().contains("earth_rate"), "{refused}");
    }
}
