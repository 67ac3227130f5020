//! An effect that a calibration leaves out.

use serde::{Deserialize, Serialize};

/// An effect that the model leaves out: how far off it may put the parameter that it moves most.
///
/// The standard errors of a calibration hold for sensors without further effects. Where a sensor has this one, as large as is
/// usual in consumer-grade sensors and as far as the recording does not show otherwise, errors are larger.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Name of the effect in the catalogue, or of the finding that says so where it shows.
    pub effect: String,
    /// Name of the parameter.
    pub parameter: String,
    /// Root mean square of the error that leaving it out adds, beside the standard error; in the unit of the parameter.
    pub std_added: f64,
}
