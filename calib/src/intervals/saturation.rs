//! The ends of a sensor's range, where a recording shows them.

use nalgebra::Vector3;

/// So many equal readings in a row at the extreme of an axis are its rail, not a peak: noise alone
/// keeps a peak from repeating to the last digit.
const RUN_AT_RAIL: usize = 5;

/// The readings at which each axis is cut off; infinite where the recording does not show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rails {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Rails {
    /// Looks for a flat top or bottom of each axis.
    pub fn of(values: &[Vector3<f64>]) -> Self {
        let axis = |k: usize, sign: f64| {
            let top = values
                .iter()
                .map(|v| sign * v[k])
                .fold(f64::NEG_INFINITY, f64::max);
            let bottom = values
                .iter()
                .map(|v| sign * v[k])
                .fold(f64::INFINITY, f64::min);
            let run = longest_run(values.iter().map(|v| sign * v[k] == top));
            if run >= RUN_AT_RAIL && top > bottom {
                sign * top
            } else {
                sign * f64::INFINITY
            }
        };
        Self {
            low: Vector3::from_fn(|k, _| axis(k, -1.0)),
            high: Vector3::from_fn(|k, _| axis(k, 1.0)),
        }
    }

    /// Whether any axis of the reading is cut off.
    pub fn reached(&self, value: &Vector3<f64>) -> bool {
        (0..3).any(|k| value[k] <= self.low[k] || value[k] >= self.high[k])
    }
}

fn longest_run(flags: impl Iterator<Item = bool>) -> usize {
    let (mut longest, mut run) = (0, 0);
    for flag in flags {
        run = if flag { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_top_is_a_rail_and_a_sharp_peak_is_not() {
        let wave = |k: usize, limit: f64| ((k as f64) * 0.1).sin().min(limit);
        let values: Vec<_> = (0..63)
            .map(|k| Vector3::new(wave(k, 0.8), wave(k, 2.0), 0.0))
            .collect();
        let rails = Rails::of(&values);
        assert!(rails.reached(&Vector3::new(0.8, 0.0, 0.0)));
        assert!(!rails.reached(&Vector3::new(0.7, 0.999, 0.0)));
    }
}
