//! Time constants of named effects, fitted where the recordings show them.

use std::ops::Range;

use ::findings::{Finding, Kind};
use estimate::calibration::Calibration;
use sensor::{Param, Role};
use solver::Parameters;

use super::family::tried;
use super::request::Session;
use super::state::State;

findings::tuning! {
    /// A time constant so many times beyond those tried is none that the recording shows.
    BEYOND_TRIED: f64 = 3.0;
}

/// A time constant that these recordings do not show.
pub struct HeldShape {
    effect: String,
    parameter: Param,
    value: f64,
}

impl HeldShape {
    /// Returns true if the fitted value of the parameter is near those tried.
    fn is_shown_by(&self, fitted: &Parameters) -> bool {
        let place = fitted.index(&format!("{}.{}", self.effect, self.parameter.name));
        place.is_some_and(|k| near(&self.parameter).contains(&fitted.values()[k]))
    }
}

/// Fits the time constants of effects, where they come out near what was tried: amplitudes are no better known than
/// that. The effects of which they do not, with the parameter and its value.
///
/// Whatever else shapes an effect stays: the delay of late stamps is measured where no fit of static intervals sees it.
pub fn settle(session: &Session<'_>, last: &mut State) -> Vec<HeldShape> {
    let effects = last.extension.effects.iter();
    let shaped = effects.filter_map(|(effect, shape)| {
        let (k, value) = (*shape)?;
        let parameter = &effect.params()[k];
        (parameter.role == Role::TimeConstant).then_some(HeldShape {
            effect: effect.name().to_owned(),
            parameter: parameter.clone(),
            value,
        })
    });
    let held: Vec<HeldShape> = shaped.collect();
    if held.is_empty() {
        return held;
    }
    let mut extension = last.extension.clone();
    extension.settles = true;
    let Ok(settled) = State::fit(session, extension) else {
        return held;
    };
    let fitted = &settled.fit.parameters;
    // Where the recording does not show a time constant, its fit wanders along a valley without an end.
    let converged = settled.fit.ending.termination.converged();
    if converged && held.iter().all(|shape| shape.is_shown_by(fitted)) {
        *last = settled;
        return Vec::new();
    }
    held
}

/// Amplitudes beside a time constant that was supposed and not fitted have no standard error that holds.
pub fn say_held(calibration: &mut Calibration, held: &[HeldShape]) {
    for HeldShape {
        effect,
        parameter: Param { name, unit, .. },
        value,
    } in held
    {
        for own in calibration.effects.iter_mut().filter(|e| e.name == *effect) {
            own.parameters.iter_mut().for_each(|p| p.std = None);
        }
        calibration.warnings.push(
            Finding::of(Kind::TIME_CONSTANT_SUPPOSED)
                .detail("effect", effect.clone())
                .detail("parameter", &**name)
                .detail("value", format!("{value} {unit}")),
        );
    }
}

/// From a third of the least value tried to three times the largest.
fn near(p: &Param) -> Range<f64> {
    let tried = tried(p);
    let least = tried.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = tried.iter().copied().fold(0.0, f64::max);
    least / BEYOND_TRIED.get()..largest * BEYOND_TRIED.get()
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{Request, discover};

    #[test]
    fn late_stamps_are_measured_and_not_said_to_be_supposed() {
        let spec = Spec::hand_held(3).with_effect("time_offset", 3.0);
        let recordings = [spec.run().unwrap().recording];
        let findings = discover(&recordings, &Request::new(spec.gravity))
            .unwrap()
            .findings;
        assert!(findings.effects.iter().any(|e| e.name == "time_offset"));
        let warnings = findings
            .calibration
            .warnings
            .texts(::findings::Front::CommandLine);
        let supposed = warnings.iter().find(|w| w.contains("is supposed to be"));
        assert_eq!(supposed, None);
    }
}
