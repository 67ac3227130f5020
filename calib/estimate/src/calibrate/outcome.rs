//! A calibration and what it was made from.

use crate::calibration::Calibration;
use crate::methods::joint::JointFit;
use crate::methods::{AccelerometerFit, Choice, GyroscopeFit};

/// A calibration and what it was made from.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The result.
    pub calibration: Calibration,
    /// Segmentation of each recording.
    pub choices: Vec<Choice>,
    /// The fit of the accelerometer.
    pub accelerometer: Option<AccelerometerFit>,
    /// The fit of the gyroscope.
    pub gyroscope: Option<GyroscopeFit>,
    /// The joint fit, of that method.
    pub joint: Option<JointFit>,
}
