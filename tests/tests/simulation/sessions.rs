//! Simulated sessions as an estimator sees them, against the truth they come with.

use calib::effects::catalogue_of;
use calib::recording::intervals::{Detector, segment};
use calib::simulate::{Fault, Grade, HandHeld, Motion, Session, Spec, StaticInterval, Vibration};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use sensor::{Kinematics, Model, Quantity, Sensor};

fn samples(session: &Session, sensor: Sensor) -> (&[f64], &[Vector3<f64>]) {
    let stream = session.recording.stream(sensor).unwrap();
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

#[test]
fn every_effect_of_the_catalogue_changes_the_session_it_is_in() {
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for effect in catalogue_of(sensor) {
            let name = effect.name();
            let mut with = Spec::hand_held(5).noise_free().with_effect(name, 1.0);
            let motion = HandHeld {
                placements: Some(8),
                initial_rest: Some(20.0),
                ..HandHeld::default()
            };
            with.motion = Motion::HandHeld(motion);
            let mut without = with.clone();
            without.effects.clear();
            without.latitude = None;
            let (with, without) = (with.run().unwrap(), without.run().unwrap());
            assert_eq!(with.truth.effects, [name]);
            assert!(without.truth.effects.is_empty());
            let changed = |sensor| samples(&with, sensor) != samples(&without, sensor);
            assert_eq!(
                changed(Sensor::Accelerometer),
                sensor == Sensor::Accelerometer,
                "{name}"
            );
            assert_eq!(
                changed(Sensor::Gyroscope),
                sensor == Sensor::Gyroscope,
                "{name}"
            );
        }
    }
}

#[test]
fn the_model_with_the_true_parameters_explains_every_effect_at_rest() {
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for effect in catalogue_of(sensor) {
            let name = effect.name();
            // What turned before is tested with what is known of an instant.
            if effect.needs().contains(&Quantity::LastTurn) {
                continue;
            }
            let mut spec = Spec::hand_held(6).noise_free().with_effect(name, 3.0);
            // Vibration is noise of its own here: what it shifts is tested with the effect.
            spec.vibration = spec.vibration.map(|_| Vibration {
                rms: 1e-10,
                share: 1.0,
                ..Vibration::default()
            });
            let session = spec.run().unwrap();
            let model = Model::base(sensor).with(effect.clone());
            let p = session.truth.parameters(sensor).values();
            let mut sign = Vector3::zeros();
            let mut before: Option<Vector3<f64>> = None;
            for rest in &session.truth.static_intervals {
                let f = Vector3::from(rest.specific_force);
                sign = before.map_or(sign, |b| calib::covariates::last_change(&sign, &b, &f));
                before = Some(f);
                let [w, x, y, z] = rest.attitude;
                let (t, values) = samples(&session, sensor);
                let k = t.partition_point(|&t| t < 0.5 * (rest.start + rest.end));
                let rate = spec.temperature.as_ref().map_or(0.0, |c| c.rate_at(t[k]));
                let truth = Kinematics {
                    temperature_rate: rate,
                    warming: if rate == 0.0 { 0.0 } else { rate.signum() },
                    time: t[k],
                    temperature: spec.temperature.as_ref().map_or(25.0, |c| c.at(t[k])),
                    last_change: sign,
                    attitude: sensor::attitude::Attitude {
                        w,
                        v: Vector3::new(x, y, z),
                    },
                    ..Kinematics::at_rest(f)
                };
                let corrected = model.correct(&values[k], &truth, p);
                let off = (corrected - truth.signal(sensor)).norm();
                assert!(off < 1e-9, "{name} {}: {off}", rest.label);
            }
        }
    }
}

