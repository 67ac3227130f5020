//! The ranges in which numbers of blocks are kept.

use std::collections::BTreeMap;

use crate::constraints::Constraint;
use crate::error::Error;

/// Lower and upper bounds by block and coordinate; infinite where there is none.
pub(crate) type Ranges = BTreeMap<(u32, u32), (f64, f64)>;

/// Checks a range for a coordinate and keeps it; none where both ends are infinite.
///
/// # Errors
/// Nothing between the ends, or an end that is not a number.
pub(crate) fn keep(
    ranges: &mut Ranges,
    key: (u32, u32),
    name: String,
    [lower, upper]: [f64; 2],
) -> Result<(), Error> {
    let ordered = lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY;
    if !ordered {
        let terms = vec![(name, 1.0)];
        return Err(Constraint {
            terms,
            lower,
            upper,
        }
        .empty());
    }
    if lower == f64::NEG_INFINITY && upper == f64::INFINITY {
        ranges.remove(&key);
    } else {
        ranges.insert(key, (lower, upper));
    }
    Ok(())
}
