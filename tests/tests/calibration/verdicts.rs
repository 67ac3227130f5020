//! The verdict on eighty sessions, clean and with each kind of fault, against what a person of the field would say of them.

use calib::calibrate::{Method, Request, calibrate};
use calib::gravity::GravitySource;
use calib::recording::{Recording, Stream};
use calib::simulate::{HandHeld, Motion, Spec};
use findings::{Grade, Kind, Remedy};
use nalgebra::Vector3;

/// A kind of session: its name, what is done to it, and the verdict that is expected.
struct Case {
    name: &'static str,
    prepare: fn(&mut Spec),
    damage: fn(&mut Recording),
    method: Method,
    knows_gravity: bool,
    level: Grade,
    /// First reasons that a person of the field would give; none of a good session.
    reasons: &'static [Kind],
    /// What the first step is about.
    step: fn(&Remedy) -> bool,
}

const SEEDS: u64 = 5;

fn nothing(_: &mut Spec) {}
fn as_recorded(_: &mut Recording) {}
fn any_step(_: &Remedy) -> bool {
    true
}

fn is_setting(remedy: &Remedy) -> bool {
    matches!(remedy, Remedy::Set { .. })
}

fn hidden(spec: &mut Spec, effect: &str) {
    *spec = spec.clone().with_effect(effect, 5.0);
}

/// Readings of a sensor in the second half of its time.
fn second_half(readings: &mut Stream, change: impl Fn(&mut Vector3<f64>)) {
    let half = readings.t.len() / 2;
    readings.values.iter_mut().skip(half).for_each(change);
}

fn cases() -> Vec<Case> {
    let clean = || Case {
        name: "clean",
        prepare: nothing,
        damage: as_recorded,
        method: Method::Stepwise,
        knows_gravity: true,
        level: Grade::Good,
        reasons: &[],
        step: any_step,
    };
    vec![
        clean(),
        Case {
            name: "clean, gravity not given",
            knows_gravity: false,
            reasons: &[Kind::GRAVITY_ASSUMED],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "g-sensitivity",
            prepare: |spec| hidden(spec, "gyro_g_sensitivity"),
            level: Grade::Care,
            reasons: &[Kind::MISFIT],
            step: |remedy| *remedy == Remedy::Discover,
            ..clean()
        },
        Case {
            name: "accelerometer's square",
            prepare: |spec| hidden(spec, "accel_quadratic"),
            level: Grade::Care,
            reasons: &[Kind::MISFIT, Kind::EFFECT_MISSING],
            step: |remedy| *remedy == Remedy::Discover,
            ..clean()
        },
        Case {
            name: "square and no gravity",
            prepare: |spec| hidden(spec, "accel_quadratic"),
            knows_gravity: false,
            level: Grade::Care,
            reasons: &[Kind::MISFIT, Kind::EFFECT_MISSING],
            step: |remedy| *remedy == Remedy::Discover,
            ..clean()
        },
        Case {
            name: "gyroscope in degrees per second",
            damage: |r| {
                r.gyroscope
                    .iter_mut()
                    .flat_map(|s| &mut s.values)
                    .for_each(|w| *w *= 57.3)
            },
            level: Grade::Care,
            reasons: &[Kind::READINGS_IN_DEGREES],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "an axis of the accelerometer at half its size",
            damage: |r| {
                r.accelerometer
                    .iter_mut()
                    .flat_map(|s| &mut s.values)
                    .for_each(|f| f.x *= 0.5)
            },
            level: Grade::Bad,
            reasons: &[Kind::AXIS_UNIT],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "an axis of the accelerometer a tenth larger than the others",
            damage: |r| {
                r.accelerometer
                    .iter_mut()
                    .flat_map(|s| &mut s.values)
                    .for_each(|f| f.x *= 1.1)
            },
            level: Grade::Care,
            reasons: &[Kind::AXIS_APART],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "an axis of the gyroscope with the other sign",
            damage: |r| {
                r.gyroscope
                    .iter_mut()
                    .flat_map(|s| &mut s.values)
                    .for_each(|w| w.y = -w.y)
            },
            level: Grade::Bad,
            reasons: &[Kind::LEFT_HANDED],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "half the rate",
            damage: |r| {
                let streams = [&mut r.accelerometer, &mut r.gyroscope];
                streams
                    .into_iter()
                    .flatten()
                    .flat_map(|s| &mut s.t)
                    .for_each(|t| *t *= 2.0);
            },
            level: Grade::Bad,
            reasons: &[Kind::GYROSCOPE_SCALE_OFF],
            step: is_setting,
            ..clean()
        },
        Case {
            name: "another range from half way on",
            damage: |r| {
                r.accelerometer
                    .iter_mut()
                    .for_each(|s| second_half(s, |f| *f *= 1.05))
            },
            level: Grade::Care,
            reasons: &[Kind::SCALE_CHANGE],
            step: |remedy| matches!(remedy, Remedy::Split | Remedy::RecordAgain),
            ..clean()
        },
        Case {
            name: "a step of the bias half way",
            damage: |r| {
                r.gyroscope
                    .iter_mut()
                    .for_each(|s| second_half(s, |w| w.z += 0.02))
            },
            level: Grade::Care,
            reasons: &[Kind::BIAS_STEP, Kind::MISFIT],
            step: |remedy| {
                matches!(
                    remedy,
                    Remedy::Split | Remedy::RecordAgain | Remedy::Discover
                )
            },
            ..clean()
        },
        Case {
            name: "range and no gravity",
            damage: |r| {
                r.accelerometer
                    .iter_mut()
                    .for_each(|s| second_half(s, |f| *f *= 1.05))
            },
            knows_gravity: false,
            level: Grade::Care,
            reasons: &[Kind::SCALE_CHANGE],
            step: |remedy| matches!(remedy, Remedy::Split | Remedy::RecordAgain),
            ..clean()
        },
        Case {
            name: "a gyroscope that warms up",
            method: Method::Joint,
            prepare: |spec| *spec = spec.clone().with_effect("gyro_drift", 60.0),
            level: Grade::Care,
            reasons: &[Kind::BIAS_MOVED],
            step: |remedy| *remedy == Remedy::Discover,
            ..clean()
        },
        Case {
            name: "a logger that paused in a turn",
            method: Method::Joint,
            damage: pause,
            level: Grade::Care,
            reasons: &[Kind::TURN_MISSED],
            step: |remedy| *remedy == Remedy::RecordAgain,
            ..clean()
        },
        Case {
            name: "a dead axis",
            method: Method::Joint,
            damage: |r| r.gyroscope.iter_mut().for_each(dead),
            level: Grade::Bad,
            reasons: &[Kind::AXIS_ONLY_NOISE],
            step: any_step,
            ..clean()
        },
        Case {
            name: "two devices one after the other",
            method: Method::Joint,
            damage: another,
            level: Grade::Care,
            reasons: &[Kind::OF_ANOTHER_ACCELEROMETER],
            step: any_step,
            ..clean()
        },
    ]
}

