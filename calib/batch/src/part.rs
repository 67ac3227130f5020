//! The part file of a shard: a header, a record per line, and an end that tells a whole file from half of one.

use findings::{Finding, Kind};
use serde::{Deserialize, Serialize};

use crate::hash;
use crate::record::Record;
use crate::shard::Shard;

/// Schema of a part file.
const SCHEMA: &str = "stillpoint.batch-part/1";

/// First line of a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartHeader {
    /// `stillpoint.batch-part/1`.
    pub schema: String,
    /// Program and version.
    pub created_by: String,
    /// SHA-256 of all devices and options of the run.
    pub manifest_sha256: String,
    /// Shard that the part holds.
    pub shard: Shard,
    /// Devices of the whole run.
    pub devices: usize,
}

/// Last line of a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct PartEnd {
    /// Records.
    records: usize,
    /// SHA-256 of everything before this line.
    sha256: String,
}

impl PartHeader {
    /// Builds the header of the part of a shard.
    pub fn new(created_by: &str, manifest_sha256: String, shard: Shard, devices: usize) -> Self {
        Self {
            schema: SCHEMA.into(),
            created_by: created_by.into(),
            manifest_sha256,
            shard,
            devices,
        }
    }
}

/// File name of a part.
pub fn part_name(shard: Shard) -> String {
    format!("part-{}-of-{}.jsonl", shard.k, shard.n)
}

/// File name of what the devices of a part took.
pub fn timings_name(shard: Shard) -> String {
    format!("timings-{}-of-{}.jsonl", shard.k, shard.n)
}

/// A line of JSON.
fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

/// A part as text.
pub fn part_text<'a>(header: &PartHeader, records: impl IntoIterator<Item = &'a Record>) -> String {
    let mut text = line(header);
    let mut count = 0;
    for record in records {
        text += &line(record);
        count += 1;
    }
    let end = PartEnd {
        records: count,
        sha256: hash::of_text(&text),
    };
    text + &line(&end)
}

/// A part that is whole.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Its first line.
    pub header: PartHeader,
    /// Its records.
    pub records: Vec<Record>,
    /// SHA-256 of both.
    pub sha256: String,
}

/// The run that a part is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Beginning of the hash of its devices and options.
    pub manifest: String,
    /// Devices of the whole run.
    pub devices: usize,
    /// Shards of the whole run.
    pub shards: usize,
    /// Program and version.
    pub program: String,
}

impl PartHeader {
    /// The run that it is of.
    pub(crate) fn identity(&self) -> Identity {
        let whole = &self.manifest_sha256;
        Identity {
            manifest: whole.get(..12).unwrap_or(whole).to_owned(),
            devices: self.devices,
            shards: self.shard.n,
            program: self.created_by.clone(),
        }
    }
}

/// A part, whole or not at all.
///
/// # Errors
/// No part, one without an end, a changed one.
pub(crate) fn read_part(text: &str) -> Result<Part, Box<Finding>> {
    let incomplete = || Box::new(Finding::of(Kind::PART_INCOMPLETE));
    let header: PartHeader = text
        .lines()
        .next()
        .and_then(|line| serde_json::from_str(line).ok())
        .filter(|header: &PartHeader| header.schema == SCHEMA)
        .ok_or_else(|| Finding::of(Kind::NO_BATCH_PART))?;
    let whole = text.strip_suffix('\n').ok_or_else(incomplete)?;
    let (before, end) = whole.rsplit_once('\n').ok_or_else(incomplete)?;
    let end: PartEnd = serde_json::from_str(end).map_err(|_| incomplete())?;
    let body = &text[..before.len() + 1];
    if hash::of_text(body) != end.sha256 {
        return Err(Finding::of(Kind::PART_CHANGED).into());
    }
    let records = before.lines().skip(1).map(serde_json::from_str);
    let records: Result<Vec<Record>, _> = records.collect();
    let records = records.map_err(|error: serde_json::Error| {
        let found = Finding::of(Kind::PART_OF_OTHER_VERSION);
        found.detail("reason", error.to_string())
    })?;
    Ok(Part {
        header,
        records,
        sha256: end.sha256,
    })
}
