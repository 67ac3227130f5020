//! The evidence for everything that may be missing.

use std::f64::consts::LN_2;

use estimate::methods::joint::{BiasNoise, Columns};
use faer::Mat;
use sensor::{EffectRef, Sensor};

use super::family::{Claim, Family};
use super::noise::level::Level;
use super::noise::projected::Projected;
use super::noise::spectrum::Kept;
use super::score::{Score, log_tail, of_normal, score};

findings::tuning! {
    /// Evidence that differs by less than this (20 to 1) does not part two claims.
    pub APART: f64 = 2.995_732_273_553_991;

    /// Evidence that an integrated likelihood ratio has too much where the noise of the biases is not known, beside the `ln 2` of two tests: without
    /// both, three of 300 simulated sessions with nothing hidden had a claim.
    PRICE_OF_INTEGRATION: f64 = 0.2;

    /// Evidence that differs by less than this is the same: the first of the places that have it is taken on every machine.
    ROUNDING: f64 = 1e-6;
}

/// The evidence for one family: that of its best hypothesis, the search paid for.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// The family's place.
    pub family: usize,
    /// The hypothesis' place in the family.
    pub hypothesis: usize,
    /// Noise of the biases under it.
    pub noise: BiasNoise,
    /// Share of the scatter of the turns under it.
    pub scatter: f64,
    /// Likelihood ratio `2 (max LL_c − max LL_0)`.
    pub statistic: f64,
    /// Its degrees of freedom: what the data can see of the columns, and a shape.
    pub dof: f64,
    /// `ln p` in this one test: of an effect or a disturbance over all that the noise may be, of a shape that of the statistic.
    pub log_p: f64,
    /// `−ln p − ln n_sub − ln 2m`: significant at family-wise level α where above `−ln α`.
    pub evidence: f64,
    /// The expected change of the coefficients, in typical sizes.
    pub score: Score,
}

/// The evidence for all families, greatest first, at the settings `levels` of the densities.
pub fn rank(projected: &Projected, families: &[Family], levels: &[Level]) -> Vec<Ranked> {
    let Some(nothing) = levels.first().map(|l| l.whitened.log_likelihood()) else {
        return Vec::new();
    };
    let choice = cost_of_choice(families);
    let mut ranked = Vec::new();
    for sensor in Sensor::ALL {
        let own = families.iter().enumerate();
        let own = own.filter(|(_, f)| !f.hypotheses.is_empty() && f.claim.sensor() == sensor);
        let own: Vec<(usize, &Family)> = own.collect();
        let seen = try_all(&own, projected, levels, sensor, nothing);
        let judged = own.into_iter().zip(seen);
        ranked.extend(
            judged.filter_map(|((place, family), tried)| best(place, family, tried, choice)),
        );
    }
    ranked.sort_by(|a, b| {
        let order = b.evidence.total_cmp(&a.evidence);
        order.then(a.family.cmp(&b.family))
    });
    ranked
}

/// All hypotheses of the families of one sensor at all of its densities: their columns side by side, which are whitened
/// at once.
fn try_all<'a>(
    families: &[(usize, &Family)],
    projected: &Projected,
    levels: &'a [Level],
    sensor: Sensor,
    nothing: f64,
) -> Vec<Vec<Tried<'a>>> {
    let columns = families.iter();
    let columns: Vec<Columns> = columns
        .map(|(_, family)| projected.by_recording(&family.columns))
        .collect();
    let columns = projected.side_by_side(&columns);
    let mut kept = Kept::of(&columns);
    let nothing_yet =
        |family: &Family| family.hypotheses.iter().map(|_| Tried::default()).collect();
    let mut all: Vec<Vec<Tried<'_>>> = families.iter().map(|(_, f)| nothing_yet(f)).collect();
    for level in at_levels(sensor, levels) {
        let seen = level.whitened.again(&mut kept);
        let gained = level.whitened.log_likelihood() - nothing;
        let mut first = 0;
        for ((_, family), tried) in families.iter().zip(&mut all) {
            // A turn that is bad because a bias of the other sensor moved is none.
            let is_local = matches!(family.claim, Claim::Disturbed(_));
            if is_local && !level.is_of(sensor) {
                first += family.columns.ncols();
                continue;
            }
            for (tried, hypothesis) in tried.iter_mut().zip(&family.hypotheses) {
                let own = first + hypothesis.columns.start..first + hypothesis.columns.end;
                let (a, b) = seen.normal(own, &level.whitened.z);
                tried.add(level, gained, of_normal(&a, &b), family.shape_dof);
            }
            first += family.columns.ncols();
        }
    }
    all
}

/// The levels at which an error of a sensor is tried.
fn at_levels(sensor: Sensor, levels: &[Level]) -> impl Iterator<Item = &Level> {
    levels.iter().filter(move |level| level.is_for(sensor))
}

