//! Names in a spec: effects and parameters.

use effects::{is_earth_rotation, looks_at_temperature, looks_at_vibration};
use recording::did_you_mean;
use sensor::{AnyEffect, Param, Role, Sensor, base_names};

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
                let hint = did_you_mean(name, all.iter().map(|e| e.name()));
                return Err(Complaint::new(
                    key,
                    format!("there is no such effect{hint}"),
                ));
            };
            for (parameter, value) in wanted {
                let key = format!("{key}.{parameter}");
                let own = || effect.params().iter().map(|p| p.name).chain([SIZE]);
                if !own().any(|n| n == parameter) {
                    let known = own().collect::<Vec<_>>().join(", ");
                    let hint = did_you_mean(parameter, own());
                    let what = format!("`{name}` has no such parameter (it has {known}){hint}");
                    return Err(Complaint::new(key, what));
                }
                let own = effect.params().iter().find(|p| p.name == parameter);
                let is_shape =
                    |p: &Param| matches!(p.role_by_name(), Role::Shape | Role::TimeConstant);
                let smallest = if own.is_some_and(is_shape) {
                    1e-3
                } else {
                    -HUGE
                };
                number(&key, *value, smallest..=HUGE)?;
            }
            if effect.sensor() == Sensor::Magnetometer && self.magnetic_field.is_none() {
                let what = "is silent without a [magnetic_field] section";
                return Err(Complaint::new(key, what));
            }
            self.check_effect_shows(name)?;
        }
        self.check_parameters(&all)
    }

    /// An effect that cannot show would be a truth that nobody can find.
    fn check_effect_shows(&self, name: &str) -> Result<(), Complaint> {
        let key = format!("effects.{name}");
        if looks_at_temperature(name) && self.temperature.is_none() {
            let what = "is silent at constant temperature: add a [temperature] section";
            return Err(Complaint::new(key, what));
        }
        if looks_at_vibration(name) && self.vibration.is_none() {
            return Err(Complaint::new(
                key,
                "is silent without a [vibration] section",
            ));
        }
        if is_earth_rotation(name) && self.latitude.is_some() {
            return Err(Complaint::new(
                key,
                "is given twice: `latitude` switches it on too",
            ));
        }
        Ok(())
    }

    fn check_parameters(&self, all: &[&'static dyn AnyEffect]) -> Result<(), Complaint> {
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
                let hint = did_you_mean(name, known.iter().map(String::as_str));
                return Err(Complaint::new(
                    key,
                    format!("there is no such parameter{hint}"),
                ));
            }
            number(&key, *value, -HUGE..=HUGE)?;
        }
        Ok(())
    }
}
