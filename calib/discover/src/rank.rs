//! The evidence for everything that may be missing.

use estimate::methods::joint::{BiasNoise, Columns};
use faer::Mat;
use sensor::Sensor;

use super::family::{Claim, Family};
use super::noise::level::Level;
use super::noise::projected::Projected;
use super::score::{Score, log_tail, of_normal, score};

/// Evidence that differs by less than this (20 to 1) does not part two claims.
pub const APART: f64 = 2.995_732_273_553_991;

/// Evidence that differs by less than this is the same: the first of the places that have it is taken on every machine.
const ROUNDING: f64 = 1e-6;

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
    /// `ln p` in this one test: of an effect or a disturbance a mean over what the densities may be under it, of a shape that
    /// of the statistic.
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
    let nothing_yet =
        |family: &Family| family.hypotheses.iter().map(|_| Tried::default()).collect();
    let mut all: Vec<Vec<Tried<'_>>> = families.iter().map(|(_, f)| nothing_yet(f)).collect();
    for (level, prior) in at_levels(sensor, levels) {
        let seen = level.whitened.by_recording(columns.clone());
        let gained = level.whitened.log_likelihood() - nothing;
        let mut first = 0;
        for ((_, family), tried) in families.iter().zip(&mut all) {
            // A turn that is bad because a bias of the other sensor moved is none.
            let is_local = matches!(family.claim, Claim::Disturbed(_));
            if is_local && !level.is_of(sensor) {
                first += family.columns.ncols();
                continue;
            }
            let prior = if is_local { 0.0 } else { prior };
            for (tried, hypothesis) in tried.iter_mut().zip(&family.hypotheses) {
                let own = first + hypothesis.columns.start..first + hypothesis.columns.end;
                let (a, b) = seen.normal(own, &level.whitened.z);
                tried.add(level, (gained, prior), of_normal(&a, &b), family.shape_dof);
            }
            first += family.columns.ncols();
        }
    }
    all
}

/// The densities at which an error of a sensor is tried, and `ln` of their prior chances: those of the other sensor count together
/// as one.
fn at_levels(sensor: Sensor, levels: &[Level]) -> impl Iterator<Item = (&Level, f64)> {
    let of_other = move |level: &Level| !level.is_of(sensor);
    let others = levels.iter().filter(|l| l.is_for(sensor) && of_other(l));
    let one_of = -(1.0 + others.count() as f64).ln();
    let own = levels.iter().enumerate();
    own.filter(move |(_, l)| l.is_for(sensor))
        .map(move |(k, l)| (l, if k == 0 || of_other(l) { one_of } else { 0.0 }))
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
        let averaged = tried.log_p();
        let (level, statistic, score) = tried.likeliest?;
        // Shapes describe, and are held against the scatter of a bias that wanders: by likelihood ratios.
        let log_p = match is_shape {
            true => log_tail(statistic, score.dof as f64 + family.shape_dof),
            false => averaged,
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
        |best, next| match next.evidence > best.evidence + ROUNDING {
            true => next,
            false => best,
        },
    )
}

/// `ln p` of columns of a sensor (`m × k`, white-whitened), a mean over what its densities may be under them.
pub fn log_p_of(
    projected: &Projected,
    (sensor, columns): (Sensor, &Mat<f64>),
    levels: &[Level],
) -> f64 {
    let columns = projected.columns(columns.as_ref());
    let nothing = levels.first().map_or(0.0, |l| l.whitened.log_likelihood());
    let mut tried = Tried::default();
    for (level, prior) in at_levels(sensor, levels) {
        let score = score(level.whitened.columns(&columns).as_ref(), &level.whitened.z);
        let gained = level.whitened.log_likelihood() - nothing;
        tried.add(level, (gained, prior), score, 0.0);
    }
    tried.log_p()
}

impl Ranked {
    /// The evidence by the likelihood ratio alone, as if the densities were known to be the likeliest: what shapes and wandering
    /// biases are held against, which are judged so.
    pub fn by_ratio(&self) -> f64 {
        self.evidence + self.log_p - log_tail(self.statistic, self.dof)
    }
}

/// One hypothesis at all densities.
#[derive(Default)]
pub(super) struct Tried<'a> {
    /// Setting at which the data are likeliest under the hypothesis, with the likelihood ratio and the score there.
    pub likeliest: Option<(&'a Level, f64, Score)>,
    /// Log-likelihood plus log prior of each setting under the hypothesis, integrated over its coefficients, and `ln p` of
    /// the score.
    all: Vec<[f64; 2]>,
}

impl<'a> Tried<'a> {
    /// `gained` is the log-likelihood at the densities of `level` without the hypothesis, over that at the likeliest ones,
    /// `prior` the logarithm of their prior chance.
    pub fn add(
        &mut self,
        level: &'a Level,
        (gained, prior): (f64, f64),
        score: Score,
        shape_dof: f64,
    ) {
        if score.dof == 0 {
            // What cannot be seen there explains nothing.
            self.all.push([prior + gained, 0.0]);
            return;
        }
        let log_p = log_tail(score.statistic, score.dof as f64 + shape_dof);
        let likelihood = prior + gained + 0.5 * (score.statistic + score.log_determinant);
        self.all.push([likelihood, log_p]);
        let statistic = score.statistic + 2.0 * gained;
        if self
            .likeliest
            .as_ref()
            .is_none_or(|(_, best, _)| statistic > *best)
        {
            self.likeliest = Some((level, statistic, score));
        }
    }

    /// `ln Σ w p`, `w` the weights of the densities by their likelihood under the hypothesis, which the size of what it
    /// explains has no part in.
    ///
    /// A likelihood ratio is `χ²` where the densities are known. Where few static intervals show how a bias walks, a drift can
    /// take a walk for its own: the ratio is then that of a walk which is far too small (Bayarri & Berger 2000, partial
    /// posterior predictive p-values).
    pub fn log_p(&self) -> f64 {
        let weighed = self
            .all
            .iter()
            .map(|[likelihood, log_p]| likelihood + log_p);
        log_sum(weighed) - log_sum(self.all.iter().map(|[likelihood, _]| *likelihood))
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
