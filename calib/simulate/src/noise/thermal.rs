//! A bias that moves while the device warms up, without a thermometer to show it.

use nalgebra::Vector3;
use sensor::Sensor;

use crate::random::{Purpose, Random};

/// `b(t) = d (1 − exp(−3t/T))/(1 − exp(−3))` in a random direction: 0 at the first sample, `d` at the end `T`.
#[derive(Clone, Debug)]
pub(crate) struct Thermal {
    moved: Vector3<f64>,
    /// Samples from begin to end.
    length: f64,
    count: f64,
}

/// Time constants in a session.
const CONSTANTS: f64 = 3.0;

impl Thermal {
    /// A bias that moves by `size` (norm) within `length` samples.
    pub fn new(size: f64, length: f64, seed: u64, sensor: Sensor) -> Self {
        let mut random = Random::new(seed, Purpose::Thermal(sensor));
        Self {
            moved: random.direction() * size,
            length: length.max(1.0),
            count: 0.0,
        }
    }

    /// The bias less its value at the first sample.
    pub fn value(&self) -> Vector3<f64> {
        let share = (-CONSTANTS * self.count / self.length).exp_m1() / (-CONSTANTS).exp_m1();
        self.moved * share
    }

    /// Goes on to the next sample.
    pub fn step(&mut self) {
        self.count += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bias_has_moved_by_its_size_at_the_end_and_by_most_of_it_half_way() {
        let mut thermal = Thermal::new(0.01, 1000.0, 3, Sensor::Accelerometer);
        let mut norms = Vec::new();
        for _ in 0..=1000 {
            norms.push(thermal.value().norm());
            thermal.step();
        }
        assert_eq!(norms[0], 0.0);
        // (1 − e^−1.5)/(1 − e^−3) = 1/(1 + e^−1.5)
        assert!((norms[500] / 0.01 - 0.817_574_476).abs() < 1e-9);
        assert!((norms[1000] / 0.01 - 1.0).abs() < 1e-12);
    }
}
