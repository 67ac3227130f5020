//! An axis that reads nothing but noise while the others turn.

use nalgebra::Vector3;

use crate::averages::{NORMAL_OVER_MEDIAN, median};
use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Readings that are looked at.
    LOOKED_AT: usize = 100_000;

    /// Share of the readings below and above those whose range counts.
    TAIL: f64 = 0.01;

    /// Range of noise, in standard deviations: 4.7 of white normal noise, and some for a bias that moves.
    OF_NOISE: f64 = 8.0;

    /// Range of an axis that turns, in the same.
    TURNS: f64 = 100.0;
}

/// Returns the axis that reads only noise, if another one turns.
pub fn only_noise(values: &[Vector3<f64>]) -> Option<usize> {
    let stride = values.len().div_ceil(LOOKED_AT.get()).max(1);
    let ranges = [0, 1, 2].map(|axis| range(values, stride, axis));
    let turns = ranges.iter().flatten().any(|range| *range > TURNS.get());
    let is_noise = |axis: &usize| ranges[*axis].is_some_and(|range| range < OF_NOISE.get());
    (0..3).find(is_noise).filter(|_| turns)
}

/// The range of an axis in standard deviations of its noise, by differences of neighbours; `None` where these are zero.
fn range(values: &[Vector3<f64>], stride: usize, axis: usize) -> Option<f64> {
    let pairs = values.windows(2).step_by(stride);
    let steps = pairs.map(|pair| (pair[1][axis] - pair[0][axis]).abs());
    let noise = NORMAL_OVER_MEDIAN * median(steps)? / std::f64::consts::SQRT_2;
    let own = || values.iter().step_by(stride).map(|value| value[axis]);
    let count = own().count();
    let tail = (TAIL.get() * count as f64) as usize;
    let low = nth_smallest(own(), tail)?;
    let high = nth_smallest(own(), count - 1 - tail)?;
    (noise > 0.0).then_some((high - low) / noise)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise of one, an axis that turns, and one that turns `share` times as much.
    fn readings(share: f64) -> Vec<Vector3<f64>> {
        let noise = |k: usize| {
            let bits = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            (0..12)
                .map(|n| ((bits >> (n * 4)) & 15) as f64 / 15.0 - 0.5)
                .sum::<f64>()
        };
        let value = |k: usize| {
            let turn = 500.0 * (0.002 * k as f64).sin().powi(3);
            Vector3::new(
                turn + noise(3 * k),
                noise(3 * k + 1),
                share * turn + noise(3 * k + 2),
            )
        };
        (0..20_000).map(value).collect()
    }

    #[test]
    fn an_axis_without_motion_is_found_and_one_that_turns_a_hundredth_as_much_is_not() {
        assert_eq!(only_noise(&readings(0.5)), Some(1));
        let both: Vec<_> = readings(0.02)
            .iter()
            .map(|v| Vector3::new(v.x, v.z, v.z))
            .collect();
        assert_eq!(only_noise(&both), None);
        let still: Vec<_> = readings(0.0)
            .iter()
            .map(|v| Vector3::new(v.y, v.z, v.y))
            .collect();
        assert_eq!(only_noise(&still), None);
    }
}
