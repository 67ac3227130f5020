//! A magnetometer from recording to corrected field.

mod bound;
mod left_out;

use calib::calibrate::{Method, Request, calibrate};
use calib::calibration::{Calibration, apply, effect_named};
use calib::effects::catalogue_of;
use calib::evaluate;
use calib::intervals::Segmentation;
use calib::methods::cut;
use calib::recording::{FieldUnit, Recording};
use calib::simulate::{HandHeld, MagneticField, Motion, Session, Spec};
use findings::Kind;
use nalgebra::Matrix3;
use sensor::{Base, EffectRef, Sensor};

fn spec(seed: u64, unevenness: f64) -> Spec {
    Spec {
        motion: Motion::HandHeld(HandHeld {
            placements: Some(26),
            initial_rest: Some(20.0),
            ..HandHeld::default()
        }),
        magnetic_field: Some(MagneticField {
            unevenness,
            ..MagneticField::default()
        }),
        ..Spec::hand_held(seed)
    }
}

fn request(method: Method) -> Request {
    Request {
        method,
        ..Request::default()
    }
}

fn calibrated(session: &Session, request: &Request) -> Calibration {
    let outcome = calibrate(std::slice::from_ref(&session.recording), &[], request);
    outcome.unwrap().calibration
}

/// `(estimate − truth) / standard error` of the twelve parameters; the truth is that of a field of known strength.
fn errors(calibration: &Calibration, session: &Session) -> Vec<f64> {
    let triad = calibration.magnetometer.as_ref().unwrap();
    let truth = Base::from_parameters(session.truth.parameters(Sensor::Magnetometer).values());
    let given = calibration.magnetic_field.as_ref().unwrap().strength_given;
    let scale = if given {
        1.0
    } else {
        truth.t.determinant().cbrt()
    };
    let mut all = Vec::new();
    for i in 0..3 {
        for j in 0..3 {
            all.push((triad.t[i][j] - truth.t[(i, j)] / scale) / triad.t_std[i][j].unwrap());
        }
        all.push((triad.bias[i] - truth.bias[i]) / triad.bias_std[i].unwrap());
    }
    all
}

