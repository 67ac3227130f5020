//! Short stretches in which nothing moves, and what they tell of unnamed sensors.

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::averages::median;
use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Samples looked at: three hours' at 100 Hz.
    LOOKED_AT: usize = 1_000_000;
    /// Samples of a window.
    WINDOW: usize = 40;
    /// Windows quieter than this times the quietest tenth are at rest.
    QUIET: f64 = 16.0;
    /// The quietest tenth is at rest if it is this much quieter than the whole.
    STILL: f64 = 0.02;
}

/// Means of two sensors while neither changed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest {
    /// Samples from here.
    pub from: usize,
    /// To here.
    pub to: usize,
    /// Means of both.
    pub means: [Vector3<f64>; 2],
}

fn moments(values: &[Vector3<f64>]) -> (Vector3<f64>, f64) {
    let count = values.len().max(1) as f64;
    let mean: Vector3<f64> = values.iter().sum::<Vector3<f64>>() / count;
    let squares: f64 = values
        .iter()
        .map(|value| (value - mean).norm_squared())
        .sum();
    (mean, squares / count)
}

/// The stretches of rest of two sensors in the same rows; none where it does not move and rest by turns.
pub(crate) fn rests(first: &[Vector3<f64>], second: &[Vector3<f64>]) -> Vec<Rest> {
    let sensors = [first, second];
    let windows = sensors.map(|values| {
        values
            .chunks_exact(WINDOW.get())
            .map(moments)
            .collect::<Vec<_>>()
    });
    let count = windows[0].len().min(windows[1].len());
    if count < 20 {
        return Vec::new();
    }
    let quiet: Option<Vec<f64>> = (0..2)
        .map(|k| {
            let whole = moments(sensors[k]).1;
            let tenth = nth_smallest(windows[k].iter().map(|w| w.1), count / 10)?;
            // Readings of whole steps may not change at all for a while.
            (tenth <= STILL.get() * whole).then(|| (QUIET.get() * tenth).max(1e-6 * whole))
        })
        .collect();
    let Some(quiet) = quiet else {
        return Vec::new();
    };
    let is_still = |at: usize| (0..2).all(|k| windows[k][at].1 <= quiet[k]);
    let mut rests: Vec<Rest> = Vec::new();
    let mut start = None;
    for at in 0..=count {
        match (at < count && is_still(at), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                // The middle half: a slow turn begins and ends as if nothing moved.
                let margin = (at - from) / 4;
                let range = (from + margin) * WINDOW.get()..(at - margin) * WINDOW.get();
                let means = sensors.map(|values| moments(&values[range.clone()]).0);
                rests.push(Rest {
                    from: range.start,
                    to: range.end,
                    means,
                });
                start = None;
            }
            _ => {}
        }
    }
    rests
}

/// Returns the index of the accelerometer of two sensors in the same rows: its mean in static intervals turns with gravity, while a
/// gyroscope's is always its bias. `None` if the static intervals do not tell.
pub(crate) fn accelerometer(sensors: [&[Vector3<f64>]; 2]) -> Option<usize> {
    let sensors = sensors.map(|values| &values[..values.len().min(LOOKED_AT.get())]);
    let rests = rests(sensors[0], sensors[1]);
    if rests.len() < 3 {
        return None;
    }
    let means = [0, 1].map(|k| rests.iter().map(|rest| rest.means[k]).collect::<Vec<_>>());
    let shares = |size: fn(&[Vector3<f64>]) -> f64| {
        [0, 1].map(|k| size(&means[k]) / moments(sensors[k]).1.sqrt())
    };
    let told = |shares: [f64; 2]| match shares {
        [first, second] if first > 0.5 && second < 0.25 => Some(0),
        [first, second] if second > 0.5 && first < 0.25 => Some(1),
        _ => None,
    };
    // The middle of a slow turn may look like a rest: the usual distance does not mind, the root mean square does. Of
    // a recording that rests mostly in one attitude it is the other way round.
    told(shares(usual_distance)).or_else(|| told(shares(|means| moments(means).1.sqrt())))
}

