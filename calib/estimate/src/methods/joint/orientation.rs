//! Does what is left at the static intervals depend on the orientation? No walk of a bias explains that.

pub(crate) mod interval;
pub(crate) mod oriented;

use faer::Mat;
use nalgebra::{DMatrix, DVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::methods::chance;
use crate::methods::joint::blocks::basis::{Basis, orthonormal_with_pivots};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::groups::RowGroups;
use crate::methods::joint::noise::walk_filter::WalkFilter;
use crate::methods::joint::orientation::interval::Oriented;

findings::tuning! {
    /// Chance that a sensor of which nothing is missing shows any pattern.
    CHANCE: f64 = 2e-3;

    /// Fewer spare numbers than this beside a pattern and its parameters show nothing.
    LEAST_SPARE: usize = 3;

    /// P-value below which the residual of the norm is a misfit, and not chance.
    UNLIKELY: f64 = 1e-3;

    /// Degrees of freedom that the measured noise counts for.
    KNOWN: f64 = 30.0;
    /// So likely what remains has to be by it alone.
    UNREMARKABLE: f64 = 0.1;

    /// Standard deviations below this share of the largest are held up to it: intervals of very different lengths.
    LEAST_SHARE: f64 = 1e-3;

    /// Columns of unit length of which others leave less than this depend on them.
    RANK_TOLERANCE: f64 = 1e-7;
}

/// Walks tried, as multiples of the variance that the noise has: from none to one that dominates.
const WALKS: [f64; 9] = [0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0];

/// A shape that the misfit of the static intervals may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// `f_i²`: even powers of the specific force.
    Quadratic,
    /// `|f_i|`: another scale factor upwards than downwards.
    Asymmetry,
    /// `f_i³`: odd powers.
    Cubic,
    /// The sign of the last change of `f_i`: where the device came from.
    History,
    /// `f_j` in the rate: sensitivity of the gyroscope to specific force.
    Force,
}

impl Pattern {
    /// Those of the norm of specific force.
    pub const OF_NORM: [Self; 4] = [Self::Quadratic, Self::Asymmetry, Self::Cubic, Self::History];

    /// The errors of the three axes for a unit coefficient on axis `i`: `eᵢ` of the direction `u` of specific force in
    /// units of gravity, and of its last change.
    fn error(self, u: f64, last_change: f64) -> f64 {
        match self {
            Self::Quadratic => u * u,
            Self::Asymmetry => u.abs(),
            Self::Cubic | Self::Force => u.powi(3),
            Self::History => last_change,
        }
    }
}

/// Numbers of the static intervals: residuals, what the parameters may take of them, noise.
#[derive(Clone, Debug)]
pub struct StaticNumbers {
    /// The interval of every number, and the direction (body frame) along which it was measured.
    pub rows: Vec<(Oriented, Vector3<f64>)>,
    /// Residuals (`n`).
    pub residuals: DVector<f64>,
    /// `∂r/∂p` of the parameters (`n × k`).
    pub jacobian: DMatrix<f64>,
    /// Standard deviations by the noise within the intervals (`n`).
    pub sigma: DVector<f64>,
}

/// A pattern that chance does not make.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// Its shape.
    pub pattern: Pattern,
    /// Probability of so much by chance, whatever walks.
    pub p_value: f64,
    /// Degrees of freedom of the test: of the pattern, of what it is compared with.
    pub dof: [usize; 2],
}

impl StaticNumbers {
    /// The likeliest of the patterns, where chance does not explain it.
    ///
    /// F test of the pattern's columns beside the parameters, against what remains: that may be noise, scatter from interval
    /// to interval, or a walk of the bias, whose density is the likeliest with the pattern present. Nothing of that kind
    /// depends on the orientation.
    pub fn shown(&self, patterns: &[Pattern]) -> Option<Shown> {
        if self.rows.len() < LEAST_SPARE.get() {
            return None;
        }
        let walks = self.walks(&WALKS);
        let all = patterns.iter().filter_map(|&pattern| {
            let (p_value, dof) = self.test(&walks, &self.columns(pattern))?;
            Some(Shown {
                pattern,
                p_value,
                dof,
            })
        });
        let best = all.min_by(|a, b| a.p_value.total_cmp(&b.p_value))?;
        (best.p_value < CHANCE.get() / patterns.len() as f64).then_some(best)
    }

    /// Returns the root mean square of the residuals per degree of freedom; zero where chance explains it.
    pub fn misfit(&self) -> f64 {
        if self.rows.len() < LEAST_SPARE.get() {
            return 0.0;
        }
        let Some(base) = self.walks(&[0.0]).first().map(|walk| walk.base) else {
            return 0.0;
        };
        let spare = self.rows.len().saturating_sub(base.rank) as f64;
        if spare < 1.0 || chance::of_chi2(base.square, spare) > UNLIKELY.get() {
            return 0.0;
        }
        let variance = self.sigma.norm_squared() / self.rows.len() as f64;
        (variance * base.square / spare).sqrt()
    }

