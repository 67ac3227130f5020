//! Placements in one plane leave parameters unknown: both methods must say which, and what to add.

use calib::Recording;
use calib::calibrate::{Method, Request, calibrate};
use calib::recording::Stream;
use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use stillpoint_tests::coverage::Row;

/// The nine parameters of gravity's norm and, for those in `T`, row and column.
const NINE: [(&str, Option<(usize, usize)>); 9] = [
    ("accel.s_x", Some((0, 0))),
    ("accel.s_y", Some((1, 1))),
    ("accel.s_z", Some((2, 2))),
    ("accel.alpha_yz", Some((0, 1))),
    ("accel.alpha_zy", Some((0, 2))),
    ("accel.alpha_zx", Some((1, 2))),
    ("accel.b_x", None),
    ("accel.b_y", None),
    ("accel.b_z", None),
];

/// How much of each parameter's unit vector lies in what directions in the plane across `normal` cannot see of
/// `u · (δT u − δb/g)`, 0 to 1: the null space of that linear form over the whole plane.
fn unseen(normal: &Vector3<f64>) -> Vec<f64> {
    let across = normal.cross(&Vector3::new(0.31, -0.77, 0.55)).normalize();
    let other = normal.cross(&across);
    let design = DMatrix::from_fn(36, 9, |i, k| {
        let (sin, cos) = (i as f64 * std::f64::consts::TAU / 36.0).sin_cos();
        let u = across * cos + other * sin;
        match NINE[k].1 {
            Some((row, column)) => u[row] * u[column],
            None => -u[k - 6],
        }
    });
    let seen = design.svd(false, true);
    let rows = seen.v_t.unwrap();
    let kept = (0..9).filter(|&k| seen.singular_values[k] > 1e-9);
    let mut unseen = vec![1.0; 9];
    for k in kept {
        for (j, share) in unseen.iter_mut().enumerate() {
            *share -= rows[(k, j)].powi(2);
        }
    }
    unseen
}

/// The same recording of a device whose axes are turned within its case.
fn turned(recording: &Recording, by: &Matrix3<f64>) -> Recording {
    let turn = |stream: &Option<Stream>| {
        stream.as_ref().map(|s| Stream {
            t: s.t.clone(),
            values: s.values.iter().map(|v| by * v).collect(),
        })
    };
    Recording {
        accelerometer: turn(&recording.accelerometer),
        gyroscope: turn(&recording.gyroscope),
        ..recording.clone()
    }
}

fn random_rotation(seed: u64) -> Matrix3<f64> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    let axis = Vector3::from_fn(|_, _| StandardNormal.sample(&mut random));
    let angle: f64 = StandardNormal.sample(&mut random);
    Rotation3::from_scaled_axis(Vector3::normalize(&axis) * (1.5 + angle)).into_inner()
}

/// What is said of a recording: the refusal, or the warnings of what was accepted.
fn words(recording: &Recording, method: Method) -> String {
    let request = Request {
        method,
        ..Request::default()
    };
    match calibrate(std::slice::from_ref(recording), &[], &request) {
        Err(calib::Error::NotEnough(found)) => found.text(findings::Front::CommandLine),
        Err(other) => panic!("{other}"),
        Ok(outcome) => outcome
            .calibration
            .warnings
            .texts(findings::Front::CommandLine)
            .join("\n"),
    }
}

/// Whether a parameter is named by itself or leads a combination: no factor stands before it.
fn leads(words: &str, name: &str) -> bool {
    let tokens: Vec<&str> = words.split_whitespace().collect();
    let is_name = |token: &str| token.trim_end_matches([';', ',', ':']) == name;
    (0..tokens.len()).any(|k| {
        let factor = k.checked_sub(1).map(|before| tokens[before].parse::<f64>());
        is_name(tokens[k]) && !matches!(factor, Some(Ok(_)))
    })
}

fn the_unknown_is_named(recording: &Recording, normal: &Vector3<f64>, seed: u64) {
    let unseen = unseen(normal);
    for method in [Method::Stepwise, Method::Joint] {
        let words = words(recording, method);
        let named: Vec<usize> = (0..9).filter(|&k| leads(&words, NINE[k].0)).collect();
        // What cannot be seen of it at all is more than a sixth of its variance.
        let right = !named.is_empty() && named.iter().all(|&k| unseen[k] > 0.17);
        assert!(right, "{seed} {method:?} {normal:?}: {words} ({unseen:?})");
        assert!(words.contains("; add "), "{seed}: {words}");
    }
}

#[test]
fn seven_placements_in_the_plane_of_x_and_y_are_refused_for_what_lies_along_z() {
    for seed in 0..4 {
        let session = Row::Coplanar.spec(seed).run().unwrap();
        the_unknown_is_named(&session.recording, &Vector3::z(), seed);
        for method in [Method::Stepwise, Method::Joint] {
            let words = words(&session.recording, method);
            assert!(words.contains("z up, z down"), "{seed} {method:?}: {words}");
        }
    }
}

#[test]
fn seven_placements_in_any_plane_are_refused_for_what_lies_along_its_normal() {
    for seed in 10..14 {
        let session = Row::Coplanar.spec(seed).run().unwrap();
        let by = random_rotation(seed);
        let recording = turned(&session.recording, &by);
        the_unknown_is_named(&recording, &(by * Vector3::z()), seed);
    }
}

#[test]
fn many_placements_in_one_plane_are_no_better() {
    use calib::simulate::{HandHeld, Motion};
    for seed in 20..23 {
        let mut spec = Row::Coplanar.spec(seed);
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(24),
            coplanar: true,
            ..HandHeld::default()
        });
        let session = spec.run().unwrap();
        the_unknown_is_named(&session.recording, &Vector3::z(), seed);
    }
}
