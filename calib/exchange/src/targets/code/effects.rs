//! Effects of a calibration as code: the signals are what the base models give less the errors at the signals.

use calib::effects::force_sensitivity;
use sensor::expression::Language;
use sensor::{Axis, Covariate, EffectRef, REFERENCE_TEMPERATURE, Sensor, error_code};

use crate::source::Source;

/// Rounds in which signals and their errors are made to agree: each leaves what an effect makes of an error, a hundredth or less.
pub const ROUNDS: usize = 6;

/// The errors of both sensors in a language, as expressions over the names of covariates.
#[derive(Clone, Debug)]
pub struct Effects {
    /// The sensors that the calibration has.
    pub signals: Vec<Signal>,
    /// What time and temperature that the errors look at are, by name: of the arguments `seconds` and `celsius`.
    pub surroundings: Vec<String>,
}

/// A sensor in code.
#[derive(Clone, Debug)]
pub struct Signal {
    /// The sensor's name.
    pub name: &'static str,
    /// The variable of what the base model gives.
    pub base: &'static str,
    /// The variable of the signal.
    pub signal: &'static str,
    /// True if the function of its base model takes a force.
    pub takes_force: bool,
    /// Components of the signal that errors look at, by name and place.
    pub seen: Vec<(Covariate, usize)>,
    /// The error on each axis.
    pub errors: [String; 3],
}

impl Effects {
    /// Those of a calibration; `None` where it has none but a g-sensitivity.
    pub fn of(source: &Source<'_>, language: Language) -> Option<Self> {
        let mut effects = source.calibration.effects.iter();
        let others = effects.find(|values| {
            let effect = values.effect().ok().filter(is_code);
            effect.is_some_and(|effect| effect.name() != force_sensitivity().name())
        });
        others?;
        let mut seen = Vec::new();
        let sensors = [
            (Sensor::Accelerometer, source.accelerometer.is_some()),
            (Sensor::Gyroscope, source.gyroscope.is_some()),
        ];
        let sensors = sensors.into_iter().filter(|(_, has)| *has);
        let errors = sensors.map(|(sensor, _)| {
            let of = |axis| sum(source, (sensor, axis), language, &mut seen);
            (sensor, Axis::ALL.map(of))
        });
        let errors: Vec<(Sensor, [String; 3])> = errors.collect();
        let is_with_g = source.g_sensitivity.is_some();
        let signals = errors.into_iter().map(|(sensor, errors)| {
            let is_force = sensor == Sensor::Accelerometer;
            let of = if is_force {
                Covariate::SpecificForce
            } else {
                Covariate::AngularRate
            };
            let components = Axis::ALL.into_iter().map(of).enumerate();
            Signal {
                name: sensor.name(),
                base: if is_force { "a" } else { "w" },
                signal: if is_force { "force" } else { "rate" },
                takes_force: !is_force && is_with_g,
                seen: components
                    .filter(|(_, component)| seen.contains(component))
                    .map(|(axis, component)| (component, axis))
                    .collect(),
                errors,
            }
        });
        let reference = language.number(REFERENCE_TEMPERATURE);
        let surroundings = [
            (Covariate::Time, "t = seconds".to_owned()),
            (Covariate::Temperature, "T = celsius".to_owned()),
            (
                Covariate::TemperatureChange,
                format!("dT = celsius - {reference}"),
            ),
        ];
        let surroundings = surroundings.into_iter();
        Some(Self {
            signals: signals.collect(),
            surroundings: surroundings
                .filter(|(covariate, _)| seen.contains(covariate))
                .map(|(_, set)| set)
                .collect(),
        })
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
        let effect = values.effect().ok().filter(is_code);
        let Some(effect) = effect.filter(|effect| effect.sensor() == sensor) else {
            continue;
        };
        let p: Vec<f64> = values.parameters.iter().map(|v| v.value).collect();
        let Some(code) = error_code(&*effect, &p, axis, language) else {
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
pub fn is_code(effect: &EffectRef) -> bool {
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
            let code = error_code(&**effect, &p, *axis, Language::Rust);
            code.is_some_and(|code| code.covariates.iter().all(is_known))
        })
}
