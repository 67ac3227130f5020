//! Several recordings of a device: what is of one of them stays there, and what is not of the device is said.

use calib::calibrate::{Method, Outcome, Request, calibrate};
use calib::calibration::apply;
use calib::discover::{Findings, Request as Discovery, discover};
use calib::recording::Stream;
use calib::simulate::{HandHeld, Motion, Session, Spec, Temperature};
use calib::{Error, Recording};
use findings::Kind;
use nalgebra::Vector3;

/// A device with parameters that are drawn once, and 20 placements in a recording.
fn device(seed: u64) -> Spec {
    let mut spec = Spec::hand_held(seed);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(20),
        initial_rest: Some(20.0),
        ..HandHeld::default()
    });
    let truth = spec.run().unwrap().truth;
    for p in [&truth.accelerometer, &truth.gyroscope] {
        let values = p.names().iter().cloned().zip(p.values().iter().copied());
        spec.parameters.extend(values);
    }
    spec
}

/// A recording of the device.
fn recorded(device: &Spec, seed: u64, name: &str) -> Session {
    let mut session = Spec {
        seed,
        ..device.clone()
    }
    .run()
    .unwrap();
    session.recording.name = name.into();
    session
}

/// The device with a parameter that is larger.
fn with(device: &Spec, parameter: &str, change: f64) -> Spec {
    let mut changed = device.clone();
    *changed.parameters.get_mut(parameter).unwrap() += change;
    changed
}

fn warm(device: &Spec, ambient: f64) -> Spec {
    let temperature = Temperature {
        ambient,
        ..Temperature::default()
    };
    Spec {
        temperature: Some(temperature),
        ..device.clone()
    }
}

fn fitted(recordings: &[Recording], gravity: f64) -> Result<Outcome, Error> {
    let request = Request {
        gravity,
        method: Method::Joint,
        ..Request::default()
    };
    calibrate(recordings, &[], &request)
}

fn found(recordings: &[Recording], gravity: f64) -> Result<Findings, Error> {
    let found = discover(recordings, &Discovery::new(gravity))?;
    Ok(found.findings)
}

fn recordings(sessions: &[Session]) -> Vec<Recording> {
    sessions.iter().map(|s| s.recording.clone()).collect()
}

/// A difference of two standard errors is refuted in one case of a few; a common bias is then off by several of its own.
#[test]
fn a_bias_that_moved_a_little_is_no_error_of_many_standard_errors() {
    let (mut squares, mut count) = (0.0, 0);
    for seed in 50..56 {
        let device = device(seed);
        let other = with(&device, "accel.b_z", 1.2e-3);
        let both = [recorded(&device, 1, "one"), recorded(&other, 2, "other")];
        let fit = fitted(&recordings(&both), device.gravity).unwrap();
        let biases = fit.calibration.accelerometer.unwrap().recordings;
        for (bias, session) in biases.iter().zip(&both) {
            let truth = session.truth.get("accel.b_z").unwrap();
            let z = (bias.bias[2] - truth) / bias.bias_std[2].unwrap();
            squares += z * z;
            count += 1;
        }
    }
    assert_eq!(count, 12);
    assert!(squares / 12.0 < 2.5, "{}", squares / 12.0);
}

#[test]
fn scale_factors_that_differ_by_little_are_said_and_no_effect_is_blamed_for_it() {
    let mut said = 0;
    for seed in 80..84 {
        let device = device(seed);
        let mut warmer = device.clone();
        for axis in ["x", "y", "z"] {
            for (sensor, share) in [("accel", 7e-4), ("gyro", 1.2e-3)] {
                let name = format!("{sensor}.s_{axis}");
                warmer = with(&warmer, &name, share);
            }
        }
        let all = [
            recorded(&device, 1, "one"),
            recorded(&device, 2, "two"),
            recorded(&warmer, 3, "warmer"),
        ];
        let fit = fitted(&recordings(&all), device.gravity).unwrap();
        let warnings = &fit.calibration.warnings;
        let is = |kinds: &[Kind]| warnings.iter().any(|found| kinds.contains(&found.kind));
        let differ = is(&[Kind::RECORDINGS_DIFFER]);
        said += usize::from(differ);
        assert!(!(differ && is(&[Kind::EFFECT_MISSING])), "{seed}");
    }
    assert!(said >= 3, "{said}");
}

