//! Simulated sessions calibrated without being told anything, against their truth.

use calib::Error;
use calib::calibrate::{Outcome, Request, calibrate};
use calib::calibration::{apply, effect_named};
use calib::recording::Recording;
use calib::simulate::{HandHeld, Motion, Session, Spec};
use findings::Kind;

fn request(session: &Session) -> Request {
    Request {
        gravity: session.truth.spec.gravity,
        ..Request::default()
    }
}

/// (estimate − truth) / standard error of every free parameter that the truth knows.
fn pulls(session: &Session, outcome: &Outcome) -> Vec<(String, f64)> {
    let fits = [
        outcome.accelerometer.as_ref().map(|fit| &fit.fitted),
        outcome.gyroscope.as_ref().map(|fit| &fit.fitted),
    ];
    let mut pulls = Vec::new();
    for fitted in fits.into_iter().flatten() {
        for name in &fitted.free {
            if let Some(truth) = session.truth.get(name) {
                let estimate = fitted.parameters.get(name).unwrap();
                let std = fitted.standard_error(name).unwrap();
                pulls.push((name.clone(), (estimate - truth) / std));
            }
        }
    }
    pulls
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = values.collect();
    (all.iter().map(|v| v * v).sum::<f64>() / all.len() as f64).sqrt()
}

#[test]
fn every_placement_is_found_and_the_truth_lies_within_the_errors() {
    let mut all = Vec::new();
    for seed in 0..12 {
        let session = Spec::hand_held(seed).run().unwrap();
        let outcome = calibrate(
            std::slice::from_ref(&session.recording),
            &[],
            &request(&session),
        )
        .unwrap();
        let found = outcome.choices[0].segmentation.statics.len();
        assert_eq!(found, session.truth.static_intervals.len(), "seed {seed}");
        assert_eq!(
            outcome
                .calibration
                .warnings
                .texts(findings::Front::CommandLine),
            Vec::<String>::new(),
            "seed {seed}"
        );
        all.extend(pulls(&session, &outcome));
    }
    let worst = all
        .iter()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        .unwrap();
    // 12 × 18 numbers: one beyond 4.5 standard errors would come by chance in 0.2 % of studies.
    assert!(worst.1.abs() < 4.5, "{worst:?}");
    // The stepwise method weights all turns alike, so its errors need not be the last word, but they
    // must not be a third too small.
    let rms = root_mean_square(all.iter().map(|p| p.1));
    assert!((0.8..1.3).contains(&rms), "{rms}");
}

#[test]
fn g_sensitivity_in_the_model_is_recovered_within_its_errors() {
    let session = Spec::hand_held(5)
        .with_effect("gyro_g_sensitivity", 1.0)
        .run()
        .unwrap();
    let effects = vec![effect_named("gyro_g_sensitivity").unwrap()];
    let request = Request {
        effects,
        ..request(&session)
    };
    let outcome = calibrate(std::slice::from_ref(&session.recording), &[], &request).unwrap();
    let pulls = pulls(&session, &outcome);
    assert_eq!(
        pulls
            .iter()
            .filter(|p| p.0.starts_with("gyro_g_sensitivity"))
            .count(),
        9
    );
    assert!(pulls.iter().all(|p| p.1.abs() < 4.0), "{pulls:?}");
}

#[test]
fn raw_counts_give_the_same_corrected_signal_as_si_units() {
    let si = Spec::hand_held(3);
    let mut counts = si.clone();
    counts.accelerometer.counts = true;
    counts.accelerometer.step = 5e-4;
    counts.gyroscope.counts = true;
    counts.gyroscope.step = 2e-4;
    let sessions = [si.run().unwrap(), counts.run().unwrap()];
    let corrected: Vec<Recording> = sessions
        .iter()
        .map(|s| {
            let outcome = calibrate(std::slice::from_ref(&s.recording), &[], &request(s)).unwrap();
            apply(&outcome.calibration, &s.recording).unwrap()
        })
        .collect();
    // A count of 5e-4 m/s² rounds by 1.4e-4 rms: the two may differ by that and by what the
    // parameters make of it.
    let streams = |k: usize| {
        (
            corrected[k].accelerometer.as_ref().unwrap(),
            corrected[k].gyroscope.as_ref().unwrap(),
        )
    };
    let ((a, w), (b, v)) = (streams(0), streams(1));
    let rms = |x: &[nalgebra::Vector3<f64>], y: &[nalgebra::Vector3<f64>]| {
        root_mean_square(x.iter().zip(y).map(|(x, y)| (x - y).norm()))
    };
    assert!(rms(&a.values, &b.values) < 5e-4);
    assert!(rms(&w.values, &v.values) < 2e-4);
}