#[test]
fn errors_are_as_large_as_stated_by_both_methods() {
    for (method, field, unevenness) in [
        (Method::Joint, None, 0.0),
        (Method::Stepwise, Some(48.0), 0.0),
        (Method::Joint, Some(48.0), 0.6),
        (Method::Stepwise, None, 0.6),
    ] {
        let mut squares = Vec::new();
        for seed in 0..4 {
            let session = spec(seed, unevenness).run().unwrap();
            let asked = Request {
                field,
                ..request(method)
            };
            let calibration = calibrated(&session, &asked);
            assert!(!names_an_effect(&calibration), "{:?}", calibration.warnings);
            squares.extend(errors(&calibration, &session).iter().map(|z| z * z));
            let found = calibration.magnetic_field.unwrap();
            assert!((found.unevenness - unevenness).abs() < 0.2, "{found:?}");
            assert!((found.last.inclination - 65.0).abs() < 4.5 * found.last.inclination_std);
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        // 48 squares, those of a session correlated: 1 ± 0.3.
        assert!(
            (0.4..1.9).contains(&mean),
            "{method:?} {unevenness}: {mean}"
        );
    }
}

#[test]
fn headings_tell_the_joint_gyroscope_what_turns_about_the_vertical_are() {
    let session = spec(3, 0.0).run().unwrap();
    let mut bare = session.clone();
    bare.recording.magnetometer = None;
    let joint = request(Method::Joint);
    let [with, without] = [&session, &bare].map(|s| calibrated(s, &joint).gyroscope.unwrap());
    let mut shares = Vec::new();
    for k in 0..3 {
        let [with, without] = [&with, &without].map(|triad| triad.t_std[k][k].unwrap());
        assert!(with <= without * (1.0 + 1e-9));
        shares.push(with / without);
    }
    assert!(shares.iter().any(|share| *share < 0.97), "{shares:?}");
    let truth = session.truth.parameters(Sensor::Gyroscope).values();
    for (k, truth) in truth.iter().take(3).enumerate() {
        let z = (with.t[k][k] - truth) / with.t_std[k][k].unwrap();
        assert!(z.abs() < 4.0, "{z}");
    }
    // Stepwise stays as published.
    let stepwise = request(Method::Stepwise);
    let [with, without] = [&session, &bare].map(|s| calibrated(s, &stepwise).gyroscope);
    assert_eq!(with, without);
}

#[test]
fn the_corrected_field_is_the_same_everywhere_on_another_recording() {
    let session = spec(5, 0.0).run().unwrap();
    let calibration = calibrated(&session, &request(Method::Joint));
    let mut other = spec(6, 0.0);
    for sensor in Sensor::ALL {
        let parameters = session.truth.parameters(sensor);
        for (name, value) in parameters.names().iter().zip(parameters.values()) {
            other.parameters.insert(name.clone(), *value);
        }
    }
    let other = other.run().unwrap().recording;
    let segmentation = segmented(&other);
    let of = |c: Option<&Calibration>| {
        let misfit = evaluate(&other, &segmentation, c, 9.80665).unwrap();
        misfit.magnetic_field.unwrap()
    };
    let (raw, corrected) = (of(None), of(Some(&calibration)));
    assert!(raw.norm_spread > 0.1, "{raw:?}");
    assert!(corrected.norm_spread < 2e-3, "{corrected:?}");
    assert!(corrected.angle_spread < 0.2, "{corrected:?}");
    // 65° below the horizontal lie 155° from up.
    assert!((corrected.angle - 155.0).abs() < 0.2, "{corrected:?}");
}

fn segmented(recording: &Recording) -> Segmentation {
    let detector = calib::intervals::Detector::default();
    cut(recording, &detector, true, 9.80665)
        .unwrap()
        .segmentation
}

#[test]
fn effects_are_estimated_saved_and_applied() {
    let effects: Vec<EffectRef> = catalogue_of(Sensor::Magnetometer).collect();
    let all = |spec: Spec, effect: &EffectRef| spec.with_effect(effect.name(), 3.0);
    let session = effects.iter().fold(spec(11, 0.0), all).run().unwrap();
    let asked = Request {
        effects: effects.clone(),
        field: Some(48.0),
        ..request(Method::Joint)
    };
    let calibration = calibrated(&session, &asked);
    for values in &calibration.effects {
        for p in &values.parameters {
            let truth = session
                .truth
                .get(&format!("{}.{}", values.name, p.name))
                .unwrap();
            let z = (p.value - truth) / p.std.unwrap();
            assert!(z.abs() < 4.5, "{}.{}: {z}", values.name, p.name);
        }
    }
    let text = serde_json::to_string(&calibration).unwrap();
    let path = std::path::Path::new("cal.json");
    let read = calib::calibration::read_calibration(&text, path, &[]).unwrap();
    let corrected = apply(&read, &session.recording).unwrap();
    let misfit = evaluate(&corrected, &segmented(&session.recording), None, 9.80665).unwrap();
    assert!(misfit.magnetic_field.unwrap().norm_spread < 2e-3);
    let bare = calibrated(&session, &request(Method::Joint));
    assert!(bare.magnetic_field.unwrap().unevenness > 0.1);
}

fn names_an_effect(calibration: &Calibration) -> bool {
    let texts = calibration.warnings.texts(findings::Front::CommandLine);
    let mut warnings = texts.iter();
    warnings.any(|w| w.contains("the readings of the magnetometer go with"))
}

#[test]
fn whoever_asks_for_the_accelerometer_alone_gets_no_magnetometer() {
    let session = spec(3, 0.0).run().unwrap();
    let both = calibrated(&session, &request(Method::Joint));
    assert!(both.magnetometer.is_some() && both.gyroscope.is_some());
    let alone = Request {
        accelerometer_alone: true,
        ..request(Method::Joint)
    };
    let alone = calibrated(&session, &alone);
    assert!(alone.accelerometer.is_some());
    assert!(alone.magnetometer.is_none() && alone.gyroscope.is_none());
}

#[test]
fn an_effect_that_the_model_lacks_is_named() {
    for effect in catalogue_of(Sensor::Magnetometer) {
        let session = spec(12, 0.0).with_effect(effect.name(), 3.0).run().unwrap();
        let bare = calibrated(&session, &request(Method::Stepwise));
        let named = format!("depend on {},", effect.name());
        let texts = bare.warnings.texts(findings::Front::CommandLine);
        let mut warnings = texts.iter();
        assert!(
            warnings.any(|w| w.contains(&named)),
            "{named}: {:?}",
            bare.warnings
        );
        let asked = Request {
            effects: vec![effect],
            ..request(Method::Stepwise)
        };
        assert!(!names_an_effect(&calibrated(&session, &asked)));
    }
}

#[test]
fn gauss_and_microtesla_are_the_same_field() {
    let session = spec(7, 0.0).run().unwrap();
    let mut gauss = session.clone();
    let field = gauss.recording.magnetometer.as_mut().unwrap();
    field.stream.values.iter_mut().for_each(|v| *v *= 0.01);
    field.unit = Some(FieldUnit::Gauss);
    let joint = request(Method::Joint);
    let [one, other] = [&session, &gauss].map(|s| calibrated(s, &joint).magnetometer.unwrap());
    let [one, other] = [one, other].map(|triad| triad.base());
    assert!((one.t - other.t).norm() < 1e-6);
    assert!((one.bias - other.bias).norm() < 1e-4);
    assert!((one.t.determinant() - 1.0).abs() < 1e-7);
}

#[test]
fn axes_in_any_order_are_found_without_a_guess() {
    let session = spec(8, 0.0).run().unwrap();
    let mut turned = session.clone();
    // x forward, y left, z up becomes z, x, y: a rotation.
    let turn = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let field = turned.recording.magnetometer.as_mut().unwrap();
    field.stream.values.iter_mut().for_each(|v| *v = turn * *v);
    let joint = request(Method::Joint);
    let [one, other] = [&session, &turned].map(|s| calibrated(s, &joint).magnetometer.unwrap());
    assert!((one.base().t - other.base().t * turn).norm() < 1e-6);
}

#[test]
fn a_place_near_iron_is_named_and_left_out() {
    let session = spec(9, 0.0).run().unwrap();
    let rest = &session.truth.static_intervals[12];
    let mut near_iron = session.clone();
    let stream = &mut near_iron.recording.magnetometer.as_mut().unwrap().stream;
    for (t, value) in stream.t.iter().zip(&mut stream.values) {
        if (rest.start..rest.end).contains(t) {
            value.x += 8.0;
        }
    }
    let calibration = calibrated(&near_iron, &request(Method::Joint));
    let texts = calibration.warnings.texts(findings::Front::CommandLine);
    let named = texts
        .iter()
        .find(|w| w.contains("magnetic field is off by"));
    assert!(named.unwrap().contains("interval 13"), "{named:?}");
    let squares: Vec<f64> = errors(&calibration, &session)
        .iter()
        .map(|z| z * z)
        .collect();
    assert!(squares.iter().sum::<f64>() / 12.0 < 3.0, "{squares:?}");
    let clean = calibrated(&session, &request(Method::Joint));
    assert!(
        !clean
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("magnet")),
        "{:?}",
        clean.warnings
    );
}