#[test]
fn vibration_shakes_the_readings_and_the_effect_rectifies_it() {
    let with = Spec::hand_held(7)
        .noise_free()
        .with_effect("accel_vibration_rectification", 1.0);
    let mut without = with.clone();
    without.effects.clear();
    let (with, without) = (with.run().unwrap(), without.run().unwrap());
    let p = with.truth.accelerometer.values();
    let mut shaken = 0;
    for rest in &with.truth.static_intervals {
        let rms = Vector3::from(rest.vibration);
        let shift = Vector3::from_column_slice(&p[12..15])
            .component_mul(&rms)
            .component_mul(&rms);
        let one = at_rest(&with, Sensor::Accelerometer, rest);
        let other = at_rest(&without, Sensor::Accelerometer, rest);
        let mean: Vector3<f64> = other.iter().sum::<Vector3<f64>>() / other.len() as f64;
        let square: Vector3<f64> = other
            .iter()
            .map(|v| (v - mean).component_mul(&(v - mean)))
            .sum::<Vector3<f64>>()
            / other.len() as f64;
        // Some 600 samples: a standard error of 3 % of the root mean square.
        assert!((square.map(f64::sqrt) - rms).amax() < 0.12 * rms.amax() + 1e-12);
        for (a, b) in one.iter().zip(&other) {
            let difference =
                correct(&with, Sensor::Accelerometer, a) - correct(&with, Sensor::Accelerometer, b);
            assert!((difference - shift).norm() < 1e-13);
        }
        shaken += usize::from(rms.amax() > 0.1);
    }
    assert!(shaken > 5);
}

#[test]
fn raw_counts_are_corrected_by_the_truth_in_counts() {
    let mut spec = Spec::hand_held(8).noise_free();
    spec.accelerometer.counts = true;
    spec.accelerometer.step = 1e-3;
    let session = spec.run().unwrap();
    let (_, values) = samples(&session, Sensor::Accelerometer);
    assert!(values.iter().all(|v| {
        v.iter()
            .all(|c| c.fract() == 0.0 && (0.0..65536.0).contains(c))
    }));
    for rest in &session.truth.static_intervals {
        for raw in at_rest(&session, Sensor::Accelerometer, rest) {
            let f = correct(&session, Sensor::Accelerometer, &raw);
            // Half a count per axis.
            assert!((f - Vector3::from(rest.specific_force)).amax() < 0.6e-3);
        }
    }
}

#[test]
fn a_late_accelerometer_clock_and_the_effect_time_offset_are_the_same() {
    let mut clock = Spec::hand_held(4);
    clock.accelerometer.clock.offset = 0.013;
    let mut effect = Spec::hand_held(4);
    effect
        .effects
        .insert("time_offset".into(), [("d".into(), 0.013)].into());
    let (clock, effect) = (clock.run().unwrap(), effect.run().unwrap());
    assert_eq!(
        clock.recording.accelerometer,
        effect.recording.accelerometer
    );
    assert_eq!(effect.truth.get("time_offset.d"), Some(0.013));
    let (late, _) = samples(&clock, Sensor::Accelerometer);
    let (own, _) = samples(&clock, Sensor::Gyroscope);
    assert!((late[100] - own[100] - 0.013).abs() < 1e-12);
}

#[test]
fn axes_that_are_a_sample_late_read_what_they_read_a_sample_before() {
    let mut late = Spec::hand_held(4).noise_free();
    let delay = [("x", 0.01), ("y", 0.0), ("z", 0.01)].map(|(k, v)| (k.to_string(), v));
    late.effects.insert("gyro_delay".into(), delay.into());
    let (late, own) = (
        late.run().unwrap(),
        Spec::hand_held(4).noise_free().run().unwrap(),
    );
    let (_, late) = samples(&late, Sensor::Gyroscope);
    let (_, own) = samples(&own, Sensor::Gyroscope);
    for (a, b) in late.windows(2).zip(own.windows(2)) {
        // Windows that differ by rounding, under an angular acceleration of 50 rad/s².
        assert!((a[1].x - b[0].x).abs() < 1e-11 && (a[1].z - b[0].z).abs() < 1e-11);
        assert!((a[1].y - b[1].y).abs() < 1e-11);
    }
}

