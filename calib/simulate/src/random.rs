//! Random numbers from one seed, a stream per purpose.
//!
//! Every purpose has its own stream of the generator, so that switching one of them off (a shock, a
//! noise term) leaves all others bit for bit as they were.

use std::ops::Range;

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use sensor::Sensor;

/// Purpose of a random stream.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    /// Placements, turns, tremor.
    Motion,
    /// Table contact.
    Shock,
    /// Vibration level of the table in each placement.
    Table,
    /// The vibration itself.
    Vibration,
    /// Thermometer noise.
    Thermometer,
    /// Scale factors, misalignments, biases.
    Errors(Sensor),
    /// White noise.
    White(Sensor),
    /// Bias random walk.
    Walk(Sensor),
    /// Bias instability.
    Instability(Sensor),
    /// Jitter of the time stamps.
    Clock(Sensor),
    /// Unevenness of the sampling.
    Sampling(Sensor),
    /// Samples that are missing.
    Lost(Sensor),
    /// Spikes.
    Spikes(Sensor),
    /// Direction of a thermal drift.
    Thermal(Sensor),
    /// Rocking of the table.
    Rocking,
    /// Motion during the placement with this place in the session.
    Unsteady(usize),
    /// Knocks during turns.
    Knocks,
    /// Coefficients of the effect with this place in the sensor's catalogue.
    Effect(Sensor, usize),
    /// The hidden disturbance with this place in the list.
    Hidden(usize),
    /// The fault with this place in the list.
    Fault(usize),
    /// Deviation of the magnetic field in the placement with this place in the session.
    Uneven(usize),
}

impl Purpose {
    fn stream(self) -> u64 {
        let of = |kind: u64, sensor: Sensor| match sensor {
            Sensor::Accelerometer => 2 * kind,
            Sensor::Gyroscope => 2 * kind + 1,
            Sensor::Magnetometer => (1 << 36) + kind,
        };
        match self {
            Self::Motion => 0,
            Self::Shock => 1,
            Self::Table => 2,
            Self::Vibration => 3,
            Self::Thermometer => 4,
            Self::Errors(sensor) => of(10, sensor),
            Self::White(sensor) => of(11, sensor),
            Self::Walk(sensor) => of(12, sensor),
            Self::Instability(sensor) => of(13, sensor),
            Self::Clock(sensor) => of(14, sensor),
            Self::Rocking => 5,
            Self::Knocks => 7,
            Self::Sampling(sensor) => of(15, sensor),
            Self::Lost(sensor) => of(16, sensor),
            Self::Spikes(sensor) => of(17, sensor),
            Self::Thermal(sensor) => of(18, sensor),
            Self::Effect(sensor, place) => of(1000 + place as u64, sensor),
            Self::Hidden(place) => (1 << 34) + place as u64,
            Self::Unsteady(place) => (1 << 35) + place as u64,
            Self::Fault(place) => (1 << 33) + place as u64,
            Self::Uneven(place) => (1 << 37) + place as u64,
        }
    }
}

/// A generator for one purpose of one simulation.
#[derive(Clone, Debug)]
pub(crate) struct Random(ChaCha8Rng);

impl Random {
    /// The stream of `seed` for `purpose`.
    pub fn new(seed: u64, purpose: Purpose) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(purpose.stream());
        Self(generator)
    }

    /// A standard normal number.
    pub fn normal(&mut self) -> f64 {
        self.0.sample(StandardNormal)
    }

    /// Three standard normal numbers.
    pub fn normal3(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal())
    }

    /// Uniform in `range`.
    pub fn uniform(&mut self, range: Range<f64>) -> f64 {
        range.start + (range.end - range.start) * self.0.random::<f64>()
    }

    /// A whole number from `0` to `n − 1`; `0` for an empty range.
    pub fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { self.0.random_range(0..n) }
    }

    /// A direction, uniform on the sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        self.normal3()
            .try_normalize(1e-9)
            .unwrap_or_else(Vector3::z)
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.0.random::<bool>() { 1.0 } else { -1.0 }
    }

    /// Puts `items` into random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}
