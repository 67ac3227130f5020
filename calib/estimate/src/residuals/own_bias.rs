//! Several recordings of one device: everything shared but the bias.

use faer::Mat;
use sensor::BASE_PARAMETERS;
use solver::{Parameters, Problem};

/// The place of the bias among the parameters of a model.
const BIAS: std::ops::Range<usize> = 9..BASE_PARAMETERS;

/// The problems of several recordings that share a model.
///
/// Parameters: those of the model, whose bias is that of the *last* recording; then, with
/// `own_bias`, three for the bias of each earlier recording in turn.
#[derive(Clone, Debug)]
pub struct OwnBias<P> {
    /// The problem of each recording, in terms of the model's parameters.
    pub parts: Vec<P>,
    /// Number of parameters of the model.
    pub shared: usize,
    /// True if each recording has a bias of its own.
    pub own_bias: bool,
}

impl<P> OwnBias<P> {
    /// The parameters: those of the model, then `accel.b_x[name]` … for each earlier recording.
    pub fn parameters(&self, model: &Parameters, recordings: &[String]) -> Parameters {
        let mut all = model.clone();
        if !self.own_bias {
            return all;
        }
        for recording in &recordings[..recordings.len().saturating_sub(1)] {
            for k in BIAS {
                let name = format!("{}[{recording}]", model.names()[k]);
                all.push(name, model.units()[k].clone(), model.values()[k]);
            }
        }
        all
    }

    /// The model's parameters for recording `k`.
    fn local(&self, x: &[f64], k: usize) -> Vec<f64> {
        let mut local = x[..self.shared].to_vec();
        if self.own_bias && k + 1 < self.parts.len() {
            let from = self.shared + 3 * k;
            local[BIAS].copy_from_slice(&x[from..from + 3]);
        }
        local
    }

    /// Returns the model's parameters that are free in recording `k`, where those of the whole are `free`, and the place of
    /// each in `free`.
    fn local_columns(&self, k: usize, free: &[usize]) -> (Vec<usize>, Vec<usize>) {
        let own = self.own_bias && k + 1 < self.parts.len();
        let from = self.shared + 3 * k;
        let local = |&index: &usize| {
            if own && BIAS.contains(&index) {
                None
            } else if own && (from..from + 3).contains(&index) {
                Some(BIAS.start + index - from)
            } else {
                (index < self.shared).then_some(index)
            }
        };
        let places = free.iter().enumerate();
        places
            .filter_map(|(column, index)| Some((local(index)?, column)))
            .unzip()
    }
}

impl<P: Problem> Problem for OwnBias<P> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let mut own = Vec::new();
        out.clear();
        for (k, part) in self.parts.iter().enumerate() {
            part.values(&self.local(x, k), &mut own);
            out.append(&mut own);
        }
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        residuals.clear();
        let mut blocks = Vec::with_capacity(self.parts.len());
        let mut own = Vec::new();
        for (k, part) in self.parts.iter().enumerate() {
            let (local, columns) = self.local_columns(k, free);
            let matrix = part.linearize(&self.local(x, k), &local, &mut own);
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
        self.parts.iter().enumerate().all(|(k, part)| {
            let (x, v) = (self.local(x, k), self.local(v, k));
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
    use solver::{Jet, Residual, from_fn};

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
        let problem = OwnBias {
            parts,
            shared: 12,
            own_bias: true,
        };
        // The recordings in turn, with the parameters of each picked by hand.
        let residual = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
            for (part, bias) in problem.parts.iter().zip([12..15, 15..18, 9..12]) {
                let local: Vec<Jet> = [&x[..9], &x[bias]].concat();
                part.residuals(&local, out);
            }
        });
        let x: Vec<f64> = (0..18).map(|k| 0.3 + 0.1 * f64::from(k)).collect();
        let free = [0, 4, 8, 9, 11, 13, 17];
        let (mut r, mut s) = (Vec::new(), Vec::new());
        let wanted = residual.linearize(&x, &free, &mut r);
        let got = problem.linearize(&x, &free, &mut s);
        assert_eq!(r, s);
        assert_eq!(wanted, got);
    }
}
