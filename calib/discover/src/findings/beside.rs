//! Effects that may exist beside a named one: too weak to be named, but so correlated that its coefficients depend on them.

use estimate::calibration::EffectParameter;
use estimate::methods::joint::Basis;
use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::EffectRef;
use serde::Serialize;

use crate::family::effect_family;
use crate::score::{Score, log_tail, score};
use crate::search::Search;
use crate::state::State;

findings::tuning! {
    /// An effect of which chance would show as much in fewer than this share of recordings may be there.
    LIKELY: f64 = 0.01;

    /// Coefficients that move by fewer of their standard errors are not worth a word.
    LARGE_CHANGE: f64 = 2.0;

    /// Nor are standard errors that become larger by less than this factor.
    LARGE_FACTOR: f64 = 3.0;
}

/// An effect that may be there beside a name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Beside {
    /// Its name in the catalogue.
    pub name: String,
    /// Likelihood ratio of the model with it over that of all that is named.
    pub statistic: f64,
    /// Its degrees of freedom.
    pub dof: usize,
    /// Chance of so much by this one test.
    pub p_value: f64,
    /// The most by which a coefficient of the named effect would change, in its standard errors.
    pub largest_change: f64,
    /// The most by which a standard error of the named effect would become larger, as a factor.
    pub largest_factor: f64,
}

impl Beside {
    /// Returns true if it is significant and would change a coefficient of the named effect by several standard errors.
    pub fn is_likely(&self) -> bool {
        self.p_value < LIKELY.get() && self.largest_change > LARGE_CHANGE.get()
    }
}

/// An effect that was evident before anything was named, and is not beside the names.
pub struct Rival {
    effect: EffectRef,
    /// Its columns (`m × k`), for typical sizes and whitened by everything.
    columns: Mat<f64>,
    /// Score of its columns against the residuals, with the named effects in the model.
    score: Score,
    p_value: f64,
}

/// The rivals of all that a search named, where evidence beyond `threshold` is evident.
pub fn rivals(search: &Search, threshold: f64) -> Vec<Rival> {
    let first = search.first_ranking.iter();
    let evident = first.filter(|(_, ranked)| ranked.evidence > threshold);
    let effects = evident.filter_map(|(claim, _)| claim.effect());
    let others = effects.filter(|effect| !search.last.has(effect.name()));
    let others: Vec<&EffectRef> = others.collect();
    if others.is_empty() {
        return Vec::new();
    }
    let taken = Basis::of(&search.last.fit.jacobian);
    let of = |effect| Rival::of(&search.last, &taken, effect);
    others.into_iter().filter_map(of).collect()
}

impl Rival {
    /// The likeliest way in which the model of `state` may lack an effect; `taken` is what the model's parameters take of the
    /// rows.
    fn of(state: &State, taken: &Basis, effect: &EffectRef) -> Option<Self> {
        let family = effect_family(state, effect, &[]);
        let columns = state.fit.whitening.finish_columns(family.columns);
        let left = taken.without(&columns).to_dense();
        let residuals = &state.fit.residuals;
        let residuals = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
        let places = family.hypotheses.iter().map(|h| h.columns.clone());
        let (score, own) = places
            .map(|own| (score(left.subcols(own.start, own.len()), &residuals), own))
            .max_by(|(a, _), (b, _)| a.statistic.total_cmp(&b.statistic))?;
        let log_p = log_tail(score.statistic, score.dof as f64 + family.shape_dof);
        let own: Vec<usize> = own.collect();
        Some(Self {
            effect: effect.clone(),
            columns: columns.select(&own).to_dense(),
            p_value: (log_p + family.log_places).exp().min(1.0),
            score,
        })
    }