#[test]
fn sensors_with_clocks_of_their_own_sample_at_their_own_rates() {
    let mut spec = Spec::still(1, 100.0);
    spec.accelerometer.clock.rate = Some(99.75);
    spec.gyroscope.clock.rate = Some(200.0);
    spec.gyroscope.clock.phase = 0.0013;
    let session = spec.run().unwrap();
    let (t, _) = samples(&session, Sensor::Accelerometer);
    assert_eq!(t.len(), 9976);
    let (t, values) = samples(&session, Sensor::Gyroscope);
    assert_eq!((t.len(), t[0]), (20_000, 0.0013));
    // The density is the same at any rate: so is the standard deviation of a sample over √rate.
    let mean = values.iter().sum::<Vector3<f64>>() / t.len() as f64;
    let square: f64 = values.iter().map(|v| (v - mean).norm_squared()).sum();
    let sigma = (square / (3 * t.len()) as f64).sqrt();
    assert!((sigma / (1e-4 * 200.0_f64.sqrt()) - 1.0).abs() < 0.02);
}

#[test]
fn faults_are_in_the_data_and_in_the_truth() {
    let mut spec = Spec::hand_held(12).noise_free();
    spec.faults = vec![
        Fault::Slip {
            interval: 3,
            angle: 2e-3,
        },
        Fault::Touch {
            interval: 5,
            size: 0.5,
        },
        Fault::Disturbed {
            interval: 7,
            size: 0.02,
        },
        Fault::Gap {
            start: 10.0,
            length: 1.4,
        },
    ];
    let session = spec.run().unwrap();
    let rests = &session.truth.static_intervals;
    let named: Vec<_> = (0..rests.len())
        .filter(|&k| !rests[k].faults.is_empty())
        .collect();
    assert_eq!(named, [3, 5, 7]);
    assert_eq!(rests[3].faults, ["mount_slip"]);
    // Slip: the mean rate over the placement is the angle over its length.
    let rates = at_rest(&session, Sensor::Gyroscope, &rests[3]);
    let sum: Vector3<f64> = rates
        .iter()
        .map(|w| correct(&session, Sensor::Gyroscope, w))
        .sum();
    assert!((sum.norm() * 0.01 - 2e-3).abs() < 1e-9);
    let norm = |k: usize| {
        let forces = at_rest(&session, Sensor::Accelerometer, &rests[k]);
        let corrected = forces
            .iter()
            .map(|f| correct(&session, Sensor::Accelerometer, f).norm());
        corrected.map(|f| (f - 9.80665).abs()).fold(0.0, f64::max)
    };
    // A slip keeps the norm up to the centripetal part; a touch and a push do not.
    assert!(norm(3) < 1e-4 && norm(5) > 1e-3 && norm(7) > 1e-4 && norm(8) < 1e-13);
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let (t, _) = samples(&session, sensor);
        let gaps = t
            .windows(2)
            .filter(|w| w[1] - w[0] > 0.015)
            .map(|w| w[1] - w[0]);
        let gaps: Vec<_> = gaps.collect();
        assert!(gaps.len() == 1 && (gaps[0] - 1.41).abs() < 1e-9, "{gaps:?}");
    }
}

#[test]
fn readings_saturate_at_the_range() {
    let mut spec = Spec::hand_held(13);
    spec.gyroscope.range = Some(1.0);
    let session = spec.run().unwrap();
    let (_, values) = samples(&session, Sensor::Gyroscope);
    let most = values.iter().map(|v| v.amax()).fold(0.0, f64::max);
    assert_eq!(most, 1.0);
    assert!(values.iter().filter(|v| v.amax() == 1.0).count() > 100);
}

#[test]
fn the_drift_in_the_truth_is_what_the_readings_drifted_by() {
    let mut spec = Spec::hand_held(14).noise_free();
    spec.accelerometer.random_walk = 1e-3;
    spec.gyroscope.instability = 1e-3;
    let session = spec.run().unwrap();
    let still = Spec::hand_held(14).noise_free().run().unwrap();
    let rests = &session.truth.static_intervals;
    for rest in rests {
        for (sensor, drift) in [
            (Sensor::Accelerometer, rest.accelerometer_drift),
            (Sensor::Gyroscope, rest.gyroscope_drift),
        ] {
            let inside = |t: f64| t >= rest.start && t < rest.end;
            let mean = |session: &Session| {
                let (t, values) = samples(session, sensor);
                let chosen: Vec<_> = t
                    .iter()
                    .zip(values)
                    .filter(|(t, _)| inside(**t))
                    .map(|(_, v)| *v)
                    .collect();
                chosen.iter().sum::<Vector3<f64>>() / chosen.len() as f64
            };
            let difference = mean(&session) - mean(&still);
            // Rounding of a sum of 1e4 numbers of size 10.
            let off = (difference - Vector3::from(drift)).norm();
            assert!(off < 1e-11, "{off}");
        }
    }
    assert!(Vector3::from(rests[9].accelerometer_drift).norm() > 1e-4);
}

