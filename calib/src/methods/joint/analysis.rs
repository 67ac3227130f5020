//! The problem linearised at a solution: levels of noise and disturbances, without a refit.

use faer::Mat;

use super::disturbance::{Suspect, Verdict, judge};
use super::exposure::covariance;
use super::likelihood::Restricted;
use super::marginal::orthonormal;
use super::problem::{Linear, RowNoise, Rows};
use super::weights::{Component, ComponentKind, NoiseLevel, White, Whitening};
use sensor::Sensor;

/// Chance of any false accusation of a clean recording.
const CHANCE: f64 = 0.001;

/// A fit whose quieter three quarters are off by this much, as χ² per degree of freedom, does not
/// know its noise: the model misses, or the noise is of another kind.
const MISFIT: f64 = 2.0;

/// How far usual walks go, in standard deviations of a chunk's mean.
const USUAL: f64 = 3.0;

/// The share of rests (or turns) that such a judgement rests on.
const QUIETER: f64 = 0.75;

/// Residuals and Jacobian (free columns), whitened by the white noise alone.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Residuals (`m`).
    pub residuals: Vec<f64>,
    /// Jacobian (`m × n`).
    pub jacobian: Mat<f64>,
    /// Whitening by the white noise.
    pub white: White,
    /// What else the noise may have.
    pub components: Vec<Component>,
}

impl Analysis {
    /// Of a linearised problem and its noise.
    pub fn new(rows: &Rows<'_>, linear: &Linear, noise: &RowNoise, free: &[usize]) -> Self {
        let m = rows.count();
        let white = White::new(noise, rows.first_turn_row());
        let mut jacobian = Mat::from_fn(m, free.len(), |i, k| linear.jacobian[(i, free[k])]);
        white.apply(jacobian.as_mut());
        let mut residuals = Mat::from_fn(m, 1, |i, _| linear.residuals[i]);
        white.apply(residuals.as_mut());
        let kinds = [
            ComponentKind::AccelerometerWalk,
            ComponentKind::GyroscopeWalk,
        ];
        let components = kinds
            .into_iter()
            .zip(&noise.exposures)
            .filter(|(_, exposures)| !exposures.is_empty())
            .map(|(kind, exposures)| Component {
                kind,
                covariance: white.both_sides(&covariance(exposures, m)),
            })
            .collect();
        Self {
            residuals: residuals.col(0).iter().copied().collect(),
            jacobian,
            white,
            components,
        }
    }

    /// Adds every kind of scatter to what the noise may have.
    pub fn allow_all_scatter(&mut self, rows: &Rows<'_>) {
        for (kind, groups) in groups(rows) {
            self.allow(kind, &groups, rows.count());
        }
    }

    fn allow(&mut self, kind: ComponentKind, groups: &[Vec<usize>], m: usize) {
        self.components.push(Component {
            kind,
            covariance: self.white.both_sides(&shared(groups, kind, m)),
        });
    }

    /// Adds scatter between rests and turns to what the noise may have, where the quieter three
    /// quarters of them are off by far more than the noise; whether any are.
    pub fn allow_scatter_where_misfit(&mut self, rows: &Rows<'_>, known: &[&Suspect]) -> bool {
        let before = self.components.len();
        let basis = orthonormal(&self.with(known));
        let spare: Vec<f64> = (0..rows.count())
            .map(|i| 1.0 - basis.row(i).iter().map(|v| v * v).sum::<f64>())
            .collect();
        let r = Mat::from_fn(rows.count(), 1, |i, _| self.residuals[i]);
        let r = &r - &basis * (basis.transpose() * &r);
        let left: Vec<f64> = r.col(0).iter().copied().collect();
        for (kind, groups) in groups(rows) {
            let ratios: Vec<(f64, f64)> = groups
                .iter()
                .map(|rows| {
                    let sum: f64 = rows.iter().map(|&i| left[i].powi(2)).sum();
                    (sum, rows.iter().map(|&i| spare[i]).sum())
                })
                .collect();
            if quieter_ratio(ratios) > MISFIT {
                self.allow(kind, &groups, rows.count());
            }
        }
        self.components.len() > before
    }

    /// The levels of the components by restricted likelihood, with the disturbances' columns among the
    /// free ones: walks as their expectation, scatter at its likeliest.
    pub fn levels(&self, disturbances: &[&Suspect]) -> Vec<NoiseLevel> {
        let jacobian = self.with(disturbances);
        let covariances: Vec<&Mat<f64>> = self.components.iter().map(|c| &c.covariance).collect();
        let restricted = Restricted::new(&self.residuals, &jacobian, &covariances);
        let walks: Vec<bool> = self.components.iter().map(|c| c.kind.is_walk()).collect();
        let likeliest = restricted.variances(&walks);
        self.components
            .iter()
            .enumerate()
            .map(|(c, component)| NoiseLevel {
                kind: component.kind,
                size: if walks[c] {
                    let usual = usual_walk(&component.covariance);
                    restricted.expected(c, &likeliest, usual).sqrt()
                } else {
                    likeliest[c].sqrt()
                },
            })
            .collect()
    }

    /// The whitening at these levels.
    pub fn whitening(&self, levels: &[NoiseLevel]) -> Whitening {
        Whitening::new(self.white.clone(), &self.components, levels)
    }

