//! The source that a proposed formula is written as: compiled here as it stands.
//!
//! `STILLPOINT_BLESS=1 cargo test -p stillpoint-tests --test discovery emitted_effect` writes the files again.

use std::path::Path;

use nalgebra::Vector3;
use sensor::{Axis, Covariate, EffectRef, Formula, Kinematics, Model, Sensor, Term, emit_effect};
use solver::{Jet, lit};

#[path = "emitted/accel_proposed.rs"]
mod accel_proposed;
#[path = "emitted/gyro_proposed.rs"]
mod gyro_proposed;

/// Products of specific force on two axes.
fn accelerometer() -> Formula {
    let force = Covariate::SpecificForce;
    let product = |axis, a, b, size| Term::new(axis, &[(force(a), 1), (force(b), 1)], size);
    let terms = vec![
        product(Axis::X, Axis::Y, Axis::Z, 1.2e-4),
        product(Axis::Z, Axis::X, Axis::Y, -8e-5),
    ];
    Formula::new(Sensor::Accelerometer, terms)
}

/// One of everything, with a line that has to be broken.
fn gyroscope() -> Formula {
    let (force, rate) = (Covariate::SpecificForce, Covariate::AngularRate);
    let acceleration = Covariate::AngularAcceleration;
    let terms = vec![
        Term::new(Axis::X, &[(force(Axis::X), 2), (rate(Axis::Z), 3)], 3e-7),
        Term::new(
            Axis::X,
            &[(Covariate::TemperatureChange, 1), (rate(Axis::Z), 1)],
            2e-4,
        ),
        Term::new(Axis::Y, &[(Covariate::Time, 2)], 1e-9),
        Term::new(Axis::Y, &[(Covariate::LastChange(Axis::X), 1)], 1e-4),
        Term::new(
            Axis::Z,
            &[
                (Covariate::TemperatureChange, 2),
                (acceleration(Axis::Y), 2),
            ],
            5e-7,
        ),
        Term::new(Axis::Z, &[(Covariate::Vibration(Axis::Z), 1)], 1e-3),
        Term::new(Axis::Z, &[(Covariate::Temperature, 1)], 1e-6),
    ];
    Formula::new(Sensor::Gyroscope, terms)
}

fn cases() -> [(&'static str, Formula, EffectRef); 2] {
    [
        (
            "accel_proposed",
            accelerometer(),
            (&accel_proposed::AccelProposed).into(),
        ),
        (
            "gyro_proposed",
            gyroscope(),
            (&gyro_proposed::GyroProposed).into(),
        ),
    ]
}

fn instant() -> Kinematics<f64> {
    Kinematics {
        time: 83.0,
        temperature: 31.5,
        angular_acceleration: Vector3::new(3.0, -4.0, 7.0),
        last_change: Vector3::new(-1.0, 1.0, 1.0),
        vibration: Vector3::new(0.01, 0.02, 0.04),
        ..Kinematics::new(Vector3::new(3.1, -8.2, 4.4), Vector3::new(0.4, 2.3, -1.9))
    }
}

#[test]
fn the_source_is_what_is_compiled_here() {
    for (name, formula, _) in cases() {
        let source = emit_effect(&formula, name).unwrap();
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(format!("tests/discovery/emitted/{name}.rs"));
        if std::env::var_os("STILLPOINT_BLESS").is_some() {
            std::fs::write(&path, &source).unwrap();
        }
        assert_eq!(std::fs::read_to_string(&path).unwrap(), source, "{name}");
    }
}

#[test]
fn the_compiled_effect_is_the_formula_term_for_term() {
    for (name, formula, compiled) in cases() {
        let interpreted = formula.effect(name).unwrap();
        assert_eq!(compiled.name(), name);
        assert_eq!(compiled.sensor(), formula.sensor);
        assert_eq!(compiled.equation(), interpreted.equation());
        assert_eq!(compiled.params(), interpreted.params());
        let n = formula.terms.len();
        for k in 0..n {
            let mut p = vec![0.0; n];
            p[k] = 1.0;
            let (a, b) = (
                compiled.error_f64(&instant(), &p),
                interpreted.error_f64(&instant(), &p),
            );
            // The two multiply in another order.
            assert!((a - b).norm() <= 1e-15 * b.norm(), "{name} {k}");
            assert!(b.norm() > 0.0);
            let jets: Vec<Jet> = p.iter().map(|v| lit(*v)).collect();
            let jet = interpreted.error_jet(&instant().cast(), &jets);
            assert_eq!(jet.map(|v| v.re), b);
        }
    }
}

#[test]
fn the_compiled_effect_keeps_to_the_rules_of_the_catalogue() {
    for (name, formula, effect) in cases() {
        let n = formula.terms.len();
        assert_eq!(effect.error_f64(&instant(), &vec![0.0; n]).norm(), 0.0);
        let model = Model::base(formula.sensor).with(effect.clone());
        let mut p = model.parameters().values().to_vec();
        for (k, term) in formula.terms.iter().enumerate() {
            assert_eq!(effect.typical_of(k), term.size.abs());
            p[12 + k] = term.size;
        }
        let raw = model.distort(&instant(), &p).unwrap();
        let signal = instant().signal(formula.sensor);
        let unknown = instant().with_signal(formula.sensor, Vector3::zeros());
        let off = model.correct(&raw, &unknown, &p) - signal;
        assert!(off.norm() < 2e-15 * signal.norm(), "{name} {off}");
    }
}