#[test]
fn a_bias_that_steps_twice_is_no_iron_nearby() {
    let mut session = spec(4, 0.0).run().unwrap();
    let magnetometer = session.recording.magnetometer.as_mut().unwrap();
    let stream = &mut magnetometer.stream;
    let end = *stream.t.last().unwrap();
    for (t, value) in stream.t.iter().zip(&mut stream.values) {
        for (from, step) in [(0.35, [3.0, -2.0, 1.0]), (0.7, [-1.0, 2.0, 3.0])] {
            if *t > from * end {
                *value += nalgebra::Vector3::from(step);
            }
        }
    }
    let found = calibrated(&session, &request(Method::Auto)).warnings;
    assert!(found.has(Kind::MAGNETIC_BIAS_STEPPED));
    assert!(!found.has(Kind::FIELD_UNEVEN) && !found.has(Kind::FIELD_LITTLE_UNEVEN));
}

/// The session with the readings of the magnetometer moved by what `moved` makes of the share of the time that has passed.
fn with_bias(seed: u64, moved: impl Fn(f64) -> [f64; 3]) -> Session {
    let mut session = spec(seed, 0.0).run().unwrap();
    let stream = &mut session.recording.magnetometer.as_mut().unwrap().stream;
    let end = *stream.t.last().unwrap();
    for (t, value) in stream.t.iter().zip(&mut stream.values) {
        *value += nalgebra::Vector3::from(moved(t / end));
    }
    session
}

