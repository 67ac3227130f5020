//! `cal.json` with sensors that are not calibrated: the reason stands in the place of the sensor.

use findings::{Finding, Findings, Inputs, Kind, Level, Step, Verdict};
use sensor::Sensor;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::not_calibrated::{NotCalibrated, NotCalibratedReason};
use super::{Calibration, RecordingBias, Triad};
use crate::limits::{LimitLine, not_kept};

impl NotCalibrated {
    /// A gyroscope with what the static intervals say of its bias.
    pub(crate) fn gyroscope(
        reason: NotCalibratedReason,
        why: &Finding,
        bias: Option<RecordingBias>,
    ) -> Self {
        Self {
            sensor: Sensor::Gyroscope,
            reason,
            text: why.to_string(),
            bias_std: bias.as_ref().map_or([None; 3], |bias| bias.bias_std),
            bias: bias.map(|bias| bias.bias),
        }
    }
}

/// A calibration with what is made of its findings.
#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten, serialize_with = "own")]
    own: &'a Calibration,
    verdict: Verdict,
    findings: Findings,
}

/// The entries of the calibration itself.
fn own<S: Serializer>(calibration: &&Calibration, serializer: S) -> Result<S::Ok, S::Error> {
    Calibration::serialize(calibration, serializer)
}

impl Serialize for Calibration {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let findings = self.findings();
        let document = Document {
            own: self,
            verdict: self.verdict_of(&findings),
            findings,
        };
        if self.not_calibrated.is_empty() {
            return document.serialize(serializer);
        }
        let value = document.serialize(serde_json::value::Serializer);
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
    /// Reads it from a document that may mark sensors as not calibrated.
    pub(super) fn from_value(mut value: Value) -> Result<Self, serde_json::Error> {
        let not_calibrated = marks(&value)?;
        for mark in &not_calibrated {
            value[mark.sensor.name()] = Value::Null;
        }
        let own = Calibration::deserialize(&value)?.with_findings(&value)?;
        Ok(Self {
            not_calibrated,
            ..own
        })
    }

    /// With the findings of the document in the place of their texts; a document of an earlier version has the texts alone.
    pub(super) fn with_findings(self, document: &Value) -> Result<Self, serde_json::Error> {
        let Some(found) = document.get("findings") else {
            return Ok(self);
        };
        let found = Findings::deserialize(found)?;
        let of_limits = [Kind::LIMIT_NOT_KEPT, Kind::REQUIRED_MISSING];
        let is_gate = |found: &&Finding| !of_limits.contains(&found.kind);
        Ok(Self {
            failed_gates: found.gates().filter(is_gate).collect(),
            warnings: found.warnings().collect(),
            ..self
        })
    }

    /// All findings, those first that forbid its use: failed gates, then limits that are not kept, then warnings.
    pub fn findings(&self) -> Findings {
        let gates = self.failed_gates.iter().cloned();
        let mut all: Findings = gates.map(|gate| gate.at_level(Level::Bad)).collect();
        all.extend(not_kept(&self.limits).into_iter().map(LimitLine::finding));
        all.extend(&self.warnings);
        all
    }

    /// The verdict on it, with commands for the recordings that it was made of.
    pub fn verdict(&self) -> Verdict {
        self.verdict_of(&self.findings())
    }

    /// The next steps: what a front end offers in its own commands, else the steps of the verdict.
    pub fn next_steps(&self) -> Vec<Step> {
        self.next.clone().unwrap_or_else(|| self.verdict().next)
    }

    fn verdict_of(&self, findings: &[Finding]) -> Verdict {
        let inputs = self.provenance.inputs.iter();
        let inputs = Inputs {
            recordings: inputs.map(|input| input.recording.as_str()).collect(),
            place: self.gravity_source.options(self.gravity),
        };
        Verdict::of_inputs(findings, &inputs)
    }

    /// Why a sensor is not calibrated, if it was recorded and is not.
    pub fn why_not(&self, sensor: Sensor) -> Option<&NotCalibrated> {
        self.not_calibrated.iter().find(|own| own.sensor == sensor)
    }

    /// Lists a finding for each sensor of which only the bias is calibrated.
    pub fn bias_alone(&self) -> Vec<Finding> {
        let inertial = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let bare = inertial.filter(|sensor| self.triad(*sensor).is_some_and(Triad::is_bias_only));
        let bare = bare.map(|sensor| Finding::of(Kind::BIAS_ALONE).of_sensor(sensor));
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
    /// Returns true if only the bias was estimated and `T` is the identity, as nothing determined it.
    pub fn is_bias_only(&self) -> bool {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let fixed = self.t_std.iter().flatten().all(Option::is_none);
        self.t == identity && fixed && self.bias_std.iter().any(Option::is_some)
    }
}
