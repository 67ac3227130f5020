//! Levels of noise by restricted likelihood.

use std::cell::Cell;

use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::{Mat, Side};

use crate::methods::joint::noise::bias::Within;

/// Newton steps at most: usual ones are ten.
const STEPS: usize = 40;

/// Third powers of the number of rows that all steps of one search may take together, and fewest steps.
const MOST_WORK: f64 = 1.5e9;
const FEWEST_STEPS: f64 = 20.0;

/// A relative change of every variance below this ends the search.
const SETTLED: f64 = 1e-3;

/// Share by which the diagonal of the information is larger in a step.
const HELD_UP: f64 = 1e-3;

/// Twice the gain in log-likelihood below which a variance is taken for zero: 5 % of recordings without
/// it pass by chance, the variance being at the edge of what it can be (½ χ²₀ + ½ χ²₁).
const WORTH_IT: f64 = 2.7;

/// What is left of the residuals when the parameters have had their share:
/// `z = Nᵀ r ~ N(0, I + Σ θ_c C_c)`, `N` the left null space of the whitened Jacobian.
#[derive(Clone, Debug)]
pub struct Restricted {
    /// `Nᵀ r` (`q`).
    pub z: Vec<f64>,
    /// `Nᵀ C_c N` (`q × q`) of every component.
    pub covariances: Vec<Mat<f64>>,
    /// Independent numbers whose variances depend on the same components.
    pub within: Vec<Within>,
}

impl Restricted {
    /// Projects residuals `r` (`m`), Jacobian `J` (`m × n`, white whitened, full rank) and covariances.
    pub fn new(residuals: &[f64], jacobian: &Mat<f64>, covariances: &[&Mat<f64>]) -> Self {
        let null = left_null_space(jacobian);
        let r = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
        let z = null.transpose() * &r;
        Self {
            z: z.col(0).iter().copied().collect(),
            covariances: covariances.iter().map(|c| both_sides(&null, c)).collect(),
            within: Vec::new(),
        }
    }

    /// The variances that maximise the likelihood, those that are not worth it at zero; `kept` ones are
    /// kept whatever they are worth.
    pub fn variances(&self, kept: &[bool]) -> Vec<f64> {
        let mut active: Vec<bool> = self.covariances.iter().map(|_| true).collect();
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
        let cube = (self.z.len() as f64).powi(3).max(1.0);
        (MOST_WORK / cube).max(FEWEST_STEPS) as usize
    }

    /// The highest `log L` over all variances, up to a constant.
    pub fn highest(&self) -> f64 {
        let count = self.covariances.len();
        let steps = Cell::new(self.most_steps());
        self.maximise(&vec![true; count], &vec![0.0; count], &steps)
            .1
    }

    /// `log L` at these variances, up to a constant.
    #[cfg(test)]
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
        let q = self.z.len();
        let mut v = Mat::<f64>::identity(q, q);
        for (c, value) in self.covariances.iter().zip(theta) {
            if *value > 0.0 {
                add_lower(&mut v, *value, c);
            }
        }
        let factor = v.llt(Side::Lower).ok()?;
        let log_determinant: f64 = (0..q).map(|k| 2.0 * factor.L()[(k, k)].ln()).sum();
        let z = Mat::from_fn(q, 1, |i, _| self.z[i]);
        let weighted = factor.solve(&z);
        let square = (z.transpose() * &weighted)[(0, 0)];
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
            factor,
            weighted,
            own,
        })
    }

    /// Derivatives of the log-likelihood, which the last point of a search is not asked for: half of the work.
    fn slopes(&self, at: &Measured, active: &[bool]) -> Slopes {
        let Measured {
            factor,
            weighted,
            own,
            ..
        } = at;
        let inverse = factor.inverse();
        let count = self.covariances.len();
        let moved: Vec<Option<Mat<f64>>> = self
            .covariances
            .iter()
            .zip(active)
            .map(|(c, on)| on.then(|| c * weighted))
            .collect();
        let mut score = vec![0.0; count];
        let mut information = vec![vec![0.0; count]; count];
        for (i, own_moved) in moved.iter().enumerate() {
            let Some(own_moved) = own_moved else { continue };
            let trace = trace_of_product(&inverse, &self.covariances[i]);
            let form = (weighted.transpose() * own_moved)[(0, 0)];
            score[i] = 0.5 * (form - trace);
            let through = factor.solve(own_moved);
            for (j, other) in moved.iter().enumerate().take(i + 1) {
                let Some(other) = other else { continue };
                let sum = 0.5 * (other.transpose() * &through)[(0, 0)];
                information[i][j] = sum;
                information[j][i] = sum;
            }
        }
        for (w, v) in self.within.iter().zip(own) {
            for i in (0..count).filter(|&i| active[i]) {
                let share = w.by_component[i] / v;
                score[i] += 0.5 * share * (w.square / v - 1.0);
                for j in (0..count).filter(|&j| active[j]) {
                    information[i][j] += 0.5 * share * w.by_component[j] / v * (w.square / v);
                }
            }
        }
        Slopes { score, information }
    }
}

