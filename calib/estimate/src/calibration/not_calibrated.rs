//! A sensor that was recorded and is not calibrated: in its place in the file stands why.

use sensor::Sensor;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use super::{Calibration, RecordingBias, Triad};

/// What stands where a calibrated sensor has its model.
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
            Self::NoUsableTurn => "no turn can be used",
            Self::TooFewTurns => "too few turns can be used",
            Self::NotObservable => "the turns leave a parameter open",
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
    /// A gyroscope with what the static intervals say of its bias.
    pub(crate) fn gyroscope(
        reason: NotCalibratedReason,
        text: String,
        bias: Option<RecordingBias>,
    ) -> Self {
        Self {
            sensor: Sensor::Gyroscope,
            reason,
            text,
            bias_std: bias.as_ref().map_or([None; 3], |bias| bias.bias_std),
            bias: bias.map(|bias| bias.bias),
        }
    }

    /// Why the calibration fails its gate, with what to do.
    pub(crate) fn gate(&self) -> String {
        let name = self.sensor.name();
        let bias = match self.bias {
            Some(_) => " (its bias at rest is kept)",
            None => "",
        };
        format!(
            "the {name} is not calibrated: {}{bias}; --sensor accelerometer calibrates the accelerometer alone",
            self.text
        )
    }

    fn to_value(&self) -> Value {
        let mut value = json!({"status": STATUS, "reason": self.reason, "text": self.text});
        if let (Some(bias), Some(own)) = (self.bias, value.as_object_mut()) {
            own.insert("bias".into(), json!(bias));
            own.insert("bias_std".into(), json!(self.bias_std));
        }
        value
    }

    /// From what stands in the place of a sensor; `None` where that is a calibrated one, or nothing.
    fn of_value(sensor: Sensor, value: &Value) -> Result<Option<Self>, serde_json::Error> {
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

impl Serialize for Calibration {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.not_calibrated.is_empty() {
            return Calibration::serialize(self, serializer);
        }
        let value = Calibration::serialize(self, serde_json::value::Serializer);
        let mut value = value.map_err(S::Error::custom)?;
        for mark in &self.not_calibrated {
            value[mark.sensor.name()] = mark.to_value();
        }
        value.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Calibration {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        Self::from_value(value).map_err(D::Error::custom)
    }
}

impl Calibration {
    /// Of a document that may have sensors that are not calibrated.
    pub(super) fn from_value(mut value: Value) -> Result<Self, serde_json::Error> {
        let not_calibrated = marks(&value)?;
        for mark in &not_calibrated {
            value[mark.sensor.name()] = Value::Null;
        }
        Ok(Self {
            not_calibrated,
            ..Calibration::deserialize(value)?
        })
    }

    /// Why a sensor is not calibrated, if it was recorded and is not.
    pub fn why_not(&self, sensor: Sensor) -> Option<&NotCalibrated> {
        self.not_calibrated.iter().find(|own| own.sensor == sensor)
    }

    /// What to say of the sensors of which only the bias is known.
    pub fn bias_alone(&self) -> Vec<String> {
        let inertial = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let bare = inertial.filter(|sensor| self.triad(*sensor).is_some_and(Triad::is_bias_only));
        let bare = bare.map(|sensor| {
            format!(
                "of the {} only the bias is known: its scale factors and misalignments are left at those of a perfect sensor",
                sensor.name()
            )
        });
        bare.collect()
    }
}

/// The sensors of a document that are not calibrated.
pub(super) fn marks(value: &Value) -> Result<Vec<NotCalibrated>, serde_json::Error> {
    let mut all = Vec::new();
    for sensor in Sensor::ALL {
        if let Some(own) = value.get(sensor.name()) {
            all.extend(NotCalibrated::of_value(sensor, own)?);
        }
    }
    Ok(all)
}

impl Triad {
    /// Whether the bias was estimated and `T` is the identity because nothing showed it.
    pub fn is_bias_only(&self) -> bool {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let fixed = self.t_std.iter().flatten().all(Option::is_none);
        self.t == identity && fixed && self.bias_std.iter().any(Option::is_some)
    }
}