    /// Returns the changes of the numbers by unit coefficients of a pattern (`n × q`).
    pub fn columns(&self, pattern: Pattern) -> DMatrix<f64> {
        let per_axis = if pattern == Pattern::Force { 9 } else { 3 };
        DMatrix::from_fn(self.rows.len(), per_axis, |row, k| {
            let (at, along) = &self.rows[row];
            if pattern == Pattern::Force {
                along[k / 3] * at.direction[k % 3]
            } else {
                along[k] * pattern.error(at.direction[k], at.last_change[k])
            }
        })
    }

    /// Fits the parameters under walks of these sizes, given as multiples of [`Self::walk`].
    fn walks(&self, sizes: &[f64]) -> Vec<Walking> {
        let groups = RowGroups::new(self.rows.iter().map(|(at, _)| at.recording).collect());
        let residuals = DMatrix::from_column_slice(self.rows.len(), 1, self.residuals.as_slice());
        let (residuals, jacobian) = (self.scaled(&residuals), self.scaled(&self.jacobian));
        let walk = self.walk();
        let filters = sizes.iter();
        let filters =
            filters.filter_map(|size| WalkFilter::new(&self.rows, &self.sigma, walk * size));
        filters
            .map(|filter| Walking::new(filter, &groups, &residuals, &jacobian))
            .collect()
    }

    /// Numbers in standard deviations.
    fn scaled(&self, a: &DMatrix<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(a.nrows(), a.ncols(), |i, k| a[(i, k)] / self.sigma[i])
    }

    /// The p-value of columns beside the parameters, and its degrees of freedom.
    fn test(&self, walks: &[Walking], columns: &DMatrix<f64>) -> Option<(f64, [usize; 2])> {
        let n = self.rows.len();
        let columns = self.scaled(columns);
        let best = walks
            .iter()
            .map(|walk| {
                let full = walk.with(&columns);
                // The scale is profiled too: scatter that all intervals share is no pattern either.
                let spare = n.saturating_sub(full.rank);
                let scale = (full.square / spare.max(1) as f64).max(1.0);
                let log_v = walk.filter.log_determinant;
                let log = -0.5
                    * (log_v + full.log_gram + full.square / scale + spare as f64 * scale.ln());
                (log, full, &walk.base)
            })
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let (_, full, base) = best?;
        let (spare, taken) = (n.checked_sub(full.rank)?, full.rank - base.rank);
        if spare < LEAST_SPARE.get() || taken == 0 {
            return None;
        }
        // Where what remains is like the noise, the noise was measured with many degrees of freedom; else what remains says
        // how large it is.
        let known = if chance::of_chi2(full.square, spare as f64) > UNREMARKABLE.get() {
            KNOWN.get()
        } else {
            0.0
        };
        let dof = known + spare as f64;
        let noise = ((known + full.square) / dof).max(1.0);
        let f = (base.square - full.square).max(0.0) / taken as f64 / noise;
        Some((chance::of_f(f, [taken as f64, dof]), [taken, spare]))
    }

    /// The density of a walk of the bias that reaches the noise's variance on average, variance per second.
    fn walk(&self) -> f64 {
        let numbers = self.rows.iter().zip(self.sigma.iter());
        let sum: f64 = numbers
            .map(|((at, along), sigma)| at.time.abs() * along.norm_squared() / (sigma * sigma))
            .sum();
        if sum > 0.0 {
            self.rows.len() as f64 / sum
        } else {
            0.0
        }
    }

    /// Drops intervals whose noise is not a number, and holds tiny standard deviations up.
    pub fn settled(mut self) -> Self {
        let largest = self.sigma.amax();
        for sigma in self.sigma.iter_mut() {
            *sigma = sigma
                .max(LEAST_SHARE.get() * largest)
                .max(f64::MIN_POSITIVE);
        }
        self
    }
}

/// Fit of columns to a residual.
#[derive(Clone, Copy, Debug)]
struct ColumnsFit {
    /// Sum of squares.
    square: f64,
    /// Rank of the columns.
    rank: usize,
    /// Logarithm of the determinant of their Gram matrix.
    log_gram: f64,
}

/// The numbers under one walk of the bias.
struct Walking {
    filter: WalkFilter,
    /// Basis of the parameters' columns.
    basis: Basis,
    /// Fit of the parameters alone.
    base: ColumnsFit,
    /// The residuals then.
    left: Vec<f64>,
}

impl Walking {
    /// Fits the parameters' columns (`n × k`) to the residuals (`n × 1`), both in standard deviations.
    fn new(
        filter: WalkFilter,
        groups: &RowGroups,
        residuals: &DMatrix<f64>,
        jacobian: &DMatrix<f64>,
    ) -> Self {
        let columns = Columns::cut(&whitened(&filter, jacobian), groups);
        let basis = Basis::with_tolerance(&columns, RANK_TOLERANCE.get());
        let left = basis.without_column(whitened(&filter, residuals).col_as_slice(0));
        let base = ColumnsFit {
            square: left.iter().map(|r| r * r).sum(),
            rank: basis.rank(),
            log_gram: 2.0 * basis.log_volume(),
        };
        Self {
            filter,
            basis,
            base,
            left,
        }
    }

