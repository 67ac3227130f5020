//! Everything that a model lacks, by the evidence for it.

use nalgebra::DVector;
use sensor::{EffectRef, Nature};

use super::few_turns::Turns;
use crate::family::{Claim, Family, families, is_late, places_by_heading, references};
use crate::rank::{Ranked, rank};
use crate::state::State;

findings::tuning! {
    /// Families whose pairs are tried, and that are shown in the first ranking.
    pub(super) PAIRED: usize = 10;

    /// A rotation whose length differs from the earth's by more than so many standard errors is not it.
    EARTH_LENGTH: f64 = 3.0;

    /// Tolerance of a rotation's length after a linear step from models fitted without it, as a share of the earth's rate.
    LINEAR: f64 = 0.1;

    /// A rotation whose vertical part is fewer standard errors than this is not known to be the earth's.
    EARTH_VERTICAL: f64 = 2.0;
}

/// Everything that a model lacks, and the evidence for it, most evident first.
pub(crate) struct Ranking {
    pub families: Vec<Family>,
    pub ranked: Vec<Ranked>,
}

impl Ranking {
    /// Beside the model of `state`: what is evident beyond `threshold` has to be so without the turns that speak for it most,
    /// where knocks have spoiled turns, and a rotation has to be the earth's.
    pub fn of(state: &State, catalogue: &[EffectRef], threshold: f64) -> Self {
        let families = families(state, catalogue);
        let mut ranked = rank(&state.projected, &families, state.walks());
        for r in &mut ranked {
            if matches!(as_the_earth(&families[r.family], r), Earth::No) {
                r.evidence = f64::NEG_INFINITY;
            }
        }
        if let Some(turns) = Turns::knocked(state) {
            for r in ranked.iter_mut().filter(|r| r.evidence > threshold) {
                let family = &families[r.family];
                match family.claim {
                    Claim::Effect(_) => r.evidence = turns.evidence_without(state, family, r),
                    Claim::Disturbed(_) => r.evidence = Turns::evidence_of_disturbance(r),
                    Claim::Shape(..) => {}
                }
            }
        }
        ranked.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        Self { families, ranked }
    }

    /// The most evident claims.
    pub(super) fn first(&self) -> Vec<(Claim, Ranked)> {
        let best = self.ranked.iter().take(PAIRED.get());
        best.map(|r| (self.families[r.family].claim.clone(), r.clone()))
            .collect()
    }

    /// The effects of which no column is left beside the model's own: they have no rank. Late stamps show in the moving
    /// accelerometer only, which is looked at on its own.
    pub(super) fn not_observable(&self) -> Vec<String> {
        let has_no_rank = |k: usize| self.ranked.iter().all(|r| r.family != k);
        let effects = self.families.iter().enumerate();
        effects
            .filter(|(_, f)| f.claim.effect().is_some_and(|effect| !is_late(effect)))
            .filter(|(k, _)| has_no_rank(*k))
            .map(|(_, f)| f.claim.name().into())
            .collect()
    }
}

/// Result of comparing a rotation with the earth's.
pub(super) enum Earth {
    /// It has the length and a vertical part, or is another claim.
    Yes,
    /// It has the length and no vertical part, as a field of the room has none.
    OrARoom,
    /// It has another length.
    No,
}

/// The place of the vertical part among the parameters of a rotation.
pub(crate) const VERTICAL: usize = 2;

findings::tuning! {
    /// A smaller variance, in the square of the earth's rate, is that of what is not seen.
    UNSEEN: f64 = 1e-12;
}

/// Returns the sort key of a variance, which puts an unobservable part last.
fn seen_first(variance: f64) -> f64 {
    if variance > UNSEEN.get() {
        variance
    } else {
        f64::INFINITY
    }
}

/// Compares the length of an estimated rotation with that of the earth's, in the stretch that shows its horizontal part
/// best.
pub(super) fn as_the_earth(family: &Family, ranked: &Ranked) -> Earth {
    let earth = family.claim.effect();
    let Some(earth) = earth.filter(|effect| effect.nature() == Nature::EarthRotation) else {
        return Earth::Yes;
    };
    let covariance = &ranked.score.covariance;
    // Beside the isotropic g-sensitivity the vertical part is nobody's to know.
    if ranked.score.dof < 3 || covariance[(VERTICAL, VERTICAL)] < UNSEEN.get() {
        return Earth::Yes;
    }
    let own = places_by_heading(ranked.score.change.len(), VERTICAL + 1, references(earth));
    let known = own.into_iter().min_by(|a, b| {
        let of = |places: &[usize]| places.iter().map(|k| covariance[(*k, *k)]).sum::<f64>();
        seen_first(of(a)).total_cmp(&seen_first(of(b)))
    });
    let mut places = known.unwrap_or_default();
    places.push(VERTICAL);
    // The typical size of the effect is the earth's rate: its length is 1.
    let rate = DVector::from_iterator(places.len(), places.iter().map(|k| ranked.score.change[*k]));
    let covariance = covariance.select_rows(&places).select_columns(&places);
    let length = rate.norm();
    let variance = (rate.transpose() * &covariance * &rate)[(0, 0)] / (length * length);
    let vertical =
        ranked.score.change[VERTICAL].abs() / ranked.score.covariance[(VERTICAL, VERTICAL)].sqrt();
    if (length - 1.0).abs() > EARTH_LENGTH.get() * variance.sqrt() + LINEAR.get() {
        Earth::No
    } else if vertical < EARTH_VERTICAL.get() {
        Earth::OrARoom
    } else {
        Earth::Yes
    }
}
