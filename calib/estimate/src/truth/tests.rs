//! The truth against the simulator's, on noise-free data.

use recording::intervals::Span;
use simulate::{Session, Simulation, Spec, Vibration};

use super::*;

/// A noise-free session of a perfect device whose placements are known, with the simulator's truth.
fn session() -> (Simulation, Session, Segmentation) {
    let mut spec = Spec::hand_held(5).noise_free();
    spec.grade = simulate::Grade::Perfect;
    spec.temperature = Some(simulate::Temperature {
        noise: 0.0,
        ..simulate::Temperature::default()
    });
    let simulation = Simulation::new(&spec).unwrap();
    let session = simulation.run().unwrap();
    let spans: Vec<Span> = simulation
        .placements()
        .into_iter()
        .map(|(from, to)| Span { from, to })
        .collect();
    let intervals = Segmentation::from_spans(&session.recording, &spans, 10.0);
    (simulation, session, intervals)
}

fn perfect() -> Models {
    Models {
        accelerometer: Some(Sensing::first(
            accelerometer::model(),
            crate::truth::RawUnit::SI,
        )),
        gyroscope: Some(Sensing::first(
            gyroscope::model(),
            crate::truth::RawUnit::SI,
        )),
        ..Models::default()
    }
}

#[test]
fn on_data_without_noise_the_truth_is_that_of_the_simulator() {
    let (simulation, session, intervals) = session();
    let truth = Truth::as_far_as_known(&session.recording, Some(&intervals), perfect());
    let heading = |a: &Attitude<f64>, first: &Attitude<f64>| {
        // The simulator's heading is against north, that of the truth against the first placement's own.
        let east = |b: &Attitude<f64>| b.into_reference(&Vector3::x());
        (east(a), east(first))
    };
    let mut worst = [0.0_f64; 5];
    for (k, rest) in intervals.statics.iter().enumerate() {
        let own = simulation.kinematics(0.5 * (rest.span.from + rest.span.to));
        let found = truth.at_rest(k);
        assert_eq!(found.last_change, own.last_change, "interval {k}");
        // The device warms up all the time.
        assert_eq!(found.warming, own.warming, "interval {k}");
        let off = found.temperature_rate - own.temperature_rate;
        assert!(off.abs() < 1e-3, "interval {k}: {off}");
        // A turn fades out: its last rotation is below what counts as turning.
        let off = (found.last_turn - own.last_turn).norm();
        assert!(off < 0.01, "interval {k}: {off}");
        let off = found.since_turn.middle() - own.since_turn.middle();
        assert!(k == 0 || (0.0..0.4).contains(&off), "interval {k}: {off}");
        // (10 µm/s²)²: rounding and the ends of turns leave up to (1.5 µm/s²)².
        let off = (found.vibration - own.vibration).amax();
        assert!(off < 1e-10, "interval {k}: {off:e}");
        worst[0] = worst[0].max((found.specific_force - own.specific_force).norm());
        worst[1] = worst[1].max((found.temperature - own.temperature).abs());
        let up = |a: &Attitude<f64>| a.into_body(&Vector3::z());
        worst[2] = worst[2].max((up(&found.attitude) - up(&own.attitude)).norm());
        let turned = |of: &dyn Fn(usize) -> Attitude<f64>| {
            let (now, first) = heading(&of(k), &of(0));
            let angle = |v: Vector3<f64>| v.y.atan2(v.x);
            angle(now) - angle(first)
        };
        let own_at = |j: usize| {
            let span = intervals.statics[j].span;
            simulation.kinematics(0.5 * (span.from + span.to)).attitude
        };
        let difference = turned(&|j| truth.at_rest(j).attitude) - turned(&own_at);
        let level = found.attitude.into_reference(&Vector3::x()).z.abs() < 0.9;
        if level {
            worst[3] = worst[3].max((difference.sin()).abs());
        }
    }
    // Means over windows of 10 ms against values at their middles; the heading adds up over twenty-odd turns.
    // The last window of an interval may reach into a turn that begins: a tenth of a µg is nothing.
    assert!(worst[0] < 1e-6, "{worst:?}");
    // The device warms by .044 K/s and the thermometer reads once a second: its mean is off by a second of that.
    assert!(worst[1] < 0.06, "{worst:?}");
    assert!(worst[2] < 1e-9, "{worst:?}");
    assert!(worst[3] < 5e-3, "{worst:?}");
}

