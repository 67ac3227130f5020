//! Recordings in units of many kinds, without a header or with a wrong one, slow and fast, with large biases: read rightly
//! or asked about, never wrongly.

use std::fmt::Write as _;

use calib::recording::{ReadOptions, Stream};
use calib::{Error, Recording};
use nalgebra::{Rotation3, Unit, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const G: f64 = 9.80665;
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Units per m/s² and whether readings are whole numbers.
const ACCEL: [(f64, bool); 6] = [
    (1.0, false),
    (1.0 / G, false),
    (1e3 / G, false),
    (100.0, false),
    (16384.0 / G, true),
    (2048.0 / G, true),
];
/// Units per rad/s.
const GYRO: [(f64, bool); 6] = [
    (1.0, false),
    (1.0 / DEGREE, false),
    (1e3 / DEGREE, false),
    (131.0 / DEGREE, true),
    (65.5 / DEGREE, true),
    (16.4 / DEGREE, true),
];

/// What stands above the rows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Header {
    None,
    NoneGyroFirst,
    Names,
    SwappedNames,
    WrongUnit,
}

const HEADERS: [Header; 5] = [
    Header::None,
    Header::NoneGyroFirst,
    Header::Names,
    Header::SwappedNames,
    Header::WrongUnit,
];

struct Case {
    text: String,
    accel: Vec<Vector3<f64>>,
    gyro: Vec<Vector3<f64>>,
    about: String,
}

fn case(seed: u64) -> Case {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (accel_unit, accel_whole) = ACCEL[random.random_range(0..ACCEL.len())];
    let (gyro_unit, gyro_whole) = GYRO[random.random_range(0..GYRO.len())];
    let header = HEADERS[random.random_range(0..HEADERS.len())];
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    // Peaks of 0.3 to 6 rad/s.
    let speed = 0.3 * 20f64.powf(between(0.0, 1.0));
    let bias = Vector3::from_fn(|_, _| between(-0.3, 0.3) * G);
    let drift = Vector3::from_fn(|_, _| between(-0.03, 0.03));
    let scale = Vector3::from_fn(|_, _| between(0.97, 1.03));
    let (mut accel, mut gyro) = (Vec::new(), Vec::new());
    let mut attitude = Rotation3::from_euler_angles(between(-3.0, 3.0), between(-1.0, 1.0), 0.0);
    for _ in 0..14 {
        let axis = Unit::new_normalize(Vector3::from_fn(|_, _| between(-1.0, 1.0)));
        let peak = speed * between(0.7, 1.0);
        // Turns of 60 to 150 degrees.
        let length = (between(60.0, 150.0) * DEGREE / (0.5 * peak) * 100.0) as usize;
        for k in 0..length + 300 {
            let phase = (k as f64 - 300.0).max(0.0) / length as f64;
            let rate = peak * (std::f64::consts::PI * phase).sin().powi(2);
            attitude = Rotation3::from_axis_angle(&axis, -rate * 0.01) * attitude;
            let noise = |size: f64, between: &mut dyn FnMut(f64, f64) -> f64| {
                Vector3::from_fn(|_, _| between(-size, size))
            };
            let force = (attitude * Vector3::z() * G).component_mul(&scale) + bias;
            accel.push(force + noise(0.02, &mut between));
            gyro.push(axis.into_inner() * rate + drift + noise(0.003, &mut between));
        }
    }
    let written = |v: &Vector3<f64>, unit: f64, whole: bool| {
        v.map(|x| {
            if whole {
                (x * unit).round()
            } else {
                (x * unit * 1e6).round() / 1e6
            }
        })
    };
    let mut text = match header {
        Header::None | Header::NoneGyroFirst => String::new(),
        Header::Names => "t,ax,ay,az,gx,gy,gz\n".to_owned(),
        Header::SwappedNames => "t,gx,gy,gz,ax,ay,az\n".to_owned(),
        Header::WrongUnit if gyro_unit == 1.0 => {
            "t,ax,ay,az,gx (deg/s),gy (deg/s),gz (deg/s)\n".to_owned()
        }
        Header::WrongUnit => "t,ax,ay,az,gx (rad/s),gy (rad/s),gz (rad/s)\n".to_owned(),
    };
    for (k, (force, rate)) in accel.iter().zip(&gyro).enumerate() {
        let f = written(force, accel_unit, accel_whole);
        let w = written(rate, gyro_unit, gyro_whole);
        let (a, b) = if header == Header::NoneGyroFirst {
            (w, f)
        } else {
            (f, w)
        };
        let _ = writeln!(
            text,
            "{:.2},{},{},{},{},{},{}",
            k as f64 * 0.01,
            a.x,
            a.y,
            a.z,
            b.x,
            b.y,
            b.z
        );
    }
    let about = format!(
        "seed {seed}: {accel_unit:.4} per m/s², {gyro_unit:.4} per rad/s, {header:?}, {speed:.2} rad/s, bias {:.2} m/s²",
        bias.norm()
    );
    Case {
        text,
        accel,
        gyro,
        about,
    }
}

