//! Yield, causes of failure, and effects that many devices of a type share.

use crate::record::{Record, Status, without_numbers};

/// Number of devices: all, passed, and by status.
#[derive(Clone, Debug, PartialEq)]
pub struct Yield {
    /// All devices.
    pub devices: usize,
    /// Those that pass.
    pub passed: usize,
    /// Those of them whose calibration is to be used with care.
    pub with_care: usize,
    /// Status and count, the commonest first.
    pub by_status: Vec<(Status, usize)>,
}

/// A reason and how many devices fail for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// Limit, gate or error, numbers and paths left out.
    pub words: String,
    /// Devices.
    pub count: usize,
    /// An example.
    pub example: String,
}

/// An effect that was named in some devices.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedEffect {
    /// Its name.
    pub name: String,
    /// Devices in which it was named.
    pub named: usize,
    /// Devices that were looked into.
    pub of: usize,
}

/// Counts devices by how they ended.
pub fn yields(records: &[Record]) -> Yield {
    let mut by_status: Vec<(Status, usize)> = Vec::new();
    for record in records {
        match by_status
            .iter_mut()
            .find(|(status, _)| *status == record.status)
        {
            Some((_, count)) => *count += 1,
            None => by_status.push((record.status, 1)),
        }
    }
    by_status.sort_by_key(|(status, count)| (std::cmp::Reverse(*count), *status));
    Yield {
        devices: records.len(),
        passed: records.iter().filter(|r| r.status == Status::Pass).count(),
        with_care: records.iter().filter(|r| r.care().is_some()).count(),
        by_status,
    }
}

/// First reasons of devices that do not pass, the commonest first.
pub fn pareto(records: &[Record]) -> Vec<Cause> {
    grouped(records, Record::cause)
}

/// Why devices that pass are to be used with care, the commonest first.
pub fn cared(records: &[Record]) -> Vec<Cause> {
    grouped(records, |record| record.care().map(without_numbers))
}

fn grouped(records: &[Record], of: impl Fn(&Record) -> Option<String>) -> Vec<Cause> {
    let mut causes: Vec<Cause> = Vec::new();
    for record in records {
        let Some(words) = of(record) else {
            continue;
        };
        match causes.iter_mut().find(|cause| cause.words == words) {
            Some(cause) => cause.count += 1,
            None => causes.push(Cause {
                words,
                count: 1,
                example: record.id.clone(),
            }),
        }
    }
    causes.sort_by(|a, b| b.count.cmp(&a.count).then_with(|| a.words.cmp(&b.words)));
    causes
}

/// Effects that were named, the commonest first.
pub fn shared_effects(records: &[Record]) -> Vec<SharedEffect> {
    let of = records.iter().filter(|r| r.verdict.is_some()).count();
    let mut all: Vec<SharedEffect> = Vec::new();
    for finding in records.iter().flat_map(|r| &r.findings) {
        match all.iter_mut().find(|e| e.name == finding.name) {
            Some(effect) => effect.named += 1,
            None => all.push(SharedEffect {
                name: finding.name.clone(),
                named: 1,
                of,
            }),
        }
    }
    all.sort_by(|a, b| b.named.cmp(&a.named).then_with(|| a.name.cmp(&b.name)));
    all
}
