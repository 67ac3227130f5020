//! The evidence for everything that may be missing.

use estimate::methods::joint::BiasNoise;
use faer::Mat;
use sensor::Sensor;

use super::family::Family;
use super::noise::projected::{Projected, Whitened};
use super::score::{Score, log_tail, of_normal, score};

/// Evidence that differs by less than this (20 to 1) does not part two claims.
pub const APART: f64 = 2.995_732_273_553_991;

/// Shares of the likeliest walk and flicker at which hypotheses are tried too: what is taken for them when nothing is
/// missing may be the effect.
const SHARES: [[f64; 2]; 7] = [
    [0.7, 0.7],
    [0.45, 0.45],
    [0.2, 0.2],
    [0.0, 1.0],
    [1.0, 0.0],
    [0.0, 0.45],
    [0.0, 0.0],
];

/// Shares of the variance by which turns scatter that are tried too: what is taken for scatter may be the effect.
const SCATTERS: [f64; 4] = [0.5, 0.2, 0.05, 0.0];

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
    /// `ln p` of the statistic, in this one test.
    pub log_p: f64,
    /// `−ln p − ln n_sub − ln 2m`: significant at family-wise level α where above `−ln α`.
    pub evidence: f64,
    /// Whether it may be a tie of what is named, but no name itself.
    pub only_a_tie: bool,
    /// The expected change of the coefficients, in typical sizes.
    pub score: Score,
}

/// One setting of the densities.
pub(super) struct Level {
    pub noise: BiasNoise,
    /// Share of the scatter of the turns.
    pub scatter: f64,
    pub whitened: Whitened,
    /// The sensor whose density differs from the likeliest; both hold the same there.
    pub of: Option<Sensor>,
}

/// The evidence for all families, greatest first.
///
/// `given` says that the densities are known: they are not profiled then.
pub fn rank(
    projected: &Projected,
    families: &[Family],
    noise: BiasNoise,
    given: bool,
) -> Vec<Ranked> {
    rank_at(projected, families, &levels(projected, noise, given))
}

/// The same at settings of the densities that were worked out before.
pub(super) fn rank_at(projected: &Projected, families: &[Family], levels: &[Level]) -> Vec<Ranked> {
    let Some(nothing) = levels.first().map(|l| l.whitened.log_likelihood()) else {
        return Vec::new();
    };
    let count = families.iter().filter(|f| !f.hypotheses.is_empty()).count();
    let mut ranked: Vec<Ranked> = families
        .iter()
        .enumerate()
        .filter_map(|(place, family)| best(place, family, projected, levels, nothing, count))
        .collect();
    ranked.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    ranked
}

/// The likeliest noise, then for each sensor shares of it, then shares of the scatter of turns.
pub(super) fn levels(projected: &Projected, noise: BiasNoise, given: bool) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let mut add = |noise: BiasNoise, scatter: f64, of: Option<Sensor>| {
        let is_there = |level: &Level| level.noise == noise && level.scatter == scatter;
        if levels.iter().any(is_there) {
            return;
        }
        if let Some(whitened) = projected.at_share(noise, scatter) {
            levels.push(Level {
                noise,
                scatter,
                whitened,
                of,
            });
        }
    };
    add(noise, 1.0, None);
    if given {
        return levels;
    }
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for [walk, flicker] in SHARES {
            add(noise.with_shares(sensor, walk, flicker), 1.0, Some(sensor));
        }
    }
    if projected.scatters {
        for share in SCATTERS {
            add(noise, share, None);
        }
    }
    levels
}

fn best(
    place: usize,
    family: &Family,
    projected: &Projected,
    levels: &[Level],
    nothing: f64,
    count: usize,
) -> Option<Ranked> {
    if family.hypotheses.is_empty() {
        return None;
    }
    let columns = projected.by_recording(&family.columns);
    let own = family.claim.sensor();
    let mut best: Option<Ranked> = None;
    for level in levels.iter().filter(|l| l.of.is_none_or(|s| s == own)) {
        let seen = level.whitened.by_recording(columns.clone());
        let lost = 2.0 * (level.whitened.log_likelihood() - nothing);
        for (k, hypothesis) in family.hypotheses.iter().enumerate() {
            let (a, b) = seen.normal(hypothesis.columns.clone(), &level.whitened.z);
            let score = of_normal(&a, &b);
            if score.dof == 0 {
                continue;
            }
            let statistic = score.statistic + lost;
            let dof = score.dof as f64 + family.shape_dof;
            let log_p = log_tail(statistic, dof);
            let evidence = -log_p - family.log_places - (2.0 * count as f64).ln();
            if best.as_ref().is_none_or(|b| evidence > b.evidence) {
                best = Some(Ranked {
                    family: place,
                    hypothesis: k,
                    noise: level.noise,
                    scatter: level.scatter,
                    statistic,
                    dof,
                    log_p,
                    evidence,
                    only_a_tie: false,
                    score,
                });
            }
        }
    }
    best
}

/// How much of what `one` explains the columns of `other` explain too: `ρ²` of the disagreement that the
/// estimate of `one` predicts, at its densities.
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
