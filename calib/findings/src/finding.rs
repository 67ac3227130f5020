//! A finding: a kind, a place, numbers, a consequence and remedies.

use std::borrow::Cow;

use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;

/// The place of a finding: as much of it as is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Place {
    /// Recording, as the user named it.
    pub recording: Option<String>,
    /// File, as the user named it; an entry of an archive after its name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line of the file or row of an array, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Byte in the line, or column of an array, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<u64>,
    /// Byte from the beginning of the content, counted from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub byte: Option<u64>,
    /// Sensor.
    pub sensor: Option<Sensor>,
    /// Static interval, counted from 1.
    pub interval: Option<usize>,
    /// Turn, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<usize>,
    /// Begin, s on the recording's clock.
    pub t0: Option<f64>,
    /// End, s.
    pub t1: Option<f64>,
}

/// A number with its name and its SI unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Number {
    /// Name, such as `noise`.
    pub name: Cow<'static, str>,
    /// Value in `unit`; none where it is not finite.
    pub value: Option<f64>,
    /// `m/s^2`, `rad/s`, `rad`, `s`, `Hz`, `1`, `share` (of one), `count`, …
    pub unit: Cow<'static, str>,
}

/// A word with its name, such as a column or a parameter.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Detail {
    /// Name, such as `parameter`.
    pub name: Cow<'static, str>,
    /// Text.
    pub value: String,
}

/// Size of the error that a finding makes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Consequence {
    /// `corrected_reading` (m/s² or rad/s), `turn` (rad per quarter turn) or a parameter's name.
    pub of: Cow<'static, str>,
    /// Size in `unit`.
    pub value: f64,
    /// Unit.
    pub unit: Cow<'static, str>,
}

/// One thing that a library has to say of a recording, a fit or a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Cause or consequence.
    pub kind: Kind,
    /// Weight.
    pub level: Level,
    /// Place.
    pub place: Place,
    /// Numbers, in the order in which they were given.
    pub numbers: Vec<Number>,
    /// Words from outside: columns, parameters, what a file says.
    pub details: Vec<Detail>,
    /// Errors that it makes.
    pub consequence: Vec<Consequence>,
    /// Ways out, the best first.
    pub remedies: Vec<Remedy>,
    /// Findings that may be the cause.
    pub because: Vec<Finding>,
}

impl Finding {
    /// The same in a recording.
    pub fn in_recording(mut self, name: impl Into<String>) -> Self {
        self.place.recording = Some(name.into());
        self
    }

    /// The same in a file.
    pub fn in_file(mut self, name: impl Into<String>) -> Self {
        self.place.file = Some(name.into());
        self
    }

    /// The same at a line, counted from 1.
    pub fn at_line(mut self, line: u64) -> Self {
        self.place.line = Some(line);
        self
    }

    /// The same at a byte of its line, counted from 1.
    pub fn at_column(mut self, column: u64) -> Self {
        self.place.column = Some(column);
        self
    }

    /// The same at a byte of the content, counted from 0.
    pub fn at_byte(mut self, byte: u64) -> Self {
        self.place.byte = Some(byte);
        self
    }

    /// The same of a sensor.
    pub fn of_sensor(mut self, sensor: Sensor) -> Self {
        self.place.sensor = Some(sensor);
        self
    }

    /// The same in a static interval, counted from 0.
    pub fn at_interval(mut self, index: usize) -> Self {
        self.place.interval = Some(index + 1);
        self
    }

    /// The same in a turn, counted from 0.
    pub fn at_turn(mut self, index: usize) -> Self {
        self.place.turn = Some(index + 1);
        self
    }

    /// The same between two times, s.
    pub fn between(mut self, t0: f64, t1: f64) -> Self {
        self.place.t0 = Some(t0);
        self.place.t1 = Some(t1);
        self
    }

    /// The same from one instant on, s.
    pub fn from_time(mut self, t0: f64) -> Self {
        self.place.t0 = Some(t0);
        self
    }

    /// The same with a number in an SI unit.
    pub fn number(mut self, name: &'static str, value: f64, unit: &'static str) -> Self {
        self.numbers.push(Number {
            name: name.into(),
            value: value.is_finite().then_some(value),
            unit: unit.into(),
        });
        self
    }

    /// The same with a number of things.
    pub fn count(self, name: &'static str, value: usize) -> Self {
        self.number(name, value as f64, "count")
    }

    /// The same with a word.
    pub fn detail(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.details.push(Detail {
            name: name.into(),
            value: value.into(),
        });
        self
    }

    /// The same with the error that it makes.
    pub fn affects(mut self, of: &'static str, value: f64, unit: &'static str) -> Self {
        if value.is_finite() {
            self.consequence.push(Consequence {
                of: of.into(),
                value,
                unit: unit.into(),
            });
        }
        self
    }

    /// The same with another level than usual.
    pub fn at_level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

    /// The same with a better remedy before the usual ones.
    pub fn remedy(mut self, remedy: Remedy) -> Self {
        self.remedies.insert(0, remedy);
        self
    }

    /// The same with the nearest of known names as a remedy, where one is near.
    pub fn or_nearest<'a>(self, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        match Remedy::nearest(name, known) {
            Some(remedy) => self.only_remedies([remedy]),
            None => self,
        }
    }

    /// The same with these remedies alone.
    pub fn only_remedies(mut self, remedies: impl IntoIterator<Item = Remedy>) -> Self {
        self.remedies = remedies.into_iter().collect();
        self
    }

    /// The same with a finding that may be its cause.
    pub fn because(mut self, cause: Self) -> Self {
        self.because.push(cause);
        self
    }

    /// A number by its name.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.numbers.iter().find(|n| n.name == name)?.value
    }

    /// A word by its name.
    pub fn word(&self, name: &str) -> Option<&str> {
        let found = self.details.iter().find(|d| d.name == name)?;
        Some(&found.value)
    }
}
