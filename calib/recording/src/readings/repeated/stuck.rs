//! An axis that stops to change while the others go on.

use std::ops::Range;

use nalgebra::Vector3;

use crate::readings::dead_zone::is_left_out;
use crate::readings::of_sensor::least_step;

findings::tuning! {
    /// Shortest run of equal values that is looked at, samples.
    RUN: usize = 100;

    /// Steps of another axis of so many of its least ones are motion or noise, not the flicker of a coarse
    /// reading.
    MOVES: f64 = 4.0;

    /// A run is no chance where the axis should have changed so many times in it ...
    EXPECTED: f64 = 40.0;
    /// ... or so many times where it reads 0, as a dead zone does through a short turn.
    EXPECTED_AT_ZERO: f64 = 400.0;

    /// Readings at the end of the range before the last run of them that show it to be one.
    CLIPPED: usize = 6;
}

/// The longest run of equal values of an axis, where the other axes change in it as they do elsewhere, when
/// this axis changes too. A run at the largest or smallest value is clipped, unless it is the recording's
/// last and the value is not met before; a run at zero is that of a dead zone where the axis has one.
pub(crate) fn stuck(values: &[Vector3<f64>], axis: usize) -> Option<Range<usize>> {
    let run = longest_run(values, axis).filter(|run| run.len() >= RUN.get())?;
    let value = values[run.start][axis];
    let extreme = |sign: f64| values.iter().all(|v| sign * v[axis] <= sign * value);
    let before = values[..run.start].iter();
    let is_met_again = before.filter(|v| v[axis] == value).count() >= CLIPPED.get();
    if (run.end < values.len() || is_met_again) && (extreme(1.0) || extreme(-1.0)) {
        return None;
    }
    if value == 0.0 && is_left_out(values, axis) {
        return None;
    }
    let others = [(axis + 1) % 3, (axis + 2) % 3];
    let least = others.map(|k| least_step(values, k));
    let moves = |pair: &[Vector3<f64>]| {
        others.iter().zip(least).any(|(&k, least)| {
            least.is_some_and(|least| (pair[1][k] - pair[0][k]).abs() >= MOVES.get() * least)
        })
    };
    let within = values[run.clone()].windows(2).filter(|p| moves(p)).count();
    let (mut moving, mut changing) = (0, 0);
    for part in [&values[..run.start], &values[run.end..]] {
        for pair in part.windows(2).filter(|p| moves(p)) {
            moving += 1;
            changing += usize::from(pair[1][axis] != pair[0][axis]);
        }
    }
    let share = changing as f64 / moving.max(1) as f64;
    let needed = if value == 0.0 {
        EXPECTED_AT_ZERO.get()
    } else {
        EXPECTED.get()
    };
    (within as f64 * share >= needed && moving >= RUN.get()).then_some(run)
}

/// The longest run of equal values.
fn longest_run(values: &[Vector3<f64>], axis: usize) -> Option<Range<usize>> {
    let mut longest = 0..0;
    let mut from = 0;
    for k in 1..=values.len() {
        if k == values.len() || values[k][axis] != values[from][axis] {
            if k - from > longest.len() {
                longest = from..k;
            }
            from = k;
        }
    }
    (!longest.is_empty()).then_some(longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy(step: f64) -> Vec<Vector3<f64>> {
        let value = |k: usize| {
            let noise = |m: usize| ((k * k * m) % 997) as f64 / 500.0 - 1.0;
            let v = Vector3::new(noise(3), noise(7), 9.8 + noise(11));
            v.map(|x| (x / step).round() * step)
        };
        (0..3000).map(value).collect()
    }

    #[test]
    fn an_axis_that_stops_is_found_where_it_does() {
        let mut values = noisy(1e-3);
        let last = values[2000].y;
        values[2000..2600].iter_mut().for_each(|v| v.y = last);
        assert_eq!(stuck(&values, 1), Some(2000..2600));
        assert_eq!(stuck(&values, 0), None);
    }

    #[test]
    fn an_axis_that_is_disconnected_reads_zero_to_the_end() {
        let mut values = noisy(1e-3);
        values[1500..].iter_mut().for_each(|v| v.z = 0.0);
        assert_eq!(stuck(&values, 2), Some(1500..3000));
    }

    #[test]
    fn a_dead_zone_is_not_stuck() {
        let mut values = noisy(1e-3);
        let turns = |k: usize| if k < 1500 { 0.01 } else { 1.0 };
        for (k, v) in values.iter_mut().enumerate() {
            v.x *= turns(k);
            v.x = if v.x.abs() < 0.02 { 0.0 } else { v.x };
        }
        assert_eq!(stuck(&values, 0), None);
    }

    #[test]
    fn coarse_readings_at_rest_and_a_clipped_peak_are_not_stuck() {
        let mut coarse = noisy(1.0);
        coarse[500..900]
            .iter_mut()
            .for_each(|v| *v = Vector3::new(0.0, 1.0, 10.0));
        assert_eq!(stuck(&coarse, 1), None);
        let mut clipped = noisy(1e-3);
        clipped[500..900].iter_mut().for_each(|v| v.x = 5.0);
        assert_eq!(stuck(&clipped, 0), None);
    }
}
