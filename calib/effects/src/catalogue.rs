//! The registry: which effects each kind of sensor has.

use sensor::{AnyEffect, Quantity, Role, Sensor};

/// The effects of one kind of sensor, in the order of its crate.
pub fn catalogue_of(sensor: Sensor) -> &'static [&'static dyn AnyEffect] {
    match sensor {
        Sensor::Accelerometer => accelerometer::EFFECTS,
        Sensor::Gyroscope => gyroscope::EFFECTS,
        Sensor::Magnetometer => magnetometer::EFFECTS,
    }
}

/// The whole catalogue.
///
/// ```
/// assert!(stillpoint_effects::catalogue().any(|effect| effect.name() == "gyro_g_sensitivity"));
/// ```
pub fn catalogue() -> impl Iterator<Item = &'static dyn AnyEffect> {
    Sensor::ALL.into_iter().flat_map(catalogue_of).copied()
}

/// The effect of that name.
pub fn effect_named(name: &str) -> Option<&'static dyn AnyEffect> {
    catalogue().find(|effect| effect.name() == name)
}

/// The effect that is the rotation of the earth.
pub fn earth_rotation() -> &'static dyn AnyEffect {
    gyroscope::EARTH_ROTATION
}

/// Whether an effect is one of a field that stands in the room: all of its parameters depend on the heading.
pub fn stands_in_the_room(effect: &dyn AnyEffect) -> bool {
    let mut params = effect.params().iter();
    params.all(|p| p.role == Role::Reference)
}

/// Whether an effect follows the last turn.
pub fn follows_turns(effect: &dyn AnyEffect) -> bool {
    effect.needs().contains(&Quantity::LastTurn)
}

/// The effect of a field that stands in the room.
pub fn room_field(sensor: Sensor) -> Option<&'static dyn AnyEffect> {
    let mut own = catalogue_of(sensor).iter().copied();
    own.find(|effect| stands_in_the_room(*effect))
}

/// The effect of a bias that relaxes after a turn.
pub fn relaxation(sensor: Sensor) -> Option<&'static dyn AnyEffect> {
    let mut own = catalogue_of(sensor).iter().copied();
    own.find(|effect| follows_turns(*effect))
}

/// The effect that is the sensitivity of the rate to specific force.
pub fn force_sensitivity() -> &'static dyn AnyEffect {
    gyroscope::FORCE_SENSITIVITY
}

/// Whether the effect of that name is the rotation of the earth.
pub fn is_earth_rotation(name: &str) -> bool {
    earth_rotation().name() == name
}

/// What the effect of that name looks at; nothing where the catalogue has none.
fn needs_of(name: &str) -> Vec<Quantity> {
    effect_named(name).map_or_else(Vec::new, |effect| effect.needs())
}

/// Whether an effect looks at the sign of a change of temperature, so that it needs one that goes up and down.
pub fn looks_at_warming(name: &str) -> bool {
    needs_of(name).contains(&Quantity::Warming)
}

/// Whether an effect is silent at a constant temperature: by what it looks at, or by its name. The name alone speaks of one
/// that is written as text.
pub fn looks_at_temperature(name: &str) -> bool {
    name.contains("temperature") || needs_of(name).into_iter().any(Quantity::is_thermal)
}

/// Whether an effect is silent on a table that does not vibrate; known as [`looks_at_temperature`] is.
pub fn looks_at_vibration(name: &str) -> bool {
    name.contains("vibration") || needs_of(name).contains(&Quantity::Vibration)
}
