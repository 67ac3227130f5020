//! `/get`: what is newer, to eight digits.

use std::collections::HashMap;

use calib::recording::Stream;
use calib::recording::shown::shown;
use findings::{Finding, Kind};
use nalgebra::Vector3;
use serde::Deserialize;

use super::client::encoded;
use super::config::Buffers;

/// The experiment's clock begins with it: a year at most, s.
const LONGEST: f64 = 3e7;
/// No sensor reads as much, m/s² or rad/s.
const LARGEST: f64 = 1e5;
/// Most values of a buffer in an answer: hours.
const MOST: usize = 4_000_000;

/// Returns true if `t` (s) is a possible time of an experiment.
pub(super) fn is_time(t: f64) -> bool {
    (-1.0..=LONGEST).contains(&t)
}

/// The query for everything of a sensor that is newer than `since`; for all of it with `None`.
pub(super) fn query(buffers: &Buffers, since: Option<f64>) -> String {
    let time = encoded(&buffers.time);
    let newer = since.map_or("full".to_owned(), |t| format!("{t}%7C{time}"));
    let names = buffers
        .values
        .iter()
        .map(|name| encoded(name))
        .chain([time.clone()]);
    let parts: Vec<String> = names.map(|name| format!("{name}={newer}")).collect();
    parts.join("&")
}

/// The answer.
#[derive(Debug, Deserialize)]
pub(super) struct Reply {
    buffer: HashMap<String, Part>,
    pub(super) status: Status,
}

/// The state of the experiment.
#[derive(Debug, Deserialize)]
pub(super) struct Status {
    pub(super) session: String,
    pub(super) measuring: bool,
}

#[derive(Debug, Deserialize)]
struct Part {
    #[serde(rename = "updateMode")]
    mode: String,
    #[serde(deserialize_with = "values")]
    buffer: Vec<f64>,
}

/// Values, at most [`MOST`]; what is no number is NaN.
fn values<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    struct Values;
    impl<'de> serde::de::Visitor<'de> for Values {
        type Value = Vec<f64>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "at most {MOST} numbers")
        }

        fn visit_seq<A: serde::de::SeqAccess<'de>>(self, mut of: A) -> Result<Vec<f64>, A::Error> {
            let mut values = Vec::new();
            while let Some(value) = of.next_element::<Option<f64>>()? {
                if values.len() == MOST {
                    return Err(serde::de::Error::invalid_length(MOST + 1, &self));
                }
                values.push(value.unwrap_or(f64::NAN));
            }
            Ok(values)
        }
    }
    from.deserialize_seq(Values)
}

impl Reply {
    pub(super) fn parse(text: &[u8]) -> Result<Self, Box<Finding>> {
        serde_json::from_slice(text).map_err(|error| {
            let found = Finding::of(Kind::ANSWER_WITHOUT_SAMPLES);
            found.detail("reason", shown(&error.to_string())).into()
        })
    }

    /// Returns true if the reply has the whole buffers of a sensor.
    pub(super) fn is_full(&self, buffers: &Buffers) -> bool {
        self.buffer
            .get(&buffers.time)
            .is_some_and(|part| part.mode == "full")
    }

    /// The samples of a sensor in order of time. Those without a number are left out.
    ///
    /// # Errors
    /// A time or a reading that no phone has.
    pub(super) fn samples(&self, buffers: &Buffers) -> Result<Stream, Box<Finding>> {
        let part = |name: &str| self.buffer.get(name).map_or(&[][..], |part| &part.buffer);
        let [x, y, z] = buffers.values.each_ref().map(|name| part(name));
        let mut stream = Stream::default();
        for (((t, x), y), z) in part(&buffers.time).iter().zip(x).zip(y).zip(z) {
            let (t, reading) = (*t, Vector3::new(*x, *y, *z));
            if t.is_nan() || reading.iter().any(|value| value.is_nan()) {
                continue;
            }
            if !is_time(t) {
                let found = Finding::of(Kind::TIME_IMPOSSIBLE);
                return Err(found.detail("seconds", format!("{t:e}")).into());
            }
            if let Some(value) = reading.iter().find(|value| value.abs() > LARGEST) {
                let found = Finding::of(Kind::READING_IMPOSSIBLE);
                return Err(found.detail("value", format!("{value:e}")).into());
            }
            if stream.t.last().is_none_or(|last| t > *last) {
                stream.t.push(t);
                stream.values.push(reading);
            }
        }
        Ok(stream)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_put_together_from_four_buffers() {
        let buffers = Buffers {
            values: ["accX", "accY", "accZ"].map(str::to_owned),
            time: "acc time".to_owned(),
        };
        assert_eq!(
            query(&buffers, Some(1.25)),
            "accX=1.25%7Cacc%20time&accY=1.25%7Cacc%20time&accZ=1.25%7Cacc%20time&acc%20time=1.25%7Cacc%20time"
        );
        let text = r#"{"buffer":{
            "accX":{"size":0,"updateMode":"partial", "buffer":[1E0,2E0,3E0]},
            "accY":{"size":0,"updateMode":"partial", "buffer":[1E0,null,3E0]},
            "accZ":{"size":0,"updateMode":"partial", "buffer":[9.8066501E0,9E0,9.5E0]},
            "acc time":{"size":0,"updateMode":"partial", "buffer":[1.26E0,1.27E0,1.28E0]}
            },"status":{"session":"a1b2c3", "measuring":true, "timedRun":false, "countDown":0}}"#;
        let reply = Reply::parse(text.as_bytes()).unwrap();
        let samples = reply.samples(&buffers).unwrap();
        assert_eq!(samples.t, [1.26, 1.28]);
        assert_eq!(samples.values[0], Vector3::new(1.0, 1.0, 9.806_650_1));
        assert!(
            reply.status.measuring && reply.status.session == "a1b2c3" && !reply.is_full(&buffers)
        );
    }
}