/// `ln 2m`: what the choice among the `m` families with a hypothesis costs, half of the chance being kept for local claims.
pub(super) fn cost_of_choice(families: &[Family]) -> f64 {
    let count = families.iter().filter(|f| !f.hypotheses.is_empty()).count();
    (2.0 * count as f64).ln()
}

/// The best hypothesis of a family.
fn best(place: usize, family: &Family, tried: Vec<Tried<'_>>, choice: f64) -> Option<Ranked> {
    let is_shape = matches!(family.claim, Claim::Shape(..));
    let tried = tried.into_iter().enumerate();
    let ranked = tried.filter_map(|(k, tried)| {
        let over_all_noise = tried.log_p();
        let (level, statistic, score) = tried.likeliest?;
        // A parameter moves the other way than its columns.
        let is_negative = |effect: &EffectRef| effect.is_positive() && score.change[0] > 0.0;
        if matches!(&family.claim, Claim::Effect(effect) if is_negative(effect)) {
            return None;
        }
        // Shapes describe, and are held against the scatter of a bias that wanders: by likelihood ratios.
        let log_p = match is_shape {
            true => log_tail(statistic, score.dof as f64 + family.shape_dof),
            false => over_all_noise,
        };
        Some(Ranked {
            family: place,
            hypothesis: k,
            noise: level.noise,
            scatter: level.scatter,
            statistic,
            dof: score.dof as f64 + family.shape_dof,
            log_p,
            evidence: -log_p - family.log_places - choice,
            score,
        })
    });
    ranked.reduce(
        |best, next| match next.evidence > best.evidence + ROUNDING.get() {
            true => next,
            false => best,
        },
    )
}

/// `ln p` of columns of a sensor (`m × k`, white-whitened) over all that the noise may be.
pub fn log_p_of(projected: &Projected, of: (Sensor, &Mat<f64>), levels: &[Level]) -> f64 {
    tried_at(projected, of, levels).log_p()
}

/// The likelihood ratio of such columns at the noise that suits them best, with its degrees of freedom; `None` of columns that the data do
/// not see.
pub fn ratio_of(
    projected: &Projected,
    of: (Sensor, &Mat<f64>),
    levels: &[Level],
) -> Option<(f64, f64)> {
    let (_, statistic, score) = tried_at(projected, of, levels).likeliest?;
    Some((statistic, score.dof as f64))
}

fn tried_at<'a>(
    projected: &Projected,
    (sensor, columns): (Sensor, &Mat<f64>),
    levels: &'a [Level],
) -> Tried<'a> {
    let columns = projected.columns(columns.as_ref());
    let nothing = levels.first().map_or(0.0, |l| l.whitened.log_likelihood());
    let mut tried = Tried::default();
    for level in at_levels(sensor, levels) {
        let score = score(level.whitened.columns(&columns).as_ref(), &level.whitened.z);
        let gained = level.whitened.log_likelihood() - nothing;
        tried.add(level, gained, score, 0.0);
    }
    tried
}

impl Ranked {
    /// The evidence by the likelihood ratio alone, as if the densities were known to be the likeliest: what shapes and wandering
    /// biases are held against, which are judged so.
    pub fn by_ratio(&self) -> f64 {
        self.evidence_at(self.statistic)
    }

    /// The evidence by a likelihood ratio, if it were `statistic`.
    pub fn evidence_at(&self, statistic: f64) -> f64 {
        self.evidence + self.log_p - log_tail(statistic, self.dof)
    }
}

/// One hypothesis at all levels of the noise.
#[derive(Default)]
pub(super) struct Tried<'a> {
    /// The level where the data are likeliest under it, the likelihood ratio, and the score there.
    pub likeliest: Option<(&'a Level, f64, Score)>,
    all: Vec<AtLevel>,
    /// Degrees of freedom of the shape.
    shape_dof: f64,
}

/// One hypothesis at one level of the noise.
struct AtLevel {
    /// `ln π + ℓ₀`: prior probability of the level and likelihood without the hypothesis.
    without: f64,
    /// `s/2`, half the score of the hypothesis.
    gain: f64,
    /// `½ ln det A⁺`: with the two before it is the likelihood with the coefficients anywhere.
    spread: f64,
    /// `ln P(χ²_q > s)`.
    log_p: f64,
}

impl<'a> Tried<'a> {
    /// `gained` is the log-likelihood at `level` without the hypothesis, over that at the likeliest noise.
    pub fn add(&mut self, level: &'a Level, gained: f64, score: Score, shape_dof: f64) {
        self.shape_dof = shape_dof;
        self.all.push(AtLevel {
            without: level.log_prior + gained,
            gain: 0.5 * score.statistic,
            spread: 0.5 * score.log_determinant,
            log_p: log_tail(score.statistic, score.dof as f64 + shape_dof),
        });
        let statistic = score.statistic + 2.0 * gained;
        let is_less = |(_, best, _): &(_, f64, _)| statistic > *best;
        if score.dof > 0 && self.likeliest.as_ref().is_none_or(is_less) {
            self.likeliest = Some((level, statistic, score));
        }
    }

