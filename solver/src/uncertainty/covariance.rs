//! Statements of the data about the parameters: covariance, rank, condition, unobservable directions.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::svd::{ComputeSvdVectors, svd, svd_scratch};
use faer::{Mat, MatRef, Par};
use serde::{Deserialize, Serialize};

use crate::linear::singular;
use crate::linear::vector::dot;
use crate::minimise::scaling::unit_if_zero;
use crate::rules::RANK_TOLERANCE;
use crate::uncertainty::observability::{in_words, separate};

/// Most columns for which rotating pairs of them is faster than a bidiagonalisation.
const SMALL: usize = 16;

/// Second-order information at a solution, for the free parameters; [`Report::standard_error`](crate::Report::standard_error) says
/// how to read it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Names of the free parameters, in the order of the covariance.
    pub names: Vec<String>,
    /// `(JᵀJ)⁺` for residuals of unit variance (`n × n`), minimum norm where the rank is short and
    /// zero across active constraints; with the curvatures of a robust loss on the rows. Times
    /// [`Report::variance`](crate::Report::variance) it is the covariance that the residuals show.
    pub covariance: Vec<Vec<f64>>,
    /// Rank of the Jacobian with unit columns, along active constraints.
    pub rank: usize,
    /// Largest over smallest singular value (of those that count) of the Jacobian with unit columns.
    #[serde(with = "crate::infinite")]
    pub condition: f64,
    /// Singular values of the Jacobian with unit columns, along active constraints, descending: what
    /// rank and condition are judged by.
    pub singular_values: Vec<f64>,
    /// Combinations of parameters that the data cannot see, in words.
    pub unobservable: Vec<String>,
}

impl Uncertainty {
    /// Standard error of free parameter `k` (an index into `names`) for residuals of standard
    /// deviation `sigma`.
    pub fn standard_error(&self, k: usize, sigma: f64) -> f64 {
        sigma * self.covariance[k][k].max(0.0).sqrt()
    }

    /// Correlation of free parameters `i` and `k`; not a number where one has no variance.
    pub fn correlation(&self, i: usize, k: usize) -> f64 {
        self.covariance[i][k] / (self.covariance[i][i] * self.covariance[k][k]).sqrt()
    }

    /// Nothing known: no rank, no finite covariance.
    pub(crate) fn unknown(names: Vec<String>) -> Self {
        let n = names.len();
        Self {
            covariance: vec![vec![f64::NAN; n]; n],
            rank: 0,
            condition: f64::INFINITY,
            unobservable: names.clone(),
            singular_values: Vec::new(),
            names,
        }
    }
}

/// Measures a Jacobian (`m × n`) with the names of its columns; a column beyond the names is called
/// by its number.
pub fn uncertainty(jacobian: &Mat<f64>, mut names: Vec<String>) -> Uncertainty {
    names.truncate(jacobian.ncols());
    names.extend((names.len()..jacobian.ncols()).map(|k| format!("x{k}")));
    uncertainty_along(jacobian.as_ref(), None, names)
}

/// Measures a Jacobian (`m × n`) along `directions` (`n × d`), all of them if `None`.
///
/// By the singular value decomposition `U S Vᵀ` of the triangle of the Jacobian with unit
/// columns (scaling columns leaves `Q` as it is, so one triangle serves): the covariance is
/// `B V S⁻² Vᵀ Bᵀ`; the normal equations are never formed.
pub(crate) fn uncertainty_along(
    jacobian: MatRef<'_, f64>,
    directions: Option<Mat<f64>>,
    names: Vec<String>,
) -> Uncertainty {
    let n = names.len();
    let triangle = triangle(jacobian);
    let reduced = match &directions {
        Some(directions) => triangle * directions,
        None => triangle,
    };
    let d = reduced.ncols();
    let norms: Vec<f64> = (0..d)
        .map(|k| unit_if_zero(reduced.col(k).norm_l2()))
        .collect();
    let scaled = Mat::from_fn(reduced.nrows(), d, |i, k| reduced[(i, k)] / norms[k]);
    let Some((s, v)) = right_vectors(scaled.as_ref()) else {
        return Uncertainty::unknown(names);
    };
    let largest = s.first().copied().unwrap_or(0.0);
    let rank = s.iter().filter(|&&v| v > RANK_TOLERANCE * largest).count();
    // B V in the parameters' units, a column per singular value.
    let unscaled = Mat::from_fn(d, d, |i, k| v[(i, k)] / norms[i]);
    let axes = match directions {
        Some(directions) => directions * unscaled,
        None => unscaled,
    };
    let units: Vec<f64> = (0..n)
        .map(|k| unit_if_zero(jacobian.col(k).norm_l2()))
        .collect();
    let unseen = (rank..d)
        .map(|k| (0..n).map(|i| axes[(i, k)]).collect())
        .collect();
    let unseen = separate(unseen, &units);
    Uncertainty {
        covariance: covariance(axes.as_ref(), &s[..rank]),
        rank,
        condition: if rank == 0 {
            f64::INFINITY
        } else {
            largest / s[rank - 1]
        },
        unobservable: unseen
            .iter()
            .map(|direction| in_words(direction, &units, &names))
            .collect(),
        singular_values: s,
        names,
    }
}

