//! Detection of a device that is held in the hand.

use nalgebra::Vector3;

use crate::averages::median;
use crate::readings::symptom::Symptom;
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Length of the windows looked at, s.
    WINDOW: f64 = 0.5;
    /// Length of the pieces whose means waver in a hand, s.
    PIECE: f64 = 0.05;

    /// The share of windows that are taken to be the quietest.
    QUIET_SHARE: f64 = 0.1;

    /// A rate that wavers by more than this is no noise of a sensor on a table, rad/s; a hand gives 10 to 100.
    OF_A_HAND: f64 = 8e-3;

    /// A hand that holds still wavers by less than this, rad/s.
    pub FASTEST_HAND: f64 = 0.2;

    /// The means of pieces vary by so many times what independent samples would, as those of a tremor do.
    BEYOND_NOISE: f64 = 2.0;
}

/// Root mean square per axis of the wavering rate in the quietest tenth of windows of half a second, rad/s, where
/// it is that of a hand; `None` where the device lay still or has no gyroscope in rad/s.
pub fn tremor(recording: &Recording) -> Option<f64> {
    let stream = recording.gyroscope.as_ref()?;
    let step = stream.median_step()?;
    let per_piece = (PIECE.get() / step).round().max(1.0) as usize;
    let pieces = (WINDOW.get() / (per_piece as f64 * step)) as usize;
    if pieces < 5 || !is_si(recording) {
        return None;
    }
    let mut windows: Vec<(f64, f64, f64)> = stream
        .values
        .chunks_exact(per_piece * pieces)
        .map(|window| wavering(window, per_piece))
        .collect();
    windows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let quiet = (QUIET_SHARE.get() * windows.len() as f64) as usize;
    let &(rate, ratio, _) = windows.get(quiet)?;
    // What goes on turning is no hand that holds still.
    let turning = median(windows[..=quiet].iter().map(|window| window.2))?;
    if turning > FASTEST_HAND.get() {
        return None;
    }
    (rate > OF_A_HAND.get() && (per_piece == 1 || ratio > BEYOND_NOISE.get())).then_some(rate)
}

/// The standard deviation of the means of pieces, its ratio to that of independent samples, and the mean rate.
fn wavering(window: &[Vector3<f64>], per_piece: usize) -> (f64, f64, f64) {
    let mean_of =
        |values: &[Vector3<f64>]| values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64;
    let mean = mean_of(window);
    let square = |values: &mut dyn Iterator<Item = Vector3<f64>>| {
        let (mut sum, mut count) = (0.0, 0.0);
        for value in values {
            sum += (value - mean).norm_squared();
            count += 1.0;
        }
        sum / 3.0 / f64::max(count - 1.0, 1.0)
    };
    let between = square(&mut window.chunks_exact(per_piece).map(mean_of));
    // Neighbouring differences hold the noise and little of the tremor.
    let differences = window
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm_squared());
    let noise = differences.sum::<f64>() / 6.0 / (window.len() - 1).max(1) as f64;
    let independent = noise / per_piece as f64;
    let ratio = (between / independent.max(1e-300)).sqrt();
    (between.sqrt(), ratio, mean.norm())
}

/// Returns true if the readings can be rad/s: the norm of the accelerometer beside them is that of gravity in m/s².
fn is_si(recording: &Recording) -> bool {
    let norm = |stream: &Stream| median(stream.values.iter().map(Vector3::norm));
    let force = recording.accelerometer.as_ref().and_then(norm);
    force.is_none_or(|f| (5.0..15.0).contains(&f))
}

pub(in crate::readings) fn found(recording: &Recording) -> Option<Symptom> {
    let rate = tremor(recording).filter(|&rate| rate < FASTEST_HAND.get())?;
    Some(Symptom::HandHeld { rate })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording(tremor: f64, noise: f64) -> Recording {
        let t: Vec<f64> = (0..6000).map(|k| 0.01 * f64::from(k)).collect();
        let value = |(k, &t): (usize, &f64)| {
            let jitter = noise * ((k * k % 997) as f64 / 288.0 - 1.73);
            let wave = |f: f64| tremor * 1.4 * (std::f64::consts::TAU * f * t).sin() + jitter;
            Vector3::new(wave(6.3), wave(7.1), wave(8.9))
        };
        let values = t.iter().enumerate().map(value).collect();
        Recording {
            gyroscope: Some(Stream { t, values }),
            ..Recording::default()
        }
    }

    #[test]
    fn a_hand_wavers_and_a_noisy_sensor_does_not() {
        let found = super::tremor(&recording(0.05, 0.001)).unwrap();
        assert!((found / 0.05 - 1.0).abs() < 0.5, "{found}");
        assert_eq!(super::tremor(&recording(0.0, 0.02)), None);
        assert_eq!(super::tremor(&recording(0.001, 0.001)), None);
    }

    #[test]
    fn a_table_that_turns_all_the_time_is_no_hand() {
        let mut table = recording(0.05, 0.001);
        let stream = table.gyroscope.as_mut().unwrap();
        stream.values.iter_mut().for_each(|w| w.z += 0.5);
        assert_eq!(super::tremor(&table), None);
    }
}
