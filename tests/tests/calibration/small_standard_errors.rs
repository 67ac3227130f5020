//! What puts numbers off by many of their standard errors is said, and of sound recordings nothing of it.

use calib::Recording;
use calib::calibrate::{Method, Request, calibrate};
use calib::recording::Stream;
use calib::simulate::{HandHeld, Motion, Planned, PlannedLeg, PlannedStep, Spec};
use findings::{Findings, Kind};
use nalgebra::Vector3;

const KINDS: [Kind; 7] = [
    Kind::RECORDINGS_DIFFER,
    Kind::PARTS_DIFFER,
    Kind::LINEARITY_UNTESTED,
    Kind::CUT_TOWARDS_ZERO,
    Kind::SETTLES_AFTER_TURNS,
    Kind::BIAS_MOVED,
    Kind::TURNS_TOO_FAST,
];

fn said(recordings: &[Recording], spec: &Spec) -> Findings {
    let request = Request {
        gravity: spec.gravity,
        method: Method::Joint,
        ..Request::default()
    };
    let calibration = calibrate(recordings, &[], &request).unwrap().calibration;
    let mut found = calibration.warnings;
    found.retain(|found| KINDS.contains(&found.kind));
    found
}

fn of(spec: &Spec) -> Recording {
    spec.run().unwrap().recording
}

/// Every face up several times, no edge and no corner.
fn six_faces(seed: u64) -> Spec {
    let quarter = |axis: [f64; 3]| PlannedStep {
        legs: vec![PlannedLeg {
            axis,
            angle: std::f64::consts::FRAC_PI_2,
            duration: 2.0,
        }],
        rest: 7.0,
    };
    let about_x = std::iter::repeat_n(quarter([1.0, 0.0, 0.0]), 4);
    let about_y = std::iter::repeat_n(quarter([0.0, 1.0, 0.0]), 4);
    let round = about_x.chain(about_y);
    Spec {
        motion: Motion::Planned(Planned {
            first_rest: 30.0,
            steps: round.clone().chain(round).collect(),
            ..Planned::default()
        }),
        ..Spec::hand_held(seed)
    }
}

#[test]
fn faces_alone_do_not_show_a_cubic_accelerometer_and_all_directions_do() {
    let faces = six_faces(3).with_effect("accel_cubic", 1.0);
    assert!(said(&[of(&faces)], &faces).has(Kind::LINEARITY_UNTESTED));
    let around = Spec::hand_held(3);
    assert!(said(&[of(&around)], &around).is_empty());
}

/// What a search says of the same kinds, and the names that it finds.
fn said_by_a_search(recording: Recording, spec: &Spec) -> (Findings, Vec<String>) {
    let request = calib::discover::Request::new(spec.gravity);
    let found = calib::discover::discover(&[recording], &request).unwrap();
    let mut said = found.findings.calibration.warnings;
    said.retain(|found| KINDS.contains(&found.kind));
    let names = found.findings.effects.into_iter().map(|e| e.name);
    (said, names.collect())
}

#[test]
fn a_search_says_too_that_faces_alone_do_not_show_a_cubic_accelerometer() {
    let faces = six_faces(3).with_effect("accel_cubic", 1.0);
    let (said, _) = said_by_a_search(of(&faces), &faces);
    assert!(said.has(Kind::LINEARITY_UNTESTED));
    let around = Spec::hand_held(3);
    assert!(said_by_a_search(of(&around), &around).0.is_empty());
}

/// The readings in steps, each rounded by `round`.
fn in_steps(mut recording: Recording, step: f64, round: fn(f64) -> f64) -> Recording {
    let readings = recording.accelerometer.as_mut().unwrap();
    let to_step = |value: &mut Vector3<f64>| *value = value.map(|v| step * round(v / step));
    readings.values.iter_mut().for_each(to_step);
    recording
}

#[test]
fn readings_cut_off_towards_zero_are_told_from_rounded_ones() {
    let spec = Spec::hand_held(5);
    let cut = in_steps(of(&spec), 0.02, f64::trunc);
    assert!(said(&[cut], &spec).has(Kind::CUT_TOWARDS_ZERO));
    let rounded = in_steps(of(&spec), 0.02, f64::round);
    assert!(said(&[rounded], &spec).is_empty());
}

#[test]
fn the_turns_tell_what_a_step_of_the_noise_at_rest_cuts_off() {
    let spec = Spec::hand_held(6);
    let cut = in_steps(of(&spec), 0.005, f64::trunc);
    assert!(said(&[cut], &spec).has(Kind::CUT_TOWARDS_ZERO));
    let rounded = in_steps(of(&spec), 0.005, f64::round);
    assert!(said(&[rounded], &spec).is_empty());
}

#[test]
fn a_search_names_no_effect_of_readings_that_are_cut_off_towards_zero() {
    let spec = Spec::hand_held(5);
    let cut = in_steps(of(&spec), 0.02, f64::trunc);
    let (said, names) = said_by_a_search(cut, &spec);
    assert!(said.has(Kind::CUT_TOWARDS_ZERO));
    assert!(names.is_empty(), "{names:?}");
}

