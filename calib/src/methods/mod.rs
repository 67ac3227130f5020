//! Ways from static intervals and turns to a calibration.

mod first_guess;
mod fitted;
mod gyro_guess;
mod gyroscope;
pub mod joint;
pub mod online_bias;
mod outliers;
pub mod six_position;
mod stepwise;
mod threshold;

pub use first_guess::{RawUnit, accelerometer_unit};
pub use fitted::Fitted;
pub use gyro_guess::{GyroGuess, gyroscope_guess};
pub use gyroscope::{GyroscopeData, GyroscopeFit, GyroscopeRequest, fit_gyroscope};
pub use outliers::{Outlier, outliers};
pub use stepwise::{AccelerometerFit, AccelerometerRequest, fit_accelerometer};
pub use threshold::{Choice, MULTIPLIERS, Trial, choose_multiplier, cut};

use nalgebra::Vector3;
use sensor::Kinematics;

use crate::intervals::{Segmentation, StaticInterval};
use crate::recording::Recording;
use crate::residuals::StaticMean;

/// The accelerometer's means over the rests of a recording.
pub fn static_means(recording: &Recording, segmentation: &Segmentation) -> Vec<StaticMean> {
    let mean = |rest: &StaticInterval| {
        let moments = rest.accelerometer?;
        Some(StaticMean {
            raw: moments.mean,
            rest: known_of(recording, rest, Vector3::zeros()),
            white: moments.white_of_mean(),
        })
    };
    segmentation.statics.iter().filter_map(mean).collect()
}

/// What is known of a rest besides a sensor's own reading.
pub(crate) fn known_of(
    recording: &Recording,
    rest: &StaticInterval,
    specific_force: Vector3<f64>,
) -> Kinematics<f64> {
    let mut known = Kinematics::at_rest(specific_force);
    known.time = 0.5 * (rest.span.from + rest.span.to) - recording.start();
    known.temperature = rest.temperature.unwrap_or(known.temperature);
    known
}
