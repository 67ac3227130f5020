//! Record of one device in a batch: one line of JSON, with the same bytes in every run.

use ::findings::{Grade, Verdict};
use calib::limits::LimitLine;
use serde::{Deserialize, Serialize};

/// Outcome of one device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Calibrated, every limit kept.
    Pass,
    /// Calibrated, but a quality gate failed or a limit is not kept.
    Fail,
    /// The device's options contradict each other.
    Usage,
    /// An input is unreadable or invalid.
    Input,
    /// The recordings do not determine the parameters.
    NotEnough,
    /// The fit did not converge.
    NotConverged,
    /// A file could not be written.
    Output,
    /// A bug of ours: a panic.
    Bug,
    /// It took longer than a device may.
    Budget,
}

impl Status {
    /// The exit status that `calibrate` would end with.
    pub fn exit(self) -> u8 {
        match self {
            Self::Pass => 0,
            Self::Fail => 1,
            Self::Usage => 2,
            Self::Input => 3,
            Self::NotEnough => 4,
            Self::NotConverged | Self::Budget => 5,
            Self::Output => 6,
            Self::Bug => 7,
        }
    }

    /// Returns the name of the status as written to the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Usage => "usage",
            Self::Input => "input",
            Self::NotEnough => "not_enough",
            Self::NotConverged => "not_converged",
            Self::Output => "output",
            Self::Bug => "bug",
            Self::Budget => "budget",
        }
    }
}

/// A parameter of a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name as in `parameters` of the calibration.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Standard error.
    pub std: Option<f64>,
}

/// Residuals of a calibration over its recordings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Misfit {
    /// Root mean square of `|f| − g` at static intervals, mm/s².
    pub residual_mm_s2: Option<f64>,
    /// Its `χ²` per degree of freedom.
    pub accelerometer_chi2: Option<f64>,
    /// Static intervals.
    pub static_intervals: Option<usize>,
    /// Root mean square angle by which gravity is missed through turns, °.
    pub residual_deg: Option<f64>,
    /// Its `χ²` per degree of freedom.
    pub gyroscope_chi2: Option<f64>,
    /// Turns.
    pub turns: Option<usize>,
}

/// An effect that was named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its name.
    pub name: String,
    /// Chance of so much by any test of the catalogue.
    pub adjusted_p_value: f64,
    /// Residual on held-out intervals, without the effect and with it, in multiples of the noise.
    pub held_out_gap: [f64; 2],
}

/// One device of a batch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Its place in the manifest, from 0.
    pub index: usize,
    /// Its name.
    pub id: String,
    /// Lot, as the manifest says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lot: Option<String>,
    /// Station.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub station: Option<String>,
    /// Time, as the manifest says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<String>,
    /// Outcome of the device.
    pub status: Status,
    /// The exit status of `calibrate`.
    pub exit: u8,
    /// SHA-256 of inputs, options and version.
    pub key: String,
    /// SHA-256 of its `cal.json`, where there is one.
    pub cal_sha256: Option<String>,
    /// Why it did not pass; the name of the limit, or the error.
    pub reasons: Vec<String>,
    /// Limits with their values.
    pub limits: Vec<LimitLine>,
    /// Parameters with their standard errors.
    pub parameters: Vec<Parameter>,
    /// Residuals of the calibration.
    pub misfit: Misfit,
    /// Number of warnings in its `cal.json`.
    pub warnings: usize,
    /// The verdict of the search for what is missing, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<String>,
    /// Effects that the search named.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
    /// The verdict on its calibration, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub calibration_verdict: Option<Verdict>,
    /// True if the device belongs to the type of the given prior; `None` without a prior.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub belongs: Option<bool>,
}

/// Computing time of one device; never part of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Its place in the manifest.
    pub index: usize,
    /// Its name.
    pub id: String,
    /// Seconds; 0 for one that was found complete.
    pub seconds: f64,
    /// True if a complete result was found and kept.
    pub resumed: bool,
}

impl Record {
    /// The value of a parameter and its standard error.
    pub fn parameter(&self, name: &str) -> Option<(f64, Option<f64>)> {
        let found = self.parameters.iter().find(|p| p.name == name)?;
        Some((found.value, found.std))
    }

    /// Why the calibration of a device that passes is to be used with care, if it is.
    pub fn care(&self) -> Option<&str> {
        let verdict = self.calibration_verdict.as_ref()?;
        let is_care = self.status == Status::Pass && verdict.level == Grade::Care;
        is_care.then(|| verdict.reason.as_deref().unwrap_or_default())
    }

    /// The first reason without what differs from device to device: paths and numbers.
    pub fn cause(&self) -> Option<String> {
        let first = self.reasons.first()?;
        let words = match first.split_once(": ") {
            // `file:line: what`, or `file: what`.
            Some((file, what)) if self.status != Status::Fail && !file.contains(' ') => what,
            _ => first,
        };
        Some(without_numbers(words))
    }
}

/// The first words with one mark for each number.
pub(crate) fn without_numbers(words: &str) -> String {
    let mut kept = String::new();
    for c in words.chars().take(120) {
        match c {
            '0'..='9' if kept.ends_with('…') => {}
            '0'..='9' => kept.push('…'),
            '.' if kept.ends_with('…') => {}
            c => kept.push(c),
        }
    }
    kept
}