/// The factor between what was read and the truth, where it is one.
fn factor(read: &Stream, truth: &[Vector3<f64>]) -> Option<f64> {
    let product: f64 = read.values.iter().zip(truth).map(|(a, b)| a.dot(b)).sum();
    let squares: f64 = truth.iter().map(Vector3::norm_squared).sum();
    let factor = product / squares;
    let off: f64 = read
        .values
        .iter()
        .zip(truth)
        .map(|(a, b)| (a - b * factor).norm_squared())
        .sum();
    (read.len() == truth.len() && off < 1e-3 * factor * factor * squares).then_some(factor)
}

/// Right, asked, or wrong with the reason.
fn outcome(case: &Case) -> Result<bool, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.csv");
    std::fs::write(&path, &case.text).unwrap();
    let recording = match Recording::read(&path, &ReadOptions::default()) {
        Ok(recording) => recording,
        Err(Error::Input(_)) => return Ok(false),
        Err(other) => return Err(other.to_string()),
    };
    let sensors = [
        (&recording.accelerometer, &case.accel),
        (&recording.gyroscope, &case.gyro),
    ];
    for ((stream, truth), described) in sensors.into_iter().zip(&recording.description.sensors) {
        let stream = stream.as_ref().ok_or("a sensor is missing")?;
        let factor = factor(stream, truth).ok_or_else(|| {
            format!(
                "{:?}: {} samples of {} and no factor; {:?}",
                described.sensor,
                stream.len(),
                truth.len(),
                recording.warnings
            )
        })?;
        if described.unit != "counts" && (factor - 1.0).abs() > 1e-3 {
            return Err(format!(
                "{:?} read as {} is {factor:.4} times the truth",
                described.sensor, described.unit
            ));
        }
    }
    Ok(true)
}

/// `UNITS=300` is the run that a release asks for, `FIRST=301 UNITS=600` one on other seeds.
#[test]
fn units_and_roles_are_right_or_asked_about() {
    let setting = |name: &str| std::env::var(name).ok()?.parse::<u64>().ok();
    let count = setting("UNITS").unwrap_or(60);
    let first = setting("FIRST").unwrap_or(0);
    let mut wrong = Vec::new();
    let mut right = 0;
    for seed in first..first + count {
        let case = case(seed);
        match outcome(&case) {
            Ok(true) => right += 1,
            Ok(false) => {}
            Err(words) => wrong.push(format!("{}: {words}", case.about)),
        }
    }
    println!(
        "{right} of {count} right, {} wrong, the others asked about",
        wrong.len()
    );
    assert!(
        wrong.is_empty(),
        "{} of {count}\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    // Swapped names and wrong units are to be asked about: two in five.
    assert!(2 * right >= count, "{right} of {count}");
}

/// A rest of a minute: no turn tells the unit, the size of noise and bias may.
#[test]
fn a_rest_alone_in_degrees_is_asked_about_and_one_in_radians_is_read() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    for header in ["", "time,acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z\n"] {
        for (unit, is_asked) in [(1.0, false), (1.0 / DEGREE, true), (1e3 / DEGREE, true)] {
            let mut text = header.to_owned();
            for k in 0..6000 {
                let f = Vector3::z() * G + Vector3::from_fn(|_, _| between(-0.02, 0.02));
                let w = Vector3::from_fn(|i, _| between(-0.003, 0.003) + 0.01 * i as f64) * unit;
                let t = f64::from(k) * 0.01;
                let _ = writeln!(
                    text,
                    "{t:.2},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6}",
                    f.x, f.y, f.z, w.x, w.y, w.z
                );
            }
            match Recording::from_bytes("rest.csv", text.into_bytes(), &ReadOptions::default()) {
                Ok(_) => assert!(!is_asked, "{unit} {header}"),
                Err(error) => {
                    assert!(is_asked, "{error}");
                    let words = error.text(findings::Front::CommandLine);
                    assert!(words.contains("--gyro-unit"), "{words}");
                }
            }
        }
    }
}
