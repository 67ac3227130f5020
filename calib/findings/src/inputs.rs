//! Inputs of a result, which the commands of its next steps name again.

use crate::remedy::OptionName;

/// Inputs of a result, as the commands of its next steps have to repeat them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inputs<'a> {
    /// Names of the recordings.
    pub recordings: Vec<&'a str>,
    /// Options that say where they were made, each with its number: gravity, or latitude and altitude.
    pub place: Vec<(OptionName, f64)>,
}
