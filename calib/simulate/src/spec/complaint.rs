//! What is wrong with a spec, and where.

use std::ops::RangeInclusive;

use recording::Error;

/// A key of the spec and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Complaint {
    /// Dotted path, such as `motion.hand_held.rest`.
    pub key: String,
    /// What was found, what is expected.
    pub what: String,
}

impl Complaint {
    pub fn new(key: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            what: what.into(),
        }
    }
}

impl From<Complaint> for Error {
    fn from(complaint: Complaint) -> Self {
        Self::usage(format!("{}: {}", complaint.key, complaint.what))
    }
}

/// A number that must lie in `range`; NaN does not.
pub(crate) fn number(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), Complaint> {
    if range.contains(&value) {
        return Ok(());
    }
    let (from, to) = range.into_inner();
    Err(Complaint::new(
        key,
        format!("is {value}, expected {from} to {to}"),
    ))
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
