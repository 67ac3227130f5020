//! Quantities of variables, recognised from their names.

use crate::Quantity;

/// The quantity that a variable is named after.
pub(crate) fn quantity(name: &str) -> Option<Quantity> {
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if has(&["acc"]) {
        Some(Quantity::SpecificForce)
    } else if has(&["angularvel", "angular_vel", "gyr", "omega"]) {
        Some(Quantity::AngularRate)
    } else if has(&["mag"]) {
        Some(Quantity::MagneticField)
    } else {
        None
    }
}
