//! Readings that a system has corrected before they were recorded.

use recording::Recording;
use recording::intervals::Segmentation;

/// A mean of an interval is zero to within so many of its standard errors ...
const ZERO: f64 = 5.0;

/// ... in so many of the intervals, on each axis.
const SHARE: f64 = 0.8;

/// Fewest static intervals.
const FEWEST: usize = 6;

/// Says where the gyroscope reads nothing at rest, as no sensor does by itself.
pub(in crate::calibrate) fn corrected_before(
    recording: &Recording,
    segmentation: &Segmentation,
) -> Option<String> {
    let means: Vec<_> = segmentation
        .statics
        .iter()
        .filter_map(|rest| rest.gyroscope)
        .filter(|m| m.count > 1 && m.white_of_mean() > 0.0)
        .collect();
    if means.len() < FEWEST {
        return None;
    }
    let is_zero = |axis: usize| {
        let near = means
            .iter()
            .filter(|m| m.mean[axis].abs() < ZERO * m.white_of_mean());
        // A dead zone reads zero as well, and is named by itself.
        let moves = means.iter().all(|m| m.covariance[(axis, axis)] > 0.0);
        moves && near.count() as f64 >= SHARE * means.len() as f64
    };
    (0..3).all(is_zero).then(|| {
        format!(
            "{}: the gyroscope reads zero at rest on all axes to within its noise: the system that recorded it has \
             taken the bias off. These parameters are on top of the system's, and hold as long as it does not change \
             them; record uncalibrated readings where there are any",
            recording.name
        )
    })
}
