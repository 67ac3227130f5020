//! The effects that are asked for.

use std::collections::BTreeMap;

/// Effects by name; each with its parameters by name, or with `size`, a multiple of the effect's
/// typical size at which coefficients not named are drawn.
pub type Effects = BTreeMap<String, BTreeMap<String, f64>>;

/// The key that sets the size of what is drawn at random.
pub const SIZE: &str = "size";