/// The likelihood at some variances.
struct Measured {
    log_likelihood: f64,
    /// Of the covariance `V` of `z`.
    factor: Llt<f64>,
    /// `V⁻¹ z`.
    weighted: Mat<f64>,
    /// Variances of the independent numbers.
    own: Vec<f64>,
}

/// First and second derivatives by the variances.
struct Slopes {
    score: Vec<f64>,
    information: Vec<Vec<f64>>,
}

impl Slopes {
    /// `I⁻¹ s` over the components that are active and not held at zero by their score.
    fn step(&self, theta: &[f64], active: &[bool]) -> Option<Vec<f64>> {
        let free: Vec<usize> = (0..theta.len())
            .filter(|&c| active[c] && (theta[c] > 0.0 || self.score[c] > 0.0))
            .collect();
        if free.is_empty() {
            return None;
        }
        // Components that do nearly the same to the data leave the information all but singular.
        let matrix = nalgebra::DMatrix::from_fn(free.len(), free.len(), |i, j| {
            let held_up = if i == j { 1.0 + HELD_UP } else { 1.0 };
            held_up * self.information[free[i]][free[j]]
        });
        let right = nalgebra::DVector::from_fn(free.len(), |i, _| self.score[free[i]]);
        let solution = matrix.cholesky()?.solve(&right);
        let mut step = vec![0.0; theta.len()];
        for (k, &c) in free.iter().enumerate() {
            step[c] = solution[k];
        }
        Some(step)
    }
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

/// `Nᵀ C N`, by the rows that are not zero in a symmetric `C`.
pub fn both_sides(null: &Mat<f64>, c: &Mat<f64>) -> Mat<f64> {
    let rows: Vec<usize> = (0..c.nrows()).filter(|&i| c[(i, i)] != 0.0).collect();
    let part = Mat::from_fn(rows.len(), null.ncols(), |i, k| null[(rows[i], k)]);
    let own = Mat::from_fn(rows.len(), rows.len(), |i, k| c[(rows[i], rows[k])]);
    part.transpose() * (own * &part)
}

/// An orthonormal basis (`m × (m − n)`) of what is orthogonal to the columns of `J`.
pub fn left_null_space(jacobian: &Mat<f64>) -> Mat<f64> {
    let (m, n) = (jacobian.nrows(), jacobian.ncols());
    let q = jacobian.qr().compute_Q();
    q.as_ref().subcols(n.min(m), m.saturating_sub(n)).to_owned()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn the_left_null_space_is_orthogonal_to_every_column() {
        let j = Mat::from_fn(7, 3, |i, k| ((i * 5 + k * 3) % 11) as f64 - 4.0);
        let null = left_null_space(&j);
        assert_eq!((null.nrows(), null.ncols()), (7, 4));
        assert!((null.transpose() * &j).norm_max() < 1e-13);
        assert!((null.transpose() * &null - Mat::<f64>::identity(4, 4)).norm_max() < 1e-14);
    }

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
        let restricted = Restricted {
            z,
            covariances: vec![Mat::identity(300, 300)],
            within: Vec::new(),
        };
        assert!((restricted.variances(&[false])[0] / closed - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_component_that_is_not_there_is_left_out() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(6);
        let z: Vec<f64> = (0..200)
            .map(|_| StandardNormal.sample(&mut random))
            .collect();
        let restricted = Restricted {
            z,
            covariances: vec![Mat::from_fn(200, 200, |i, j| (i.min(j) + 1) as f64)],
            within: Vec::new(),
        };
        assert_eq!(restricted.variances(&[false]), [0.0]);
    }
}
