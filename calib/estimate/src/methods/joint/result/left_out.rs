//! Errors of the joint fit's parameters by an effect that its model leaves out.

use faer::Mat;
use sensor::EffectRef;

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::rows::error_columns::effect_columns;
use crate::methods::left_out::squares_added;

impl JointFit {
    /// For each effect the mean square error of each free shared parameter (near SI units, in their order) that it adds, in
    /// its usual size, if the model leaves it out.
    ///
    /// `None` where the data do not determine the parameters.
    pub fn squares_added_by(&self, effects: &[EffectRef]) -> Vec<Option<Vec<f64>>> {
        let m = self.residuals.len();
        let sensitivities = self.sensitivities();
        let others = self.columns_of_others();
        let reduced = self.reduced.to_dense();
        let residuals = Mat::from_fn(m, 1, |i, _| self.residuals[i]);
        let of = |effect: &EffectRef| {
            let count = effect.params().len();
            let (nothing, wanted) = (vec![0.0; count], (0..count).collect::<Vec<_>>());
            let added = effect_columns(&sensitivities, m, effect, &nothing, &wanted);
            let added = Columns::cut(&added, self.whitening.white.groups());
            let mut added = self.whitening.whiten(added);
            // Twice is enough: what the first projection leaves of rounding, the second takes.
            for _ in 0..2 {
                added = others.without(&added);
            }
            squares_added(&reduced, &added.to_dense(), &residuals, |k| {
                effect.typical_of(k)
            })
        };
        effects.iter().map(of).collect()
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
