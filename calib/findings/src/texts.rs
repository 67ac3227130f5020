//! Findings as lists of their texts, for documents: `#[serde(with = "findings::texts::of_warnings")]`.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::finding::Finding;
use crate::level::Level;
use crate::list::Findings;
use crate::words::Front;

/// Writes what was found, without place and advice: `#[serde(serialize_with = "findings::texts::what")]`.
///
/// # Errors
/// Those of the serializer.
pub fn what<S: Serializer>(finding: &Finding, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&finding.what())
}

fn written<S: Serializer>(findings: &Findings, serializer: S) -> Result<S::Ok, S::Error> {
    findings.texts(Front::CommandLine).serialize(serializer)
}

fn read<'de, D: Deserializer<'de>>(level: Level, deserializer: D) -> Result<Findings, D::Error> {
    let texts = Vec::<String>::deserialize(deserializer)?.into_iter();
    Ok(texts
        .map(|text| Finding::from(text).at_level(level))
        .collect())
}

/// Declares how findings of a level are written and read.
macro_rules! texts_of {
    ($(#[$doc:meta])* $name:ident, $level:expr) => {
        $(#[$doc])*
        pub mod $name {
            use super::{Deserializer, Findings, Serializer};

            /// Writes the texts.
            ///
            /// # Errors
            /// Those of the serializer.
            pub fn serialize<S: Serializer>(findings: &Findings, to: S) -> Result<S::Ok, S::Error> {
                super::written(findings, to)
            }

            /// Reads texts as findings of their own.
            ///
            /// # Errors
            /// Something else than a list of texts.
            pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Findings, D::Error> {
                super::read($level, from)
            }
        }
    };
}

texts_of!(
    /// Warnings.
    of_warnings,
    crate::level::Level::Care
);
texts_of!(
    /// Findings that forbid the use of a result.
    of_gates,
    crate::level::Level::Bad
);
