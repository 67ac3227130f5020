//! The evidence of several units together.

use faer::Mat;
use nalgebra::DVector;
use sensor::{EffectRef, Quantity};

use super::unit::Unit;
use crate::family::{Claim, effect_family};
use crate::gap::channel::Channel;
use crate::gap::sequence::{Misfit, Sequence, channel_of};
use crate::rank::{APART, Ranked};
use crate::score::log_tail;
use crate::search::Ranking;

findings::tuning! {
    /// A noncentrality that hardly any unit would hide: 95 % of those with three degrees of freedom are beyond 0.5 % of chance.
    WOULD_SHOW: f64 = 25.0;

    /// A unit that shows an effect by less of a chance than this may have it.
    PERHAPS: f64 = 0.05;

    /// The share of the evidence for what goes with time that counts beside other units: of 39 cases of five units with biases that
    /// walk, and without a drift, four had one by the whole.
    BESIDE_A_WALK: f64 = 0.5;

    /// Sizes of two units that differ by less of a chance are not the same.
    DIFFERENT: f64 = 1e-3;
}

/// Evidence of one unit for an effect.
#[derive(Clone, Debug)]
pub(super) struct Says {
    /// `ln p` in this unit, the places of a shape paid for.
    pub log_p: f64,
    /// The evidence in this unit alone.
    pub evidence: f64,
    /// Parameter that shapes the effect here, by its place, and its value.
    pub shape: Option<(usize, f64)>,
    ranked: Ranked,
}

/// Evidence of all units for an effect.
#[derive(Clone, Debug)]
pub(super) struct Pooled {
    pub effect: EffectRef,
    /// Evidence of each unit; `None` where it cannot show the effect.
    pub units: Vec<Option<Says>>,
    /// `−ln p − ln 2m` of all together.
    pub evidence: f64,
}

