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
    /// The two ends of a range lie as far from zero, to this share.
    SAME: f64 = 1e-4;
}

/// Least distance from the usual reading at which an axis can be cut off. Nearer, a reading repeats because the device rests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Excursion {
    usual: Vector3<f64>,
    least: Vector3<f64>,
    steps: Vector3<f64>,
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
            steps: steps.into(),
        }
    }

    /// Returns true if a reading is at least this far from the usual one.
    pub fn reached(&self, axis: usize, value: f64) -> bool {
        (value - self.usual[axis]).abs() >= self.least[axis]
    }

    /// Of two readings, the lowest and the highest, that come again and again, those at which an axis is cut off: what lies as far below zero as above
    /// is a range, however far the other axes go.
    pub fn ends(&self, axis: usize, found: [Option<f64>; 2]) -> [Option<f64>; 2] {
        let is_range = matches!(found, [Some(low), Some(high)] if self.is_range(axis, low, high));
        found.map(|end| end.filter(|end| is_range || self.reached(axis, *end)))
    }

    fn is_range(&self, axis: usize, low: f64, high: f64) -> bool {
        let is_beyond = |end: f64| (end - self.usual[axis]).abs() >= self.steps[axis];
        low < 0.0 && (low + high).abs() <= SAME.get() * high && is_beyond(low) && is_beyond(high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_as_far_below_zero_as_above_is_a_range_however_far_other_axes_go() {
        let wave = |k: usize| (k as f64 * 0.37).sin();
        let values = (0..400)
            .map(|k| Vector3::new((3.0 * wave(k)).clamp(-2.0, 2.0), 9.0 * wave(k + 3), 0.0));
        let far = Excursion::of(&values.collect::<Vec<_>>());
        let ends = [Some(-2.0), Some(2.0)];
        assert_eq!(far.ends(0, ends), ends);
        assert_eq!(far.ends(0, [Some(-2.0), None]), [None; 2]);
        assert_eq!(far.ends(0, [Some(-1.9), Some(2.0)]), [None; 2]);
    }
}
