//! The restricted likelihood by dense matrices in the left null space of the columns: the oracle of the one that goes station by station.

use std::cell::Cell;

use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::{Mat, Side};

use super::{SETTLED, STEPS, Slopes, WORTH_IT, left_null_space};
use crate::methods::joint::blocks::basis::{RANK_TOLERANCE, orthonormal_with_pivots};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::noise::bias::Within;

/// Third powers of the number of rows that all steps of one search may take together, and fewest steps.
const MOST_WORK: f64 = 1.5e9;
const FEWEST_STEPS: f64 = 20.0;

/// Residuals with the parameters projected out: in every group of rows `z = Nᵀ r ~ N(S γ, I + Σ θ_c C_c)`, `N` the left
/// null space of the columns of the whitened Jacobian that are the group's own, `S` those that it shares with others.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    parts: Vec<Part>,
    /// Number of shared columns `s`.
    shared: usize,
    /// Number of components.
    components: usize,
    /// Independent numbers whose variances depend on the same components.
    pub(crate) within: Vec<Within>,
}

/// One group of rows.
#[derive(Clone, Debug)]
struct Part {
    /// `Nᵀ r` (`q × 1`).
    z: Mat<f64>,
    /// `Nᵀ S` (`q × s`), orthonormal over all groups.
    shared: Mat<f64>,
    /// `Nᵀ C_c N` (`q × q`) of every component.
    covariances: Vec<Mat<f64>>,
}

impl Dense {
    /// Projects residuals `r` (`m`), Jacobian `J` (`m × n`, white whitened, full rank) and covariances.
    pub(crate) fn new(residuals: &[f64], jacobian: &Columns, covariances: &[&Covariance]) -> Self {
        let groups = jacobian.groups().connected_by(covariances.iter().copied());
        let jacobian = jacobian.clone().regrouped(&groups);
        let (norms, parts_of) = (jacobian.norms(), jacobian.parts_of());
        let common: Vec<usize> = (0..parts_of.len()).filter(|&k| parts_of[k] > 1).collect();
        let mut parts: Vec<Part> = jacobian
            .parts()
            .iter()
            .map(|part| {
                let (_, others) = part.own_and_shared(&parts_of);
                let m = part.rows.len();
                let null = left_null_space(&part.own_columns(&parts_of));
                let mut shared = Mat::<f64>::zeros(m, common.len());
                for place in others {
                    let column = part.columns[place];
                    if let Ok(to) = common.binary_search(&column) {
                        for i in 0..m {
                            shared[(i, to)] = part.values[(i, place)] / norms[column];
                        }
                    }
                }
                let r = Mat::from_fn(m, 1, |i, _| residuals[part.rows[i]]);
                let projected = |c: &&Covariance| c.both_sides_of(&part.rows, &null);
                Part {
                    z: null.transpose() * &r,
                    shared: null.transpose() * &shared,
                    covariances: covariances.iter().map(projected).collect(),
                }
            })
            .collect();
        let shared = make_orthonormal(&mut parts);
        Self {
            parts,
            shared,
            components: covariances.len(),
            within: Vec::new(),
        }
    }

    /// Builds the problem of one group of rows that shares nothing: numbers `z` (`q`) and covariances (`q × q`).
    pub(crate) fn alone(z: &[f64], covariances: Vec<Mat<f64>>) -> Self {
        Self {
            components: covariances.len(),
            parts: vec![Part {
                z: Mat::from_fn(z.len(), 1, |i, _| z[i]),
                shared: Mat::zeros(z.len(), 0),
                covariances,
            }],
            shared: 0,
            within: Vec::new(),
        }
    }