#[test]
fn a_bias_that_steps_before_the_last_three_placements_is_told_from_iron() {
    let session = with_bias(4, |share| [f64::from(share > 0.88), 0.5, 0.0]);
    let found = calibrated(&session, &request(Method::Auto)).warnings;
    assert!(found.has(Kind::MAGNETIC_BIAS_STEPPED));
}

#[test]
fn a_bias_that_sways_is_no_uneven_field_and_its_standard_error_counts_that() {
    let bias_std = |size: f64| {
        let sways = |share: f64| {
            let phase = share * 2.2 * std::f64::consts::TAU;
            [
                size * phase.sin(),
                size * phase.cos(),
                size * (0.7 * phase).sin(),
            ]
        };
        let calibration = calibrated(&with_bias(4, sways), &request(Method::Auto));
        let said = calibration.warnings.has(Kind::BIAS_UNSTEADY);
        assert!(!calibration.warnings.has(Kind::FIELD_LITTLE_UNEVEN));
        (calibration.magnetometer.unwrap().bias_std[0].unwrap(), said)
    };
    let ((still, unsaid), (swaying, said)) = (bias_std(0.0), bias_std(0.7));
    assert!(said && !unsaid && swaying > 0.4 && still < 0.1);
}

#[test]
fn too_few_attitudes_leave_the_magnetometer_out_and_an_effect_of_it_is_refused() {
    let mut spec = spec(1, 0.0);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(12),
        ..HandHeld::default()
    });
    let mut session = spec.run().unwrap();
    // It stopped early.
    let stream = &mut session.recording.magnetometer.as_mut().unwrap().stream;
    let end = session.truth.static_intervals[3].end;
    let kept = stream.t.partition_point(|t| *t < end);
    stream.t.truncate(kept);
    stream.values.truncate(kept);
    let calibration = calibrated(&session, &request(Method::Stepwise));
    assert!(calibration.magnetometer.is_none());
    let said = |w: &String| w.contains("the magnetometer is not calibrated: 4 static intervals");
    assert!(
        calibration
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(said),
        "{:?}",
        calibration.warnings
    );
    let asked = Request {
        effects: vec![effect_named("mag_g_sensitivity").unwrap()],
        ..request(Method::Stepwise)
    };
    let refused = calibrate(std::slice::from_ref(&session.recording), &[], &asked);
    assert!(matches!(refused, Err(calib::Error::NotEnough(_))));
    session.recording.magnetometer = None;
    let refused = calibrate(std::slice::from_ref(&session.recording), &[], &asked);
    let words = refused.unwrap_err().to_string();
    assert!(
        words.contains("the recording has no magnetometer"),
        "{words}"
    );
}
