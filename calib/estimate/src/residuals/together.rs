//! Problems put together: one after the other, and recording by recording.

use faer::Mat;
use solver::Problem;

use super::OwnBias;

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

/// [`OwnBias`] of problems that are not residuals over any scalar.
#[derive(Clone, Debug)]
pub struct Recordings<P>(pub OwnBias<P>);

impl<P: Problem> Problem for Recordings<P> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let mut own = Vec::new();
        out.clear();
        for (k, part) in self.0.parts.iter().enumerate() {
            part.values(&self.0.local(x, k), &mut own);
            out.append(&mut own);
        }
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        residuals.clear();
        let mut blocks = Vec::with_capacity(self.0.parts.len());
        let mut own = Vec::new();
        for (k, part) in self.0.parts.iter().enumerate() {
            let (local, columns) = self.0.local_columns(k, free);
            let matrix = part.linearize(&self.0.local(x, k), &local, &mut own);
            blocks.push((residuals.len(), columns, matrix));
            residuals.append(&mut own);
        }
        let mut jacobian = Mat::zeros(residuals.len(), free.len());
        for (row, columns, block) in &blocks {
            for (j, &column) in columns.iter().enumerate() {
                for i in 0..block.nrows() {
                    jacobian[(row + i, column)] = block[(i, j)];
                }
            }
        }
        jacobian
    }

    fn second_derivative(&self, x: &[f64], v: &[f64], out: &mut Vec<f64>) -> bool {
        let mut own = Vec::new();
        out.clear();
        self.0.parts.iter().enumerate().all(|(k, part)| {
            let (x, v) = (self.0.local(x, k), self.0.local(v, k));
            let offered = part.second_derivative(&x, &v, &mut own);
            out.append(&mut own);
            offered
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use sensor::Kinematics;

    use super::*;
    use crate::residuals::{StaticMean, StaticRate};

    #[test]
    fn recordings_with_biases_of_their_own_differentiate_as_their_residual_does() {
        let model = gyroscope::model();
        let means = [[0.1, 0.2, -0.3], [0.0, 0.5, 0.1]].map(|raw| StaticMean {
            raw: Vector3::from(raw),
            rest: Kinematics::at_rest(Vector3::z()),
            white: 0.0,
        });
        let rate = |means| StaticRate {
            model: &model,
            means,
            sigma: 0.1,
        };
        let parts = vec![rate(&means[..]), rate(&means[1..]), rate(&means[..1])];
        let residual = OwnBias {
            parts,
            shared: 12,
            own_bias: true,
        };
        let x: Vec<f64> = (0..18).map(|k| 0.3 + 0.1 * f64::from(k)).collect();
        let free = [0, 4, 8, 9, 11, 13, 17];
        let (mut r, mut s) = (Vec::new(), Vec::new());
        let wanted = residual.linearize(&x, &free, &mut r);
        let got = Recordings(residual).linearize(&x, &free, &mut s);
        assert_eq!(r, s);
        assert_eq!(wanted, got);
    }
}
