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
        let mut ends = [[End::default(); 3]; 2];
        for value in values {
            for k in 0..3 {
                ends[0][k].look_at(-value[k]);
                ends[1][k].look_at(value[k]);
            }
        }
        let [low, high] = ends;
        let rail = |end: &End, other: &End| {
            if end.longest >= RUN_AT_RAIL && end.top > -other.top {
                end.top
            } else {
                f64::INFINITY
            }
        };
        Self {
            low: Vector3::from_fn(|k, _| -rail(&low[k], &high[k])),
            high: Vector3::from_fn(|k, _| rail(&high[k], &low[k])),
        }
    }

    /// Whether any axis of the reading is cut off.
    pub fn reached(&self, value: &Vector3<f64>) -> bool {
        (0..3).any(|k| value[k] <= self.low[k] || value[k] >= self.high[k])
    }
}

/// The largest reading so far and the longest run of it.
#[derive(Clone, Copy)]
struct End {
    top: f64,
    run: usize,
    longest: usize,
}

impl Default for End {
    fn default() -> Self {
        Self {
            top: f64::NEG_INFINITY,
            run: 0,
            longest: 0,
        }
    }
}

impl End {
    fn look_at(&mut self, value: f64) {
        if value > self.top {
            (self.top, self.run, self.longest) = (value, 1, 1);
        } else if value == self.top {
            self.run += 1;
            self.longest = self.longest.max(self.run);
        } else {
            self.run = 0;
        }
    }
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
