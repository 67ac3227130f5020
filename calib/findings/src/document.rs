//! Findings in documents: flat objects with their text.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::finding::{Consequence, Detail, Finding, Number, Place};
use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;
use crate::words::Front;

/// A finding as an object of a document.
#[derive(Serialize, Deserialize)]
struct Document {
    kind: String,
    level: Level,
    #[serde(flatten)]
    place: Place,
    #[serde(default)]
    numbers: Vec<Number>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    details: Vec<Detail>,
    #[serde(default)]
    consequence: Vec<Consequence>,
    /// The best remedy.
    #[serde(default)]
    remedy: Option<Remedy>,
    /// The other ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    remedies: Vec<Remedy>,
    /// Findings that may be the cause.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    because: Vec<Finding>,
    text: String,
}

impl Serialize for Finding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut remedies = self.remedies.iter().cloned();
        Document {
            kind: self.kind.name().to_owned(),
            level: self.level,
            place: self.place.clone(),
            numbers: self.numbers.clone(),
            details: self.details.clone(),
            consequence: self.consequence.clone(),
            remedy: remedies.next(),
            remedies: remedies.collect(),
            because: self.because.clone(),
            text: self.text(Front::CommandLine),
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Finding {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let own = Document::deserialize(deserializer)?;
        let kind = Kind::named(&own.kind);
        let mut details = own.details;
        // Of a kind that this version does not know the text is what it has to say.
        if kind == Kind::REMARK && !details.iter().any(|d| d.name == "text") {
            details.push(Detail {
                name: "text".into(),
                value: own.text,
            });
        }
        Ok(Self {
            kind,
            level: own.level,
            place: own.place,
            numbers: own.numbers,
            details,
            consequence: own.consequence,
            remedies: own.remedy.into_iter().chain(own.remedies).collect(),
            because: own.because,
        })
    }
}

impl From<String> for Box<Finding> {
    fn from(text: String) -> Self {
        Self::new(text.into())
    }
}

impl From<&str> for Box<Finding> {
    fn from(text: &str) -> Self {
        Self::new(text.into())
    }
}

impl From<String> for Finding {
    /// A finding whose text is its own.
    fn from(text: String) -> Self {
        Self::of(Kind::REMARK).detail("text", text)
    }
}

impl From<&str> for Finding {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensor::Sensor;

    #[test]
    fn a_finding_reads_back_as_it_was_written() {
        let found = Finding::of(Kind::MISFIT)
            .in_recording("rec_1")
            .of_sensor(Sensor::Accelerometer)
            .at_interval(3)
            .between(1.0, 2.0)
            .number("rms", 2.8e-3, "m/s^2")
            .affects("corrected_reading", 2.8e-3, "m/s^2");
        let text = serde_json::to_string(&found).unwrap();
        let back: Finding = serde_json::from_str(&text).unwrap();
        assert_eq!(back, found);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["interval"], 4);
        assert_eq!(value["remedy"]["kind"], "discover");
    }

    #[test]
    fn a_kind_of_a_later_version_keeps_its_text() {
        let text = r#"{"kind": "of_tomorrow", "level": "care", "text": "something new"}"#;
        let back: Finding = serde_json::from_str(text).unwrap();
        assert_eq!(back.text(Front::Plain), "something new");
    }
}
