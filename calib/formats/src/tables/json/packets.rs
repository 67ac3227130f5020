//! Records with the samples of a packet: `{"acc": {"Timestamp": 123, "ArrayAcc": [{"x": ..}, {"x": ..}]}}` is a row per sample.

use findings::{Finding, Kind};
use serde_json::Value;

use super::flat::{Row, flatten};
use crate::Error;
use crate::shown::shown;

/// The rows of a record: as many as the lists of samples in it have, each with the numbers that it has once; else one.
///
/// # Errors
/// Lists of several lengths, and lists within lists: which of their numbers belong to one moment is not known.
pub(super) fn rows(record: &Value) -> Result<Vec<Row>, Error> {
    let mut size = None;
    measure("", record, &mut size)?;
    let flat = |record: &Value| {
        let mut row = Row::new();
        flatten("", record, &mut row).map(|()| row)
    };
    match size {
        None => Ok(vec![flat(record)?]),
        Some(size) => (0..size).map(|at| flat(&sample(record, at))).collect(),
    }
}

/// The samples in a list, if it is one of objects or of vectors.
fn samples(value: &Value) -> Option<&[Value]> {
    let samples = value.as_array()?;
    let all = |is: fn(&Value) -> bool| !samples.is_empty() && samples.iter().all(is);
    (all(Value::is_object) || all(Value::is_array)).then_some(samples)
}

/// Finds the length of the lists of samples in a record.
fn measure(name: &str, value: &Value, size: &mut Option<usize>) -> Result<(), Error> {
    let Value::Object(members) = value else {
        return Ok(());
    };
    for (inner, value) in members {
        let name = match name.is_empty() {
            true => inner.clone(),
            false => format!("{name}.{inner}"),
        };
        measure(&name, value, size)?;
        let Some(samples) = samples(value) else {
            continue;
        };
        if size.is_some_and(|size| size != samples.len()) {
            let found = Finding::of(Kind::LISTS_IN_RECORDS);
            return Err(Error::refused(found.detail("name", shown(&name))));
        }
        *size = Some(samples.len());
    }
    Ok(())
}

/// The record with one sample in place of each list of them.
fn sample(value: &Value, at: usize) -> Value {
    match (value, samples(value)) {
        (_, Some(samples)) => samples.get(at).cloned().unwrap_or_default(),
        (Value::Object(members), None) => {
            let members = members.iter();
            Value::Object(
                members
                    .map(|(name, value)| (name.clone(), sample(value, at)))
                    .collect(),
            )
        }
        (other, None) => other.clone(),
    }
}
