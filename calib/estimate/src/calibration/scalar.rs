//! A sensor of one dimension in `cal.json`.

use findings::{Finding, Kind};
use recording::Error;
use sensor::ScalarSensorRef;
use serde::{Deserialize, Serialize};

use super::{Calibration, EffectParameter};
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

impl Calibration {
    /// The calibration of a sensor of one dimension.
    pub fn scalar(&self, name: &str) -> Option<&ScalarValues> {
        self.scalars.iter().find(|own| own.name == name)
    }

    /// The same, as read from a file, with the sensors of one dimension that this program knows.
    ///
    /// # Errors
    /// [`Error::Input`] where a sensor has other parameters than the file.
    pub fn with_sensors(mut self, sensors: &[ScalarSensorRef]) -> Result<Self, Error> {
        for values in &mut self.scalars {
            let Some(sensor) = sensors.iter().find(|own| own.name() == values.name) else {
                continue;
            };
            let own: Vec<&str> = sensor.params().iter().map(|p| &*p.name).collect();
            let found: Vec<&str> = values.parameters.iter().map(|p| p.name.as_str()).collect();
            if own != found {
                return Err(Error::input(
                    Finding::of(Kind::EntryOther)
                        .detail("key", format!("scalars.{}.parameters", values.name))
                        .detail("found", found.join(", "))
                        .detail("expected", own.join(", ")),
                ));
            }
            values.sensor = Some(sensor.clone());
        }
        Ok(self)
    }
}