#[test]
fn in_turns_signals_and_their_derivatives_follow_the_motion() {
    let (simulation, session, intervals) = session();
    let truth = Truth::as_far_as_known(&session.recording, Some(&intervals), perfect());
    let stream = session.recording.gyroscope.as_ref().unwrap();
    let (mut squares, mut errors) = ([0.0; 3], [0.0; 3]);
    for turn in &intervals.turns {
        for k in turn.samples.clone().skip(5).step_by(3) {
            let t = stream.t[k];
            let (own, found) = (simulation.kinematics(t), truth.at(t));
            assert_eq!(found.last_change, own.last_change);
            assert_eq!(found.vibration, own.vibration);
            let pairs = [
                (found.specific_force, own.specific_force),
                (found.angular_rate, own.angular_rate),
                (found.angular_acceleration, own.angular_acceleration),
            ];
            for (place, (found, own)) in pairs.into_iter().enumerate() {
                squares[place] += own.norm_squared();
                errors[place] += (found - own).norm_squared();
            }
        }
    }
    let share: Vec<f64> = (0..3).map(|k| (errors[k] / squares[k]).sqrt()).collect();
    // Slopes over five samples of 10 ms: knocks are shorter than that and hold little of the sum.
    assert!(
        share[0] < 0.02 && share[1] < 0.02 && share[2] < 0.3,
        "{share:?}"
    );
}

#[test]
fn vibration_is_what_an_interval_has_beyond_the_quietest() {
    let mut spec = Spec::hand_held(3);
    spec.vibration = Some(Vibration::default());
    let simulation = Simulation::new(&spec).unwrap();
    let session = simulation.run().unwrap();
    let inside = |(from, to): (f64, f64)| Span {
        from: from + 0.1,
        to: to - 0.1,
    };
    let spans: Vec<Span> = simulation.placements().into_iter().map(inside).collect();
    let intervals = Segmentation::from_spans(&session.recording, &spans, 10.0);
    let truth = Truth::as_far_as_known(&session.recording, Some(&intervals), perfect());
    let (mut sum, mut of) = (0.0, 0.0);
    for (k, rest) in intervals.statics.iter().enumerate() {
        let own = simulation.kinematics(rest.span.from).vibration;
        let found = truth.at_rest(k).vibration;
        // A variance of 500 samples is known to 6 %.
        assert!(
            (found - own).amax() < 0.3 * own.amax() + 1e-3,
            "interval {k}"
        );
        (sum, of) = (sum + found.sum(), of + own.sum());
    }
    assert!((sum / of - 1.0).abs() < 0.05, "{}", sum / of);
}

#[test]
fn what_cannot_be_known_is_refused_with_effect_and_quantity() {
    let session = Spec::hand_held(1).run().unwrap();
    let mut models = perfect();
    let named = |name: &str| crate::calibration::effect_named(name).unwrap();
    let with = |models: &mut Models, name: &str| {
        let sensing = match named(name).sensor() {
            Sensor::Accelerometer => models.accelerometer.as_mut(),
            Sensor::Gyroscope => models.gyroscope.as_mut(),
            Sensor::Magnetometer => models.magnetometer.as_mut(),
        };
        let sensing = sensing.unwrap();
        sensing.model = sensing.model.clone().with(named(name));
        sensing.parameters = sensing.model.parameters().values().to_vec();
    };
    with(&mut models, "accel_hysteresis");
    let refused = Truth::of(&session.recording, None, models).unwrap_err();
    let message = refused.to_string();
    assert!(matches!(refused, Error::NotEnough(_)));
    assert!(message.contains("accel_hysteresis"), "{message}");
    assert!(message.contains("sign of the last change"), "{message}");
    let mut models = perfect();
    with(&mut models, "gyro_temperature");
    let message = Truth::of(&session.recording, None, models).unwrap_err();
    assert!(
        message
            .to_string()
            .contains("gyro_temperature needs the temperature"),
        "{message}"
    );
}
