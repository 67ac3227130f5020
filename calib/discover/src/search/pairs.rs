//! Two names found one after the other may stand for two others.

use faer::Mat;

use super::Finder;
use super::named_claim::NamedClaim;
use super::ranking::PAIRED;
use crate::family::{Claim, beside};
use crate::rank::{APART, Ranked};
use crate::score::{log_tail, score};

impl Finder<'_> {
    /// Two effects found one after the other may stand for two others: all pairs of the best families at the
    /// base model, the best of them instead where it is 20 to 1 better. Whether it was.
    pub(super) fn try_pairs(&self, held: &mut Vec<NamedClaim>) -> bool {
        let base = &self.base;
        let ranking = self.ranked(base);
        let (families, ranked) = (&ranking.families, &ranking.ranked);
        let noise = base.noise;
        let Some(whitened) = base.projected.at(noise) else {
            return false;
        };
        let best: Vec<&Ranked> = ranked
            .iter()
            .filter(|r| matches!(families[r.family].claim, Claim::Effect(_)))
            .take(PAIRED.get())
            .collect();
        let columns: Vec<Mat<f64>> = best
            .iter()
            .map(|r| {
                let own = families[r.family].columns_of(r.hypothesis);
                whitened.columns(&base.projected.columns(own.as_ref()))
            })
            .collect();
        let evidence = |i: usize, j: usize| {
            let pair = [columns[i].clone(), columns[j].clone()];
            let both = beside(&pair, whitened.z.nrows());
            let score = score(both.as_ref(), &whitened.z);
            let families = [&families[best[i].family], &families[best[j].family]];
            let dof = score.dof as f64 + families.iter().map(|f| f.shape_dof).sum::<f64>();
            let places: f64 = families.iter().map(|f| f.log_places).sum();
            -log_tail(score.statistic, dof) - places
        };
        let place = |h: &NamedClaim| {
            best.iter()
                .position(|r| families[r.family].claim.is_same(&h.claim))
        };
        let (Some(a), Some(b)) = (place(&held[0]), place(&held[1])) else {
            return false;
        };
        let now = evidence(a, b);
        let mut top: Option<(f64, usize, usize)> = None;
        for i in 0..best.len() {
            for j in 0..i {
                let e = evidence(i, j);
                if e > now + APART.get() && top.is_none_or(|(best, ..)| e > best) {
                    top = Some((e, i, j));
                }
            }
        }
        if let Some((_, i, j)) = top {
            *held = vec![
                NamedClaim::of(families, best[i]),
                NamedClaim::of(families, best[j]),
            ];
        }
        top.is_some()
    }
}
