//! What recordings of this kind cannot show, and which recording would.

use sensor::{Quantity, Sensor};

use super::family::Claim;

/// What no hand-held recording shows: it is taken up by a parameter that is free.
pub const NEVER_VISIBLE: [&str; 5] = [
    "a wrong value of local gravity: it is a common scale of the accelerometer",
    "a clock that runs fast or slow: it is a common scale of the gyroscope",
    "the distance between the accelerometer's axes (size effect): the rests do not turn",
    "a delay common to the three axes of the gyroscope: turns begin and end at rest",
    "isotropic g-sensitivity against the vertical part of the earth's rate, where no latitude is given",
];

/// A recording that tells a named effect from what cannot be told from it in this one, by what they look at.
pub fn told_apart_by<'a>(
    name: &'a Claim,
    ties: impl ExactSizeIterator<Item = &'a Claim>,
) -> Option<String> {
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
    let what = if any(&[Quantity::TemperatureRate, Quantity::Warming]) {
        "a recording in which the temperature rises and falls at least twice, slowly and fast"
    } else if any(&[Quantity::Temperature]) && any(&[Quantity::Time]) {
        "a recording in which temperature rises and falls: warm the device, then let it cool while you turn it"
    } else if any(&[Quantity::Time]) {
        "a recording twice as long, that begins with five minutes at rest right after switching on and returns to \
         its first placement several times"
    } else if only(Sensor::Gyroscope) {
        "turns of very different speed, from slow (20 deg/s) to as fast as the range allows, both ways about every axis"
    } else if only(Sensor::Accelerometer) {
        "more placements between the faces: tilts of 20 to 70 degrees on every axis"
    } else if any(&[Quantity::LastChange]) {
        "the same placements reached from different sides, in mixed order"
    } else if any(&[Quantity::SpecificForce, Quantity::Attitude]) {
        "longer rests (30 s) in at least twelve orientations, and the latitude given"
    } else {
        "a second recording of the same kind with placements in another order"
    };
    Some(what.into())
}
