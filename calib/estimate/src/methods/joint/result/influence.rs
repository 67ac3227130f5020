//! Static intervals that the result rests on.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;

findings::tuning! {
    /// Smallest squared pivot of `I − H` in the rows of a static interval; below it the other rows do not determine these.
    HELD_UP: f64 = 1e-8;
}

/// The influence of one static interval.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// Place of the rest in the data.
    pub rest: usize,
    /// The shared parameter that moves most without it.
    pub parameter: String,
    /// By how much, in its standard errors.
    pub change: f64,
}

/// How a static interval is taken out of a fit.
struct Deletion<'a> {
    basis: Basis,
    reduced: &'a Columns,
    /// Covariance of the shared parameters, by the weights alone.
    covariance: Vec<Vec<f64>>,
}

findings::tuning! {
    /// Share of `least` from which on a change is worked out in full.
    WORTH_A_LOOK: f64 = 0.5;
}

impl JointFit {
    /// The static intervals without whose means a shared parameter moves by more than `least` of its standard errors, their turns kept.
    ///
    /// Deleting rows is giving them a free parameter each: with `E` their unit columns whitened and `P` the
    /// projection orthogonal to the Jacobian, the parameters move by `−(JᵀJ)⁻¹ Jᵀ E (Eᵀ P E)⁻¹ Eᵀ r`.
    /// Exact for the linearised problem under any covariance of the rows. A first look takes the whitened rows for those of the interval,
    /// which they are but for what a wandering bias mixes into them.
    pub fn influential(&self, least: f64) -> Vec<Influence> {
        let shared: Vec<usize> = (0..self.free.len())
            .filter(|&k| self.free[k] < self.shared)
            .collect();
        let stated = self.shared_uncertainty().covariance;
        let errors: Vec<f64> = (0..shared.len()).map(|k| stated[k][k].sqrt()).collect();
        let deletion = Deletion {
            basis: Basis::of(&self.jacobian),
            reduced: &self.reduced,
            covariance: self.covariance_of_weights(),
        };
        let largest = |moved: Vec<f64>| {
            let changes = moved.into_iter().zip(&errors).map(|(by, error)| by / error);
            changes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
        };
        (0..self.data.rests.len())
            .filter_map(|rest| {
                let rows = self.rows_of_means(rest);
                let (_, roughly) = largest(deletion.of_rows(&rows, &self.residuals)?)?;
                if roughly < WORTH_A_LOOK.get() * least {
                    return None;
                }
                let columns = self.whitened_units(&rows);
                let (k, change) = largest(deletion.of_columns(&columns, &self.residuals)?)?;
                (change > least).then(|| Influence {
                    rest,
                    parameter: self.parameters.names()[self.free[shared[k]]].clone(),
                    change,
                })
            })
            .collect()
    }

    /// The rows of the mean readings in a static interval.
    fn rows_of_means(&self, rest: usize) -> Vec<usize> {
        (0..self.first_rows[1])
            .filter(|&i| self.rest_of_row[i] == rest)
            .collect()
    }

    /// The unit columns of some rows, whitened by everything, each of length 1.
    fn whitened_units(&self, rows: &[usize]) -> Vec<Vec<f64>> {
        let column = |&row: &usize| {
            let mut unit = vec![0.0; self.residuals.len()];
            unit[row] = 1.0;
            let whitened = self.whitening.finish_column(&unit);
            let length = whitened.iter().map(|v| v * v).sum::<f64>().sqrt();
            whitened.into_iter().map(|v| v / length).collect()
        };
        rows.iter().map(column).collect()
    }
}

impl Deletion<'_> {
    /// How far every shared parameter moves without some rows; `None` where the other rows do not determine these.
    fn of_rows(&self, rows: &[usize], r: &[f64]) -> Option<Vec<f64>> {
        let gram = DMatrix::from_fn(rows.len(), rows.len(), |i, k| {
            f64::from(u8::from(i == k)) - self.basis.row_product(rows[i], rows[k])
        });
        let right = DVector::from_fn(rows.len(), |i, _| r[rows[i]]);
        let deleted = solved(gram, &right)?;
        let along = |b: usize| -> f64 {
            let own = rows.iter().zip(deleted.iter());
            own.map(|(&i, v)| self.reduced.get(i, b) * v).sum()
        };
        Some(self.moved(along))
    }

    /// The same without what some columns `E` of length 1 span.
    fn of_columns(&self, columns: &[Vec<f64>], r: &[f64]) -> Option<Vec<f64>> {
        let n = columns.len();
        let seen: Vec<_> = columns
            .iter()
            .map(|e| self.basis.without_column(e))
            .collect();
        let gram = DMatrix::from_fn(n, n, |i, k| dot(&seen[i], &seen[k]));
        let right = DVector::from_fn(n, |i, _| dot(&columns[i], r));
        let deleted = solved(gram, &right)?;
        let out: Vec<f64> = (0..r.len())
            .map(|i| {
                columns
                    .iter()
                    .zip(deleted.iter())
                    .map(|(e, v)| e[i] * v)
                    .sum()
            })
            .collect();
        let along = |b: usize| -> f64 {
            let rows = out.iter().enumerate().filter(|(_, v)| **v != 0.0);
            rows.map(|(i, v)| self.reduced.get(i, b) * v).sum()
        };
        Some(self.moved(along))
    }

    /// The sizes of `C g`, `g` being what is deleted along every shared parameter.
    fn moved(&self, along: impl Fn(usize) -> f64) -> Vec<f64> {
        let gradient: Vec<f64> = (0..self.covariance.len()).map(along).collect();
        self.covariance
            .iter()
            .map(|of| dot(of, &gradient).abs())
            .collect()
    }
}

/// `(Eᵀ P E)⁻¹ Eᵀ r`; `None` where the matrix is singular.
fn solved(gram: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let factor = gram.cholesky()?;
    let holds = factor
        .l_dirty()
        .diagonal()
        .iter()
        .all(|l| l * l > HELD_UP.get());
    holds.then(|| factor.solve(right))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
