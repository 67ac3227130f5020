//! The effects a simulated device has, and how large they are.

use std::collections::BTreeMap;

use findings::{Finding, Kind};
use recording::Error;
use sensor::{EffectRef, Model, Role, Sensor};
use solver::Parameters;

use super::device::Device;
use super::random::{Purpose, Random};
use super::spec::{SIZE, Spec};

/// One sensor of the device that `spec` asks for, with random errors where it says nothing. `end` is
/// the length of the recording, s.
pub(crate) fn draw_device(
    spec: &Spec,
    sensor: Sensor,
    seed: u64,
    end: f64,
) -> Result<Device, Error> {
    let mut model = Model::base(sensor);
    let mut drawn = Vec::from(spec.grade.draw(sensor, seed).parameters());
    let effects = spec.all_effects();
    for (place, effect) in spec.catalogue(sensor)?.iter().enumerate() {
        if let Some(wanted) = effects.get(effect.name()) {
            model = model.with(effect.clone());
            let mut random = Random::new(seed, Purpose::Effect(sensor, place));
            drawn.extend(coefficients(effect, wanted, end, &mut random));
        }
    }
    let mut parameters: Parameters = model.parameters();
    parameters.values_mut().copy_from_slice(&drawn);
    for (name, value) in &spec.parameters {
        if let Some(place) = parameters.index(name) {
            parameters.values_mut()[place] = *value;
        }
    }
    let device = Device::new(model, parameters);
    match device.is_regular() {
        true => Ok(device),
        false => Err(Error::usage(
            Finding::of(Kind::MATRIX_SINGULAR)
                .of_sensor(sensor)
                .detail("key", format!("parameters.{}.T", sensor.prefix())),
        )),
    }
}

/// Coefficients that are not given get a random sign and 0.5 to 1.5 times `size` typical sizes.
fn coefficients(
    effect: &EffectRef,
    wanted: &BTreeMap<String, f64>,
    end: f64,
    random: &mut Random,
) -> Vec<f64> {
    let names_one = effect
        .params()
        .iter()
        .any(|p| wanted.contains_key(&*p.name));
    let size = wanted
        .get(SIZE)
        .copied()
        .unwrap_or(if names_one { 0.0 } else { 1.0 });
    let draw = |k: usize, p: &sensor::Param, random: &mut Random| {
        let drawn = random.sign() * random.uniform(0.5..1.5) * size * effect.typical_of(k);
        match (p.role, p.nominal) {
            // A step is only seen if it lies within the recording.
            (Role::Instant, _) => random.uniform(0.3 * end..0.7 * end),
            (_, 0.0) => drawn,
            (_, nominal) => nominal,
        }
    };
    let mut value = |(k, p): (usize, &sensor::Param)| {
        let drawn = draw(k, p, random);
        wanted.get(&*p.name).copied().unwrap_or(drawn)
    };
    effect.params().iter().enumerate().map(&mut value).collect()
}
