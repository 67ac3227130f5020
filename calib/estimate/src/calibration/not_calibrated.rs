//! A sensor that was recorded and is not calibrated: in its place in the file stands why.

use findings::{Finding, Kind, names};
use sensor::Sensor;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Value of `status` in place of the model of a sensor that is not calibrated.
const STATUS: &str = "not_calibrated";

/// Why a sensor is not calibrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum NotCalibratedReason {
    /// Every turn has a gap, is cut off at the end of the range or has frozen readings, or there is no turn.
    NoUsableTurn,
    /// Turns that can be used are fewer than the parameters need.
    TooFewTurns,
    /// The turns that can be used leave a parameter open.
    NotObservable,
}

impl NotCalibratedReason {
    /// In words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::NoUsableTurn => names::NO_TURN,
            Self::TooFewTurns => names::FEW_TURNS,
            Self::NotObservable => names::OPEN_TURNS,
        }
    }
}

/// A sensor that was recorded and is not calibrated.
#[derive(Clone, Debug, PartialEq)]
pub struct NotCalibrated {
    /// The sensor.
    pub sensor: Sensor,
    /// Why.
    pub reason: NotCalibratedReason,
    /// The same with numbers, and what to do.
    pub text: String,
    /// The bias, where the static intervals show it though nothing shows the rest; unit of the readings.
    pub bias: Option<[f64; 3]>,
    /// Its standard errors.
    pub bias_std: [Option<f64>; 3],
}

impl NotCalibrated {
    /// Why the calibration fails its gate, with what to do.
    pub(crate) fn gate(&self) -> Finding {
        let found = Finding::of(Kind::NOT_CALIBRATED)
            .of_sensor(self.sensor)
            .detail("why", self.text.clone());
        match self.bias {
            Some(_) => found.detail("kept", "at rest"),
            None => found,
        }
    }

    pub(super) fn to_value(&self) -> Value {
        let mut value = json!({"status": STATUS, "reason": self.reason, "text": self.text});
        if let (Some(bias), Some(own)) = (self.bias, value.as_object_mut()) {
            own.insert("bias".into(), json!(bias));
            own.insert("bias_std".into(), json!(self.bias_std));
        }
        value
    }

    /// From what stands in the place of a sensor; `None` where that is a calibrated one, or nothing.
    pub(super) fn of_value(
        sensor: Sensor,
        value: &Value,
    ) -> Result<Option<Self>, serde_json::Error> {
        #[derive(Deserialize)]
        struct Written {
            reason: NotCalibratedReason,
            #[serde(default)]
            text: String,
            #[serde(default)]
            bias: Option<[f64; 3]>,
            #[serde(default)]
            bias_std: [Option<f64>; 3],
        }
        if value.get("status").and_then(Value::as_str) != Some(STATUS) {
            return Ok(None);
        }
        let written = Written::deserialize(value)?;
        Ok(Some(Self {
            sensor,
            reason: written.reason,
            text: written.text,
            bias: written.bias,
            bias_std: written.bias_std,
        }))
    }
}