/// `A S⁻² Aᵀ` of as many columns of `A` (`n × …`) as there are singular values.
fn covariance(axes: MatRef<'_, f64>, s: &[f64]) -> Vec<Vec<f64>> {
    let n = axes.nrows();
    let mut root = Vec::with_capacity(n * s.len());
    for i in 0..n {
        root.extend(s.iter().enumerate().map(|(k, s)| axes[(i, k)] / s));
    }
    let row = |i: usize| &root[i * s.len()..(i + 1) * s.len()];
    (0..n)
        .map(|i| (0..n).map(|k| dot(row(i), row(k))).collect())
        .collect()
}

/// Singular values, descending, and all right vectors `V` (`n × n`); the left ones cost as much again
/// and nobody asks for them.
pub(crate) fn right_vectors(a: MatRef<'_, f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let (m, n) = a.shape();
    if n <= SMALL
        && let Some(found) = singular(a)
    {
        return Some((found.values, found.vectors));
    }
    let (left, right) = (ComputeSvdVectors::No, ComputeSvdVectors::Full);
    let need = svd_scratch::<f64>(m, n, left, right, Par::Seq, Default::default());
    let mut memory = MemBuffer::new(need);
    let mut s = Diag::zeros(m.min(n));
    let mut v = Mat::zeros(n, n);
    svd(
        a,
        s.as_mut(),
        None,
        Some(v.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    )
    .ok()?;
    Some((s.column_vector().iter().copied().collect(), v))
}

/// A matrix of as many columns and few rows with the same singular values and right vectors.
pub(crate) fn triangle(a: MatRef<'_, f64>) -> Mat<f64> {
    if a.nrows() <= 2 * a.ncols() || a.ncols() == 0 {
        return a.to_owned();
    }
    let qr = a.qr();
    let r = qr.thin_R();
    Mat::from_fn(
        r.nrows(),
        r.ncols(),
        |i, k| if i <= k { r[(i, k)] } else { 0.0 },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_vectors_are_those_of_the_full_decomposition() {
        for (m, n) in [(9, 9), (4, 3), (2, 5), (20, 20)] {
            let a = Mat::from_fn(m, n, |i, k| ((i * 5 + k * 3 + i * i * k) % 11) as f64 - 4.0);
            let full = a.svd().unwrap();
            let (s, v) = right_vectors(a.as_ref()).unwrap();
            for (k, (fast, simple)) in s.iter().zip(full.S().column_vector().iter()).enumerate() {
                assert!((fast - simple).abs() < 1e-13 * s[0], "{m} {n} {k}");
            }
            // `A V` has orthogonal columns of lengths `s`: what `AᵀA = V S² Vᵀ` says.
            let gram = v.transpose() * a.transpose() * &a * &v;
            let square = |k: usize| s.get(k).map_or(0.0, |s| s * s);
            for i in 0..n {
                for k in 0..n {
                    let expected = if i == k { square(k) } else { 0.0 };
                    assert!(
                        (gram[(i, k)] - expected).abs() < 1e-12 * s[0] * s[0],
                        "{i} {k}"
                    );
                }
            }
        }
    }
}
