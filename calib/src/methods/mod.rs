//! Ways from static intervals and turns to a calibration.

mod first_guess;
mod fitted;
mod gyro_guess;
mod gyroscope;
pub mod joint;
pub mod online_bias;
mod outliers;
pub mod six_position;
pub(crate) mod small_sample;
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

use crate::covariates::{last_changes, vibrations};
use crate::intervals::{Moments, Segmentation, StaticInterval};
use crate::recording::Recording;
use crate::residuals::StaticMean;

/// The accelerometer's means over the rests of a recording, with what effects ask for.
pub fn static_means(recording: &Recording, segmentation: &Segmentation) -> Vec<StaticMean> {
    let rests: Vec<(&StaticInterval, Moments)> = segmentation
        .statics
        .iter()
        .filter_map(|rest| Some((rest, rest.accelerometer?)))
        .collect();
    let forces: Vec<Vector3<f64>> = rests.iter().map(|(_, m)| m.mean).collect();
    let variances: Vec<Vector3<f64>> = rests.iter().map(|(_, m)| m.covariance.diagonal()).collect();
    let (changes, shaking) = (last_changes(&forces), vibrations(&variances));
    rests
        .into_iter()
        .zip(changes.into_iter().zip(shaking))
        .map(|((rest, moments), (last_change, vibration))| StaticMean {
            raw: moments.mean,
            rest: Kinematics {
                last_change,
                vibration,
                ..known_of(recording, rest, Vector3::zeros())
            },
            white: moments.white_of_mean(),
        })
        .collect()
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
