//! What the data say about the parameters: covariance, rank, condition, unobservable directions.

use faer::Mat;
use serde::{Deserialize, Serialize};

/// Singular values below this fraction of the largest one count as zero.
const RANK_TOLERANCE: f64 = 1e-10;

/// A component smaller than this is not named in an unobservable direction.
const NAMED_COMPONENT: f64 = 0.05;

/// Second-order information at a solution, for the free parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Names of the free parameters, in the order of the covariance.
    pub names: Vec<String>,
    /// `(JᵀJ)⁺` for residuals of unit variance (`n × n`), minimum norm where the rank is short.
    pub covariance: Vec<Vec<f64>>,
    /// Rank of the Jacobian with unit columns.
    pub rank: usize,
    /// Largest over smallest singular value (of those that count) of the Jacobian with unit columns.
    pub condition: f64,
    /// Singular values of the Jacobian as it stands, descending.
    pub singular_values: Vec<f64>,
    /// Combinations of parameters that the data cannot see, in words.
    pub unobservable: Vec<String>,
}

impl Uncertainty {
    /// Standard error of free parameter `k` for residuals of standard deviation `sigma`.
    pub fn standard_error(&self, k: usize, sigma: f64) -> f64 {
        sigma * self.covariance[k][k].max(0.0).sqrt()
    }
}

/// Measures a Jacobian (`m × n`).
pub fn uncertainty(jacobian: &Mat<f64>, names: Vec<String>) -> Uncertainty {
    let (rows, n) = (jacobian.nrows(), jacobian.ncols());
    let norms: Vec<f64> = (0..n).map(|k| jacobian.col(k).norm_l2()).collect();
    let unit = |k: usize| if norms[k] > 0.0 { norms[k] } else { 1.0 };
    // Rows of zeros complete the null space where there are fewer residuals than parameters.
    let scaled = Mat::from_fn(rows.max(n), n, |i, k| {
        if i < rows {
            jacobian[(i, k)] / unit(k)
        } else {
            0.0
        }
    });
    let singular_values = jacobian.singular_values().unwrap_or_default();
    let Ok(svd) = scaled.thin_svd() else {
        return Uncertainty {
            covariance: vec![vec![f64::NAN; n]; n],
            rank: 0,
            condition: f64::INFINITY,
            unobservable: names.clone(),
            singular_values,
            names,
        };
    };
    let s: Vec<f64> = svd.S().column_vector().iter().copied().collect();
    let largest = s.first().copied().unwrap_or(0.0);
    let rank = s.iter().filter(|&&v| v > RANK_TOLERANCE * largest).count();
    let v = svd.V();
    let covariance = (0..n)
        .map(|i| {
            (0..n)
                .map(|j| {
                    let sum: f64 = (0..rank)
                        .map(|k| v[(i, k)] * v[(j, k)] / (s[k] * s[k]))
                        .sum();
                    sum / (unit(i) * unit(j))
                })
                .collect()
        })
        .collect();
    let unobservable = (rank..n.min(s.len()))
        .map(|k| {
            let direction: Vec<f64> = (0..n).map(|i| v[(i, k)] / unit(i)).collect();
            in_words(&direction, &names)
        })
        .collect();
    let condition = if rank == 0 {
        f64::INFINITY
    } else {
        largest / s[rank - 1]
    };
    Uncertainty {
        names,
        covariance,
        rank,
        condition,
        singular_values,
        unobservable,
    }
}

/// A direction in parameter space as `a + 0.5 b − c`.
fn in_words(direction: &[f64], names: &[String]) -> String {
    let largest = direction
        .iter()
        .copied()
        .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    let mut words = String::new();
    for (value, name) in direction.iter().zip(names) {
        let c = value / largest;
        if c.abs() < NAMED_COMPONENT {
            continue;
        }
        let sign = if c < 0.0 { "-" } else { "+" };
        if !words.is_empty() {
            words.push_str(&format!(" {sign} "));
        } else if c < 0.0 {
            words.push('-');
        }
        if (c.abs() - 1.0).abs() > 0.005 {
            words.push_str(&format!("{:.2} ", c.abs()));
        }
        words.push_str(name);
    }
    words
}
