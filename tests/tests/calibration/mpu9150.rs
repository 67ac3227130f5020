//! A five-dollar sensor in the hand: both methods on recordings whose rests all shake.

use calib::Recording;
use calib::calibrate::{Method, Outcome, Request, calibrate};
use calib::recording::ReadOptions;
use stillpoint_tests::needed_data::needed;

fn calibrated(name: &str, method: Method) -> Option<Outcome> {
    let path = needed(&format!("mpu9150/{name}"))?;
    let recording = Recording::read(&path, &ReadOptions::default()).unwrap();
    let request = Request {
        method,
        ..Request::default()
    };
    Some(calibrate(&[recording], &[], &request).unwrap())
}

#[test]
fn rests_that_all_shake_are_weighted_not_thrown_away() {
    let Some(joint) = calibrated("imu0.csv", Method::Joint) else {
        return;
    };
    let stepwise = calibrated("imu0.csv", Method::Stepwise).unwrap();
    let unsteady = |w: &String| w.contains("shake") || w.contains("noisier in static intervals");
    assert!(
        joint
            .calibration
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(unsteady)
    );
    let (joint, stepwise) = (joint.calibration, stepwise.calibration);
    let (a, b) = (
        joint.accelerometer.unwrap(),
        stepwise.accelerometer.unwrap(),
    );
    assert_eq!(a.rank, 9);
    for axis in 0..3 {
        // Another tool's bias of this recording (the data's README), mm/s² where both agree.
        let other = [0.1029, 0.0970, 0.3446][axis];
        assert!((a.bias[axis].abs() - other).abs() < 0.02, "{:?}", a.bias);
        assert!((a.bias[axis] - b.bias[axis]).abs() < 0.01);
    }
}
