//! The ends of a sensor's range, where a recording shows them.

use std::cell::LazyCell;

use nalgebra::Vector3;

use crate::readings::Excursion;

findings::tuning! {
    /// So many equal readings in a row at the extreme of an axis are its rail, not a peak: noise alone
    /// keeps a peak from repeating to the last digit.
    RUN_AT_RAIL: usize = 5;

    /// A run that readings in steps make by chance as often as this is none.
    CHANCE: f64 = 0.01;

    /// Readings beside such a run, within a step of it, that a rail has at most, as a share of the run: the top of a
    /// parabola that is read in steps has a fifth of it on either side.
    BESIDE: f64 = 0.2;

    /// The axes of a sensor have one range: a shorter run at the same reading as the rail of another, to this share, is cut off.
    SAME: f64 = 1e-4;
    /// Length of such a shorter run.
    RUN_AT_KNOWN_RAIL: usize = 2;
}

/// The readings at which each axis is cut off; infinite where the recording does not show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rails {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Rails {
    /// Looks for a flat top or bottom of each axis, which readings in steps do not round off.
    pub fn of(values: &[Vector3<f64>]) -> Self {
        // Most recordings show no rail, and are not asked how far it would be.
        let far = LazyCell::new(|| Excursion::of(values));
        let sides = [0, 1, 2].map(|axis| {
            let upwards: Vec<f64> = values.iter().map(|v| v[axis]).collect();
            let downwards: Vec<f64> = upwards.iter().map(|v| -v).collect();
            let (step, longest) = (least_step(&upwards), longest_by_chance(&upwards));
            let ends = [downwards, upwards];
            let found = ends.each_ref().map(|values| rail(values, step, longest));
            let found = match found {
                [None, None] => found,
                [low, high] => {
                    let [low, high] = far.ends(axis, [low.map(|end| -end), high]);
                    [low.map(|end| -end), high]
                }
            };
            let [low, high] = ends;
            [(found[0], low), (found[1], high)]
        });
        let known = sides.iter().flatten().find_map(|(rail, _)| *rail);
        let rails = sides.map(|axis| {
            axis.map(|(rail, values)| {
                let rail = rail.or_else(|| same_rail(&values, known?));
                rail.unwrap_or(f64::INFINITY)
            })
        });
        Self {
            low: Vector3::from_fn(|k, _| -rails[k][0]),
            high: Vector3::from_fn(|k, _| rails[k][1]),
        }
    }

    /// Returns true if any axis of the reading is saturated.
    pub fn reached(&self, value: &Vector3<f64>) -> bool {
        (0..3).any(|k| value[k] <= self.low[k] || value[k] >= self.high[k])
    }
}

/// The smallest step between neighbouring readings that differ; 0 of none.
fn least_step(values: &[f64]) -> f64 {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let least = steps
        .filter(|step| *step > 0.0)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// Returns the shortest run of equal readings that chance does not explain: `n` readings that repeat their neighbour with
/// probability `p` have `n p^(k−1)` runs of `k`.
fn longest_by_chance(values: &[f64]) -> usize {
    let pairs = values.windows(2);
    let equal = pairs.filter(|pair| pair[0] == pair[1]).count() as f64;
    let repeats = equal / values.len().max(2) as f64;
    let runs = (values.len() as f64 / CHANCE.get()).ln() / -repeats.ln();
    RUN_AT_RAIL.get().max(runs.ceil() as usize + 1)
}

/// The largest reading, where a long run of it begins and ends with a leap.
fn rail(values: &[f64], step: f64, longest: usize) -> Option<f64> {
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let is_beside = |value: &&f64| **value >= top - 1.5 * step;
    let mut first = 0;
    for run in values.chunk_by(|a, b| (*a == top) == (*b == top)) {
        let (begin, end) = (first, first + run.len());
        first = end;
        if run[0] != top || run.len() < longest {
            continue;
        }
        let before = values[..begin].iter().rev().take_while(is_beside).count();
        let after = values[end..].iter().take_while(is_beside).count();
        if ((before + after) as f64) < BESIDE.get() * run.len() as f64 {
            return Some(top);
        }
    }
    None
}

/// The largest reading, where it is that at which another axis is cut off and repeats.
fn same_rail(values: &[f64], known: f64) -> Option<f64> {
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut runs = values.chunk_by(|a, b| (*a == top) == (*b == top));
    let repeats = runs.any(|run| run[0] == top && run.len() >= RUN_AT_KNOWN_RAIL.get());
    (repeats && (top - known).abs() <= SAME.get() * known).then_some(top)
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

    #[test]
    fn a_round_peak_that_is_read_in_steps_is_no_rail_and_one_that_is_cut_off_is() {
        let wave = |k: usize, limit: f64| {
            let value = (10.0 * (k as f64 * 0.05).sin()).min(limit);
            (value / 0.1).round() * 0.1
        };
        let values: Vec<_> = (0..300)
            .map(|k| Vector3::new(wave(k, 8.0), wave(k, 20.0), 0.0))
            .collect();
        let rails = Rails::of(&values);
        assert!(rails.reached(&Vector3::new(8.0, 0.0, 0.0)));
        assert!(!rails.reached(&Vector3::new(7.9, 10.0, 0.0)));
    }

    #[test]
    fn a_coarse_reading_at_rest_is_no_rail_where_the_device_turns_one_way_only() {
        let rate = |k: usize| match k % 400 {
            0..100 => 2.0 * (k as f64 % 400.0 * 0.0314).sin(),
            _ => 0.0,
        };
        let values: Vec<_> = (0..4000)
            .map(|k| Vector3::repeat(((rate(k) - 0.03) / 0.04).round() * 0.04))
            .collect();
        assert!(!Rails::of(&values).reached(&Vector3::repeat(-0.04)));
    }

    #[test]
    fn a_short_run_at_the_rail_of_another_axis_is_cut_off_too() {
        let wave = |k: usize, size: f64| size * ((k as f64) * 0.1).sin();
        let values = |limit: f64| -> Vec<_> {
            (0..63)
                .map(|k| Vector3::new(wave(k, 1.0).min(0.8), -wave(k, 0.805).min(limit), 0.0))
                .collect()
        };
        let cut = Rails::of(&values(0.8));
        assert!(cut.reached(&Vector3::new(0.0, -0.8, 0.0)));
        // A peak elsewhere is none, nor is one reading that happens to be there.
        let free = Rails::of(&values(0.9));
        assert!(!free.reached(&Vector3::new(0.0, -0.805, 0.0)));
    }
}