/// Two values of a scale factor have no truth between them that a small standard error could be of.
#[test]
fn a_scale_factor_that_differs_between_two_recordings_is_said_and_within_the_standard_errors() {
    let device = device(90);
    for (parameter, change) in [("accel.s_y", 8e-4), ("gyro.s_z", 1.5e-3)] {
        let other = with(&device, parameter, change);
        let both = [recorded(&device, 1, "one"), recorded(&other, 2, "other")];
        let calibration = fitted(&recordings(&both), device.gravity)
            .unwrap()
            .calibration;
        assert!(
            calibration.warnings.has(Kind::RECORDINGS_DIFFER),
            "{parameter}"
        );
        let (triad, place) = match parameter {
            "accel.s_y" => (calibration.accelerometer.unwrap(), 1),
            _ => (calibration.gyroscope.unwrap(), 2),
        };
        let (value, std) = (triad.t[place][place], triad.t_std[place][place].unwrap());
        for session in &both {
            let off = value - session.truth.get(parameter).unwrap();
            assert!(off.abs() < 3.0 * std, "{parameter}: {off} ± {std}");
        }
    }
}

#[test]
fn every_recording_of_a_calibration_has_its_own_biases_taken_off() {
    let one = device(60);
    let other = with(&with(&one, "accel.b_x", 0.05), "gyro.b_y", 2e-3);
    let sessions = [recorded(&one, 1, "one"), recorded(&other, 2, "other")];
    let both = recordings(&sessions);
    let calibration = fitted(&both, one.gravity).unwrap().calibration;
    for recording in &both {
        let corrected = apply(&calibration, recording).unwrap();
        assert_eq!(corrected.warnings, recording.warnings);
        let gyroscope = corrected.gyroscope.unwrap();
        let first = &gyroscope.values[..1000];
        let rate = first.iter().sum::<Vector3<f64>>() / 1000.0;
        assert!(rate.norm() < 3e-4, "{}: {rate}", recording.name);
    }
    let third = recorded(&one, 3, "third").recording;
    let said = apply(&calibration, &third)
        .unwrap()
        .warnings
        .texts(findings::Front::CommandLine);
    assert!(
        said.iter()
            .any(|w| w.contains("none of them") && w.contains("stillpoint bias")),
        "{said:?}"
    );
}

/// Two recordings of one bias know it better than the last of them.
#[test]
fn biases_that_agree_are_taken_together_for_another_recording() {
    let device = device(67);
    let sessions = [recorded(&device, 1, "one"), recorded(&device, 2, "other")];
    let calibration = fitted(&recordings(&sessions), device.gravity)
        .unwrap()
        .calibration;
    let third = recorded(&device, 3, "third").recording;
    let alone = calibration.of_recording(&third);
    let own = calibration.accelerometer.as_ref().unwrap();
    let together = alone.accelerometer.as_ref().unwrap();
    for axis in 0..3 {
        let [a, b] = [0, 1].map(|k| own.recordings[k].bias[axis]);
        let mean = together.bias[axis];
        assert!(a.min(b) < mean && mean < a.max(b), "{a} {b}: {mean}");
        let last = &own.recordings[1];
        assert!(together.bias_std[axis].unwrap() < last.bias_std[axis].unwrap());
        // The document states what is subtracted.
        assert_eq!(own.bias[axis], mean);
    }
}

#[test]
fn a_recording_without_thermometer_is_given_no_temperature() {
    let device = device(61).with_effect("gyro_scale_temperature", 0.3);
    let cold = recorded(&warm(&device, 10.0), 1, "cold");
    let hot = recorded(&warm(&device, 40.0), 2, "hot");
    let named = found(&recordings(&[cold.clone(), hot.clone()]), device.gravity).unwrap();
    assert!(
        named
            .effects
            .iter()
            .any(|e| e.name == "gyro_scale_temperature")
    );
    let mut unknown = recorded(&warm(&device, 40.0), 3, "unknown");
    unknown.recording.temperature = None;
    let all = recordings(&[cold, hot, unknown]);
    let found = found(&all, device.gravity).unwrap();
    let names: Vec<_> = found.effects.iter().map(|e| e.name.as_str()).collect();
    assert!(
        !names.iter().any(|name| name.contains("temperature")),
        "{names:?}"
    );
    let said = found
        .calibration
        .warnings
        .texts(findings::Front::CommandLine);
    assert!(
        said.iter()
            .any(|w| w.contains("without a temperature (unknown)")),
        "{said:?}"
    );
}

#[test]
fn scale_factors_that_go_with_the_temperature_are_no_other_device() {
    let mut device = device(62);
    let slope = std::collections::BTreeMap::from([
        ("x".to_owned(), 1e-4),
        ("y".to_owned(), -8e-5),
        ("z".to_owned(), 1.2e-4),
    ]);
    device
        .effects
        .insert("accel_scale_temperature".into(), slope);
    let both = [
        recorded(&warm(&device, 10.0), 1, "cold"),
        recorded(&warm(&device, 45.0), 2, "hot"),
    ];
    let both = recordings(&both);
    let found = found(&both, device.gravity).unwrap();
    assert!(
        found
            .effects
            .iter()
            .any(|e| e.name == "accel_scale_temperature")
    );
    let said = fitted(&both, device.gravity)
        .unwrap()
        .calibration
        .warnings
        .texts(findings::Front::CommandLine);
    assert!(
        said.iter()
            .any(|w| w.contains("°C") && w.contains("discover")),
        "{said:?}"
    );
}

