//! The registry: which effects each kind of sensor has.

use sensor::{EffectRef, Quantity, Role, Sensor};

/// The effects of one kind of sensor, in the order of its crate.
pub fn catalogue_of(sensor: Sensor) -> impl Iterator<Item = EffectRef> {
    let registry = match sensor {
        Sensor::Accelerometer => accelerometer::EFFECTS,
        Sensor::Gyroscope => gyroscope::EFFECTS,
        Sensor::Magnetometer => magnetometer::EFFECTS,
    };
    registry.iter().map(|effect| EffectRef::from(*effect))
}

/// The whole catalogue.
///
/// ```
/// assert!(stillpoint_effects::catalogue().any(|effect| effect.name() == "gyro_g_sensitivity"));
/// ```
pub fn catalogue() -> impl Iterator<Item = EffectRef> {
    Sensor::ALL.into_iter().flat_map(catalogue_of)
}

/// The effect of that name.
pub fn effect_named(name: &str) -> Option<EffectRef> {
    catalogue().find(|effect| effect.name() == name)
}

/// The effect that is the rotation of the earth.
pub fn earth_rotation() -> EffectRef {
    gyroscope::EARTH_ROTATION.into()
}

/// Returns true if the effect comes from a field fixed to the room: all of its parameters depend on the heading.
pub fn stands_in_the_room(effect: &EffectRef) -> bool {
    let mut params = effect.params().iter();
    params.all(|p| p.role == Role::Reference)
}

/// Returns true if the effect depends on the last turn.
pub fn follows_turns(effect: &EffectRef) -> bool {
    effect.needs().contains(&Quantity::LastTurn)
}

/// The effect of a field that stands in the room.
pub fn room_field(sensor: Sensor) -> Option<EffectRef> {
    catalogue_of(sensor).find(stands_in_the_room)
}

/// The effect of a bias that relaxes after a turn.
pub fn relaxation(sensor: Sensor) -> Option<EffectRef> {
    catalogue_of(sensor).find(follows_turns)
}

/// The effect that is the sensitivity of the rate to specific force.
pub fn force_sensitivity() -> EffectRef {
    gyroscope::FORCE_SENSITIVITY.into()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use sensor::{Axis, DefinedParam, Definition, Kinematics};

    use super::*;

    #[test]
    fn the_formula_of_an_effect_is_its_error() {
        let of_an_instant = [
            Quantity::SpecificForce,
            Quantity::AngularRate,
            Quantity::Time,
            Quantity::Temperature,
        ];
        let mut compared = 0;
        for effect in catalogue().filter(|effect| effect.sensor() != Sensor::Magnetometer) {
            let is_known = |quantity: &Quantity| of_an_instant.contains(quantity);
            let formula = effect.formula(Axis::X);
            let name = effect.name();
            assert_eq!(
                effect.needs().iter().all(is_known),
                formula.is_some(),
                "{name}"
            );
            if formula.is_none() {
                continue;
            }
            let parameters = effect.params().iter();
            let own = Definition {
                name: "own".into(),
                x: effect.formula(Axis::X).unwrap(),
                y: effect.formula(Axis::Y).unwrap(),
                z: effect.formula(Axis::Z).unwrap(),
                parameters: parameters
                    .map(|p| DefinedParam {
                        nominal: p.nominal,
                        ..DefinedParam::new(&p.name, &p.unit, 0.1)
                    })
                    .collect(),
                ..Definition::silent(effect.sensor())
            };
            let own = own.effect().unwrap();
            let p: Vec<f64> = (0..effect.params().len())
                .map(|k| 0.7 + 0.3 * k as f64)
                .collect();
            for sign in [1.0, -1.0] {
                let mut truth = Kinematics::new(
                    Vector3::new(2.0, -3.0, 5.0) * sign,
                    Vector3::new(-0.7, 1.1, 0.4) * sign,
                );
                truth.time = 3.0 + 2.5 * sign;
                truth.temperature = 31.0 + 9.0 * sign;
                let (found, expected) = (own.error_f64(&truth, &p), effect.error_f64(&truth, &p));
                assert!(
                    (found - expected).norm() <= 1e-12 * expected.norm(),
                    "{name}"
                );
            }
            compared += 1;
        }
        assert!(compared >= 26);
    }
}
