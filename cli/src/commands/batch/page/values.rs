//! Row limit and parameter values for the tables of devices.

use batch::Record;

/// Rows of a table of devices.
pub(super) const ROWS: usize = 30;

pub(super) fn values(records: &[Record], name: &str) -> Vec<f64> {
    records
        .iter()
        .filter_map(|r| Some(r.parameter(name)?.0))
        .collect()
}
