//! A device's session, and how a test reads it back.

use std::fmt::Write as _;

use nalgebra::{Rotation3, Unit, Vector3};
use stillpoint_recording::{Error, ReadOptions, Recording};

pub const G: f64 = 9.80665;

/// What a device read: eight rests and the turns between them, 50 Hz.
pub struct Session {
    pub t: Vec<f64>,
    pub force: Vec<Vector3<f64>>,
    pub rate: Vec<Vector3<f64>>,
    pub field: Vec<Vector3<f64>>,
}

pub fn session() -> Session {
    let mut session = Session {
        t: Vec::new(),
        force: Vec::new(),
        rate: Vec::new(),
        field: Vec::new(),
    };
    let mut attitude = Rotation3::identity();
    for place in 0..8_i32 {
        let axis = Unit::new_normalize(Vector3::new(1.0, f64::from(place % 3) - 1.0, 0.3));
        for k in 0..200 {
            let speed = if k < 100 { 0.0 } else { 0.6 };
            let noise = Vector3::from_fn(|i, _| 1e-3 * (f64::from(k * 5) + 2.0 * i as f64).sin());
            attitude = Rotation3::from_axis_angle(&axis, -speed * 0.02) * attitude;
            session.t.push(f64::from(place * 200 + k) * 0.02);
            session.force.push(attitude * Vector3::z() * G + noise);
            session.rate.push(axis.into_inner() * speed + 0.1 * noise);
            let field = attitude * Vector3::new(20.0, 0.0, -40.0);
            session.field.push(field + 100.0 * noise);
        }
    }
    session
}

/// Three numbers with so many digits, times a factor.
pub fn xyz(value: &Vector3<f64>, scale: f64) -> String {
    let cell = |v: &f64| format!("{:.6}", v * scale);
    value.iter().map(cell).collect::<Vec<_>>().join(",")
}

pub fn table(header: &str, row: impl Fn(usize) -> String) -> String {
    let mut text = match header {
        "" => String::new(),
        header => format!("{header}\n"),
    };
    for k in 0..1600 {
        let _ = writeln!(text, "{}", row(k));
    }
    text
}

pub fn read_as(text: &str, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::from_bytes("a.csv", text.as_bytes(), options)
}

pub fn read(text: &str) -> Recording {
    read_as(text, &ReadOptions::default()).unwrap()
}

/// The recording is the session, to what its digits leave.
#[track_caller]
pub fn is_it(found: &Recording, s: &Session, tolerance: f64) {
    let (force, rate) = (
        found.accelerometer.as_ref().unwrap(),
        found.gyroscope.as_ref().unwrap(),
    );
    assert_eq!((force.len(), rate.len()), (1600, 1600));
    for k in [0, 150, 799, 1501] {
        assert!(
            (force.values[k] - s.force[k]).amax() < tolerance,
            "{k}: {} {}",
            force.values[k],
            s.force[k]
        );
        assert!(
            (rate.values[k] - s.rate[k]).amax() < tolerance,
            "{k}: {} {}",
            rate.values[k],
            s.rate[k]
        );
        assert!((force.t[k] - force.t[0] - s.t[k]).abs() < 2e-3, "{k}");
    }
}

#[track_caller]
pub fn says(warnings: &[String], words: &str) {
    assert!(
        warnings.iter().any(|w| w.contains(words)),
        "{words}: {warnings:?}"
    );
}
