//! Effects of a calibration as code: the signals are what the base models give less the errors at the signals.

use sensor::expression::Language;
use sensor::{AnyEffect, Axis, Covariate, Sensor, error_code};

use crate::source::Source;

/// Rounds in which signals and their errors are made to agree: each leaves what an effect makes of an error, a hundredth or less.
pub const ROUNDS: usize = 6;

/// The errors of both sensors in a language, as expressions over the names of covariates.
#[derive(Clone, Debug)]
pub struct Effects {
    /// The error on each axis, of the sensors that the calibration has.
    pub errors: Vec<(Sensor, [String; 3])>,
    /// What they look at.
    covariates: Vec<Covariate>,
}

impl Effects {
    /// Those of a calibration; `None` where it has none but a g-sensitivity.
    pub fn of(source: &Source<'_>, language: Language) -> Option<Self> {
        let mut effects = source.calibration.effects.iter();
        let is_more = effects.any(|values| {
            let effect = values.effect().ok();
            let is_g = source.g_sensitivity.is_some() && values.parameters.len() == 9;
            effect.is_some_and(|effect| is_code(effect) && !is_g)
        });
        if !is_more {
            return None;
        }
        let mut covariates = Vec::new();
        let sensors = [
            (Sensor::Accelerometer, source.accelerometer.is_some()),
            (Sensor::Gyroscope, source.gyroscope.is_some()),
        ];
        let sensors = sensors.into_iter().filter(|(_, has)| *has);
        let errors = sensors.map(|(sensor, _)| {
            let of = |axis| sum(source, (sensor, axis), language, &mut covariates);
            (sensor, Axis::ALL.map(of))
        });
        Some(Self {
            errors: errors.collect(),
            covariates,
        })
    }

    /// Returns true if an error looks at this covariate.
    pub fn look_at(&self, covariate: Covariate) -> bool {
        self.covariates.contains(&covariate)
    }
}

/// The sum of the errors on an axis.
fn sum(
    source: &Source<'_>,
    (sensor, axis): (Sensor, Axis),
    language: Language,
    covariates: &mut Vec<Covariate>,
) -> String {
    let mut terms = Vec::new();
    for values in &source.calibration.effects {
        let effect = values.effect().ok().filter(|effect| is_code(*effect));
        let Some(effect) = effect.filter(|effect| effect.sensor() == sensor) else {
            continue;
        };
        let p: Vec<f64> = values.parameters.iter().map(|v| v.value).collect();
        let Some(code) = error_code(effect, &p, axis, language) else {
            continue;
        };
        covariates.extend(code.covariates);
        terms.push(code.text);
    }
    match terms.is_empty() {
        true => language.number(0.0),
        false => terms.join(" + "),
    }
}

/// Returns true of an effect of the accelerometer or the gyroscope that is a formula of force, rate, time and temperature of one instant.
pub fn is_code(effect: &dyn AnyEffect) -> bool {
    let is_known = |covariate: &Covariate| {
        matches!(
            covariate,
            Covariate::SpecificForce(_)
                | Covariate::AngularRate(_)
                | Covariate::Time
                | Covariate::Temperature
                | Covariate::TemperatureChange
        )
    };
    let p = vec![1.0; effect.params().len()];
    effect.sensor() != Sensor::Magnetometer
        && Axis::ALL.iter().all(|axis| {
            let code = error_code(effect, &p, *axis, Language::Rust);
            code.is_some_and(|code| code.covariates.iter().all(is_known))
        })
}
