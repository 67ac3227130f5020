//! Effects that a user wrote: what they may cost, and failures that are theirs.

use findings::{Finding, Kind};
use recording::{Error, Recording, Stream};
use sensor::{AnyEffect, EffectFault, fault_of};

/// Grants each as many steps as fits of these recordings need.
pub fn grant_steps<'a>(
    effects: &[&'static dyn AnyEffect],
    recordings: impl Iterator<Item = &'a Recording>,
) {
    let samples = |r: &Recording| {
        let streams = [&r.accelerometer, &r.gyroscope].into_iter().flatten();
        streams.map(Stream::len).max().unwrap_or(0)
    };
    let samples = recordings.map(samples).sum();
    for effect in effects {
        sensor::grant_steps(*effect, samples);
    }
}

/// The outcome; the error of the effect that is to blame where a fit failed or an effect's steps are spent.
pub fn blamed<T>(
    effects: &[&'static dyn AnyEffect],
    outcome: Result<T, Error>,
) -> Result<T, Error> {
    let fault = effects.iter().find_map(|effect| {
        let fault = fault_of(*effect)?;
        let spent = fault == EffectFault::StepsSpent;
        (outcome.is_err() || spent).then(|| Finding::of_effect(*effect, &fault))
    });
    match (fault, outcome) {
        (Some(fault), _) => Err(Error::not_converged(fault)),
        (None, outcome) => outcome.map_err(|error| suspected(effects, error)),
    }
}

/// The error of a fit with the effects of a user named, whose formulas may be the reason.
fn suspected(effects: &[&'static dyn AnyEffect], error: Error) -> Error {
    let own = effects
        .iter()
        .filter(|effect| effect.definition().is_some());
    let own: Vec<&str> = own.map(|effect| effect.name()).collect();
    if own.is_empty() {
        return error;
    }
    let name = if own.len() == 1 { "effect" } else { "effects" };
    let suspected = Finding::of(Kind::OwnEffectSuspected).detail(name, own.join(", "));
    let with = |reason: Box<Finding>| reason.because(suspected);
    match error {
        Error::NotEnough(reason) => Error::not_enough(with(reason)),
        Error::NotConverged(reason) => Error::not_converged(with(reason)),
        other => other,
    }
}

/// Lists the faults of effects that a search left out because of them.
pub fn left_out(effects: &[&'static dyn AnyEffect]) -> impl Iterator<Item = Finding> {
    effects.iter().filter_map(|effect| {
        let fault = fault_of(*effect)?;
        Some(
            Finding::of(Kind::EffectFault)
                .detail("effect", effect.name())
                .because(Finding::of_effect(*effect, &fault)),
        )
    })
}