    /// Beside a named effect with these `parameters`, where much hangs on it.
    pub fn beside(
        &self,
        named: &EffectRef,
        parameters: &[EffectParameter],
        state: &State,
    ) -> Option<Beside> {
        let moved = self.moved(named, state)?;
        let with_errors = moved.iter().filter_map(|own| {
            let parameter = parameters.iter().find(|p| p.name == own.parameter)?;
            Some((own, parameter.std.filter(|std| *std > 0.0)?))
        });
        let (mut largest_change, mut largest_factor) = (0.0_f64, 1.0_f64);
        for (own, std) in with_errors {
            largest_change = largest_change.max((own.change / std).abs());
            largest_factor = largest_factor.max((own.variance / (std * std)).sqrt().hypot(1.0));
        }
        let beside = Beside {
            name: self.effect.name().into(),
            statistic: self.score.statistic,
            dof: self.score.dof,
            p_value: self.p_value,
            largest_change,
            largest_factor,
        };
        // The first order of a polynomial is always known less well beside the second.
        let is_higher_order = self.effect.companion() == Some(named.name());
        let hangs_on_it = largest_factor > LARGE_FACTOR.get() && !is_higher_order;
        (beside.is_likely() || hangs_on_it).then_some(beside)
    }

    /// Computes the change of the coefficients of an effect of the model that its coefficients `δ` cause.
    ///
    /// With `A` the columns of that effect, projected onto the null space of all other parameters, and `W` its own columns,
    /// the change is `T δ` with `T = −(AᵀA)⁻¹AᵀW`, of covariance `T cov(δ) Tᵀ`.
    fn moved(&self, named: &EffectRef, state: &State) -> Option<Vec<Moved>> {
        let fit = &state.fit;
        let parameter_of = |k: usize| {
            let name = &fit.parameters.names()[fit.free[k]];
            name.strip_prefix(named.name())?.strip_prefix('.')
        };
        let (own, others): (Vec<usize>, Vec<usize>) =
            (0..fit.free.len()).partition(|k| parameter_of(*k).is_some());
        let taken = Basis::of(&fit.jacobian.select(&others));
        let a = taken.without(&fit.jacobian.select(&own)).to_dense();
        let (gram, product) = (a.transpose() * &a, a.transpose() * &self.columns);
        let (n, k) = (product.nrows(), product.ncols());
        let gram = DMatrix::from_fn(n, n, |i, j| gram[(i, j)]);
        let product = DMatrix::from_fn(n, k, |i, j| -product[(i, j)]);
        let transfer = gram.cholesky()?.solve(&product);
        let change = &transfer * DVector::from_column_slice(&self.score.change);
        let covariance = &transfer * &self.score.covariance * transfer.transpose();
        let parameters = own.iter().filter_map(|k| parameter_of(*k)).enumerate();
        let moved = parameters.map(|(i, parameter)| Moved {
            parameter: parameter.into(),
            change: change[i],
            variance: covariance[(i, i)],
        });
        Some(moved.collect())
    }
}

/// Effect of a rival on one coefficient of a named effect.
struct Moved {
    parameter: String,
    change: f64,
    /// Increase of the coefficient's variance.
    variance: f64,
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{EffectFinding, Request, discover};

    fn found(spec: &Spec) -> Vec<EffectFinding> {
        let recordings = [spec.run().unwrap().recording];
        let request = Request::new(spec.gravity);
        discover(&recordings, &request).unwrap().findings.effects
    }

    /// Of two that do nearly the same one is named, and takes what the other does into its coefficients.
    #[test]
    fn the_name_says_that_its_errors_hang_on_an_effect_that_does_nearly_the_same() {
        for seed in [40, 43] {
            let spec = Spec::hand_held(seed).with_effect("gyro_asymmetry", 1.0);
            let named = found(&spec.with_effect("gyro_quadratic", 1.0));
            let others = named[0].may_be_beside.iter();
            let is_said = others.filter(|o| o.name == "gyro_quadratic").count() == 1;
            assert!(named.len() == 2 || is_said, "{seed}: {named:?}");
        }
    }

    #[test]
    fn nothing_is_said_beside_an_effect_that_is_like_no_other() {
        let spec = Spec::hand_held(41).with_effect("gyro_g_sensitivity", 1.0);
        let named = found(&spec);
        assert_eq!(named.len(), 1);
        assert_eq!(named[0].may_be_beside, []);
    }
}
