//! Distance of an axis from its usual reading.

use nalgebra::Vector3;

use crate::order_statistic::nth_smallest;
use crate::recording::stream::least_steps;

findings::tuning! {
    /// The end of a range lies at least this share of the sensor's largest excursion from an axis's usual reading, which lies
    /// nearer to an end that is reached often ...
    FAR: f64 = 1.0 / 3.0;
    /// ... and so many of its least steps.
    STEPS: f64 = 4.0;
}

/// Least distance from the usual reading at which an axis can be cut off. Nearer, a reading repeats because the device rests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Excursion {
    usual: Vector3<f64>,
    least: Vector3<f64>,
}

impl Excursion {
    /// Computes it from the readings of a sensor (`n × 3`).
    pub fn of(values: &[Vector3<f64>]) -> Self {
        let usual = Vector3::from_fn(|axis, _| {
            let column = values.iter().map(move |v| v[axis]);
            nth_smallest(column, values.len() / 2).unwrap_or(0.0)
        });
        let largest = values
            .iter()
            .map(|v| (v - usual).amax())
            .fold(0.0, f64::max);
        let steps = least_steps(values).map(|step| STEPS.get() * step);
        Self {
            usual,
            least: Vector3::from_fn(|axis, _| f64::max(FAR.get() * largest, steps[axis])),
        }
    }

    /// Returns true if a reading is at least this far from the usual one.
    pub fn reached(&self, axis: usize, value: f64) -> bool {
        (value - self.usual[axis]).abs() >= self.least[axis]
    }
}
