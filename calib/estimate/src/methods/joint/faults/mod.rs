//! Faults of a recording: what may be wrong at a place of it and not with the sensors.
//!
//! A fault is a file here and a line in [`FAULTS`]: `calibrate` and `discover` then test it at all of its places, hold its parameters
//! free where it is beyond doubt, and report it.

mod creep;
mod disturbed_interval;
mod fault;
mod outlying_turn;
mod rate_excursion;
mod settling;
mod sudden_slip;

pub use disturbed_interval::DISTURBED_INTERVAL;
pub(crate) use disturbed_interval::shaken;
pub use fault::{Fault, FaultRef, Flagged, Reason, Scope, Seen, Site, Suspect};
pub use outlying_turn::OUTLYING_TURN;
pub use rate_excursion::RATE_EXCURSION;

/// All faults, in the order of their parameters.
pub static FAULTS: &[FaultRef] = &[
    &creep::CREEP,
    &DISTURBED_INTERVAL,
    &OUTLYING_TURN,
    &RATE_EXCURSION,
    &settling::SETTLING,
    &sudden_slip::SUDDEN_SLIP,
];

/// Every place of all faults.
pub fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    FAULTS.iter().flat_map(|f| (f.suspects)(site)).collect()
}

/// Every place of the faults that a wandering bias does not imitate.
pub fn suspects_beside_biases(site: &Site<'_>) -> Vec<Suspect> {
    let own = FAULTS.iter().filter(|f| !f.is_imitated_by_bias);
    own.flat_map(|f| (f.suspects)(site)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_faults_are_reported_by_the_same_kind() {
        for (k, one) in FAULTS.iter().enumerate() {
            assert!(FAULTS[..k].iter().all(|other| other != one), "{one:?}");
            assert!(one.typical > 0.0 && !one.name.is_empty());
        }
    }
}
