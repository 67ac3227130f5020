use nalgebra::{UnitQuaternion, Vector3};
use sensor::{Axis, Sensor};

use super::*;
use crate::{Fault, Grade, Session, Spec};

const BOTH: [Sensor; 2] = [Sensor::Accelerometer, Sensor::Gyroscope];

/// One of each kind, on the gyroscope where there is a choice.
fn one_of_each() -> Vec<Hidden> {
    let (sensor, axis) = (Sensor::Gyroscope, Axis::Y);
    let amplitude = 1e-3;
    vec![
        Hidden::Periodic(Periodic {
            sensor,
            axis,
            amplitude,
            period: 40.0,
            phase: 0.3,
        }),
        Hidden::Pattern(Pattern {
            sensor,
            axis,
            amplitude,
            wavenumber: 7.0,
        }),
        Hidden::Telegraph(Telegraph {
            sensor,
            axis,
            amplitude,
            dwell: 20.0,
        }),
        Hidden::Heading(Heading {
            sensor,
            amplitude,
            azimuth: 0.8,
        }),
        Hidden::Relaxation(Relaxation {
            sensor,
            axis,
            amplitude,
            tau: 3.0,
        }),
        Hidden::Rezeroing(Rezeroing {
            sensor,
            amplitude,
            after: 3.0,
        }),
        Hidden::SizeEffect(SizeEffect { amplitude }),
        Hidden::WrongGravity { amplitude },
        Hidden::FastClock { amplitude },
    ]
}

/// A hand-held session without noise and base errors: what is left of the difference is the disturbance.
fn session(hidden: Option<&Hidden>) -> Session {
    let mut spec = Spec {
        grade: Grade::Perfect,
        ..Spec::hand_held(4)
    }
    .noise_free();
    spec.motion = crate::Motion::HandHeld(crate::HandHeld {
        placements: Some(5),
        initial_rest: Some(10.0),
        ..Default::default()
    });
    spec.hidden = hidden.cloned().into_iter().collect();
    spec.run().unwrap()
}

fn values(session: &Session, sensor: Sensor) -> &[Vector3<f64>] {
    &session.recording.stream(sensor).unwrap().values
}

/// What `hidden` adds to each sample.
fn added(hidden: &Hidden, sensor: Sensor) -> Vec<Vector3<f64>> {
    let (with, without) = (session(Some(hidden)), session(None));
    let pairs = values(&with, sensor).iter().zip(values(&without, sensor));
    pairs.map(|(a, b)| a - b).collect()
}

fn at_rest(time: f64, force: Vector3<f64>) -> Instant {
    Instant {
        time,
        force,
        rate: Vector3::zeros(),
        angular_acceleration: Vector3::zeros(),
        attitude: UnitQuaternion::identity(),
    }
}

#[test]
fn each_kind_disturbs_one_sensor_in_proportion_to_its_amplitude() {
    for hidden in &one_of_each()[..7] {
        let own = match hidden {
            Hidden::SizeEffect(_) => Sensor::Accelerometer,
            _ => Sensor::Gyroscope,
        };
        let twice = hidden.clone().with_amplitude(2.0 * hidden.amplitude());
        for sensor in BOTH {
            let (one, two) = (added(hidden, sensor), added(&twice, sensor));
            let largest = one.iter().map(|v| v.amax()).fold(0.0, f64::max);
            assert_eq!(largest > 0.0, sensor == own, "{} {largest}", hidden.name());
            // A few roundings of a reading of 10 to 20.
            let off = one.iter().zip(&two).map(|(a, b)| (b - a * 2.0).amax());
            assert!(off.fold(0.0, f64::max) < 2e-14, "{}", hidden.name());
        }
    }
}

#[test]
fn truth_says_what_was_hidden_and_what_was_drawn_for_it() {
    for hidden in one_of_each() {
        let truth = session(Some(&hidden)).truth;
        assert_eq!(truth.hidden.len(), 1);
        assert_eq!(truth.hidden[0].name, hidden.name());
        assert_eq!(truth.hidden[0].amplitude, 1e-3);
        assert_eq!(truth.spec.hidden, std::slice::from_ref(&hidden));
        let drawn = matches!(
            hidden,
            Hidden::Pattern(_)
                | Hidden::Telegraph(_)
                | Hidden::Relaxation(_)
                | Hidden::Rezeroing(_)
                | Hidden::SizeEffect(_)
        );
        assert_eq!(
            !truth.hidden[0].drawn.is_empty(),
            drawn,
            "{}",
            hidden.name()
        );
    }
}

