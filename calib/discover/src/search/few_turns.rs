//! Evidence that a few turns make.

use estimate::methods::joint::{OUTLYING_TURN, without};
use faer::Mat;

use crate::family::Family;
use crate::rank::Ranked;
use crate::score::{log_tail, score};
use crate::state::State;

findings::tuning! {
    /// Turns that evidence has to do without.
    ///
    /// How much of a knock is missing differs from knock to knock: turns miss by more than the one share says, now and then,
    /// and an effect that shows in turns can be fitted to two of them.
    SPARED: usize = 2;

    /// By how much larger the variance of a turn may be than the one share for all of them says: knocks that miss twice as much.
    pub(crate) KNOCKED: f64 = 4.0;
}

/// Columns of every turn on its own (`q × 2` each), for a model whose turns are spoiled by knocks.
pub(crate) struct Turns(Vec<Mat<f64>>);

impl Turns {
    /// `None` where the rate did not jump between samples.
    pub fn knocked(state: &State) -> Option<Self> {
        let is_knocked = state.fit.data.misses_something_between_samples();
        is_knocked.then(|| {
            let suspects = state.suspects.iter();
            let turns = suspects.filter(|s| s.fault == &OUTLYING_TURN);
            Self(turns.map(|turn| state.explained_by(turn)).collect())
        })
    }

    /// The evidence that something else is wrong with a turn, or with a static interval beside it.
    pub fn evidence_of_disturbance(ranked: &Ranked) -> f64 {
        let log_p = log_tail(ranked.statistic / KNOCKED.get(), ranked.dof);
        ranked.evidence + ranked.log_p - log_p.max(ranked.log_p)
    }

    /// The evidence for a claim without the turns that speak for it most.
    pub fn evidence_without(&self, state: &State, family: &Family, ranked: &Ranked) -> f64 {
        let Some(whitened) = state.projected.at_share(ranked.noise, ranked.scatter) else {
            return ranked.evidence;
        };
        let own = family.columns_of(ranked.hypothesis);
        let mut w = whitened.columns(&state.projected.columns(own.as_ref()));
        let mut z = whitened.z.clone();
        let turns: Vec<Mat<f64>> = self.0.iter().map(|b| whitened.columns(b)).collect();
        let mut least = ranked.score.statistic;
        for _ in 0..SPARED.get() {
            let spared = turns.iter().map(|b| (without(b, &w), without(b, &z)));
            let judged = spared.map(|(w, z)| (score(w.as_ref(), &z).statistic, w, z));
            let Some(best) = judged.min_by(|a, b| a.0.total_cmp(&b.0)) else {
                break;
            };
            (least, w, z) = best;
        }
        let statistic = ranked.statistic - ranked.score.statistic + least;
        let without = ranked.evidence_at(statistic);
        without.min(ranked.evidence)
    }
}
