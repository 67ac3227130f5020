//! Names that what remains explains, or outweighs, are withdrawn.

use nalgebra::{DMatrix, DVector};
use recording::Error;
use sensor::{EffectRef, Role, Sensor};

use super::biases::biases;
use super::scatter::scatters;
use super::unexplained::Unexplained;
use super::weighed_again::weighed_again;
use crate::extension::Extension;
use crate::family::Claim;
use crate::gap::held_out::gap_of;
use crate::gap::sequence::{Sequence, channel_of};
use crate::rank::APART;
use crate::request::Session;
use crate::score::log_tail;
use crate::search::Search;
use crate::state::State;

/// Coefficients that chance makes so large in more cases than this say nothing.
const BY_CHANCE: f64 = 0.05;

/// An effect that leaves less than this share of the misfit of its channel is what is missing: what it leaves is of second order.
const NEARLY_ALL: f64 = 0.01;

/// Withdraws the effects that are not evident against what remains unexplained: a rest of `g` times the noise
/// makes all likelihood ratios `g²` times too large. One that explains nearly all stays.
pub(crate) fn without_weak(session: &Session<'_>, found: &mut Search) -> Result<bool, Error> {
    let threshold = session.request.threshold();
    let noise = found.last.noise;
    let left = Sequence::of(&found.last, noise).misfits(&found.last);
    let mut extension = found.last.extension.clone();
    let before = found.names.len();
    found.names.retain(|name| {
        let Claim::Effect(effect) = &name.claim else {
            return true;
        };
        let without = Sequence::of(&name.without, noise);
        let channel = channel_of(&without.of_column(name.predicted().col_as_slice(0)));
        let gap = gap_of(&left, channel).max(1.0);
        let before = gap_of(&without.misfits(&name.without), channel);
        let explains_nearly_all = gap.powi(2) < NEARLY_ALL * before.powi(2);
        let ranked = &name.ranked;
        let evident =
            explains_nearly_all || ranked.evidence_at(ranked.statistic / (gap * gap)) > threshold;
        if !evident {
            extension.effects.retain(|(e, _)| e.name() != effect.name());
        }
        evident
    });
    if found.names.len() == before {
        return Ok(false);
    }
    found.last = found.fit(session, extension)?;
    Ok(true)
}

/// Withdraws the steps that a bias which wanders explains as well: whether there were any.
///
/// A step moves and stays. Beside a random walk, which forgets nothing, a bias that comes back after some seconds can be fitted by
/// a step wherever it stayed away for long.
pub(crate) fn without_doubtful_steps(
    session: &Session<'_>,
    search: &mut Search,
) -> Result<bool, Error> {
    let mut less = search.last.extension.clone();
    for name in &search.names {
        let Claim::Effect(effect) = &name.claim else {
            continue;
        };
        if effect.instant().is_some()
            && wandering(&name.without, effect.sensor()) > name.ranked.by_ratio() - APART
        {
            less.effects.retain(|(own, _)| own.name() != effect.name());
        }
    }
    withdraw(session, search, less)
}

/// Goes on with fewer effects and faults, where `less` has fewer; whether it has.
pub(crate) fn withdraw(
    session: &Session<'_>,
    search: &mut Search,
    less: Extension,
) -> Result<bool, Error> {
    let of = |own: &Extension| own.effects.len() + own.disturbed.len();
    let has_fewer = of(&less) < of(&search.last.extension);
    if has_fewer {
        search.withdraw_to(session, less)?;
    }
    Ok(has_fewer)
}

/// The evidence that the bias of an axis of a sensor wanders.
fn wandering(state: &State, sensor: Sensor) -> f64 {
    let found = scatters(&biases(state, state.levels()));
    let search = (found.len().max(1) as f64).ln();
    let own = found.iter().filter(|scatter| scatter.sensor == sensor);
    own.map(|scatter| -scatter.log_p - search)
        .fold(0.0, f64::max)
}