#[test]
fn another_gyroscope_is_refused() {
    let device = device(63);
    let other = with(&device, "gyro.s_y", 0.01);
    let both = [recorded(&device, 1, "one"), recorded(&other, 2, "other")];
    let both = recordings(&both);
    let refused = |error: Error| {
        let words = error.text(findings::Front::CommandLine);
        assert!(
            words.contains("of the gyroscope differs") && words.contains("--force-device"),
            "{words}"
        );
    };
    refused(fitted(&both, device.gravity).unwrap_err());
    refused(found(&both, device.gravity).unwrap_err());
}

#[test]
fn the_same_readings_on_another_clock_are_not_counted_twice() {
    let device = device(64);
    let whole = recorded(&device, 1, "whole").recording;
    let part = |stream: &Option<Stream>| {
        let stream = stream.as_ref().unwrap();
        let from = stream.len() / 3;
        Some(Stream {
            t: stream.t[from..].iter().map(|t| t + 500.0).collect(),
            values: stream.values[from..]
                .iter()
                .map(|v| v.map(|v| (v * 1e4).round() / 1e4))
                .collect(),
        })
    };
    let again = Recording {
        name: "again".into(),
        accelerometer: part(&whole.accelerometer),
        gyroscope: part(&whole.gyroscope),
        ..whole.clone()
    };
    let both = [whole, again];
    for error in [
        fitted(&both, device.gravity).unwrap_err(),
        found(&both, device.gravity).unwrap_err(),
    ] {
        let words = error.to_string();
        assert!(
            words.contains("again: this recording repeats readings of whole"),
            "{words}"
        );
    }
}

#[test]
fn stamps_that_are_late_in_one_recording_are_late_there_alone() {
    let device = device(65);
    let mut late = device.clone();
    let given = std::collections::BTreeMap::from([("d".to_owned(), 15e-3)]);
    late.effects.insert("time_offset".into(), given);
    let both = [recorded(&late, 1, "late"), recorded(&device, 2, "punctual")];
    let found = found(&recordings(&both), device.gravity).unwrap();
    assert!(found.effects.iter().all(|e| e.name != "time_offset"));
    let faults = found.integrity.iter().filter(|f| f.name == "time_offset");
    let faults: Vec<_> = faults
        .map(|f| (f.recording.as_str(), f.size.unwrap().value))
        .collect();
    assert!(
        matches!(faults.as_slice(), [("late", d)] if (d - 15e-3).abs() < 3e-3),
        "{faults:?}"
    );
}

#[test]
fn a_bias_that_steps_in_one_recording_is_said_to_step_there() {
    let device = device(66);
    let mut steps = device.clone();
    let given = std::collections::BTreeMap::from([
        ("t0".to_owned(), 120.0),
        ("x".to_owned(), 4e-4),
        ("y".to_owned(), -3e-4),
        ("z".to_owned(), 2e-4),
    ]);
    steps.effects.insert("gyro_step".into(), given);
    let both = [recorded(&device, 1, "still"), recorded(&steps, 2, "moved")];
    let found = found(&recordings(&both), device.gravity).unwrap();
    let said = found.unexplained.unwrap();
    assert!(said.shape().contains("the bias steps"), "{said:?}");
    assert_eq!(said.recording.as_deref(), Some("moved"));
    assert_eq!(found.effects, []);
}

#[test]
fn a_bias_that_steps_in_a_recording_for_the_gyroscope_alone_is_said_to_step_there() {
    let device = device(66);
    let for_turns = recorded(&device, 2, "turns");
    let mut turns = for_turns.recording.clone();
    let gyroscope = turns.gyroscope.as_mut().unwrap();
    let half = gyroscope.len() / 2;
    for value in &mut gyroscope.values[half..] {
        value.z += 0.02;
    }
    let still = recorded(&device, 1, "still").recording;
    for method in [Method::Stepwise, Method::Joint] {
        let request = Request {
            gravity: device.gravity,
            method,
            ..Request::default()
        };
        let outcome = calibrate(&[&still], &[&turns], &request).unwrap();
        let mut all = outcome.calibration.warnings.iter();
        let stepped = all.find(|found| found.kind == Kind::BIAS_STEP);
        let place = stepped.and_then(|found| found.place.recording.clone());
        assert_eq!(place.as_deref(), Some("turns"), "{method:?}");
    }
}
