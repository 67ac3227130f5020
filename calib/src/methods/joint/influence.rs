//! What every static interval does to the result.

use faer::Mat;
use serde::Serialize;

use super::fit::JointFit;
use super::marginal::orthonormal;

/// What is left of a row when all others have had their say; below this they say nothing of it.
const HELD_UP: f64 = 1e-8;

/// The influence of one rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// Place of the rest in the data.
    pub rest: usize,
    /// How many parameters' worth of information its rows are: the sum of their leverages.
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
        let basis = orthonormal(&self.jacobian);
        let shared: Vec<usize> = (0..self.free.len())
            .filter(|&k| self.free[k] < self.shared)
            .collect();
        let reduced = &self.reduced;
        let stated = self.shared_uncertainty().covariance;
        let errors: Vec<f64> = (0..shared.len()).map(|k| stated[k][k].sqrt()).collect();
        let covariance = self.covariance_of_weights();
        (0..self.data.rests.len())
            .map(|rest| {
                let mut own = self.influence(rest, &basis, reduced, &shared, &covariance);
                let worst = (0..shared.len())
                    .max_by(|&a, &b| (own.1[a] / errors[a]).total_cmp(&(own.1[b] / errors[b])));
                if let Some(k) = worst {
                    own.0.parameter = self.parameters.names()[self.free[shared[k]]].clone();
                    own.0.change = own.1[k] / errors[k];
                }
                own.0
            })
            .collect()
    }

    /// The leverage of a rest, and by how much every shared parameter would move.
    fn influence(
        &self,
        rest: usize,
        basis: &Mat<f64>,
        reduced: &Mat<f64>,
        shared: &[usize],
        covariance: &[Vec<f64>],
    ) -> (Influence, Vec<f64>) {
        let rows: Vec<usize> = (0..self.first_rows[1])
            .filter(|&i| self.rest_of_row[i] == rest)
            .collect();
        let leverage = rows
            .iter()
            .map(|&i| basis.row(i).iter().map(|v| v * v).sum::<f64>())
            .sum();
        // The rows of a whitened problem stand for their rests: a walk mixes only little into them.
        let e = Mat::from_fn(self.residuals.len(), rows.len(), |i, k| {
            f64::from(u8::from(rows[k] == i))
        });
        let left = &e - basis * (basis.transpose() * &e);
        let gram = left.transpose() * &left;
        let gram = nalgebra::DMatrix::from_fn(rows.len(), rows.len(), |i, k| gram[(i, k)]);
        let r = nalgebra::DVector::from_fn(rows.len(), |i, _| self.residuals[rows[i]]);
        let own = gram
            .cholesky()
            .filter(|c| c.l_dirty().diagonal().iter().all(|l| l * l > HELD_UP))
            .map(|c| c.solve(&r));
        let moved: Vec<f64> = (0..shared.len())
            .map(|a| match &own {
                None => f64::INFINITY,
                Some(d) => {
                    let change: f64 = (0..shared.len())
                        .map(|b| {
                            let gradient: f64 = rows
                                .iter()
                                .zip(d.iter())
                                .map(|(&i, v)| reduced[(i, b)] * v)
                                .sum();
                            covariance[a][b] * gradient
                        })
                        .sum();
                    change.abs()
                }
            })
            .collect();
        let influence = Influence {
            rest,
            leverage,
            parameter: String::new(),
            change: 0.0,
        };
        (influence, moved)
    }
}