/// Withdraws the steps of a sensor whose bias wanders beside them: whether there were any.
pub(crate) fn without_steps_of(
    session: &Session<'_>,
    search: &mut Search,
    sensor: Sensor,
) -> Result<bool, Error> {
    let wanders = |effect: &EffectRef| effect.sensor() == sensor && effect.instant().is_some();
    let mut less = search.last.extension.clone();
    less.effects.retain(|(effect, _)| !wanders(effect));
    withdraw(session, search, less)
}

/// Withdraws the effects that the last fit cannot tell from none: whether there were any.
///
/// A name is evident beside those that the search had then. Where one of them has been withdrawn since, or a larger walk leaves its
/// coefficients within chance of zero, `βᵀ C⁻¹ β` of `C` their covariance in the last fit, the device need not have it.
pub(crate) fn without_undetermined(
    session: &Session<'_>,
    search: &mut Search,
) -> Result<bool, Error> {
    let known = search.last.fit.shared_uncertainty();
    let values = &search.last.fit.parameters;
    let by_chance_alone = |effect: &EffectRef| {
        let of = |p: &sensor::Param| format!("{}.{}", effect.name(), p.name);
        let coefficients = effect.params().iter();
        let coefficients = coefficients.filter(|p| p.role == Role::Coefficient);
        let places: Option<Vec<(usize, f64)>> = coefficients
            .map(|p| {
                let place = known.names.iter().position(|name| *name == of(p))?;
                Some((place, values.get(&of(p))?))
            })
            .collect();
        let Some(places) = places.filter(|places| !places.is_empty()) else {
            return false;
        };
        let n = places.len();
        let covariance = DMatrix::from_fn(n, n, |i, k| known.covariance[places[i].0][places[k].0]);
        let beta = DVector::from_fn(n, |i, _| places[i].1);
        covariance.cholesky().is_some_and(|factor| {
            log_tail(beta.dot(&factor.solve(&beta)), n as f64) > BY_CHANCE.ln()
        })
    };
    let mut less = search.last.extension.clone();
    let is_named = |own: &EffectRef| {
        let names = search.names.iter();
        let mut named = names.filter_map(|name| name.claim.effect());
        named.any(|effect| effect.name() == own.name())
    };
    less.effects
        .retain(|(effect, _)| !(is_named(effect) && by_chance_alone(effect)));
    withdraw(session, search, less)
}

/// Withdraws what is no longer evident beside the shape of what remains.
pub(crate) fn weigh_beside_shape(
    session: &Session<'_>,
    search: &mut Search,
    found: &mut Unexplained,
) -> Result<(), Error> {
    let Some(shape) = &found.columns else {
        return Ok(());
    };
    let Some(less) = weighed_again(search, &session.request, &shape.columns, shape.noise) else {
        return Ok(());
    };
    let withdrawn = search.withdraw_to(session, less)?;
    found.instead_of.extend(withdrawn);
    Ok(())
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_distr::StandardNormal;
    use simulate::Spec;

    use crate::{Request, discover};

    /// A bias that wanders with a memory of 20 s and jumps once beside it: nobody can say that it moved and stayed.
    #[test]
    fn a_bias_that_jumps_and_wanders_has_no_step() {
        let mut spec = Spec::hand_held(21);
        spec.accelerometer.random_walk = 0.0;
        let mut recording = spec.run().unwrap().recording;
        let stream = recording.accelerometer.as_mut().unwrap();
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(4);
        let (first, last) = (stream.t[0], *stream.t.last().unwrap());
        let (mut bias, mut before) = (0.0_f64, first);
        for (t, value) in stream.t.iter().zip(&mut stream.values) {
            let keeps = (-(t - before) / 20.0).exp();
            let kick: f64 = random.sample(StandardNormal);
            bias = keeps * bias + (1.0 - keeps * keeps).sqrt() * 4e-3 * kick;
            before = *t;
            value.z += bias + if *t > 0.5 * (first + last) { 8e-3 } else { 0.0 };
        }
        let findings = discover(&[recording], &Request::new(spec.gravity))
            .unwrap()
            .findings;
        assert!(findings.unexplained.is_some(), "{:?}", findings.verdict);
        let steps = findings.effects.iter().filter(|e| e.name == "accel_step");
        assert_eq!(steps.count(), 0);
    }
}
