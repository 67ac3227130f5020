//! Names that what remains explains, or outweighs, are withdrawn.

use std::sync::Arc;

use ::findings::Kind;
use estimate::methods::joint::{BiasNoise, Known};
use faer::Mat;
use nalgebra::{DMatrix, DVector};
use recording::Error;
use sensor::{EffectRef, Role, Sensor};

use super::biases::biases;
use super::scatter::scatters;
use crate::family::{Claim, Family, beside, families};
use crate::gap::held_out::gap_of;
use crate::gap::sequence::Sequence;
use crate::rank::{APART, cost_of_choice};
use crate::request::Session;
use crate::score::{log_tail, score};
use crate::search::Search;
use crate::state::{Extension, State};

findings::tuning! {
    /// Coefficients that chance makes so large in more cases than this say nothing.
    BY_CHANCE: f64 = 0.05;

    /// An effect that leaves less than this share of the misfit of its channel is what is missing: what it leaves is of second order.
    NEARLY_ALL: f64 = 0.01;
}

/// Withdraws the effects that are not evident against what remains unexplained: a rest of `g` times the noise
/// makes all likelihood ratios `g²` times too large. One that explains nearly all stays.
pub(crate) fn without_weak(session: &Session<'_>, found: &mut Search) -> Result<bool, Error> {
    let threshold = session.request.threshold();
    let noise = found.last.noise;
    let left = Sequence::of(&found.last, noise).misfits(&found.last);
    found.withdraw_where(session, |name| {
        if name.claim.effect().is_none() {
            return false;
        }
        let without = Sequence::of(&name.without, noise);
        let channel = without.channel_of(&name.predicted());
        let gap = gap_of(&left, channel).max(1.0);
        let before = gap_of(&without.misfits(&name.without), channel);
        let explains_nearly_all = gap.powi(2) < NEARLY_ALL.get() * before.powi(2);
        let ranked = &name.ranked;
        let evident =
            explains_nearly_all || ranked.evidence_at(ranked.statistic / (gap * gap)) > threshold;
        !evident
    })
}

/// Withdraws the steps that a bias which wanders explains as well: whether there were any.
///
/// A step moves and stays. Beside a random walk, which forgets nothing, a bias that comes back after some seconds can be fitted by
/// a step wherever it stayed away for long.
pub(crate) fn without_doubtful_steps(
    session: &Session<'_>,
    search: &mut Search,
) -> Result<bool, Error> {
    search.withdraw_where(session, |name| {
        let wanders =
            |sensor| wandering(&name.without, sensor) > name.ranked.by_ratio() - APART.get();
        name.stepping().is_some_and(wanders)
    })
}

/// The evidence that the bias of an axis of a sensor wanders.
fn wandering(state: &State, sensor: Sensor) -> f64 {
    let found = scatters(&biases(state, state.levels()));
    let search = (found.len().max(1) as f64).ln();
    let own = found.iter().filter(|scatter| scatter.sensor == sensor);
    own.map(|scatter| -scatter.log_p - search)
        .fold(0.0, f64::max)
}

/// Withdraws the effects that the last fit cannot tell from none: whether there were any.
///
/// A name is evident beside those that the search had then. Where one of them has been withdrawn since, or a larger walk leaves its
/// coefficients within chance of zero, `βᵀ C⁻¹ β` of `C` their covariance in the last fit, the device need not have it.
pub(crate) fn without_undetermined(
    session: &Session<'_>,
    search: &mut Search,
) -> Result<bool, Error> {
    // Of a device that turns while it should rest that motion is in the fit that its calibration is written of, and in no fit of the search: a
    // name has to be evident there, among all that might have been named.
    let tried = session.candidates.len().max(1) as f64;
    let (fit, level) = match session.remarks.has(Kind::RESTS_TURN) {
        true => {
            let fit = Arc::new(search.last.fitted_in_full(session)?);
            (fit, -session.request.threshold() - tried.ln())
        }
        false => (Arc::clone(&search.last.fit), BY_CHANCE.get().ln()),
    };
    let known = fit.shared_uncertainty();
    let values = &fit.parameters;
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
        covariance
            .cholesky()
            .is_some_and(|factor| log_tail(beta.dot(&factor.solve(&beta)), n as f64) > level)
    };
    search.withdraw_where(session, |name| {
        name.claim.effect().is_some_and(by_chance_alone)
    })
}