#[test]
fn a_periodic_bias_is_the_sine_of_the_time() {
    let hidden = &one_of_each()[0];
    let (with, added) = (session(Some(hidden)), added(hidden, Sensor::Gyroscope));
    let t = &with.recording.gyroscope.unwrap().t;
    for (t, e) in t.iter().zip(added) {
        let expected = 1e-3 * (std::f64::consts::TAU * t / 40.0 + 0.3).sin();
        // In a turn the mean over a sample of 10 ms: (π 0.01/40)²/6 = 1e-7 of 1e-3.
        assert!((e - Vector3::y() * expected).norm() < 2e-10);
    }
}

#[test]
fn a_pattern_has_a_third_of_its_amplitude_over_the_sphere_and_changes_within_twenty_degrees() {
    let mut random = Random::new(8, Purpose::Motion);
    let Hidden::Pattern(pattern) = one_of_each()[1].clone() else {
        panic!()
    };
    let drawn = pattern.draw(&mut random);
    let error = |f: Vector3<f64>| drawn.error(&at_rest(0.0, f)).y / 1e-3;
    let n = 20_000;
    let (mut square, mut change) = (0.0, 0.0);
    for _ in 0..n {
        let (u, v) = (random.direction(), random.direction());
        let here = error(u * 9.8);
        square += here * here / f64::from(n);
        change += (error((u + v * 0.35) * 9.8) - here).powi(2) / f64::from(n);
    }
    // Three sines squared, each a half on average: 0.354, less where the three directions interfere.
    assert!((0.25..0.45).contains(&square.sqrt()), "{square}");
    // Independent values would differ by twice the variance.
    assert!(change > 0.7 * square, "{change} {square}");
}

#[test]
fn a_telegraph_has_two_values_and_changes_when_truth_says() {
    let hidden = &one_of_each()[2];
    let with = session(Some(hidden));
    let jumps = &with.truth.hidden[0].drawn["jumps"];
    assert!(!jumps.is_empty());
    let added = added(hidden, Sensor::Gyroscope);
    let t = &with.recording.gyroscope.as_ref().unwrap().t;
    for (t, e) in t.iter().zip(added) {
        let jumped = jumps.iter().filter(|jump| *jump < t).count();
        let near = jumps.iter().any(|jump| (jump - t).abs() < 0.02);
        let sign = if jumped % 2 == 0 { 1.0 } else { -1.0 };
        assert!(near || (e.y - 1e-3 * sign).abs() < 1e-14, "{t}");
    }
}

#[test]
fn a_heading_is_a_world_direction_seen_from_the_body() {
    let hidden = &one_of_each()[3];
    let (with, added) = (session(Some(hidden)), added(hidden, Sensor::Gyroscope));
    let t = &with.recording.gyroscope.as_ref().unwrap().t;
    for rest in &with.truth.static_intervals {
        let [w, x, y, z] = rest.attitude;
        let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        let h = q.inverse() * Vector3::new(0.8_f64.cos(), 0.8_f64.sin(), 0.0);
        let k = t.partition_point(|&t| t < 0.5 * (rest.start + rest.end));
        assert!((added[k] - h * 1e-3).norm() < 1e-14, "{}", rest.label);
        // Gravity has no part in it.
        let up = Vector3::from(rest.specific_force);
        assert!(added[k].dot(&up).abs() < 1e-13);
    }
}

#[test]
fn a_relaxation_starts_with_the_sign_of_the_turn_and_falls_to_a_third_in_tau() {
    let hidden = &one_of_each()[4];
    let (with, added) = (session(Some(hidden)), added(hidden, Sensor::Gyroscope));
    let t = &with.recording.gyroscope.as_ref().unwrap().t;
    let at = |time: f64| added[t.partition_point(|&t| t < time)].y;
    let rests = &with.truth.static_intervals;
    assert_eq!(at(0.5 * rests[0].end), 0.0);
    for pair in rests.windows(2) {
        let turn = pair[0].end..pair[1].start;
        let turned: f64 = t
            .iter()
            .zip(values(&with, Sensor::Gyroscope))
            .filter(|(t, _)| turn.contains(*t))
            .map(|(_, w)| w.y)
            .sum();
        let start = at(pair[1].start + 0.01);
        // Up to two samples after the end: 0.02/3 of it has decayed.
        assert!((start - 1e-3 * turned.signum()).abs() < 1e-5, "{start}");
        let ratio = at(pair[1].start + 3.01) / start;
        assert!((ratio - (-1.0_f64).exp()).abs() < 2e-3, "{ratio}");
    }
}