    /// The variances that maximise the likelihood, those that are not worth it at zero; `kept` ones are
    /// kept whatever they are worth.
    pub(crate) fn variances(&self, kept: &[bool]) -> Vec<f64> {
        let mut active = vec![true; self.components];
        let mut from = vec![0.0; active.len()];
        let left = Cell::new(self.most_steps());
        loop {
            let (theta, whole) = self.maximise(&active, &from, &left);
            from.clone_from(&theta);
            for (on, value) in active.iter_mut().zip(&theta) {
                *on &= *value > 0.0;
            }
            let gains = (0..theta.len())
                .filter(|&c| active[c] && !kept[c])
                .map(|c| {
                    let mut without = active.clone();
                    without[c] = false;
                    (c, 2.0 * (whole - self.maximise(&without, &theta, &left).1))
                });
            match gains.min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((c, gain)) if gain < WORTH_IT => {
                    active[c] = false;
                    from[c] = 0.0;
                }
                _ => return theta,
            }
        }
    }

    fn most_steps(&self) -> usize {
        let cubes = self
            .parts
            .iter()
            .map(|part| (part.z.nrows() as f64).powi(3));
        (MOST_WORK / cubes.sum::<f64>().max(1.0)).max(FEWEST_STEPS) as usize
    }

    /// First derivatives and average information at these variances.
    pub(crate) fn derivatives(&self, theta: &[f64], active: &[bool]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let at = self.measure(theta, f64::NEG_INFINITY).unwrap();
        let slopes = self.slopes(&at, active);
        (slopes.score, slopes.information)
    }

    /// `log L` at these variances, up to a constant.
    pub(crate) fn log_likelihood(&self, theta: &[f64]) -> Option<f64> {
        Some(self.measure(theta, f64::NEG_INFINITY)?.log_likelihood)
    }

    /// Newton steps by the average information (Gilmour, Thompson & Cullis 1995), in no more than the steps that are left, over the active components from the variances `from`, zero for the others; variances and
    /// log-likelihood.
    fn maximise(&self, active: &[bool], from: &[f64], left: &Cell<usize>) -> (Vec<f64>, f64) {
        let start = from.iter().zip(active);
        let mut theta: Vec<f64> = start.map(|(&t, &on)| if on { t } else { 0.0 }).collect();
        let mut at = match self.measure(&theta, f64::NEG_INFINITY) {
            Some(at) => at,
            None => return (theta, f64::NEG_INFINITY),
        };
        for _ in 0..STEPS.min(left.get()) {
            left.set(left.get() - 1);
            let Some(step) = self.slopes(&at, active).step(&theta, active) else {
                break;
            };
            let mut factor = 1.0;
            let mut next = None;
            while factor > 1e-3 {
                let tried: Vec<f64> = theta
                    .iter()
                    .zip(&step)
                    .map(|(t, s)| (t + factor * s).max(0.0))
                    .collect();
                if let Some(measured) = self.measure(&tried, at.log_likelihood) {
                    next = Some((tried, measured));
                    break;
                }
                factor *= 0.3;
            }
            let Some((tried, measured)) = next else { break };
            let moved = tried
                .iter()
                .zip(&theta)
                .any(|(a, b)| (a - b).abs() > SETTLED * a.max(*b));
            theta = tried;
            at = measured;
            if !moved {
                break;
            }
        }
        (theta, at.log_likelihood)
    }

    /// The log-likelihood; `None` where it is below `least`.
    fn measure(&self, theta: &[f64], least: f64) -> Option<Measured> {
        let mut parts = Vec::with_capacity(self.parts.len());
        let (mut log_determinant, mut square) = (0.0, 0.0);
        let mut normal = Mat::<f64>::zeros(self.shared, self.shared);
        let mut right = Mat::<f64>::zeros(self.shared, 1);
        for part in &self.parts {
            let q = part.z.nrows();
            let mut v = Mat::<f64>::identity(q, q);
            for (c, value) in part.covariances.iter().zip(theta) {
                if *value > 0.0 {
                    add_lower(&mut v, *value, c);
                }
            }
            let factor = v.llt(Side::Lower).ok()?;
            log_determinant += (0..q).map(|k| 2.0 * factor.L()[(k, k)].ln()).sum::<f64>();
            let weighted = factor.solve(&part.z);
            square += (part.z.transpose() * &weighted)[(0, 0)];
            let shared = factor.solve(&part.shared);
            normal += part.shared.transpose() * &shared;
            right += part.shared.transpose() * &weighted;
            parts.push(MeasuredPart {
                factor,
                weighted,
                shared,
            });
        }
        let common = match self.shared {
            0 => None,
            s => {
                let factor = normal.llt(Side::Lower).ok()?;
                log_determinant += (0..s).map(|k| 2.0 * factor.L()[(k, k)].ln()).sum::<f64>();
                let taken = factor.solve(&right);
                square -= (right.transpose() * &taken)[(0, 0)];
                for part in &mut parts {
                    part.weighted -= &part.shared * &taken;
                }
                Some(factor)
            }
        };
        let mut log_likelihood = -0.5 * (log_determinant + square);
        let own: Vec<f64> = self.within.iter().map(|w| w.variance(theta)).collect();
        for (w, v) in self.within.iter().zip(&own) {
            log_likelihood -= 0.5 * (v.ln() + w.square / v);
        }
        if log_likelihood.is_nan() || log_likelihood < least {
            return None;
        }
        Some(Measured {
            log_likelihood,
            parts,
            common,
            own,
        })
    }

    /// Derivatives of the log-likelihood, which the last point of a search is not asked for: half of the work.
    fn slopes(&self, at: &Measured, active: &[bool]) -> Slopes {
        let count = self.components;
        let mut score = vec![0.0; count];
        let mut information = vec![vec![0.0; count]; count];
        // `Sᵀ V⁻¹ C_c P z` over all groups.
        let mut of_shared: Vec<Mat<f64>> = vec![Mat::zeros(self.shared, 1); count];
        for (part, at_part) in self.parts.iter().zip(&at.parts) {
            let inverse = at_part.factor.inverse();
            let moved: Vec<Option<Mat<f64>>> = part
                .covariances
                .iter()
                .zip(active)
                .map(|(c, on)| on.then(|| c * &at_part.weighted))
                .collect();
            for (i, own_moved) in moved.iter().enumerate() {
                let Some(own_moved) = own_moved else { continue };
                let mut trace = trace_of_product(&inverse, &part.covariances[i]);
                if let Some(common) = &at.common {
                    let c = &part.covariances[i];
                    let through = at_part.shared.transpose() * (c * &at_part.shared);
                    let inside = common.solve(&through);
                    trace -= (0..self.shared).map(|k| inside[(k, k)]).sum::<f64>();
                    of_shared[i] += at_part.shared.transpose() * own_moved;
                }
                let form = (at_part.weighted.transpose() * own_moved)[(0, 0)];
                score[i] += 0.5 * (form - trace);
                let through = at_part.factor.solve(own_moved);
                for (j, other) in moved.iter().enumerate().take(i + 1) {
                    let Some(other) = other else { continue };
                    let sum = 0.5 * (other.transpose() * &through)[(0, 0)];
                    information[i][j] += sum;
                    if j < i {
                        information[j][i] += sum;
                    }
                }
            }
        }
        if let Some(common) = &at.common {
            for i in 0..count {
                let through = common.solve(&of_shared[i]);
                for j in 0..count {
                    information[i][j] -= 0.5 * (of_shared[j].transpose() * &through)[(0, 0)];
                }
            }
        }
        let mut slopes = Slopes { score, information };
        slopes.add_independent(&self.within, &at.own, active);
        slopes
    }
}