/// Withdraws what is no longer evident beside `columns` (`m × k`, white-whitened), a shape or a formula, under the noise that it was found
/// with: the names that go, `None` where all stays.
pub(crate) fn withdrawn_beside(
    session: &Session<'_>,
    search: &mut Search,
    columns: &Mat<f64>,
    noise: BiasNoise,
) -> Result<Option<Vec<String>>, Error> {
    let less = weighed_again(search, session, columns, noise);
    less.map(|less| search.withdraw_to(session, less))
        .transpose()
}

/// One term of the model, with the columns of the family that it was taken from.
struct Item {
    claim: Claim,
    known: Option<Known>,
    columns: Mat<f64>,
    /// Price of its search, and degrees of freedom of a shape.
    cost: f64,
    shape_dof: f64,
}

/// The extension of the final model without what is no longer evident beside `columns` (`m × k`, white-whitened), a shape
/// or a formula: backward elimination at the base model under the noise that it was found with. `None` where all stays.
fn weighed_again(
    search: &Search,
    session: &Session<'_>,
    columns: &Mat<f64>,
    noise: BiasNoise,
) -> Option<Extension> {
    let (base, last) = (&search.base, &search.last);
    let families = families(base, &session.candidates);
    let mut items = items(last, &families);
    let before = items.len();
    let whitened = base.projected.at(noise)?;
    let white = |columns: &Mat<f64>| whitened.columns(&base.projected.columns(columns.as_ref()));
    let shape = white(columns);
    for item in &mut items {
        item.columns = white(&item.columns);
    }
    let explained = |kept: &[&Item]| {
        let own = kept.iter().map(|item| item.columns.clone());
        let all: Vec<Mat<f64>> = std::iter::once(shape.clone()).chain(own).collect();
        let score = score(beside(&all, whitened.z.nrows()).as_ref(), &whitened.z);
        (score.statistic, score.dof as f64)
    };
    while !items.is_empty() {
        let all: Vec<&Item> = items.iter().collect();
        let (whole, dof) = explained(&all);
        let evidence = |k: usize| {
            let mut others = all.clone();
            let own = others.remove(k);
            let (without, fewer) = explained(&others);
            -log_tail(whole - without, (dof - fewer).max(1.0) + own.shape_dof) - own.cost
        };
        let weights = (0..items.len()).map(|k| (evidence(k), k));
        let (least, place) = weights.min_by(|a, b| a.0.total_cmp(&b.0))?;
        if least > session.request.threshold() {
            break;
        }
        items.remove(place);
    }
    (items.len() < before).then(|| without(&last.extension, &items))
}

fn items(last: &State, families: &[Family]) -> Vec<Item> {
    let choice = cost_of_choice(families);
    let mut items = Vec::new();
    for family in families {
        let cost = family.log_places + choice;
        for (k, hypothesis) in family.hypotheses.iter().enumerate() {
            let known = match &family.claim {
                Claim::Effect(effect) => {
                    let own = |(e, shape): &(sensor::EffectRef, _)| {
                        e.name() == effect.name() && *shape == hypothesis.shape
                    };
                    if !last.extension.effects.iter().any(own) {
                        continue;
                    }
                    None
                }
                Claim::Disturbed(fault) => {
                    let known = hypothesis.place.and_then(|place| last.known(fault, place));
                    if known.is_none() {
                        continue;
                    }
                    known
                }
                Claim::Shape(..) => continue,
            };
            items.push(Item {
                claim: family.claim.clone(),
                known,
                columns: family.columns_of(k),
                cost,
                shape_dof: family.shape_dof,
            });
        }
    }
    items
}

/// The extension with the `kept` alone.
fn without(extension: &Extension, kept: &[Item]) -> Extension {
    let mut less = extension.clone();
    less.disturbed
        .retain(|known| kept.iter().any(|item| item.known == Some(*known)));
    less.effects.retain(|(effect, _)| {
        kept.iter()
            .any(|item| matches!(&item.claim, Claim::Effect(own) if own.name() == effect.name()))
    });
    less
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
