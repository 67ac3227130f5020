//! Influence of every static interval on the result.

use serde::Serialize;

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;

/// Smallest squared pivot of `I − H` in the rows of a static interval; below it the other rows do not determine these.
const HELD_UP: f64 = 1e-8;

/// The influence of one rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// Place of the rest in the data.
    pub rest: usize,
    /// Sum of the leverages of its rows: the number of parameters that they determine.
    pub leverage: f64,
    /// The shared parameter that moves most without it.
    pub parameter: String,
    /// By how much, in its standard errors; infinite where nothing else determines it.
    pub change: f64,
}

impl JointFit {
    /// Leverage and leave-one-out change of every rest: its means deleted, its turns kept.
    ///
    /// Deleting rows is giving them a free parameter each: with `E` their unit columns whitened and `P` the
    /// projection orthogonal to the Jacobian, the parameters move by `−(JᵀJ)⁻¹ Jᵀ E (Eᵀ P E)⁻¹ Eᵀ r`.
    /// Exact for the linearised problem under any covariance of the rows.
    pub fn influences(&self) -> Vec<Influence> {
        let basis = Basis::of(&self.jacobian);
        let shared: Vec<usize> = (0..self.free.len())
            .filter(|&k| self.free[k] < self.shared)
            .collect();
        let reduced = &self.reduced;
        let stated = self.shared_uncertainty().covariance;
        let errors: Vec<f64> = (0..shared.len()).map(|k| stated[k][k].sqrt()).collect();
        let covariance = self.covariance_of_weights();
        (0..self.data.rests.len())
            .map(|rest| {
                let (leverage, moved) =
                    self.leverage_and_changes(rest, &basis, reduced, &covariance);
                let changes = moved.iter().zip(&errors).map(|(by, error)| by / error);
                let largest = changes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
                let name = |k: usize| self.parameters.names()[self.free[shared[k]]].clone();
                Influence {
                    rest,
                    leverage,
                    parameter: largest.map(|(k, _)| name(k)).unwrap_or_default(),
                    change: largest.map_or(0.0, |(_, change)| change),
                }
            })
            .collect()
    }

    /// The leverage of a rest, and by how much every shared parameter would move.
    fn leverage_and_changes(
        &self,
        rest: usize,
        basis: &Basis,
        reduced: &Columns,
        covariance: &[Vec<f64>],
    ) -> (f64, Vec<f64>) {
        let rows: Vec<usize> = (0..self.first_rows[1])
            .filter(|&i| self.rest_of_row[i] == rest)
            .collect();
        let leverage = rows.iter().map(|&i| basis.leverage(i)).sum();
        // The rows of a whitened problem stand for their rests: a walk mixes only little into them.
        let gram = nalgebra::DMatrix::from_fn(rows.len(), rows.len(), |i, k| {
            f64::from(u8::from(i == k)) - basis.row_product(rows[i], rows[k])
        });
        let r = nalgebra::DVector::from_fn(rows.len(), |i, _| self.residuals[rows[i]]);
        let own = gram
            .cholesky()
            .filter(|c| c.l_dirty().diagonal().iter().all(|l| l * l > HELD_UP))
            .map(|c| c.solve(&r));
        let Some(deleted) = own else {
            return (leverage, vec![f64::INFINITY; covariance.len()]);
        };
        let gradient = |b: usize| -> f64 {
            let own = rows.iter().zip(deleted.iter());
            own.map(|(&i, v)| reduced.get(i, b) * v).sum()
        };
        let gradient: Vec<f64> = (0..covariance.len()).map(gradient).collect();
        let change = |of: &Vec<f64>| of.iter().zip(&gradient).map(|(c, g)| c * g).sum::<f64>();
        let changes = covariance.iter().map(|of| change(of).abs()).collect();
        (leverage, changes)
    }
}
