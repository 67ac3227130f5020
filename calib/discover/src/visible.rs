//! Errors that recordings of this kind cannot show, and the recordings that would.

use ::findings::{Finding, Findings, Kind, Remedy};
use sensor::{Quantity, Sensor};

use super::family::Claim;

/// Kinds of errors that no hand-held recording shows: a free parameter takes each up.
pub fn never_visible() -> Findings {
    let kinds = [
        Kind::GravityNeverSeen,
        Kind::ClockNeverSeen,
        Kind::DistanceNeverSeen,
        Kind::DelayNeverSeen,
        Kind::EarthNeverSeen,
    ];
    kinds.map(Finding::of).to_vec().into()
}

/// A recording that tells a named effect from what cannot be told from it in this one, by what they look at.
pub fn told_apart_by<'a>(
    name: &'a Claim,
    ties: impl ExactSizeIterator<Item = &'a Claim>,
) -> Option<Remedy> {
    if ties.len() == 0 {
        return None;
    }
    let effects = std::iter::once(name).chain(ties).filter_map(Claim::effect);
    let all: Vec<_> = effects
        .map(|effect| (effect.sensor(), effect.needs()))
        .collect();
    let any = |wanted: &[Quantity]| {
        let mut needs = all.iter().flat_map(|(_, needs)| needs);
        needs.any(|q| wanted.contains(q))
    };
    let only = |sensor: Sensor| {
        let own = (sensor, vec![Quantity::signal_of(sensor)]);
        all.contains(&own)
    };
    Some(if any(&[Quantity::TemperatureRate, Quantity::Warming]) {
        Remedy::TemperatureCycles
    } else if any(&[Quantity::Temperature]) && any(&[Quantity::Time]) {
        Remedy::WarmAndCool
    } else if any(&[Quantity::Time]) {
        Remedy::LongFromSwitchOn
    } else if only(Sensor::Gyroscope) {
        Remedy::SpeedsThatDiffer
    } else if only(Sensor::Accelerometer) {
        Remedy::TiltsBetweenFaces
    } else if any(&[Quantity::LastChange]) {
        Remedy::OtherSides
    } else if any(&[Quantity::SpecificForce, Quantity::Attitude]) {
        Remedy::LongRests
    } else {
        Remedy::OtherOrder
    })
}