/// Makes the shared columns of all groups together orthonormal; how many are left.
fn make_orthonormal(parts: &mut [Part]) -> usize {
    let rows = parts.iter().map(|part| part.z.nrows()).sum();
    let count = parts.first().map_or(0, |part| part.shared.ncols());
    let mut all = Mat::<f64>::zeros(rows, count);
    let mut above = 0;
    for part in parts.iter() {
        let q = part.z.nrows();
        all.as_mut().subrows_mut(above, q).copy_from(&part.shared);
        above += q;
    }
    let basis = orthonormal_with_pivots(&all, RANK_TOLERANCE, &mut Vec::new());
    above = 0;
    for part in parts.iter_mut() {
        let q = part.z.nrows();
        part.shared = basis.as_ref().subrows(above, q).to_owned();
        above += q;
    }
    basis.ncols()
}

/// The likelihood at some variances.
struct Measured {
    log_likelihood: f64,
    parts: Vec<MeasuredPart>,
    /// Factor of `Σ Sᵀ V⁻¹ S`; `None` where nothing is shared.
    common: Option<Llt<f64>>,
    /// Variances of the independent numbers.
    own: Vec<f64>,
}

/// The same of one group of rows.
struct MeasuredPart {
    /// Factor of the covariance `V` of `z`.
    factor: Llt<f64>,
    /// `P z`: `V⁻¹ z` less what the shared columns take.
    weighted: Mat<f64>,
    /// `V⁻¹ S`.
    shared: Mat<f64>,
}

