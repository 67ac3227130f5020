//! Simulated sessions as an estimator sees them, against the truth they come with.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use calib::simulate::{Grade, Session, Spec, StaticInterval};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use sensor::{Kinematics, Model, Sensor};

fn samples(session: &Session, sensor: Sensor) -> (&[f64], &[Vector3<f64>]) {
    let stream = match sensor {
        Sensor::Accelerometer => session.recording.accelerometer.as_ref().unwrap(),
        Sensor::Gyroscope => session.recording.gyroscope.as_ref().unwrap(),
    };
    (&stream.t, &stream.values)
}

/// Readings that lie within an interval, a step away from its ends.
fn at_rest(session: &Session, sensor: Sensor, rest: &StaticInterval) -> Vec<Vector3<f64>> {
    let (t, values) = samples(session, sensor);
    let inside = |t: f64| t > rest.start + 0.011 && t < rest.end - 0.011;
    t.iter()
        .zip(values)
        .filter(|(t, _)| inside(**t))
        .map(|(_, v)| *v)
        .collect()
}

fn correct(session: &Session, sensor: Sensor, raw: &Vector3<f64>) -> Vector3<f64> {
    let parameters = session.truth.parameters(sensor).values();
    Model::base(sensor).correct(raw, &Kinematics::at_rest(Vector3::zeros()), parameters)
}

#[test]
fn without_noise_the_true_parameters_correct_every_rest_to_gravity_and_no_rate() {
    let session = Spec::hand_held(1).noise_free().run().unwrap();
    for rest in &session.truth.static_intervals {
        for raw in at_rest(&session, Sensor::Accelerometer, rest) {
            let f = correct(&session, Sensor::Accelerometer, &raw);
            assert!((f.norm() - 9.80665).abs() < 1e-13);
            assert!((f - Vector3::from(rest.specific_force)).norm() < 1e-13);
        }
        for raw in at_rest(&session, Sensor::Gyroscope, rest) {
            assert!(correct(&session, Sensor::Gyroscope, &raw).norm() < 1e-16);
        }
    }
}

#[test]
fn specific_force_at_rest_is_plus_g_on_the_axis_that_points_up() {
    let session = Spec {
        grade: Grade::Perfect,
        ..Spec::still(1, 1.0)
    }
    .run()
    .unwrap();
    let (_, values) = samples(&session, Sensor::Accelerometer);
    assert!(
        values
            .iter()
            .all(|v| (v - Vector3::z() * 9.80665).norm() < 1e-15)
    );
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    let spec = Spec::hand_held(3).with_effect("gyro_g_sensitivity", 1.0);
    let (one, two) = (spec.run().unwrap(), spec.run().unwrap());
    assert_eq!(one.recording.accelerometer, two.recording.accelerometer);
    assert_eq!(one.recording.gyroscope, two.recording.gyroscope);
    assert_eq!(one.truth, two.truth);
    let other = std::thread::spawn(move || spec.run().unwrap())
        .join()
        .unwrap();
    assert_eq!(one.recording.gyroscope, other.recording.gyroscope);
    let third = Spec::hand_held(4).run().unwrap();
    assert_ne!(one.recording.gyroscope, third.recording.gyroscope);
}

#[test]
fn a_session_looks_like_a_session() {
    for seed in 0..5 {
        let session = Spec::hand_held(seed).run().unwrap();
        let rests = &session.truth.static_intervals;
        assert!((26..=40).contains(&rests.len()));
        assert!((50.0..=120.0).contains(&(rests[0].end - rests[0].start)));
        assert!(
            rests[1..]
                .iter()
                .all(|r| (6.0..=8.0).contains(&(r.end - r.start)))
        );
        let turns = rests.windows(2).map(|w| w[1].start - w[0].end);
        assert!(turns.into_iter().all(|t| (2.0..=4.0).contains(&t)));
        let up = |r: &StaticInterval| Vector3::from(r.specific_force);
        assert!(up(&rests[0]).angle(&up(&rests[rests.len() - 1])) < 0.4);
    }
}

/// Integrates window means over a turn: `exp(ΔΘ_k)` with the coning term `½·(1/6)(θ_{k−1} × θ_k)`.
fn turned_by_means(rates: &[Vector3<f64>], step: f64) -> UnitQuaternion<f64> {
    let mut attitude = UnitQuaternion::identity();
    let mut before = Vector3::zeros();
    for rate in rates {
        let angle = rate * step;
        attitude *= UnitQuaternion::from_scaled_axis(angle + before.cross(&angle) / 12.0);
        before = angle;
    }
    attitude
}

#[test]
fn corrected_rates_carry_gravity_from_one_rest_to_the_next() {
    let session = Spec::hand_held(2).noise_free().run().unwrap();
    let (t, values) = samples(&session, Sensor::Gyroscope);
    for pair in session.truth.static_intervals.windows(2) {
        let inside = |t: f64| t > pair[0].end - 0.1 && t < pair[1].start + 0.1;
        let chosen = t.iter().zip(values).filter(|(t, _)| inside(**t));
        let rates: Vec<_> = chosen
            .map(|(_, v)| correct(&session, Sensor::Gyroscope, v))
            .collect();
        let turned = turned_by_means(&rates, 0.01);
        let at = |r: &StaticInterval| {
            let [w, x, y, z] = r.attitude;
            UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
        };
        let error = (at(&pair[0]) * turned).angle_to(&at(&pair[1]));
        // Third-order coning at 100 Hz under a 10 Hz tremor of 0.1 rad/s.
        assert!(error < 1e-6, "{error}");
    }
}
