//! Readings whose length was divided out: a direction of gravity instead of a force.

use nalgebra::Vector3;

use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Lengths of a normalised reading agree to this share of it, ...
    SAME: f64 = 3e-4;
    /// ... or to a step in which the readings were written, if that is no coarser than this share.
    COARSEST: f64 = 0.011;
    /// Fewest rows that show it.
    FEWEST: usize = 500;
    /// The device turns by more than this, cosine of 30°.
    TURNED: f64 = 0.87;
    /// Noise along a reading that was normalised is no more than this share of that across it, squared.
    FLAT: f64 = 0.1;
    /// A row is noise rather than a turn where it leaves the line through its neighbours by this part of their distance ...
    JUMPS: f64 = 0.25;
    /// ... and so many of the rows are, at rest nearly all, where the steps of the readings hide no noise ...
    NOISY: f64 = 0.3;
    /// ... and so many where they do.
    NOISY_IN_STEPS: f64 = 0.02;
    /// Changes below this share of the length are the computer's rounding.
    NOTHING: f64 = 1e-9;
    /// Noise that is no more than so many steps is that of rounding, if a step is so coarse a share of the length that it hides the
    /// sensor's own.
    ROUNDING: f64 = 4.0;
    /// A step is so coarse a share of the length that it hides the sensor's own noise.
    HIDING: f64 = 8e-4;
}

/// True for readings of the same length in every row, the turns among them, whose noise lies across them: a sensor that reads a
/// force has noise along it, and turns add to its length.
pub(super) fn is_direction(values: &[Vector3<f64>]) -> bool {
    let Some(first) = values.first().filter(|_| values.len() >= FEWEST.get()) else {
        return false;
    };
    let length = values.iter().map(Vector3::norm).sum::<f64>() / values.len() as f64;
    if !(length > 0.0 && length.is_finite()) {
        return false;
    }
    let step = least_step(values, NOTHING.get() * length);
    let allowed = (SAME.get() * length).max(if step <= COARSEST.get() * length {
        step
    } else {
        0.0
    });
    let same = |value: &Vector3<f64>| (value.norm() - length).abs() <= allowed;
    let turns = values
        .iter()
        .any(|value| value.dot(first) < TURNED.get() * length * length);
    turns && values.iter().all(same) && has_no_noise_along(values, step, length)
}

/// The smallest change of an axis from row to row beyond `nothing`.
fn least_step(values: &[Vector3<f64>], nothing: f64) -> f64 {
    let changes = values.windows(2).flat_map(|pair| {
        let change = pair[1] - pair[0];
        [change.x.abs(), change.y.abs(), change.z.abs()]
    });
    changes
        .filter(|change| *change > nothing)
        .fold(f64::INFINITY, f64::min)
}

/// Second differences of rows that do not turn leave the length as it is, or are those of rounding. Readings without any noise
/// are of no sensor. Medians: where a turn begins, the second difference is that of the turn.
fn has_no_noise_along(values: &[Vector3<f64>], step: f64, length: f64) -> bool {
    let (mut along, mut all) = (Vec::new(), Vec::new());
    for three in values.windows(3) {
        let second = three[2] - 2.0 * three[1] + three[0];
        let is_noise = second.norm() > JUMPS.get() * (three[2] - three[0]).norm();
        if is_noise && second.norm() > NOTHING.get() * length {
            let lengths = [0, 1, 2].map(|k| three[k].norm());
            along.push((lengths[2] - 2.0 * lengths[1] + lengths[0]).powi(2));
            all.push(second.norm_squared());
        }
    }
    let share = all.len() as f64 / values.len() as f64;
    let middle = |squares: &[f64]| nth_smallest(squares.iter().copied(), squares.len() / 2);
    let (Some(along), Some(all)) = (middle(&along), middle(&all)) else {
        return false;
    };
    // Steps so coarse a share of the length hide the sensor's own noise.
    let in_steps = step >= HIDING.get() * length && all <= (ROUNDING.get() * step).powi(2);
    match in_steps {
        true => share >= NOISY_IN_STEPS.get(),
        false => share >= NOISY.get() && along <= FLAT.get() * (all - along).max(0.0) / 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rests and turns of an accelerometer with noise of this size, m/s².
    fn readings(size: f64) -> Vec<Vector3<f64>> {
        let noise = |k: usize, i: usize| size * ((k * k * 7 + k * 13 + i * 31) as f64).sin();
        let value = |k: usize| {
            let at = (k / 200) as f64 + ((k % 200) as f64 / 100.0 - 1.0).max(0.0);
            let (sin, cos) = (0.7 * at).sin_cos();
            let up = Vector3::new(sin, cos * (0.4 * at).cos(), cos * (0.4 * at).sin());
            up * 9.8 + Vector3::from_fn(|i, _| noise(k, i))
        };
        (0..2000).map(value).collect()
    }

    #[test]
    fn readings_of_one_length_in_turns_too_are_a_direction_however_they_are_rounded() {
        let readings = readings(0.02);
        assert!(!is_direction(&readings));
        for digits in [2, 3, 4, 9] {
            let unit = 10f64.powi(digits);
            let round = |v: &Vector3<f64>| v.normalize().map(|x| (x * unit).round() / unit);
            let normalised: Vec<_> = readings.iter().map(round).collect();
            assert!(is_direction(&normalised), "{digits} digits");
            let of_gravity: Vec<_> = normalised.iter().map(|v| v * 9.80665).collect();
            assert!(is_direction(&of_gravity), "{digits} digits");
        }
    }

    #[test]
    fn a_good_sensor_and_readings_without_noise_are_a_force() {
        for size in [0.001, 0.0] {
            let written = |v: &Vector3<f64>| v.map(|x| (x * 1e6).round() * 1e-6);
            let readings: Vec<_> = readings(size).iter().map(written).collect();
            assert!(!is_direction(&readings), "{size}");
        }
    }
}
