//! Errors of the joint fit's parameters by an effect that its model leaves out.

use faer::Mat;
use sensor::EffectRef;

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::rows::error_columns::effect_columns;
use crate::methods::left_out::squares_added;

/// An error of the accelerometer at rest that a model leaves out.
#[derive(Clone, Debug)]
pub struct ErrorLeftOut {
    /// Column that a unit error adds to the rows.
    pub column: Vec<f64>,
    /// Its usual size.
    pub size: f64,
    /// Estimate of it by readings that no row has, and its variance.
    pub seen: (f64, f64),
}

/// The rows of a fit as what a model leaves out meets them.
#[derive(Debug)]
pub struct LeftOutRows<'a> {
    fit: &'a JointFit,
    /// The columns of all parameters that are not shared.
    others: Basis,
    /// Those of the shared ones beside them.
    reduced: Mat<f64>,
    residuals: Mat<f64>,
}

impl LeftOutRows<'_> {
    /// For each effect the mean square error of each free shared parameter (near SI units, in their order) that it adds, in
    /// its usual size, if the model leaves it out.
    ///
    /// `None` where the data do not determine the parameters.
    pub fn squares_added_by(&self, effects: &[EffectRef]) -> Vec<Option<Vec<f64>>> {
        let sensitivities = self.fit.sensitivities();
        let of = |effect: &EffectRef| {
            let count = effect.params().len();
            let (nothing, wanted) = (vec![0.0; count], (0..count).collect::<Vec<_>>());
            let rows = self.residuals.nrows();
            let added = effect_columns(&sensitivities, rows, effect, &nothing, &wanted);
            squares_added(&self.reduced, &self.left(&added), &self.residuals, |k| {
                effect.typical_of(k)
            })
        };
        effects.iter().map(of).collect()
    }

    /// The same of errors together, of which readings that no row has say something too: each a row that no parameter moves.
    pub fn squares_added_by_errors(&self, errors: &[ErrorLeftOut]) -> Option<Vec<f64>> {
        let m = self.residuals.nrows();
        let columns = Mat::from_fn(m, errors.len(), |i, k| errors[k].column[i]);
        let left = self.left(&columns);
        let rows = m + errors.len();
        let weight = |k: usize| errors[k].seen.1.sqrt().recip();
        let parameters = Mat::from_fn(rows, self.reduced.ncols(), |i, k| match i < m {
            true => self.reduced[(i, k)],
            false => 0.0,
        });
        let added = Mat::from_fn(rows, errors.len(), |i, k| match i.checked_sub(m) {
            None => left[(i, k)],
            Some(own) if own == k => weight(k),
            Some(_) => 0.0,
        });
        let residuals = Mat::from_fn(rows, 1, |i, _| match i.checked_sub(m) {
            None => self.residuals[(i, 0)],
            Some(k) => -errors[k].seen.0 * weight(k),
        });
        squares_added(&parameters, &added, &residuals, |k| errors[k].size)
    }

    /// What the parameters that are not shared leave of columns, whitened.
    fn left(&self, columns: &Mat<f64>) -> Mat<f64> {
        let whitening = &self.fit.whitening;
        let mut left = whitening.whiten(Columns::cut(columns, whitening.white.groups()));
        // Twice is enough: what the first projection leaves of rounding, the second takes.
        for _ in 0..2 {
            left = self.others.without(&left);
        }
        left.to_dense()
    }
}

impl JointFit {
    /// The rows as what the model leaves out meets them.
    pub fn left_out_rows(&self) -> LeftOutRows<'_> {
        LeftOutRows {
            fit: self,
            others: self.columns_of_others(),
            reduced: self.reduced.to_dense(),
            residuals: Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]),
        }
    }

    /// The free shared parameters and how far an error of the readings moves them, in their units; `column` is what it adds to the rows.
    pub(crate) fn moved_by(&self, column: &[f64]) -> Vec<(String, f64)> {
        let whitened = self.whitening.whiten_column(column);
        let along = |b: usize| -> f64 {
            let rows = whitened.iter().enumerate().filter(|(_, v)| **v != 0.0);
            rows.map(|(i, v)| self.reduced.get(i, b) * v).sum()
        };
        let covariance = self.covariance_of_weights();
        let gradient: Vec<f64> = (0..covariance.len()).map(along).collect();
        let shared = self.free.iter().copied().filter(|&k| k < self.shared);
        let each = shared.zip(&covariance);
        let moved = each.map(|(k, of)| {
            let moved: f64 = of.iter().zip(&gradient).map(|(c, g)| c * g).sum();
            let (unit, place) = self.unit_of(k);
            (
                self.parameters.names()[k].clone(),
                moved * unit.factor(place),
            )
        });
        moved.collect()
    }

    /// A basis of the columns of all parameters that are not shared.
    fn columns_of_others(&self) -> Basis {
        let is_other = |k: &usize| self.free[*k] >= self.shared;
        let others: Vec<usize> = (0..self.free.len()).filter(is_other).collect();
        Basis::of(&self.jacobian.select(&others))
    }
}