/// The evidence of all units for every effect, most evident first.
///
/// `p` of independent units are put together by `−2 Σ ln pᵢ ~ χ²` of two degrees each (Fisher, Statistical Methods for
/// Research Workers, 1932, section 21.1), so that each unit keeps its own noise and degrees of freedom. Units outside `among` are
/// not asked, where it says which are.
pub(super) fn pool(
    units: &[Unit<'_>],
    catalogue: &[EffectRef],
    threshold: f64,
    among: &[bool],
) -> Vec<Pooled> {
    let rankings = units
        .iter()
        .map(|unit| Ranking::of(&unit.state, catalogue, threshold));
    let rankings: Vec<Ranking> = rankings.collect();
    let tests = |ranking: &Ranking| {
        let families = ranking.families.iter();
        families.filter(|f| !f.hypotheses.is_empty()).count()
    };
    let count = rankings.iter().map(tests).max().unwrap_or(1).max(1) as f64;
    let search = (2.0 * count).ln();
    let is_asked = |k: usize| units[k].is_counted() && among.get(k).is_none_or(|is_in| *is_in);
    let says = |k: usize, effect: &EffectRef| {
        if !is_asked(k) {
            return None;
        }
        let ranking = &rankings[k];
        let own = |r: &&Ranked| match &ranking.families[r.family].claim {
            Claim::Effect(e) => e.name() == effect.name(),
            _ => false,
        };
        let ranked = ranking.ranked.iter().find(own)?;
        let family = &ranking.families[ranked.family];
        let own_search = (2.0 * tests(ranking) as f64).ln();
        // As many times too large as this unit's readings scatter more than their noise.
        let by_excess = ranked.statistic / units[k].excess.powi(2);
        let weakened = log_tail(by_excess, ranked.dof) - ranked.log_p;
        let evidence = ranked.evidence - weakened;
        // A walk that is estimated leaves a drift too much of a chance: half of it is counted, as it adds up over the units.
        let share = if effect.needs().contains(&Quantity::Time) {
            BESIDE_A_WALK.get()
        } else {
            1.0
        };
        Some(Says {
            log_p: -share * (evidence + own_search).max(0.0),
            evidence,
            shape: family.hypotheses[ranked.hypothesis].shape,
            ranked: ranked.clone(),
        })
    };
    let mut all: Vec<Pooled> = catalogue
        .iter()
        .filter(|effect| effect.instant().is_none())
        .filter_map(|effect| {
            let units: Vec<Option<Says>> = (0..units.len()).map(|k| says(k, effect)).collect();
            units.iter().flatten().next()?;
            let together = units.iter().flatten().map(|says| says.log_p);
            Some(Pooled {
                effect: effect.clone(),
                evidence: -fisher(together) - search,
                units,
            })
        })
        .collect();
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    all
}

/// `ln p` of independent `ln pᵢ`.
fn fisher(log_ps: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = log_ps.fold((0.0, 0.0), |(n, sum), log_p| (n + 1.0, sum + log_p));
    log_tail(-2.0 * sum, 2.0 * count)
}

impl Pooled {
    /// The unit that speaks for it most.
    pub fn strongest(&self) -> Option<usize> {
        let said = self.units.iter().enumerate();
        let said = said.filter_map(|(k, says)| Some((k, says.as_ref()?.log_p)));
        said.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    /// Returns true if the units other than the most significant one are significant together, at level `alpha`.
    pub fn is_shared(&self, alpha: f64) -> bool {
        let Some(strongest) = self.strongest() else {
            return false;
        };
        let others = self.units.iter().enumerate();
        let others = others.filter(|(k, _)| *k != strongest);
        let others: Vec<f64> = others
            .filter_map(|(_, s)| Some(s.as_ref()?.log_p))
            .collect();
        !others.is_empty() && fisher(others.into_iter()) < alpha.ln()
    }

    /// Names the effects that all of the units together cannot tell from it.
    pub fn ties(&self, all: &[Self]) -> Vec<String> {
        let near = |other: &&Self| {
            other.effect.name() != self.effect.name()
                && other.evidence > self.evidence - APART.get()
        };
        all.iter()
            .filter(near)
            .map(|p| p.effect.name().into())
            .collect()
    }

    /// The channel in which the units, whose models lack the effect, show most of it.
    pub fn channel(&self, without: &[Unit<'_>], effect: &EffectRef) -> Option<Channel> {
        let mut parts = [Misfit::default(); 3];
        for (unit, says) in without.iter().zip(&self.units) {
            let Some(says) = says else { continue };
            let predicted = says.predicted(unit, effect)?;
            let shown = Sequence::of(&unit.state, unit.state.noise).of_column(&predicted);
            parts
                .iter_mut()
                .zip(shown)
                .for_each(|(sum, own)| sum.add(own));
        }
        Some(channel_of(&parts))
    }

    /// Returns true if any other unit would show the effect as unit `k` has it, but does not.
    ///
    /// `None` where unit `k` has no estimate. Units whose turns are spoiled by knocks do not count.
    pub fn shown_by_others(
        &self,
        k: usize,
        units: &[Unit<'_>],
        effect: &EffectRef,
    ) -> Option<bool> {
        let mine = self.units.get(k)?.as_ref()?;
        let change = &mine.ranked.score.change;
        let shows = |(place, unit): (usize, &Unit<'_>)| {
            let own = self.units[place].as_ref();
            let denies =
                |own: &Says| own.log_p >= PERHAPS.get().ln() && own.differs_from(&mine.ranked);
            if !own.is_some_and(denies) || unit.state.fit.data.misses_something_between_samples() {
                return false;
            }
            let family = effect_family(&unit.state, effect, &[]);
            let columns = family.columns_of(0);
            if columns.ncols() != change.len() {
                return false;
            }
            let change = Mat::from_fn(change.len(), 1, |i, _| change[i]);
            let moved = unit.state.projected.columns((columns * change).as_ref());
            let whitened = unit.state.projected.at(unit.state.noise);
            whitened.is_some_and(|w| {
                w.columns(&moved).squared_norm_l2() > WOULD_SHOW.get() * unit.excess.powi(2)
            })
        };
        let others = units.iter().enumerate().filter(|(other, _)| *other != k);
        Some(others.into_iter().any(shows))
    }
}

impl Says {
    /// Returns true if the estimates of two units differ beyond the errors of both.
    fn differs_from(&self, other: &Ranked) -> bool {
        let (one, two) = (&self.ranked.score, &other.score);
        if one.change.len() != two.change.len() {
            return true;
        }
        let apart =
            DVector::from_column_slice(&one.change) - DVector::from_column_slice(&two.change);
        let covariance = &one.covariance + &two.covariance;
        let weighed = covariance.cholesky().map(|factor| factor.solve(&apart));
        let chi2 = weighed.map_or(0.0, |weighed| weighed.dot(&apart));
        log_tail(chi2, apart.len() as f64) < DIFFERENT.get().ln()
    }

    /// Computes the contribution of its estimate to the rows, white-whitened.
    fn predicted(&self, unit: &Unit<'_>, effect: &EffectRef) -> Option<Vec<f64>> {
        let family = effect_family(&unit.state, effect, &[]);
        let own = family.columns_of(self.ranked.hypothesis.min(family.hypotheses.len() - 1));
        let count = own.ncols().min(self.ranked.score.change.len());
        let change = Mat::from_fn(count, 1, |i, _| self.ranked.score.change[i]);
        let column = own.as_ref().subcols(0, count) * change;
        Some(column.col_as_slice(0).to_vec())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_chances_of_a_tenth_together_are_one_of_eighteen() {
        // χ²₄ beyond −2 ln 0.01 = 9.21: e^{−4.605}(1 + 4.605) = 0.01 · 5.605.
        let p = fisher([0.1_f64.ln(), 0.1_f64.ln()].into_iter()).exp();
        assert!((p - 0.056_05).abs() < 1e-4, "{p}");
    }
}
