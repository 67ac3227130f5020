//! Names in a spec: effects and parameters.

use findings::{Finding, Kind};
use sensor::{EffectRef, Nature, Param, Quantity, Role, Sensor, base_names};

use super::Spec;
use super::complaint::{Complaint, number};
use super::wanted::SIZE;

/// Largest number that makes sense anywhere in a spec.
const HUGE: f64 = 1e9;

impl Spec {
    /// Effects and parameters exist, have numbers, and can show.
    pub(super) fn check_names(&self) -> Result<(), Complaint> {
        let each = Sensor::ALL.map(|sensor| self.catalogue(sensor));
        let all = each.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        for (name, wanted) in &self.effects {
            let key = format!("effects.{name}");
            let Some(effect) = all.iter().find(|e| e.name() == name) else {
                let found = Finding::of(Kind::EFFECT_UNKNOWN);
                let known = all.iter().map(|e| e.name());
                return Err(Complaint::new(key, found.or_nearest(name, known)));
            };
            for (parameter, value) in wanted {
                let key = format!("{key}.{parameter}");
                let own = || effect.params().iter().map(|p| &*p.name).chain([SIZE]);
                if !own().any(|n| n == parameter) {
                    let known = own().collect::<Vec<_>>().join(", ");
                    let found = Finding::of(Kind::PARAMETER_UNKNOWN)
                        .detail("effect", name.clone())
                        .detail("known", known)
                        .or_nearest(parameter, own());
                    return Err(Complaint::new(key, found));
                }
                let own = effect.params().iter().find(|p| p.name == *parameter);
                let is_shape = |p: &Param| matches!(p.role, Role::Shape | Role::TimeConstant);
                let smallest = if own.is_some_and(is_shape) {
                    1e-3
                } else {
                    -HUGE
                };
                number(&key, *value, smallest..=HUGE)?;
            }
            if effect.sensor() == Sensor::Magnetometer && self.magnetic_field.is_none() {
                return Err(silent(key, "magnetic_field"));
            }
            self.check_effect_shows(effect)?;
        }
        self.check_parameters(&all)
    }

    /// An effect that cannot show would be a truth that nobody can find.
    fn check_effect_shows(&self, effect: &EffectRef) -> Result<(), Complaint> {
        let key = format!("effects.{}", effect.name());
        let needs = effect.needs();
        if needs.iter().any(|need| need.is_thermal()) && self.temperature.is_none() {
            return Err(silent(key, "temperature"));
        }
        if needs.contains(&Quantity::Vibration) && self.vibration.is_none() {
            return Err(silent(key, "vibration"));
        }
        if effect.nature() == Nature::EarthRotation && self.latitude.is_some() {
            let twice = Finding::of(Kind::GIVEN_TWICE).detail("other", "latitude");
            return Err(Complaint::new(key, twice));
        }
        Ok(())
    }

    fn check_parameters(&self, all: &[EffectRef]) -> Result<(), Complaint> {
        let mut known: Vec<String> = Sensor::ALL.into_iter().flat_map(base_names).collect();
        for effect in all.iter().filter(|e| self.effects.contains_key(e.name())) {
            known.extend(
                effect
                    .params()
                    .iter()
                    .map(|p| format!("{}.{}", effect.name(), p.name)),
            );
        }
        for (name, value) in &self.parameters {
            let key = format!("parameters.{name}");
            if !known.contains(name) {
                let found = Finding::of(Kind::PARAMETER_UNKNOWN);
                let known = known.iter().map(String::as_str);
                return Err(Complaint::new(key, found.or_nearest(name, known)));
            }
            number(&key, *value, -HUGE..=HUGE)?;
        }
        Ok(())
    }
}

/// An effect that a spec has no section for.
fn silent(key: String, section: &'static str) -> Complaint {
    Complaint::new(
        key,
        Finding::of(Kind::EFFECT_SILENT).detail("section", section),
    )
}
