//! Effects that a user wrote: what they may cost, and failures that are theirs.

use findings::{Finding, Kind};
use recording::{Error, Recording, Stream};
use sensor::{EffectFault, EffectRef};

/// The same effects, each with as many steps as fits of these recordings need: a budget of this run alone.
pub fn granted<'a>(
    effects: &[EffectRef],
    recordings: impl Iterator<Item = &'a Recording>,
) -> Vec<EffectRef> {
    let samples = |r: &Recording| {
        let streams = [&r.accelerometer, &r.gyroscope].into_iter().flatten();
        streams.map(Stream::len).max().unwrap_or(0)
    };
    let samples = recordings.map(samples).sum();
    let of_run = |effect: &EffectRef| effect.granted(samples).unwrap_or_else(|| effect.clone());
    effects.iter().map(of_run).collect()
}

/// The outcome; the error of the effect that is to blame where a fit failed or an effect's steps are spent.
pub fn blamed<T>(effects: &[EffectRef], outcome: Result<T, Error>) -> Result<T, Error> {
    let fault = effects.iter().find_map(|effect| {
        let fault = effect.fault()?;
        let spent = fault == EffectFault::StepsSpent;
        (outcome.is_err() || spent).then(|| Finding::of_effect(effect, &fault))
    });
    match (fault, outcome) {
        (Some(fault), _) => Err(Error::not_converged(fault)),
        (None, outcome) => outcome.map_err(|error| suspected(effects, error)),
    }
}

/// The error of a fit with the effects of a user named, whose formulas may be the reason.
fn suspected(effects: &[EffectRef], error: Error) -> Error {
    let own = effects
        .iter()
        .filter(|effect| effect.definition().is_some());
    let own: Vec<&str> = own.map(|effect| effect.name()).collect();
    if own.is_empty() {
        return error;
    }
    let name = if own.len() == 1 { "effect" } else { "effects" };
    let suspected = Finding::of(Kind::OWN_EFFECT_SUSPECTED).detail(name, own.join(", "));
    let with = |reason: Box<Finding>| reason.because(suspected);
    match error {
        Error::NotEnough(reason) => Error::not_enough(with(reason)),
        Error::NotConverged(reason) => Error::not_converged(with(reason)),
        other => other,
    }
}

/// Lists the faults of effects that a search left out because of them.
pub fn left_out(effects: &[EffectRef]) -> impl Iterator<Item = Finding> {
    effects.iter().filter_map(|effect| {
        let fault = effect.fault()?;
        Some(
            Finding::of(Kind::EFFECT_FAULT)
                .detail("effect", effect.name())
                .because(Finding::of_effect(effect, &fault)),
        )
    })
}
