//! Complaints about a spec, each with its key.

use std::ops::RangeInclusive;

use findings::{Finding, Kind};
use recording::{Error, figure};
use sensor::DefinitionError;

/// A key of the spec and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Complaint {
    /// Dotted path, such as `motion.hand_held.rest`.
    pub key: String,
    /// Finding with the value that was found and what is expected.
    pub what: Box<Finding>,
}

impl Complaint {
    pub fn new(key: impl Into<String>, what: Finding) -> Self {
        let key = key.into();
        Self {
            what: Box::new(what.detail("key", key.clone())),
            key,
        }
    }
}

impl From<Complaint> for Error {
    fn from(complaint: Complaint) -> Self {
        Self::usage(complaint.what)
    }
}

impl From<DefinitionError> for Complaint {
    fn from(error: DefinitionError) -> Self {
        Self {
            key: error.key.clone(),
            what: Box::new(error.into()),
        }
    }
}

/// A number that must lie in `range`; NaN does not.
pub(crate) fn number(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), Complaint> {
    if range.contains(&value) {
        return Ok(());
    }
    let (from, to) = range.into_inner();
    let found = Finding::of(Kind::OUT_OF_RANGE)
        .detail("value", figure(value))
        .detail("expected", format!("{} to {}", figure(from), figure(to)));
    Err(Complaint::new(key, found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_is_in_no_range() {
        assert!(number("rate", f64::NAN, 0.0..=1.0).is_err());
        assert!(number("rate", 1.0, 0.0..=1.0).is_ok());
    }
}