    /// The disturbances that chance does not explain, one after the other from the worst on, given
    /// those already `accused`; `None` where there are more than `most` (places among `suspects`).
    pub fn accuse(
        &self,
        suspects: &[Suspect],
        accused: &[usize],
        levels: &[NoiseLevel],
        most: usize,
    ) -> Option<Vec<usize>> {
        let mut found = accused.to_vec();
        let whitening = self.whitening(levels);
        let level = CHANCE / suspects.len().max(1) as f64;
        loop {
            let known: Vec<&Suspect> = found.iter().map(|&k| &suspects[k]).collect();
            let worst = self
                .verdicts(suspects, &known, &whitening)
                .into_iter()
                .filter(|v| !found.contains(&v.suspect) && v.p_value < level)
                .min_by(|a, b| {
                    let by_p = a.p_value.total_cmp(&b.p_value);
                    by_p.then(b.statistic.total_cmp(&a.statistic))
                });
            match worst {
                None => return Some(found),
                Some(_) if found.len() >= most => return None,
                Some(verdict) => found.push(verdict.suspect),
            }
        }
    }

    /// Those of the doubtful among the accused whose own test, given the others, chance does not
    /// explain.
    pub fn confirm(
        &self,
        suspects: &[Suspect],
        accused: &[usize],
        doubtful: &[usize],
        levels: &[NoiseLevel],
    ) -> Vec<usize> {
        let whitening = self.whitening(levels);
        let level = CHANCE / suspects.len().max(1) as f64;
        let holds = |k: usize| {
            let others: Vec<&Suspect> = accused
                .iter()
                .filter(|&&o| o != k)
                .map(|&o| &suspects[o])
                .collect();
            self.verdicts(&suspects[k..=k], &others, &whitening)
                .iter()
                .any(|v| v.p_value < level)
        };
        doubtful.iter().copied().filter(|&k| holds(k)).collect()
    }

    /// The tests of `suspects` with the columns of `known` among the free ones.
    fn verdicts(
        &self,
        suspects: &[Suspect],
        known: &[&Suspect],
        whitening: &Whitening,
    ) -> Vec<Verdict> {
        let mut jacobian = self.with(known);
        whitening.finish(jacobian.as_mut());
        let mut residuals = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        whitening.finish(residuals.as_mut());
        judge(suspects, whitening, &orthonormal(&jacobian), &residuals)
    }

    /// The Jacobian with more columns, all whitened by white noise.
    fn with(&self, disturbances: &[&Suspect]) -> Mat<f64> {
        let (m, n) = (self.jacobian.nrows(), self.jacobian.ncols());
        let extra: Vec<&Vec<f64>> = disturbances.iter().flat_map(|s| &s.columns).collect();
        let mut added = Mat::from_fn(m, extra.len(), |i, k| extra[k][i]);
        self.white.apply(added.as_mut());
        Mat::from_fn(m, n + extra.len(), |i, k| {
            if k < n {
                self.jacobian[(i, k)]
            } else {
                added[(i, k - n)]
            }
        })
    }
}

/// The density up to which walks are common: at the far end of the recording the bias has moved by three
/// standard deviations of a chunk's mean.
fn usual_walk(covariance: &Mat<f64>) -> f64 {
    let farthest = (0..covariance.nrows())
        .map(|k| covariance[(k, k)])
        .fold(0.0, f64::max);
    if farthest > 0.0 {
        USUAL / farthest.sqrt()
    } else {
        1.0
    }
}

/// The rows of every rest, by sensor, and of every turn.
fn groups(rows: &Rows<'_>) -> [(ComponentKind, Vec<Vec<usize>>); 3] {
    let of_rests = |sensor: Sensor, first: usize| {
        let mut groups = vec![Vec::new(); rows.data.rests.len()];
        for (k, (_, chunk)) in rows.means(sensor).enumerate() {
            groups[chunk.rest].extend(first + 3 * k..first + 3 * k + 3);
        }
        groups
    };
    let turns = (0..rows.data.turns.len())
        .map(|k| {
            vec![
                rows.first_turn_row() + 2 * k,
                rows.first_turn_row() + 2 * k + 1,
            ]
        })
        .collect();
    [
        (
            ComponentKind::ForceScatter,
            of_rests(Sensor::Accelerometer, 0),
        ),
        (
            ComponentKind::RateScatter,
            of_rests(Sensor::Gyroscope, rows.first_rate_row()),
        ),
        (ComponentKind::TurnScatter, turns),
    ]
}

/// `χ²` per degree of freedom of the quieter groups, of `(χ², degrees of freedom)`; 0 of none.
fn quieter_ratio(mut groups: Vec<(f64, f64)>) -> f64 {
    groups.retain(|(_, dof)| *dof > 0.1);
    groups.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    groups.truncate((QUIETER * groups.len() as f64).ceil() as usize);
    let (sum, dof) = groups
        .iter()
        .fold((0.0, 0.0), |(s, d), g| (s + g.0, d + g.1));
    if dof > 0.0 { sum / dof } else { 0.0 }
}

/// Covariance of a scatter that the chunks of a rest share, axis by axis; the rows of a turn share none.
fn shared(groups: &[Vec<usize>], kind: ComponentKind, m: usize) -> Mat<f64> {
    let mut covariance = Mat::zeros(m, m);
    for group in groups {
        for (a, &i) in group.iter().enumerate() {
            for (b, &j) in group.iter().enumerate() {
                let same = if kind == ComponentKind::TurnScatter {
                    a == b
                } else {
                    a % 3 == b % 3
                };
                if same {
                    covariance[(i, j)] = 1.0;
                }
            }
        }
    }
    covariance
}
