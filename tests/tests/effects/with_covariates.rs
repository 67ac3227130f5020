//! Effects that ask for more than the two signals, in recordings that were simulated with them.

use calib::calibrate::{Method, Outcome, Request, calibrate};
use calib::calibration::effect_named;
use calib::intervals::Span;
use calib::simulate::{EARTH_RATE, Session, Spec};

fn calibrated(session: &Session, method: Method, effect: &str) -> Outcome {
    // The true rests, whatever the detector makes of them.
    let rests = session.truth.static_intervals.iter().map(|rest| Span {
        from: rest.start + 0.3,
        to: rest.end - 0.3,
    });
    let request = Request {
        method,
        gravity: session.truth.spec.gravity,
        effects: vec![effect_named(effect).unwrap()],
        sections: vec![rests.collect()],
        ..Request::default()
    };
    calibrate(std::slice::from_ref(&session.recording), &[], &request).unwrap()
}

/// Estimate, truth and standard error of a parameter; no error of one that others are counted from.
fn of(outcome: &Outcome, session: &Session, effect: &str, axis: &str) -> (f64, f64, f64) {
    let effects = &outcome.calibration.effects;
    let found = effects.iter().find(|e| e.name == effect).unwrap();
    let found = found.parameters.iter().find(|p| p.name == axis).unwrap();
    let truth = session.truth.get(&format!("{effect}.{axis}")).unwrap();
    (found.value, truth, found.std.unwrap_or(0.0))
}

#[test]
fn an_effect_that_needs_history_comes_back_by_both_methods() {
    let effect = "accel_hysteresis";
    let session = Spec::hand_held(11).with_effect(effect, 3.0).run().unwrap();
    for method in [Method::Joint, Method::Stepwise] {
        let outcome = calibrated(&session, method, effect);
        let mut seen = 0;
        for axis in ["x", "y", "z"] {
            let (value, truth, std) = of(&outcome, &session, effect, axis);
            // Of six such errors one is beyond 4.5 σ in 25 000 sessions; the seed is fixed.
            assert!(
                (value - truth).abs() < 4.5 * std,
                "{effect} {axis} {method:?}: {value} {truth} {std}"
            );
            seen += usize::from(value.abs() > 3.0 * std);
        }
        assert!(seen > 0, "{effect} {method:?} is not seen at all");
    }
}

#[test]
fn a_delay_between_the_axes_of_the_gyroscope_comes_back() {
    let session = Spec::hand_held(12)
        .with_effect("gyro_delay", 4.0)
        .run()
        .unwrap();
    let outcome = calibrated(&session, Method::Joint, "gyro_delay");
    let at = |axis| of(&outcome, &session, "gyro_delay", axis);
    let (x, y, z) = (at("x"), at("y"), at("z"));
    assert_eq!(x.0.min(y.0).min(z.0), 0.0);
    // What the three share is not visible; the differences are, to a tenth of a millisecond.
    for (a, b) in [(x, y), (y, z)] {
        let error = (a.0 - b.0) - (a.1 - b.1);
        assert!(error.abs() < 3e-4, "{error}");
    }
}

#[test]
fn the_latitude_takes_the_rotation_of_the_earth_off_the_bias() {
    let mut spec = Spec::hand_held(13);
    spec.latitude = Some(60.0);
    let session = spec.run().unwrap();
    let errors = |latitude: Option<f64>| {
        let request = Request {
            method: Method::Joint,
            gravity: spec.gravity,
            latitude,
            ..Request::default()
        };
        let outcome = calibrate(std::slice::from_ref(&session.recording), &[], &request).unwrap();
        let triad = outcome.calibration.gyroscope.unwrap();
        let fit = outcome.joint.unwrap();
        if latitude.is_some() {
            let p = |axis| fit.parameters.get(&format!("earth_rate.{axis}")).unwrap();
            let horizontal = p("x").hypot(p("y"));
            // Half of the earth's rotation; a rest's mean rate is known to 4e-5 rad/s, all to 5e-6.
            assert!(
                (horizontal - 0.5 * EARTH_RATE).abs() < 3e-5,
                "{horizontal:e}"
            );
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let truth = session.truth.get(&format!("gyro.b_{axis}")).unwrap();
            let pull = (triad.bias[k] - truth) / triad.bias_std[k].unwrap();
            assert!(pull.abs() < 4.0, "{latitude:?} {axis} {pull}");
        }
        triad.bias_std.into_iter().flatten().sum::<f64>()
    };
    // What is not said is uncertainty.
    let (without, with) = (errors(None), errors(Some(60.0)));
    assert!(with < without, "{with} {without}");
}

#[test]
fn a_latitude_of_the_wrong_sign_is_noticed() {
    let mut spec = Spec::hand_held(14);
    spec.latitude = Some(60.0);
    let session = spec.run().unwrap();
    let doubts = |latitude: f64| {
        let request = Request {
            method: Method::Joint,
            gravity: spec.gravity,
            latitude: Some(latitude),
            ..Request::default()
        };
        let outcome = calibrate(std::slice::from_ref(&session.recording), &[], &request).unwrap();
        let warnings = outcome.calibration.warnings;
        warnings.has(findings::Kind::LATITUDE_DOUBTFUL)
    };
    assert!(doubts(-60.0) && !doubts(60.0));
}

#[test]
fn a_bias_says_for_which_time_it_holds_and_how_far_it_moved() {
    let spec = Spec::hand_held(15).with_effect("gyro_drift", 1.0);
    let session = spec.run().unwrap();
    let request = Request {
        method: Method::Joint,
        gravity: spec.gravity,
        ..Request::default()
    };
    let outcome = calibrate(std::slice::from_ref(&session.recording), &[], &request).unwrap();
    let triad = outcome.calibration.gyroscope.unwrap();
    let time = triad.bias_time.unwrap();
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let drift = session.truth.get(&format!("gyro_drift.{axis}")).unwrap();
        let moved = drift * (time.to - time.from);
        let pull = (time.change[k] - moved) / time.change_std[k];
        assert!(pull.abs() < 4.0, "{axis}: {} {moved}", time.change[k]);
        assert!((time.end[k] - time.start[k] - time.change[k]).abs() < 1e-12);
        assert!((time.start[k] - triad.bias[k]) * (time.end[k] - triad.bias[k]) <= 0.0);
    }
}
