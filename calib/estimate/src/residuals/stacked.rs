//! Two problems, one after the other.

use faer::Mat;
use solver::Problem;

/// The rows of two problems with the same parameters, those of the first before those of the second.
#[derive(Clone, Debug)]
pub struct Stacked<A, B> {
    /// The first rows.
    pub first: A,
    /// The others.
    pub second: B,
}

impl<A: Problem, B: Problem> Problem for Stacked<A, B> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let mut more = Vec::new();
        self.first.values(x, out);
        self.second.values(x, &mut more);
        out.append(&mut more);
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        let mut more = Vec::new();
        let above = self.first.linearize(x, free, residuals);
        let below = self.second.linearize(x, free, &mut more);
        residuals.append(&mut more);
        Mat::from_fn(residuals.len(), free.len(), |i, j| {
            match i.checked_sub(above.nrows()) {
                None => above[(i, j)],
                Some(i) => below[(i, j)],
            }
        })
    }

    fn second_derivative(&self, x: &[f64], v: &[f64], out: &mut Vec<f64>) -> bool {
        let mut more = Vec::new();
        let both = self.first.second_derivative(x, v, out)
            && self.second.second_derivative(x, v, &mut more);
        out.append(&mut more);
        both
    }
}