    /// `ln p` of the hypothesis: of two tests the one that says more, each at half the level. Where the noise is known they are one.
    ///
    /// Few static intervals show how a bias walks. What looks like a walk, as a drift does, is seen best by a ratio of likelihoods over
    /// all walks; what does not, as an error of orientation, by the mean of `p` over them. That mean is no less than the `p` of the
    /// likelihood ratio: many columns that go by time or temperature leave little that shows a walk, and are likeliest beside none.
    pub fn log_p(&self) -> f64 {
        match (self.all.as_slice(), &self.likeliest) {
            (_, None) => 0.0,
            ([known], _) => known.log_p,
            (_, Some((_, ratio, score))) => {
                let dof = score.dof as f64 + self.shape_dof;
                let integrated = log_tail(self.integrated(), dof) + PRICE_OF_INTEGRATION.get();
                let averaged = self.averaged().max(log_tail(*ratio, dof));
                (integrated.min(averaged) + LN_2).min(0.0)
            }
        }
    }

    /// The integrated likelihood ratio `T = 2 [ln Σ π e^(ℓ₀ + s/2) − ln Σ π e^ℓ₀]`: the walk is integrated out under both hypotheses alike.
    ///
    /// Source: Berger, Liseo & Wolpert 1999, *Integrated likelihood methods for eliminating nuisance parameters*.
    fn integrated(&self) -> f64 {
        let with = log_sum(self.all.iter().map(|own| own.without + own.gain));
        let without = log_sum(self.all.iter().map(|own| own.without));
        2.0 * (with - without)
    }

    /// `ln Σ w p`, `w` the weights of the levels by their likelihood under the hypothesis, which the size of what it explains has no part
    /// in.
    ///
    /// Source: Bayarri & Berger 2000, partial posterior predictive p-values.
    fn averaged(&self) -> f64 {
        let weight = |own: &AtLevel| own.without + own.gain + own.spread;
        let weighed = log_sum(self.all.iter().map(|own| weight(own) + own.log_p));
        weighed - log_sum(self.all.iter().map(weight))
    }
}

/// `ln Σ eᵃ`.
pub(super) fn log_sum(a: impl Iterator<Item = f64> + Clone) -> f64 {
    let most = a.clone().fold(f64::NEG_INFINITY, f64::max);
    most + a.map(|a| (a - most).exp()).sum::<f64>().ln()
}

/// Computes the share `ρ²` of the contribution of `one` that the columns of `other` explain too, at the densities of `one`.
pub fn shared(
    projected: &Projected,
    families: &[Family],
    one: &Ranked,
    other: &Ranked,
) -> Option<f64> {
    let whitened = projected.at_share(one.noise, one.scatter)?;
    let of = |ranked: &Ranked| {
        let own = families[ranked.family].columns_of(ranked.hypothesis);
        whitened.columns(&projected.columns(own.as_ref()))
    };
    let (mine, theirs) = (of(one), of(other));
    let change = Mat::from_fn(mine.ncols(), 1, |i, _| one.score.change[i]);
    let predicted = &mine * &change;
    let whole = predicted.squared_norm_l2();
    (whole > 0.0).then(|| score(theirs.as_ref(), &predicted).statistic / whole)
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::RowGroups;
    use nalgebra::DMatrix;

    use super::*;

    #[test]
    fn walks_that_are_unlikely_without_an_effect_make_it_no_more_evident_than_its_likelihood_ratio()
    {
        let rows = RowGroups::whole(9);
        let one = Columns::cut(&Mat::from_fn(9, 1, |i, _| i as f64), &rows);
        let projected = Projected::new(&[0.1; 9], &one, (&[], &[]));
        let level = Level::at(&projected, (BiasNoise::default(), 1.0), None, 0.0).unwrap();
        let score = |statistic: f64| Score {
            statistic,
            dof: 6,
            change: vec![0.0; 6],
            covariance: DMatrix::identity(6, 6),
            log_determinant: 0.0,
        };
        // Columns that take a walk for themselves: much is explained where there is none, which is unlikely without them.
        let mut tried = Tried::default();
        tried.add(&level, 0.0, score(20.0), 0.0);
        tried.add(&level, -10.0, score(60.0), 0.0);
        let ratio = tried.likeliest.as_ref().unwrap().1;
        assert_eq!(ratio, 40.0);
        let own = log_tail(ratio, 6.0);
        assert!(tried.averaged() < own - 1.0);
        assert!((tried.log_p() - LN_2 - own).abs() < 1e-12);
    }
}
