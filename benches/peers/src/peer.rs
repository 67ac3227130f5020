//! A problem in the terms of the crate levenberg-marquardt.

use std::cell::Cell;
use std::hint::black_box;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use solver::{Parameters, Problem};

struct Peer<'a> {
    problem: &'a dyn Problem,
    x: Vec<f64>,
    /// Number of residuals seen last: room for the next ones, as the solver has it.
    rows: Cell<usize>,
    jacobians: &'a Cell<usize>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Peer<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from_slice(x.as_slice());
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.x)
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut out = Vec::with_capacity(self.rows.get());
        self.problem.values(&self.x, &mut out);
        self.rows.set(out.len());
        Some(DVector::from_vec(out))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.jacobians.set(self.jacobians.get() + 1);
        let free: Vec<usize> = (0..self.x.len()).collect();
        let mut residuals = Vec::with_capacity(self.rows.get());
        let j = self.problem.linearize(&self.x, &free, &mut residuals);
        let mut entries = Vec::with_capacity(residuals.len() * free.len());
        for &k in &free {
            entries.extend_from_slice(j.col_as_slice(k));
        }
        Some(DMatrix::from_vec(residuals.len(), free.len(), entries))
    }
}

/// A whole fit; how many Jacobians it took.
pub fn fit(problem: &dyn Problem, start: &Parameters) -> usize {
    let jacobians = Cell::new(0);
    let peer = Peer {
        problem,
        x: start.values().to_vec(),
        rows: Cell::new(0),
        jacobians: &jacobians,
    };
    black_box(LevenbergMarquardt::new().minimize(peer));
    jacobians.get()
}
