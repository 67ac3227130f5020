//! Ways from static intervals and turns to a calibration.

mod bias_errors;
pub mod chance;
pub mod earth;
mod ending;
pub(crate) mod first_guess;
mod fitted;
mod gyro_guess;
mod gyroscope;
pub mod joint;
pub(crate) mod left_out;
pub mod magnetic;
pub mod online_bias;
mod outliers;
pub mod six_position;
pub(crate) mod small_sample;
mod stepwise;
mod threshold;

pub use crate::truth::RawUnit;
pub use ending::Ending;
pub use first_guess::accelerometer_unit;
pub use fitted::Fitted;
pub use gyro_guess::{GyroGuess, gyroscope_guess};
pub use gyroscope::{GyroscopeData, GyroscopeFit, GyroscopeRequest, fit_gyroscope};
pub use outliers::{Outlier, outliers};
pub use stepwise::{AccelerometerFit, AccelerometerRequest, fit_accelerometer, step_two};
pub use threshold::{Choice, MULTIPLIERS, OfAnother, Trial, choose_multiplier, cut, cut_several};

use recording::Recording;
use recording::intervals::Segmentation;

use crate::residuals::StaticMean;
use crate::truth::{Models, Truth};

/// The accelerometer's means over the static intervals of a recording; of the truth there time and temperature are known.
pub fn static_means(recording: &Recording, segmentation: &Segmentation) -> Vec<StaticMean> {
    let truth = Truth::as_far_as_known(recording, Some(segmentation), Models::default());
    static_means_by(&truth, segmentation)
}

/// The same with the truth that effects look at.
pub fn static_means_by(truth: &Truth<'_>, segmentation: &Segmentation) -> Vec<StaticMean> {
    let statics = segmentation.statics.iter().enumerate();
    statics
        .filter_map(|(k, rest)| {
            let moments = rest.accelerometer?;
            Some(StaticMean {
                raw: moments.mean,
                rest: truth.at_rest(k),
                white: moments.white_of_mean(),
            })
        })
        .collect()
}