/// Returns true if the second sensor's means in static intervals are gravity: of one norm, or on a sphere about its bias.
pub(crate) fn is_gravity(first: &[Vector3<f64>], second: &[Vector3<f64>]) -> bool {
    let [first, second] =
        [first, second].map(|values| &values[..values.len().min(LOOKED_AT.get())]);
    let rests = rests(first, second);
    let means: Vec<Vector3<f64>> = rests.iter().map(|rest| rest.means[1]).collect();
    let Some(usual) = median(means.iter().map(Vector3::norm)) else {
        return false;
    };
    let others = means
        .iter()
        .filter(|mean| (mean.norm() - usual).abs() > 0.25 * usual);
    (usual > 0.0 && 10 * others.count() <= means.len()) || sphere(&means).is_some()
}

/// Returns true if the mean of a sensor exceeds its spread: an accelerometer in one orientation, and no gyroscope.
pub(crate) fn has_gravity(values: &[Vector3<f64>]) -> bool {
    let (mean, square) = moments(&values[..values.len().min(LOOKED_AT.get())]);
    mean.norm() > square.sqrt()
}

/// The median distance from the median of every axis.
fn usual_distance(means: &[Vector3<f64>]) -> f64 {
    let middle =
        Vector3::from_fn(|axis, _| median(means.iter().map(|mean| mean[axis])).unwrap_or_default());
    median(means.iter().map(|mean| (mean - middle).norm())).unwrap_or_default()
}

/// True for a sensor that moves and rests by turns, and always rests at the same reading.
pub(crate) fn at_one_reading(values: &[Vector3<f64>]) -> bool {
    let values = &values[..values.len().min(LOOKED_AT.get())];
    let rests = rests(values, values);
    let means: Vec<Vector3<f64>> = rests.iter().map(|rest| rest.means[0]).collect();
    means.len() >= 3 && usual_distance(&means) < 0.1 * moments(values).1.sqrt()
}

/// The noise of an axis, root mean square, and the mean of a sensor that rests from beginning to end; `None` for one
/// that moves.
pub(crate) fn rest_throughout(values: &[Vector3<f64>]) -> Option<(f64, Vector3<f64>)> {
    let values = &values[..values.len().min(LOOKED_AT.get())];
    let windows: Vec<f64> = values
        .chunks_exact(WINDOW.get())
        .map(|window| moments(window).1)
        .collect();
    let (count, (mean, whole)) = (windows.len(), moments(values));
    let share = |share: usize| nth_smallest(windows.iter().copied(), count * share / 20);
    let (quiet, usual, loud) = (share(2)?, share(10)?, share(19)?);
    let rests = count >= 5 && loud <= QUIET.get() * quiet && whole <= QUIET.get() * usual;
    rests.then(|| ((usual / 3.0).sqrt(), mean))
}

