//! The restricted likelihood by dense matrices in the left null space of the columns: the oracle of the one that goes station by station.

use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::{Mat, Side};

use super::{Slopes, left_null_space};
use crate::methods::joint::blocks::basis::{RANK_TOLERANCE, orthonormal_with_pivots};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;

/// Residuals with the parameters projected out: in every group of rows `z = Nᵀ r ~ N(S γ, I + Σ θ_c C_c)`, `N` the left
/// null space of the columns of the whitened Jacobian that are the group's own, `S` those that it shares with others.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    parts: Vec<Part>,
    /// Number of shared columns `s`.
    shared: usize,
    /// Number of components.
    components: usize,
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
        }
    }

    /// First derivatives and average information at these variances.
    pub(crate) fn derivatives(&self, theta: &[f64], active: &[bool]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let at = self.measure(theta).unwrap();
        let slopes = self.slopes(&at, active);
        (slopes.score, slopes.information)
    }

    /// `log L` at these variances, up to a constant.
    pub(crate) fn log_likelihood(&self, theta: &[f64]) -> Option<f64> {
        Some(self.measure(theta)?.log_likelihood)
    }

    /// The log-likelihood; `None` where it is no number.
    fn measure(&self, theta: &[f64]) -> Option<Measured> {
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
        let log_likelihood = -0.5 * (log_determinant + square);
        (!log_likelihood.is_nan()).then_some(Measured {
            log_likelihood,
            parts,
            common,
        })
    }

    /// Derivatives of the log-likelihood.
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
        Slopes { score, information }
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
    let basis = orthonormal_with_pivots(&all, RANK_TOLERANCE.get(), &mut Vec::new());
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
