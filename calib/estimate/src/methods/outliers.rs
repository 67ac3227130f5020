//! Single rests that disagree with all the others.

use solver::{Problem, Report};

use crate::methods::chance;

findings::tuning! {
    /// A row that the fit follows more closely than this says nothing of the others.
    LEAST_FREE_SHARE: f64 = 1e-6;
}

/// A residual that the others do not explain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Row of the residual.
    pub row: usize,
    /// The residual that the fit of the others leaves there, in the residual's unit.
    pub deleted_residual: f64,
    /// Probability of one so large among all rows by chance (Bonferroni).
    pub p_value: f64,
}

/// The rows whose externally studentised residual is improbable at `level` over all rows:
/// `t = e / (s₍ᵢ₎ √(1 − h))` with the leverage `h = j C jᵀ` and `s₍ᵢ₎` the scatter without the row
/// (Cook & Weisberg 1982, Residuals and Influence in Regression).
pub fn outliers(problem: &dyn Problem, report: &Report, level: f64) -> Vec<Outlier> {
    let names = &report.uncertainty.names;
    let free: Vec<usize> = names
        .iter()
        .filter_map(|name| report.parameters.index(name))
        .collect();
    let rows = report.residuals.len();
    let Some(spare) = rows.checked_sub(report.uncertainty.rank + 1) else {
        return Vec::new();
    };
    if spare == 0 {
        return Vec::new();
    }
    let jacobian = problem.linearize(report.parameters.values(), &free, &mut Vec::new());
    let covariance = &report.uncertainty.covariance;
    let leverage = |i: usize| -> f64 {
        let n = free.len();
        (0..n)
            .flat_map(|a| (0..n).map(move |b| (a, b)))
            .map(|(a, b)| jacobian[(i, a)] * covariance[a][b] * jacobian[(i, b)])
            .sum()
    };
    (0..rows)
        .filter_map(|row| {
            let e = report.residuals[row];
            let free_share = 1.0 - leverage(row);
            let rest = (2.0 * report.cost - e * e / free_share) / spare as f64;
            let t = (e / (rest * free_share).sqrt()).abs();
            if free_share < LEAST_FREE_SHARE.get() || !t.is_finite() {
                return None;
            }
            let p_value = (chance::of_t(t, spare as f64) * rows as f64).min(1.0);
            (p_value < level).then_some(Outlier {
                row,
                deleted_residual: e / free_share,
                p_value,
            })
        })
        .collect()
}