/// Centre and radius of the sphere on which an accelerometer's means at rest lie, `‖m - c‖ = r`; `None` where they
/// do not determine one.
pub(crate) fn sphere(means: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    if means.len() < 6 {
        return None;
    }
    let scale = means.iter().map(Vector3::norm).sum::<f64>() / means.len() as f64;
    let mut normal = Matrix4::zeros();
    let mut right = Vector4::zeros();
    for mean in means {
        let m = mean / scale;
        let row = Vector4::new(2.0 * m.x, 2.0 * m.y, 2.0 * m.z, 1.0);
        normal += row * row.transpose();
        right += row * m.norm_squared();
    }
    let eigen = normal.symmetric_eigenvalues();
    if eigen.min() < 0.01 * eigen.max() {
        return None;
    }
    let x = normal.cholesky()?.solve(&right);
    let centre = Vector3::new(x[0], x[1], x[2]);
    let radius = (x[3] + centre.norm_squared()).max(0.0).sqrt();
    let off = means
        .iter()
        .map(|mean| ((mean / scale - centre).norm() - radius).powi(2));
    let rms = (off.sum::<f64>() / means.len() as f64).sqrt();
    (rms < 0.1 * radius).then_some((centre * scale, radius * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_that_always_reads_about_the_same_has_gravity_and_one_that_turns_has_not() {
        let wave = |k: usize| Vector3::new(0.2, 2.0 * (0.1 * k as f64).sin(), 0.1);
        let [turning, resting]: [Vec<_>; 2] = [0.0, 9.8].map(|g| {
            let readings = (0..1000).map(|k| wave(k) + Vector3::z() * g);
            readings.collect()
        });
        assert!(has_gravity(&resting) && !has_gravity(&turning));
    }

    /// Rests in eight directions, quarter turns between them.
    fn sensors(bias: f64) -> [Vec<Vector3<f64>>; 2] {
        let noise = |k: usize, i: usize| 0.003 * ((k * 7 + i * 3) as f64).sin();
        let mut all = [Vec::new(), Vec::new()];
        for place in 0..8usize {
            for k in 0..400 {
                let turned = (k as f64 / 400.0 - 0.5).max(0.0) * 2.0;
                let angle = (place as f64 + turned) * 0.8;
                let tilt = (place as f64 + turned) * 1.3;
                let up = Vector3::new(
                    angle.sin() * tilt.cos(),
                    angle.cos() * tilt.cos(),
                    tilt.sin(),
                );
                let rate = if k < 200 {
                    Vector3::zeros()
                } else {
                    Vector3::new(0.9, -0.3, 0.5)
                };
                all[0].push(up + Vector3::x() * bias + Vector3::from_fn(|i, _| noise(k, i)));
                all[1].push(rate + Vector3::repeat(0.1) + Vector3::from_fn(|i, _| noise(k + 3, i)));
            }
        }
        all
    }

    #[test]
    fn a_stretch_of_a_slow_turn_that_looks_like_a_rest_does_not_hide_the_accelerometer() {
        let [accel, mut gyro] = sensors(0.2);
        // Even turns are as quiet as rests: of one of them the middle stands still for both sensors.
        let mut accel = accel;
        let (still, rate) = (accel[700], gyro[700]);
        for at in 640..800 {
            accel[at] = still + (accel[at % 100] - accel[0]) * 1e-3;
            gyro[at] = rate;
        }
        assert_eq!(accelerometer([&accel, &gyro]), Some(0));
        assert_eq!(accelerometer([&gyro, &accel]), Some(1));
    }

    #[test]
    fn a_sensor_that_rests_throughout_is_told_from_one_that_turns() {
        let [_, gyro] = sensors(0.0);
        assert_eq!(rest_throughout(&gyro), None);
        let rest: Vec<Vector3<f64>> = (0..400)
            .map(|k| Vector3::from_fn(|i, _| 0.5 + 0.1 * f64::from(k * (i as i32 + 3)).sin()))
            .collect();
        let (noise, mean) = rest_throughout(&rest).unwrap();
        assert!((noise - 0.1 / 2f64.sqrt()).abs() < 0.01, "{noise}");
        assert!((mean.x - 0.5).abs() < 0.01, "{mean}");
    }

    #[test]
    fn the_accelerometer_is_the_one_whose_mean_turns() {
        for bias in [0.0, 0.5] {
            let [accel, gyro] = sensors(bias);
            assert_eq!(accelerometer([&accel, &gyro]), Some(0));
            assert_eq!(accelerometer([&gyro, &accel]), Some(1));
            // Of a turn at an even rate alone nobody can tell that it is no rest.
            let uneven = |(k, rate): (usize, &Vector3<f64>)| rate * (1.0 + (0.05 * k as f64).sin());
            let turns = gyro
                .iter()
                .enumerate()
                .map(|(k, rate)| match k % 400 < 200 {
                    true => *rate,
                    false => uneven((k, rate)),
                });
            let turns: Vec<_> = turns.collect();
            assert!(at_one_reading(&turns) && !at_one_reading(&accel));
            assert!(is_gravity(&gyro, &accel));
            // The rates of a rate table are of no one length.
            let rates: Vec<_> = (0..3200)
                .map(|k| gyro[k % 200] + Vector3::x() * (k / 400) as f64)
                .collect();
            assert!(!is_gravity(&accel, &rates));
            let means: Vec<_> = rests(&accel, &gyro)
                .iter()
                .map(|rest| rest.means[0])
                .collect();
            let (centre, radius) = sphere(&means).unwrap();
            assert!(
                (radius - 1.0).abs() < 0.02 && (centre.x - bias).abs() < 0.02,
                "{centre} {radius}"
            );
        }
        let [accel, gyro] = sensors(0.0);
        assert_eq!(accelerometer([&accel[..200], &gyro[..200]]), None);
    }
}