/// The rows of two sessions in one file.
fn one_behind_the_other(first: Recording, second: &Recording) -> Recording {
    let mut both = first;
    let end = both.accelerometer.as_ref().unwrap().t.last().unwrap() + 0.01;
    let append = |to: &mut Option<Stream>, from: &Option<Stream>| {
        let (to, from) = (to.as_mut().unwrap(), from.as_ref().unwrap());
        to.t.extend(from.t.iter().map(|t| t - from.t[0] + end));
        to.values.extend_from_slice(&from.values);
    };
    append(&mut both.accelerometer, &second.accelerometer);
    append(&mut both.gyroscope, &second.gyroscope);
    both
}

#[test]
fn a_second_device_in_the_second_half_of_a_recording_is_said() {
    let device = |seed, scale| {
        let mut spec = Spec::hand_held(seed);
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(20),
            initial_rest: Some(20.0),
            ..HandHeld::default()
        });
        for name in ["accel.s_y", "gyro.s_y"] {
            spec.parameters.insert(name.into(), scale);
        }
        for name in ["accel.s_x", "accel.s_z", "gyro.s_x", "gyro.s_z"] {
            spec.parameters.insert(name.into(), 1.003);
        }
        for angle in ["accel.alpha_yz", "accel.alpha_zy", "accel.alpha_zx"] {
            spec.parameters.insert(angle.into(), 1e-3);
        }
        for bias in ["x", "y", "z"] {
            spec.parameters.insert(format!("accel.b_{bias}"), 0.02);
            spec.parameters.insert(format!("gyro.b_{bias}"), 2e-3);
        }
        for angle in ["yz", "zy", "xz", "zx", "xy", "yx"] {
            spec.parameters.insert(format!("gyro.beta_{angle}"), 1e-3);
        }
        spec
    };
    let [own, other] = [device(7, 1.0), device(8, 1.003)];
    let glued = one_behind_the_other(of(&own), &of(&other));
    assert!(said(&[glued], &own).has(Kind::PARTS_DIFFER));
    let same = one_behind_the_other(of(&own), &of(&device(8, 1.0)));
    assert!(said(&[same], &own).is_empty());
}

/// The readings where this share of the force follows it with a time constant, s.
fn following_late(mut recording: Recording, share: f64, tau: f64) -> Recording {
    let readings = recording.accelerometer.as_mut().unwrap();
    let (mut followed, mut last) = (readings.values[0], readings.t[0]);
    for (t, value) in readings.t.iter().zip(&mut readings.values) {
        followed += (*value - followed) * (1.0 - (-(t - last) / tau).exp());
        last = *t;
        *value += (*value - followed) * share;
    }
    recording
}

#[test]
fn readings_that_settle_after_each_turn_are_said_and_counted_in_the_standard_errors() {
    let spec = Spec::hand_held(9);
    let scale_error = |recording: Recording| {
        let request = Request {
            gravity: spec.gravity,
            method: Method::Joint,
            ..Request::default()
        };
        let calibration = calibrate(&[recording], &[], &request).unwrap().calibration;
        let triad = calibration.accelerometer.unwrap();
        let says = calibration.warnings.has(Kind::SETTLES_AFTER_TURNS);
        (triad.t[2][2], triad.t_std[2][2].unwrap(), says)
    };
    let (right, usual, says) = scale_error(of(&spec));
    assert!(!says);
    // Of the slow one the intervals see little of its fading, and their means what the turns before left.
    for tau in [3.0, 20.0] {
        let (late, larger, says) = scale_error(following_late(of(&spec), 8e-4, tau));
        let off = (late - right).abs();
        assert!(says && larger > 2.0 * usual, "{tau}: {larger}");
        assert!(off > 2.0 * usual && off < 3.0 * larger, "{tau}: {off}");
    }
}

/// A hand-held session of so many placements.
fn placed(seed: u64, placements: usize) -> Spec {
    let mut spec = Spec::hand_held(seed);
    if let Motion::HandHeld(motion) = &mut spec.motion {
        motion.placements = Some(placements);
    }
    spec
}

#[test]
fn a_quadratic_accelerometer_has_no_bias_that_moves_and_no_parts_that_differ() {
    let mut spec = placed(6, 20);
    let quadratic = [("x", 4e-4), ("y", -4e-4), ("z", 4e-4)];
    let quadratic = quadratic.map(|(axis, size)| (axis.to_owned(), size));
    spec.effects
        .insert("accel_quadratic".into(), quadratic.into());
    assert!(said(&[of(&spec)], &spec).is_empty());
}

#[test]
fn a_search_says_too_that_turns_are_too_fast() {
    let mut spec = placed(4, 16);
    spec.rate = 15.0;
    if let Motion::HandHeld(motion) = &mut spec.motion {
        motion.turn = [0.8, 1.2];
    }
    assert!(said(&[of(&spec)], &spec).has(Kind::TURNS_TOO_FAST));
    let (said, _) = said_by_a_search(of(&spec), &spec);
    assert!(said.has(Kind::TURNS_TOO_FAST));
}
