//! Places at which a loss of one's own is checked.

/// Places at which a loss of one's own is checked: from far inside to far outside, off the places where losses
/// are usually put together.
pub(crate) fn places() -> impl Iterator<Item = f64> {
    (-12..=18).map(|k| 1.1 * 10f64.powf(f64::from(k) / 3.0))
}
