//! Residuals and leverages of the rows after a fit of columns.

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;

findings::tuning! {
    /// The share of rests (or turns) that a judgement of most of them rests on.
    QUIETER: f64 = 0.75;
}

/// Residuals and leverages of the rows after a fit of columns.
pub(crate) struct RowResiduals {
    residuals: Vec<f64>,
    basis: Basis,
}

impl RowResiduals {
    pub fn of(columns: &Columns, r: &[f64]) -> Self {
        let basis = Basis::of(columns);
        let residuals = basis.without_column(r);
        Self { residuals, basis }
    }

    /// Square of what is left of row `i`.
    pub fn square(&self, i: usize) -> f64 {
        self.residuals[i].powi(2)
    }

    /// The part of row `i` that the columns leave free: what its square is expected to be.
    pub fn spare(&self, i: usize) -> f64 {
        1.0 - self.basis.leverage(i)
    }

    /// `χ²` per degree of freedom of the quieter groups of rows.
    pub fn quieter_ratio(&self, groups: &[Vec<usize>]) -> f64 {
        let of = |rows: &Vec<usize>| {
            let square: f64 = rows.iter().map(|&i| self.square(i)).sum();
            (square, rows.iter().map(|&i| self.spare(i)).sum())
        };
        quieter_ratio(groups.iter().map(of).collect())
    }
}

/// `χ²` per degree of freedom of the quieter groups, of `(χ², degrees of freedom)`; 0 of none.
fn quieter_ratio(mut groups: Vec<(f64, f64)>) -> f64 {
    groups.retain(|(_, dof)| *dof > 0.1);
    groups.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    groups.truncate((QUIETER.get() * groups.len() as f64).ceil() as usize);
    let (sum, dof) = groups
        .iter()
        .fold((0.0, 0.0), |(s, d), g| (s + g.0, d + g.1));
    if dof > 0.0 { sum / dof } else { 0.0 }
}
