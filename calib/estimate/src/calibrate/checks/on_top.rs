//! Readings that a system has corrected before they were recorded.

use findings::{Finding, Kind};
use recording::Recording;
use recording::intervals::Segmentation;
use sensor::Sensor;

findings::tuning! {
    /// A mean of an interval is zero to within so many of its standard errors ...
    ZERO: f64 = 5.0;

    /// ... in so many of the intervals, on each axis.
    SHARE: f64 = 0.8;

    /// The mean over all intervals is zero to within so many of its standard errors, ...
    TOGETHER: f64 = 3.0;

    /// ... which are no larger than this, rad/s: a bias is seldom smaller than larger ones.
    TELLS: f64 = 1e-3;

    /// Fewest static intervals.
    FEWEST: usize = 6;
}

/// Returns the finding that a gyroscope reads nothing at rest, as none does whose readings nobody corrected.
pub fn corrected_before(recording: &Recording, segmentation: &Segmentation) -> Option<Finding> {
    reads_zero_at_rest(recording, segmentation).then(|| {
        Finding::of(Kind::BIAS_REMOVED_BEFORE)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Gyroscope)
    })
}

/// Returns true if the gyroscope reads zero in the static intervals, as no uncorrected sensor does.
pub(in crate::calibrate) fn reads_zero_at_rest(
    recording: &Recording,
    segmentation: &Segmentation,
) -> bool {
    if recording.gyroscope.is_none() {
        return false;
    }
    let means: Vec<_> = segmentation
        .statics
        .iter()
        .filter_map(|rest| rest.gyroscope)
        .filter(|m| m.count > 1 && m.white_of_mean() > 0.0)
        .collect();
    if means.len() < FEWEST.get() {
        return false;
    }
    let is_zero = |axis: usize| {
        let near = means
            .iter()
            .filter(|m| m.mean[axis].abs() < ZERO.get() * m.white_of_mean());
        // A dead zone reads zero as well, and is named by itself.
        let moves = means.iter().all(|m| m.covariance[(axis, axis)] > 0.0);
        moves
            && near.count() as f64 >= SHARE.get() * means.len() as f64
            && is_zero_together(means.iter().map(|m| m.mean[axis]))
    };
    (0..3).all(is_zero)
}

/// Returns true if the mean over all intervals is zero to within its standard error by their scatter: with the tremor of a
/// hand any bias is within the noise of one interval.
fn is_zero_together(means: impl ExactSizeIterator<Item = f64> + Clone) -> bool {
    let n = means.len() as f64;
    let mean = means.clone().sum::<f64>() / n;
    let variance = means.map(|m| (m - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    let error = (variance / n).sqrt();
    error < TELLS.get() && mean.abs() < TOGETHER.get() * error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bias_that_a_hand_hides_in_each_interval_shows_in_all_together() {
        // 13 mrad/s, from interval to interval 3 more or less.
        let means = (0..36).map(|k| 13e-3 + if k % 2 == 0 { 3e-3 } else { -3e-3 });
        assert!(!is_zero_together(means));
        let means = (0..36).map(|k| if k % 2 == 0 { 3e-3 } else { -3.2e-3 });
        assert!(is_zero_together(means));
    }
}
