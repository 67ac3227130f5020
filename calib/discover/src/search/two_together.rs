//! Two effects that are evident together and not alone: what one does is noise of the biases or scatter of the turns
//! until the other is in the model.

use std::ops::Range;

use faer::Mat;
use nalgebra::{DMatrix, DVector};

use super::Finder;
use super::named_claim::NamedClaim;
use super::ranking::{PAIRED, Ranking};
use crate::family::{Claim, Family, beside};
use crate::noise::level::Level;
use crate::rank::{Ranked, Tried, cost_of_choice};
use crate::score::{Score, log_tail, of_normal};
use crate::state::State;

impl Finder<'_> {
    /// The two of the best families that are most evident together, each of them beside the other too.
    pub(super) fn two_together(
        &self,
        state: &State,
        ranking: &Ranking,
        unfit: &[Claim],
    ) -> Option<[NamedClaim; 2]> {
        let families = &ranking.families;
        let may = |r: &&Ranked| {
            let own = &families[r.family].claim;
            let is_effect = matches!(own, Claim::Effect(_));
            is_effect && !unfit.iter().any(|claim| claim.is_same(own))
        };
        let best: Vec<&Ranked> = ranking
            .ranked
            .iter()
            .filter(may)
            .take(PAIRED.get())
            .collect();
        // Nothing speaks for one of them.
        if best.first().is_none_or(|top| top.evidence < 0.0) {
            return None;
        }
        let levels = state.walks();
        let places = levels
            .iter()
            .map(|level| NormalEquations::of(state, families, &best, level));
        let places: Vec<NormalEquations> = places.collect();
        let mut top: Option<(f64, [NamedClaim; 2])> = None;
        for (i, one) in best.iter().enumerate() {
            for (k, other) in best.iter().enumerate().take(i) {
                let pair = [*one, *other];
                let found = self.beside_each_other(families, pair, [i, k], levels, &places);
                let Some((evidence, own)) = found else {
                    continue;
                };
                if top.as_ref().is_none_or(|(best, _)| evidence > *best) {
                    let held = [0, 1].map(|j| NamedClaim {
                        evidence: own[j],
                        ..NamedClaim::of(families, pair[j])
                    });
                    top = Some((evidence, held));
                }
            }
        }
        top.map(|(_, held)| held)
    }

    /// The evidence for two effects together, and for each beside the other; `None` unless all are enough for names.
    fn beside_each_other(
        &self,
        families: &[Family],
        pair: [&Ranked; 2],
        [i, k]: [usize; 2],
        levels: &[Level],
        seen: &[NormalEquations],
    ) -> Option<(f64, [f64; 2])> {
        let family = pair.map(|r| &families[r.family]);
        let search = family.map(|f| f.log_places + cost_of_choice(families));
        let shape_dof = family[0].shape_dof + family[1].shape_dof;
        let mut tried = Tried::default();
        let nothing = levels.first()?.whitened.log_likelihood();
        for (level, seen) in levels.iter().zip(seen) {
            let gained = level.whitened.log_likelihood() - nothing;
            tried.add(level, gained, seen.score(&[i, k]), shape_dof);
        }
        let evidence = -tried.log_p() - search[0] - search[1];
        let (likeliest, _, both) = tried.likeliest?;
        let there = levels
            .iter()
            .position(|level| std::ptr::eq(level, likeliest))?;
        let [one, other] = [i, k].map(|place| seen[there].score(&[place]));
        let of = |without: &Score, j: usize| {
            let dof = both.dof as f64 - without.dof as f64 + family[j].shape_dof;
            -log_tail(both.statistic - without.statistic, dof) - search[j]
        };
        let own = [of(&other, 0), of(&one, 1)];
        let enough = |e: &f64| *e > self.threshold;
        (enough(&evidence) && own.iter().all(enough)).then_some((evidence, own))
    }
}

/// The normal equations of the best hypotheses at one setting of the densities.
struct NormalEquations {
    gram: Mat<f64>,
    moved: Mat<f64>,
    columns: Vec<Range<usize>>,
}

impl NormalEquations {
    fn of(state: &State, families: &[Family], best: &[&Ranked], level: &Level) -> Self {
        let mut columns = Vec::new();
        let mut next = 0;
        let own = best.iter().map(|r| {
            let own = families[r.family].columns_of(r.hypothesis);
            columns.push(next..next + own.ncols());
            next += own.ncols();
            level
                .whitened
                .columns(&state.projected.columns(own.as_ref()))
        });
        let own: Vec<Mat<f64>> = own.collect();
        let all = beside(&own, level.whitened.z.nrows());
        Self {
            gram: all.transpose() * &all,
            moved: all.transpose() * &level.whitened.z,
            columns,
        }
    }

    /// Computes the score of the hypotheses at these places together.
    fn score(&self, places: &[usize]) -> Score {
        let own = places.iter().flat_map(|&place| self.columns[place].clone());
        let own: Vec<usize> = own.collect();
        let a = DMatrix::from_fn(own.len(), own.len(), |i, k| self.gram[(own[i], own[k])]);
        let b = DVector::from_fn(own.len(), |i, _| self.moved[(own[i], 0)]);
        of_normal(&a, &b)
    }
}