#[test]
fn a_zero_is_set_anew_three_seconds_into_each_rest_and_stays_through_the_turn() {
    let hidden = &one_of_each()[5];
    let (with, added) = (session(Some(hidden)), added(hidden, Sensor::Gyroscope));
    let t = &with.recording.gyroscope.as_ref().unwrap().t;
    let at = |time: f64| added[t.partition_point(|&t| t < time)];
    let rests = &with.truth.static_intervals;
    assert_eq!(at(0.5 * rests[0].end), Vector3::zeros());
    let mut before = Vector3::zeros();
    for rest in &rests[1..] {
        // Up to two samples after the jump.
        assert!((at(rest.start + 2.95) - before).norm() < 1e-14);
        let after = at(rest.start + 3.03);
        assert!((after - before).norm() > 1e-4, "{after}");
        before = after;
    }
}

#[test]
fn the_size_effect_is_the_centripetal_acceleration_of_each_axis_where_it_sits() {
    let drawn = SizeEffect { amplitude: 0.01 }.draw(&mut Random::new(1, Purpose::Motion));
    let arms = drawn.drawn();
    let turning = Instant {
        rate: Vector3::new(0.0, 0.0, 5.0),
        ..at_rest(0.0, Vector3::z())
    };
    let expected = Vector3::new(-25.0 * arms["arm_x"][0], -25.0 * arms["arm_y"][1], 0.0);
    assert!((drawn.error(&turning) - expected).norm() < 1e-15);
    assert_eq!(drawn.error(&at_rest(1.0, Vector3::x())), Vector3::zeros());
}

#[test]
fn wrong_gravity_is_in_every_rest_and_not_in_what_is_told() {
    let with = session(Some(&Hidden::WrongGravity { amplitude: 2e-3 }));
    let first = values(&with, Sensor::Accelerometer)[0].norm();
    assert!((first / 9.80665 - 1.002).abs() < 1e-14);
    assert_eq!(with.truth.spec.gravity, 9.80665);
}

#[test]
fn a_fast_clock_stretches_the_stamps_and_leaves_the_readings() {
    let hidden = Hidden::FastClock { amplitude: 1e-3 };
    let (with, without) = (session(Some(&hidden)), session(None));
    for sensor in BOTH {
        assert_eq!(values(&with, sensor), values(&without, sensor));
    }
    let last = |s: &Session| *s.recording.gyroscope.as_ref().unwrap().t.last().unwrap();
    assert!((last(&with) / last(&without) - 1.001).abs() < 1e-14);
}

#[test]
fn lost_samples_leave_no_gap_in_the_stamps() {
    let spec = Spec::hand_held(4);
    let whole = spec.run().unwrap();
    let lost = spec.with_fault(Fault::Lost {
        turn: 2,
        length: 0.1,
    });
    let short = lost.run().unwrap();
    for sensor in BOTH {
        let (all, left) = (values(&whole, sensor), values(&short, sensor));
        assert_eq!(all.len() - left.len(), 10);
        // Nothing is missing but ten samples in a row, all within the turn.
        let first = all.iter().zip(left).position(|(a, b)| a != b).unwrap();
        assert_eq!(all[first + 10..], left[first..]);
        let rests = &whole.truth.static_intervals;
        let time = 0.01 * first as f64;
        assert!((rests[2].end..rests[3].start).contains(&time));
    }
    let t = &short.recording.gyroscope.unwrap().t;
    assert!(t.windows(2).all(|w| (w[1] - w[0] - 0.01).abs() < 1e-9));
}

#[test]
fn hidden_disturbances_survive_toml_and_say_what_is_wrong_with_them() {
    let mut spec = Spec::hand_held(2);
    spec.hidden = one_of_each();
    let text = spec.to_toml().unwrap();
    assert_eq!(Spec::from_toml(&text, "a.toml").unwrap(), spec);
    let refused = |text: &str| Spec::from_toml(text, "a.toml").unwrap_err().to_string();
    let message = refused("[[hidden]]\nheading = { sensor = \"gyroscop\", amplitude = 1.0 }\n");
    assert!(message.starts_with("a.toml:2:22: "), "{message}");
    assert!(message.ends_with("did you mean `gyroscope`?"), "{message}");
    let message = refused("[[hidden]]\nwrong_gravity = { amplitude = 7.0 }\n");
    let place = "a.toml:2:19: hidden.0.wrong_gravity.amplitude: is 7";
    assert!(message.starts_with(place), "{message}");
    let lost = "[[faults]]\nlost = { turn = 900, length = 0.1 }\n";
    let error = Spec::from_toml(lost, "a").unwrap().run().unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with("faults.0.turn: is 900, but"),
        "{message}"
    );
}
