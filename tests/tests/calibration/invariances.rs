//! What a calibration must not depend on: where the clock starts, and what the axes are called.

use calib::Recording;
use calib::calibrate::{Method, Request, calibrate};
use calib::calibration::{Calibration, Triad, apply};
use calib::recording::Stream;
use nalgebra::{Matrix3, Vector3};
use stillpoint_tests::coverage::Row;

/// The joint estimate stops a hundredth of a standard deviation of all parameters together, and the
/// levels of its noise a thousandth, from where they would come to rest.
const REACHED: f64 = 0.02;

fn calibrated(recording: &Recording, method: Method) -> Calibration {
    let request = Request {
        method,
        ..Request::default()
    };
    let outcome = calibrate(std::slice::from_ref(recording), &[], &request);
    outcome.unwrap().calibration
}

/// Both streams with other stamps and readings.
fn with(
    recording: &Recording,
    stamp: impl Fn(f64) -> f64,
    reading: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Recording {
    let change = |stream: &Option<Stream>| {
        stream.as_ref().map(|s| Stream {
            t: s.t.iter().map(|&t| stamp(t)).collect(),
            values: s.values.iter().map(&reading).collect(),
        })
    };
    Recording {
        accelerometer: change(&recording.accelerometer),
        gyroscope: change(&recording.gyroscope),
        ..recording.clone()
    }
}

/// Parameters in the order of the covariance.
fn values(calibration: &Calibration) -> Vec<f64> {
    let of = |triad: &Option<Triad>| {
        let triad = triad.as_ref().unwrap();
        let t = triad.base().t;
        t.iter().copied().chain(triad.bias).collect::<Vec<_>>()
    };
    [of(&calibration.accelerometer), of(&calibration.gyroscope)].concat()
}

/// Standard errors of the parameters are at least this: of a bias of a consumer's gyroscope, rad/s.
const LEAST_ERROR: f64 = 1e-5;

#[test]
fn a_clock_that_starts_elsewhere_gives_the_same_calibration() {
    for row in [Row::Consumer, Row::TacticalWalk] {
        let session = row.spec(7).run().unwrap();
        for method in [Method::Stepwise, Method::Joint] {
            let before = values(&calibrated(&session.recording, method));
            for start in [64.0, 1000.0, 12_345.678] {
                let later = with(&session.recording, |t| t + start, |v| *v);
                let after = values(&calibrated(&later, method));
                for (k, (a, b)) in after.iter().zip(&before).enumerate() {
                    let moved = (a - b).abs();
                    assert!(
                        moved < REACHED * LEAST_ERROR,
                        "{row:?} {method:?} {start} {k}: {moved:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn axes_renamed_in_a_circle_give_the_same_corrected_readings() {
    // Reading (y, z, x) in place of (x, y, z); the triangular frame then is another one, turned by no
    // more than the misalignments, which a norm does not see.
    let circle = Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
    let session = Row::Consumer.spec(8).run().unwrap();
    let renamed = with(&session.recording, |t| t, |v| circle * v);
    for method in [Method::Stepwise, Method::Joint] {
        let before = apply(&calibrated(&session.recording, method), &session.recording).unwrap();
        let after = apply(&calibrated(&renamed, method), &renamed).unwrap();
        for (name, before, after) in [
            ("m/s²", &before.accelerometer, &after.accelerometer),
            ("rad/s", &before.gyroscope, &after.gyroscope),
        ] {
            let (before, after) = (before.as_ref().unwrap(), after.as_ref().unwrap());
            let worst = before
                .values
                .iter()
                .zip(&after.values)
                .map(|(a, b)| (a.norm() - b.norm()).abs());
            let worst = worst.fold(0.0, f64::max);
            // A hundredth of what a consumer grade's biases are known to.
            assert!(worst < 1e-6, "{method:?}: {worst:e} {name}");
        }
    }
}
