//! Names and faults weighed again beside what no effect of the catalogue describes.

use estimate::methods::joint::{BiasNoise, Known};
use faer::Mat;

use crate::extension::Extension;
use crate::family::{Claim, Family, beside, families};
use crate::rank::cost_of_choice;
use crate::request::Request;
use crate::score::{log_tail, score};
use crate::search::Search;
use crate::state::State;

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
pub(crate) fn weighed_again(
    search: &Search,
    request: &Request,
    columns: &Mat<f64>,
    noise: BiasNoise,
) -> Option<Extension> {
    let (base, last) = (&search.base, &search.last);
    let candidates = request.candidates();
    let families = families(base, &candidates);
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
        if least > request.threshold() {
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

/// The extension with the `kept` alone; companions and what no family holds stay with them.
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
