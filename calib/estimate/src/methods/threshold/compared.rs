//! A check that another multiplier finds static intervals that fit another accelerometer.

use nalgebra::Vector3;
use recording::averages::root_mean_square;
use recording::intervals::Span;

use super::another::OfAnother;
use super::trial::NormFit;
use super::{Attempt, MANY_MORE};
use crate::residuals::StaticMean;

findings::tuning! {
    /// An accelerometer misses so many times what one of its own does in a part that is of another.
    MISSED: f64 = 10.0;
}

impl Attempt<'_> {
    /// The static intervals that another multiplier finds before or after all that were chosen, where they fit an accelerometer of their own
    /// and not the one chosen: the least residual has chosen between two devices.
    pub(super) fn of_another(&self, gravity: f64) -> Option<OfAnother> {
        let base = self.bases[self.chosen?].as_ref()?;
        let most = self.trials.iter().max_by_key(|trial| trial.placements)?;
        let few = self.trial()?.placements as f64;
        if (most.placements as f64) < MANY_MORE.get() * few {
            return None;
        }
        let chosen = self.survey.rests(self.multiplier);
        let (first, last) = (chosen.first()?.from, chosen.last()?.to);
        let all = self.survey.rests(most.multiplier);
        let (before, others): (Vec<Span>, Vec<Span>) = all
            .into_iter()
            .filter(|span| span.to <= first || span.from >= last)
            .partition(|span| span.to <= first);
        let parts = [before, others].into_iter();
        let part = parts.max_by_key(Vec::len)?;
        let forces = part.iter().filter_map(|span| self.survey.mean_force(*span));
        let forces: Vec<Vector3<f64>> = forces.collect();
        let means: Vec<_> = forces.iter().copied().map(StaticMean::bare).collect();
        let fit = NormFit::of(&means, self.survey.noise_of_means(&part), gravity)?;
        let missed = forces.iter().map(|f| base.correct(f).norm() - gravity);
        let missed = root_mean_square(&missed.collect::<Vec<_>>());
        (fit.sound && missed > MISSED.get() * fit.residual).then(|| OfAnother {
            span: Span {
                from: part[0].from,
                to: part[part.len() - 1].to,
            },
            intervals: part.len(),
            used: chosen.len(),
            missed,
            own: fit.residual,
        })
    }
}