/// Half a second is missing within the fastest turn of the second half, and the stamps go on as if it were not.
fn pause(r: &mut Recording) {
    let Some(rate) = &r.gyroscope else { return };
    let speeds = rate.values.iter().map(|w| w.norm()).enumerate();
    let later = speeds.skip(rate.values.len() / 2);
    let fastest = later
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(k, _)| k);
    for stream in [&mut r.accelerometer, &mut r.gyroscope]
        .into_iter()
        .flatten()
    {
        stream.values.drain(fastest - 12..fastest + 13);
        stream.t.truncate(stream.values.len());
    }
}

/// Noise in the place of an axis.
fn dead(readings: &mut Stream) {
    for (k, value) in readings.values.iter_mut().enumerate() {
        let bits = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40;
        value.z = 2e-3 * (bits as f64 / f64::from(1 << 24) - 0.5);
    }
}

/// The session of another device, which is noisier, behind this one.
fn another(r: &mut Recording) {
    let mut spec = Spec::hand_held(990);
    spec.rate = 50.0;
    spec.accelerometer.white = Some(4e-3);
    spec.gyroscope.white = Some(3e-4);
    let second = spec.run().unwrap().recording;
    for (own, other) in [
        (&mut r.accelerometer, second.accelerometer),
        (&mut r.gyroscope, second.gyroscope),
    ] {
        let (Some(own), Some(other)) = (own, other) else {
            continue;
        };
        let shift = own.t[own.t.len() - 1] + 0.02 - other.t[0];
        own.t.extend(other.t.iter().map(|t| t + shift));
        own.values.extend(other.values);
    }
}

/// The sentence of every session that is judged otherwise.
fn judged(case: &Case, seed: u64) -> Result<(), String> {
    let mut spec = Spec::hand_held(700 + seed);
    spec.rate = 50.0;
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(18),
        initial_rest: Some(8.0),
        ..HandHeld::default()
    });
    (case.prepare)(&mut spec);
    let mut session = spec.run().map_err(|error| error.to_string())?;
    (case.damage)(&mut session.recording);
    let request = Request {
        method: case.method,
        gravity: spec.gravity,
        gravity_source: match case.knows_gravity {
            true => GravitySource::Given,
            false => GravitySource::Assumed,
        },
        ..Request::default()
    };
    let outcome = calibrate(&[session.recording], &[], &request);
    let calibration = outcome.map_err(|error| error.to_string())?.calibration;
    let verdict = calibration.verdict();
    let all = calibration.findings();
    let first = findings::gravest_first(&all).first().copied().cloned();
    let right_level = verdict.level == case.level;
    let kind = first.as_ref().map(|found| found.kind);
    let right_reason = match case.reasons {
        [] => kind.is_none_or(|kind| {
            all.iter()
                .any(|f| f.kind == kind && f.level == findings::Level::Remark)
        }),
        reasons => kind.is_some_and(|kind| reasons.contains(&kind)),
    };
    let remedy = first.as_ref().and_then(|found| found.remedies.first());
    let right_step = case.reasons.is_empty() || remedy.is_some_and(case.step);
    match right_level && right_reason && right_step {
        true => Ok(()),
        false => Err(format!(
            "{} {:?} {remedy:?}: {:?}",
            verdict.sentence(),
            verdict.reasons,
            all.texts(findings::Front::Plain)
        )),
    }
}

#[test]
fn the_verdict_on_every_session_is_that_of_a_person_of_the_field() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for case in cases() {
        for seed in 0..SEEDS {
            count += 1;
            if let Err(said) = judged(&case, seed) {
                wrong.push(format!("{} {seed}: {said}", case.name));
            }
        }
    }
    assert_eq!(count, 85);
    assert!(
        wrong.len() <= 2,
        "{} of {count}:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