#[test]
fn carts_and_walkers_cover_their_distance() {
    for motion in [
        "cart = {}",
        "walking = {}",
        "cart = { along = [0.0, 0.0, -1.0] }",
    ] {
        let spec = Spec::from_toml(&format!("[motion]\n{motion}"), "a.toml").unwrap();
        let spec = Spec {
            grade: Grade::Perfect,
            ..spec
        };
        let session = spec.run().unwrap();
        let rests = &session.truth.static_intervals;
        // Strapdown by the mid-point rule on window means, with the true attitude of the begin.
        let [w, x, y, z] = rests[0].attitude;
        let mut attitude = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        let (mut velocity, mut position) = (Vector3::zeros(), Vector3::zeros());
        let (t, force) = samples(&session, Sensor::Accelerometer);
        let (_, rate) = samples(&session, Sensor::Gyroscope);
        for ((_, f), w) in t
            .iter()
            .zip(force)
            .zip(rate)
            .skip_while(|((t, _), _)| **t < rests[0].end - 1.0)
        {
            let half = UnitQuaternion::from_scaled_axis(w * 0.005);
            let a = attitude * half * f - Vector3::z() * 9.80665;
            attitude = attitude * half * half;
            position += velocity * 0.01 + a * 5e-5;
            velocity += a * 0.01;
        }
        // Sculling within 10 ms under bobbing of 20 mm and rattling of 25 Hz.
        assert!(
            (position.norm() - 4.095).abs() < 2e-3,
            "{motion}: {position}"
        );
        assert!(velocity.norm() < 1e-3);
    }
}

#[test]
fn odd_requests_give_odd_recordings_and_no_panic() {
    for (text, samples_wanted) in [
        ("rate = 0.01\nmotion.still = { duration = 0.1 }", 1),
        ("motion.still = { duration = 0.1, up = [0, 0, -1] }", 11),
        (
            "motion.still = { duration = 0.1 }\naccelerometer.clock.phase = 5.0",
            0,
        ),
        (
            "motion.still = { duration = 1.0 }\n[[faults]]\ngap = { start = 0.0, length = 9.0 }",
            0,
        ),
        (
            "[motion.hand_held]\nplacements = 2\ninitial_rest = 1.0\nrest = [0.1, 0.1]\nturn = [0.5, 0.5]\nshock = 500.0\ncoplanar = true",
            161,
        ),
        (
            "[motion.walking]\nbob = 0.0\ncadence = 0.0\nduration = 1.0\nrest = 1.0",
            701,
        ),
        (
            "motion.still = { duration = 1.0 }\ngyroscope = { counts = true, step = 1e-9 }",
            101,
        ),
    ] {
        let session = Spec::from_toml(text, "a.toml").unwrap().run().unwrap();
        let (t, values) = samples(&session, Sensor::Accelerometer);
        assert_eq!(t.len(), samples_wanted, "{text}");
        assert!(values.iter().all(|v| v.iter().all(|c| c.is_finite())));
        assert!(t.windows(2).all(|w| w[0] < w[1]));
    }
}

/// Turns begin and end slowly, and the detector's window sees them before: of a rest of 3.3 s three quarters of a second may go.
#[test]
fn every_rest_of_a_little_over_three_seconds_is_found() {
    for seed in 0..4 {
        let mut spec = Spec::hand_held(seed);
        spec.motion = Motion::HandHeld(HandHeld {
            rest: [3.3, 3.6],
            ..HandHeld::default()
        });
        let session = spec.run().unwrap();
        let found = segment(&session.recording, &Detector::default()).unwrap();
        let truth = &session.truth.static_intervals;
        assert_eq!(found.statics.len(), truth.len(), "{seed}");
    }
}