    /// Fits the parameters and more columns together.
    fn with(&self, columns: &DMatrix<f64>) -> ColumnsFit {
        let mut columns = whitened(&self.filter, columns);
        let norms: Vec<f64> = columns.col_iter().map(|c| c.norm_l2()).collect();
        for (column, norm) in columns.col_iter_mut().zip(&norms) {
            if *norm > 0.0 {
                column.iter_mut().for_each(|v| *v /= norm);
            }
        }
        let columns = Columns::cut(&columns, self.basis.groups());
        let left = self.basis.without(&self.basis.without(&columns)).to_dense();
        let mut pivots = Vec::new();
        let own = orthonormal_with_pivots(&left, RANK_TOLERANCE.get(), &mut pivots);
        let r = Mat::from_fn(self.left.len(), 1, |i, _| self.left[i]);
        let square = self.base.square - (own.transpose() * r).squared_norm_l2();
        let lengths = norms.into_iter().filter(|norm| *norm > 0.0);
        let log_volume: f64 = pivots.into_iter().chain(lengths).map(f64::ln).sum();
        ColumnsFit {
            square: square.max(0.0),
            rank: self.base.rank + own.ncols(),
            log_gram: self.base.log_gram + 2.0 * log_volume,
        }
    }
}

fn whitened(filter: &WalkFilter, a: &DMatrix<f64>) -> Mat<f64> {
    let mut own = a.clone();
    filter.whiten(&mut own);
    Mat::from_fn(own.nrows(), own.ncols(), |i, k| own[(i, k)])
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    const SIGMA: f64 = 7e-4;

    /// Norms of specific force at 24 orientations with noise, a walk, and an error by `pattern`; the nine parameters
    /// of an accelerometer beside.
    fn norms(seed: u64, walk: f64, error: Option<(Pattern, f64)>) -> StaticNumbers {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let n = 24;
        let mut bias = Vector3::zeros();
        let mut rows = Vec::new();
        let mut residuals = DVector::zeros(n);
        let mut jacobian = DMatrix::zeros(n, 9);
        let mut before: Vector3<f64> = Vector3::zeros();
        for k in 0..n {
            let u = Vector3::from_fn(|_, _| normal()).normalize();
            let last_change = (u - before).map(f64::signum);
            before = u;
            let at = Oriented {
                direction: u,
                last_change,
                time: 10.0 * (k as f64 - 11.6),
                recording: 0,
            };
            bias += Vector3::from_fn(|_, _| normal()) * walk;
            residuals[k] = SIGMA * normal() + bias.dot(&u);
            if let Some((pattern, size)) = error {
                let e = |i: usize| [1.0, -1.0, 0.8][i] * size * pattern.error(u[i], last_change[i]);
                residuals[k] += (0..3).map(|i| u[i] * e(i)).sum::<f64>();
            }
            let of = [
                u.x * u.x,
                u.y * u.y,
                u.z * u.z,
                u.x * u.y,
                u.x * u.z,
                u.y * u.z,
                u.x,
                u.y,
                u.z,
            ];
            of.iter()
                .enumerate()
                .for_each(|(c, v)| jacobian[(k, c)] = *v);
            rows.push((at, u));
        }
        StaticNumbers {
            rows,
            residuals,
            jacobian,
            sigma: DVector::repeat(n, SIGMA),
        }
    }

    #[test]
    fn noise_and_walks_show_no_pattern() {
        let shown = (0..200).filter(|&seed| {
            let walk = [0.0, 1e-4, 3e-4, 1e-3][(seed % 4) as usize];
            norms(seed, walk, None).shown(&Pattern::OF_NORM).is_some()
        });
        // 0.05 % of 200 sessions: one by chance in ten runs of this test.
        assert!(shown.count() <= 1);
    }

    #[test]
    fn no_intervals_and_no_parameters_show_nothing() {
        let none = StaticNumbers {
            rows: Vec::new(),
            residuals: DVector::zeros(0),
            jacobian: DMatrix::zeros(0, 0),
            sigma: DVector::zeros(0),
        };
        assert_eq!(none.settled().shown(&[Pattern::Force]), None);
        let mut bare = norms(1, 0.0, None);
        bare.jacobian = DMatrix::zeros(24, 0);
        assert_eq!(bare.shown(&Pattern::OF_NORM), None);
    }

    #[test]
    fn a_missing_error_of_a_milli_g_shows_through_a_walk() {
        for pattern in Pattern::OF_NORM {
            let found = (0..20).filter(|&seed| {
                let numbers = norms(seed, 1e-4, Some((pattern, 9.8e-3)));
                numbers.shown(&Pattern::OF_NORM).is_some()
            });
            let found = found.count();
            // The scale factors take up most of a cubic: half of the sessions show it, nearly all show the others.
            let asked = if matches!(pattern, Pattern::Cubic) {
                8
            } else {
                18
            };
            assert!(found >= asked, "{pattern:?} {found}");
        }
    }
}
