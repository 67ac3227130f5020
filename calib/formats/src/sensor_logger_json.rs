//! Sensor Logger's JSON: an array of `{"sensor", "time", "z", "y", "x"}`, numbers as strings.

mod choice;

use findings::{Finding, Kind};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::io::{BufReader, Read};

use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::error::no_json;
use crate::format::{Format, Reads};
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Quantity, Wanted};

/// Sensor Logger's JSON export.
pub(crate) static SENSOR_LOGGER_JSON: Format = Format {
    name: "sensor_logger_json",
    about: "the JSON of the app Sensor Logger: an array of {sensor, time, x, y, z}",
    begins: |head| {
        let mut text = head.iter().filter(|byte| !byte.is_ascii_whitespace());
        text.next() == Some(&b'[')
            && text.next() == Some(&b'{')
            && [b"\"sensor\"".as_slice(), b"\"time\""]
                .iter()
                .all(|name| memchr::memmem::find(head, name).is_some())
    },
    reads: Reads::Forward(read),
};

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let reader = BufReader::new(reader.take(limits.bytes));
    let mut json = serde_json::Deserializer::from_reader(reader);
    let mut file = File {
        recorder: Recorder::new(wanted, limits),
        counts: BTreeMap::new(),
        settings: BTreeMap::new(),
        refused: None,
    };
    let read = json.deserialize_seq(Rows(&mut file));
    if let Some(error) = file.refused.take() {
        return Err(error);
    }
    if let Err(error) = read {
        if !error.is_eof() || file.counts.is_empty() {
            return Err(no_json(&error));
        }
        let cut = Finding::of(Kind::FILE_CUT).detail("within", "an entry");
        file.recorder.content.cut = Some(cut.count("line", error.line()));
    }
    file.finish()
}

struct File {
    recorder: Recorder,
    counts: BTreeMap<String, u64>,
    /// Settings of the app, from the entry about the device.
    settings: BTreeMap<String, String>,
    refused: Option<Error>,
}

/// One entry.
#[derive(Default)]
struct Entry {
    sensor: String,
    time: Option<i64>,
    axes: [Option<f64>; 3],
    settings: BTreeMap<String, String>,
}

struct Rows<'a>(&'a mut File);

impl<'de> Visitor<'de> for Rows<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of entries")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut rows: A) -> Result<(), A::Error> {
        while let Some(Row(entry)) = rows.next_element()? {
            if let Err(error) = self.0.take(entry) {
                self.0.refused = Some(error);
                return Ok(());
            }
        }
        Ok(())
    }
}

struct Row(Entry);

impl<'de> serde::Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RowVisitor).map(Row)
    }
}

struct RowVisitor;

/// A number, a string or anything else.
struct Scalar(String);

impl<'de> serde::Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ScalarVisitor).map(Scalar)
    }
}

struct ScalarVisitor;

impl<'de> Visitor<'de> for ScalarVisitor {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("number or string")
    }

    fn visit_str<E>(self, text: &str) -> Result<String, E> {
        Ok(text.to_owned())
    }

    fn visit_f64<E>(self, number: f64) -> Result<String, E> {
        Ok(number.to_string())
    }

    fn visit_i64<E>(self, number: i64) -> Result<String, E> {
        Ok(number.to_string())
    }

    fn visit_u64<E>(self, number: u64) -> Result<String, E> {
        Ok(number.to_string())
    }

    fn visit_bool<E>(self, value: bool) -> Result<String, E> {
        Ok(value.to_string())
    }

    fn visit_unit<E>(self) -> Result<String, E> {
        Ok(String::new())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<String, A::Error> {
        while values.next_element::<IgnoredAny>()?.is_some() {}
        Ok(String::new())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<String, A::Error> {
        while entries.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(String::new())
    }
}

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Entry;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an entry")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entry, A::Error> {
        let mut entry = Entry::default();
        while let Some(key) = map.next_key::<Cow<'de, str>>()? {
            let Scalar(value) = map.next_value()?;
            match key.as_ref() {
                "sensor" => entry.sensor = value,
                "time" => entry.time = value.parse().ok(),
                "x" => entry.axes[0] = value.parse().ok(),
                "y" => entry.axes[1] = value.parse().ok(),
                "z" => entry.axes[2] = value.parse().ok(),
                "platform" | "standardisation" => {
                    entry
                        .settings
                        .insert(key.into_owned(), value.to_lowercase());
                }
                _ => {}
            }
        }
        Ok(entry)
    }
}

/// Returns the quantity that a sensor of the app measures.
fn quantity(sensor: &str) -> Option<Quantity> {
    match sensor {
        "AccelerometerUncalibrated" | "TotalAcceleration" | "Accelerometer" | "Gravity" => {
            Some(Quantity::SpecificForce)
        }
        "GyroscopeUncalibrated" | "Gyroscope" => Some(Quantity::AngularRate),
        "MagnetometerUncalibrated" | "Magnetometer" => Some(Quantity::MagneticField),
        _ => None,
    }
}

impl File {
    fn take(&mut self, entry: Entry) -> Result<(), Error> {
        let Entry {
            sensor,
            time,
            axes,
            settings,
        } = entry;
        self.settings.extend(settings);
        let count = match self.counts.get_mut(&sensor) {
            Some(count) => count,
            None => self.counts.entry(sensor.clone()).or_default(),
        };
        *count += 1;
        let [Some(x), Some(y), Some(z)] = axes else {
            return Ok(());
        };
        let (Some(quantity), Some(time)) = (quantity(&sensor), time) else {
            if *count == 1 && time.is_some() {
                self.recorder.content.unclear.push(sensor);
            }
            return Ok(());
        };
        let stream = match quantity {
            Quantity::MagneticField => self.recorder.field(&sensor, 0, "µT"),
            _ => self.recorder.stream(&sensor, 0, quantity),
        };
        match stream {
            Some(stream) => self.recorder.push(stream, time, [x, y, z]),
            None => Ok(()),
        }
    }

    fn finish(self) -> Result<Content, Error> {
        let is = |key: &str, value: &str| self.settings.get(key).is_some_and(|set| set == value);
        let turned = is("platform", "ios") && !is("standardisation", "true");
        let mut content = self.recorder.finish();
        content.listed = self
            .counts
            .iter()
            .map(|(sensor, count)| format!("{sensor} ({count} entries)"))
            .collect();
        crate::sensor_logger_json::choice::choose(&mut content, turned)?;
        Ok(content)
    }
}