/// `A += s B` on and below the diagonal, which is all that a Cholesky factor takes of a symmetric matrix.
fn add_lower(a: &mut Mat<f64>, s: f64, b: &Mat<f64>) {
    for k in 0..a.ncols() {
        let below = a.col_as_slice_mut(k).iter_mut().zip(b.col_as_slice(k));
        below.skip(k).for_each(|(a, b)| *a += s * b);
    }
}

/// `tr(A B)` of symmetric matrices.
fn trace_of_product(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let columns = a.col_iter().zip(b.col_iter());
    columns.map(|(a, b)| a.transpose() * b).sum()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::methods::joint::blocks::groups::RowGroups;

    #[test]
    fn the_variance_of_independent_residuals_has_its_closed_form() {
        // One component C = I with 1 + θ = Σ z²/q at the maximum.
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let z: Vec<f64> = (0..300)
            .map(|_| {
                let v: f64 = StandardNormal.sample(&mut random);
                2.0 * v
            })
            .collect();
        let closed = z.iter().map(|v| v * v).sum::<f64>() / 300.0 - 1.0;
        let restricted = Dense::alone(&z, vec![Mat::identity(300, 300)]);
        assert!((restricted.variances(&[false])[0] / closed - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_component_that_is_not_there_is_left_out() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(6);
        let z: Vec<f64> = (0..200)
            .map(|_| StandardNormal.sample(&mut random))
            .collect();
        let walk = Mat::from_fn(200, 200, |i, j| (i.min(j) + 1) as f64);
        let restricted = Dense::alone(&z, vec![walk]);
        assert_eq!(restricted.variances(&[false]), [0.0]);
    }

    #[test]
    fn recordings_by_themselves_have_the_likelihood_of_all_rows_together() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        let r: Vec<f64> = (0..60)
            .map(|_| StandardNormal.sample(&mut random))
            .collect();
        let whole = Mat::from_fn(60, 6, |i, k| {
            let value = ((i * 7 + k * 5 + i * k) % 11) as f64 - 5.0;
            if k < 2 || i / 30 == k / 4 { value } else { 0.0 }
        });
        let walk = Mat::from_fn(30, 30, |i, j| 0.1 * (i.min(j) + 1) as f64);
        let blocks = [0, 30].map(|first| ((first..first + 30).collect(), walk.clone()));
        let walk = Covariance::of_blocks(60, blocks.into());
        let scatter = Covariance::of_blocks(60, vec![((5..35).collect(), Mat::identity(30, 30))]);
        let groups = RowGroups::new((0..60).map(|i| i / 30).collect());
        let likelihood = |groups: &RowGroups, all: &[&Covariance], theta: &[f64]| {
            let jacobian = Columns::cut(&whole, groups);
            Dense::new(&r, &jacobian, all)
                .log_likelihood(theta)
                .unwrap()
        };
        let one = RowGroups::whole(60);
        let change = |groups: &RowGroups| {
            likelihood(groups, &[&walk], &[0.7]) - likelihood(groups, &[&walk], &[0.0])
        };
        assert!((change(&groups) - change(&one)).abs() < 1e-10);
        let both = [&walk, &scatter];
        let [a, b] = [&groups, &one]
            .map(|g| Dense::new(&r, &Columns::cut(&whole, g), &both).variances(&[true, true]));
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-6 * (1.0 + b), "{a} {b}");
        }
        let [a, b] = [&groups, &one]
            .map(|g| Dense::new(&r, &Columns::cut(&whole, g), &[&walk]).variances(&[true]));
        assert!((a[0] - b[0]).abs() < 1e-6 * b[0].max(1e-3), "{a:?} {b:?}");
    }
}
