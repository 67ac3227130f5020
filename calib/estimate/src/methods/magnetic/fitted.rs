//! Result of a fit of a magnetometer.

use nalgebra::{DMatrix, Vector3};

use super::placement::Placement;

/// The field of one recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Its strength.
    pub strength: f64,
    /// Standard error; `None` where it was given.
    pub strength_std: Option<f64>,
    /// Angle below the horizontal, rad.
    pub inclination: f64,
    /// Standard error.
    pub inclination_std: f64,
}

/// The bias of one recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnBias {
    /// Its value.
    pub value: [f64; 3],
    /// Standard errors.
    pub std: [f64; 3],
}

/// Values and their covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Values.
    pub values: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
}

/// The result.
#[derive(Clone, Debug)]
pub struct MagneticFit {
    /// Parameters of the model.
    pub model: Fitted,
    /// Errors of the other sensors as the magnetometer sees them.
    pub errors: Fitted,
    /// Covariance of `model` (rows) with `errors` (columns).
    pub between: DMatrix<f64>,
    /// The field of each recording.
    pub fields: Vec<Field>,
    /// The bias of each part: magnets that turn with the device may have moved in between. That of the last is the
    /// model's.
    pub biases: Vec<OwnBias>,
    /// Unevenness of the field: standard deviation per axis from place to place, in the unit of the readings.
    pub unevenness: f64,
    /// Reading less model, root mean square of an axis.
    pub residual_rms: f64,
    /// The same squared over the noise within the intervals, per degree of freedom.
    pub reduced_chi2: f64,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Placements that were fitted to.
    pub placements: Vec<Placement>,
    /// Reading less model of each of them, in the unit of the readings.
    pub left: Vec<Vector3<f64>>,
    /// Places of those whose reading is left out because the field was another there, with its difference (norm).
    pub disturbed: Vec<(usize, f64)>,
    /// Probability that noise makes the turns about the vertical disagree so much with the headings; 1 without turns.
    pub turns_p_value: f64,
    /// Free parameters.
    pub rank: usize,
    /// Turns used.
    pub turns: usize,
}
