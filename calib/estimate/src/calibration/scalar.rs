//! A sensor of one dimension in `cal.json`.

use sensor::ScalarSensorRef;
use serde::{Deserialize, Serialize};

use super::effect_values::EffectParameter;

/// The calibration of a sensor of one dimension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScalarValues {
    /// Name of the sensor.
    pub name: String,
    /// Unit of the true signal.
    pub unit: String,
    /// The equation.
    pub model: String,
    /// Its parameters, in order.
    pub parameters: Vec<EffectParameter>,
    /// Their covariance.
    pub covariance: Vec<Vec<f64>>,
    /// Root mean square of the residuals of the means, in the unit of the readings.
    pub residual_rms: f64,
    /// Static intervals used.
    pub static_intervals: usize,
    /// The sensor itself, where this program knows it.
    #[serde(skip)]
    pub sensor: Option<ScalarSensorRef>,
}
