//! A recording in some program's layout, and the recording.

use calib::Recording;
use calib::recording::Stream;
use nalgebra::{Rotation3, Unit, Vector3};

/// The standard gravity that units of g are of, m/s².
pub(super) const G: f64 = 9.80665;

/// A time of this century, s.
pub(super) const EPOCH: u64 = 1_700_000_000;

/// A recording in some program's layout.
#[derive(Clone, Debug)]
pub struct Layout {
    /// What wrote it.
    pub name: &'static str,
    /// Its files, by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// What is named to the program: a file or the folder of them, then options.
    pub call: Vec<&'static str>,
    /// Readings per m/s² and per rad/s where they are kept as counts, else 1.
    pub counts: [f64; 2],
    /// Largest error of a stamp, of the accelerometer in m/s², of the gyroscope in rad/s, by the digits kept.
    pub within: [f64; 3],
    /// The gyroscope is interpolated to the accelerometer's stamps.
    pub one_clock: bool,
    /// The accelerometer alone is in it.
    pub accelerometer_only: bool,
}

impl Layout {
    pub(super) fn new(
        name: &'static str,
        files: Vec<(String, Vec<u8>)>,
        call: &[&'static str],
    ) -> Self {
        Self {
            name,
            files,
            call: call.to_vec(),
            counts: [1.0; 2],
            within: [1e-6, 1e-6, 1e-6],
            one_clock: false,
            accelerometer_only: false,
        }
    }

    /// A layout that is one file of text.
    pub(super) fn text(name: &'static str, file: &'static str, text: String) -> Self {
        Self::new(name, vec![(file.to_owned(), text.into_bytes())], &[file])
    }

    pub(super) fn one_clock(self) -> Self {
        Self {
            one_clock: true,
            ..self
        }
    }

    pub(super) fn within(self, within: [f64; 3]) -> Self {
        Self { within, ..self }
    }
}

/// Both streams of [`session`], the gyroscope also at the accelerometer's stamps.
#[derive(Debug)]
pub struct Samples {
    /// The accelerometer, m/s².
    pub accel: Stream,
    /// The gyroscope, rad/s.
    pub gyro: Stream,
    /// The gyroscope at the accelerometer's stamps.
    pub together: Vec<Vector3<f64>>,
}

impl Samples {
    /// Those of the session.
    pub fn of_session() -> Self {
        let Recording {
            accelerometer,
            gyroscope,
            ..
        } = session();
        let (accel, gyro) = (
            accelerometer.unwrap_or_default(),
            gyroscope.unwrap_or_default(),
        );
        let together = accel.t.iter().filter_map(|t| gyro.at(*t)).collect();
        Self {
            accel,
            gyro,
            together,
        }
    }

    /// Stamp, force and rate of every row.
    pub(super) fn rows(&self) -> impl Iterator<Item = (f64, Vector3<f64>, Vector3<f64>)> {
        let rows = self
            .accel
            .t
            .iter()
            .zip(&self.accel.values)
            .zip(&self.together);
        rows.map(|((t, force), rate)| (*t, *force, *rate))
    }
}

/// A device that rests in ten attitudes and turns between them, the gyroscope 3 ms behind the accelerometer.
pub fn session() -> Recording {
    let (mut accel, mut gyro) = (Stream::default(), Stream::default());
    let mut attitude = Rotation3::identity();
    let mut sample = 0;
    let noise = |k: usize, axis: usize| {
        ((k * (2 * axis + 3)) as f64 * 0.7).sin() + ((k * 7) as f64 * 1.3 + axis as f64).cos()
    };
    for place in 0..10 {
        let axis = Unit::new_normalize(Vector3::new(
            1.0,
            (place % 3) as f64 - 1.0,
            0.4 * (place % 4) as f64 - 0.5,
        ));
        for k in 0..700 {
            // A smooth turn behind every rest of 5 s.
            let phase = ((k as f64 - 500.0) / 200.0).clamp(0.0, 1.0);
            let speed = (1.0 + 0.05 * place as f64) * (std::f64::consts::PI * phase).sin().powi(2);
            attitude = Rotation3::from_axis_angle(&axis, -speed * 0.01) * attitude;
            let shake = Vector3::from_fn(|i, _| noise(sample, i));
            let t = sample as f64 * 0.01;
            accel.t.push(t);
            accel.values.push(
                attitude * Vector3::z() * 9.80665 + shake * 2e-3 + Vector3::new(0.05, -0.1, 0.02),
            );
            gyro.t.push(t + 0.003);
            gyro.values
                .push(axis.into_inner() * speed + shake * 5e-4 + Vector3::new(2e-3, -1e-3, 5e-4));
            sample += 1;
        }
    }
    Recording {
        name: "session".to_owned(),
        accelerometer: Some(accel),
        gyroscope: Some(gyro),
        ..Recording::default()
    }
}
