//! `cal.json` as a tree, for targets that hold all of it.

use findings::{Finding, Kind};
use serde_json::Value;

use crate::error::Error;
use crate::kept::Kept;
use crate::loss::losses;
use crate::source::Source;

/// The calibration as `calibrate` writes it.
pub fn document(source: &Source<'_>) -> Result<Value, Error> {
    serde_json::to_value(source.calibration).map_err(|e| Error::unwritten(&e))
}

/// Returns the losses of functions that apply the base models and the g-sensitivity alone, while the document beside
/// them holds the whole calibration.
pub fn not_applied(source: &Source<'_>) -> Vec<Finding> {
    let applied = Kept {
        g_sensitivity: true,
        errors: true,
        ..Kept::sensors_of(source)
    };
    let left = losses(source, &applied).into_iter();
    left.map(|loss| loss.as_kind(Kind::NOT_APPLIED)).collect()
}

/// A list of numbers, null as not a number; `None` of anything else.
pub fn numbers(value: &Value) -> Option<Vec<f64>> {
    let all = value.as_array()?;
    let number = |v: &Value| {
        if v.is_null() {
            Some(f64::NAN)
        } else {
            v.as_f64()
        }
    };
    all.iter().map(number).collect()
}

/// Rows of numbers, all of one length.
pub fn matrix(value: &Value) -> Option<Vec<Vec<f64>>> {
    let rows: Option<Vec<Vec<f64>>> = value.as_array()?.iter().map(numbers).collect();
    let rows = rows?;
    let width = rows.first()?.len();
    rows.iter().all(|row| row.len() == width).then_some(rows)
}