#[test]
fn recordings_share_a_bias_unless_the_data_ask_for_their_own() {
    let mut spec = Spec::hand_held(21);
    let of = |spec: &Spec, seed: u64, name: &str| {
        let mut spec = spec.clone();
        spec.seed = seed;
        Recording {
            name: name.into(),
            ..spec.run().unwrap().recording
        }
    };
    let truth = Spec::hand_held(21).run().unwrap().truth;
    for p in [&truth.accelerometer, &truth.gyroscope] {
        for (name, value) in p.names().iter().zip(p.values()) {
            spec.parameters.insert(name.clone(), *value);
        }
    }
    let mut warmer = spec.clone();
    *warmer.parameters.get_mut("accel.b_x").unwrap() += 0.02;
    let same = [of(&spec, 31, "morning"), of(&spec, 32, "noon")];
    let moved = [of(&spec, 31, "morning"), of(&warmer, 33, "evening")];
    let request = Request::default();
    let common = calibrate(&same, &[], &request).unwrap();
    assert!(!common.accelerometer.as_ref().unwrap().own_bias);
    let own = calibrate(&moved, &[], &request).unwrap();
    assert!(own.accelerometer.as_ref().unwrap().own_bias);
    let biases = &own.calibration.accelerometer.as_ref().unwrap().recordings;
    let names: Vec<&str> = biases.iter().map(|b| b.recording.as_str()).collect();
    assert_eq!(names, ["morning", "evening"]);
    let difference = biases[1].bias[0] - biases[0].bias[0];
    assert!((difference - 0.02).abs() < 1.5e-3, "{difference}");
    // The bias that stands for the device is that of the last recording.
    assert_eq!(
        own.calibration.accelerometer.as_ref().unwrap().bias,
        biases[1].bias
    );
}

#[test]
fn the_same_recording_twice_counts_once() {
    let session = Spec::hand_held(4).run().unwrap();
    let once = calibrate(
        std::slice::from_ref(&session.recording),
        &[],
        &request(&session),
    )
    .unwrap();
    let both = [session.recording.clone(), session.recording.clone()];
    let twice = calibrate(&both, &[], &request(&session)).unwrap();
    assert_eq!(
        once.calibration.accelerometer,
        twice.calibration.accelerometer
    );
    assert!(
        twice
            .calibration
            .warnings
            .texts(findings::Front::CommandLine)[0]
            .contains("counted once")
    );
}

fn refusal(spec: &Spec) -> String {
    let session = spec.run().unwrap();
    match calibrate(
        std::slice::from_ref(&session.recording),
        &[],
        &request(&session),
    ) {
        Err(Error::NotEnough(what)) => what.text(findings::Front::Plain),
        Err(other) => panic!("{other}"),
        Ok(outcome) => panic!("accepted: {:?}", outcome.calibration.warnings),
    }
}

#[test]
fn a_device_that_never_turns_is_refused_with_what_to_do() {
    let what = refusal(&Spec::still(1, 60.0));
    assert!(
        what.contains("all static") && what.contains(&plan::REQUIREMENT.to_string()),
        "{what}"
    );
}

#[test]
fn three_placements_name_what_is_not_observable() {
    let mut spec = Spec::hand_held(2);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(3),
        ..HandHeld::default()
    });
    let what = refusal(&spec);
    assert!(
        what.contains("cannot be found from them") && what.contains("accel."),
        "{what}"
    );
    assert!(
        what.contains("; add ") && what.contains(" placements: 1) "),
        "{what}"
    );
}

#[test]
fn placements_in_one_plane_are_refused_with_the_parameter_that_is_not_known() {
    for seed in 0..10 {
        let mut spec = Spec::hand_held(seed);
        let motion = HandHeld {
            placements: Some(12),
            coplanar: true,
            ..HandHeld::default()
        };
        spec.motion = Motion::HandHeld(motion);
        let session = spec.run().unwrap();
        match calibrate(
            std::slice::from_ref(&session.recording),
            &[],
            &request(&session),
        ) {
            Err(Error::NotEnough(what)) => assert!(
                what.text(findings::Front::Plain).contains("accel."),
                "{what}"
            ),
            Err(other) => panic!("{other}"),
            Ok(outcome) => {
                let warnings = outcome.calibration.warnings;
                let kinds = [Kind::PLACEMENTS_MISSING, Kind::WEAK_PARAMETER];
                let said = warnings.iter().filter(|own| kinds.contains(&own.kind));
                let mut texts = said.map(|own| own.text(findings::Front::CommandLine));
                assert!(
                    texts.any(|text| text.contains(" %")),
                    "seed {seed} was accepted in silence"
                );
            }
        }
    }
}

#[test]
fn a_single_sensor_is_calibrated_as_far_as_it_goes() {
    let session = Spec::hand_held(6).run().unwrap();
    let mut no_gyro = session.recording.clone();
    no_gyro.gyroscope = None;
    let outcome = calibrate(&[no_gyro], &[], &request(&session)).unwrap();
    assert!(outcome.calibration.gyroscope.is_none());
    assert!(
        outcome
            .calibration
            .warnings
            .texts(findings::Front::CommandLine)[0]
            .contains("no gyroscope")
    );

    let mut no_accel = session.recording.clone();
    no_accel.accelerometer = None;
    let outcome = calibrate(&[no_accel], &[], &request(&session)).unwrap();
    assert!(outcome.calibration.accelerometer.is_none());
    let bias = outcome.calibration.gyroscope.unwrap().bias;
    let truth = session.truth.get("gyro.b_x").unwrap();
    assert!((bias[0] - truth).abs() < 1e-4);
}
