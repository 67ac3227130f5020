//! Several recordings of one device: everything shared but the bias.

use sensor::{BASE_PARAMETERS, ModelScalar};
use solver::{Parameters, Residual};

/// The place of the bias among the parameters of a model.
const BIAS: std::ops::Range<usize> = 9..BASE_PARAMETERS;

/// The residuals of several recordings that share a model.
///
/// Parameters: those of the model, whose bias is that of the *last* recording; then, with
/// `own_bias`, three for the bias of each earlier recording in turn.
#[derive(Clone, Debug)]
pub struct OwnBias<R> {
    /// The residual of each recording, in terms of the model's parameters.
    pub parts: Vec<R>,
    /// Number of parameters of the model.
    pub shared: usize,
    /// True if each recording has a bias of its own.
    pub own_bias: bool,
}

impl<R> OwnBias<R> {
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
    pub fn local<D: Copy>(&self, x: &[D], k: usize) -> Vec<D> {
        let mut local = x[..self.shared].to_vec();
        if self.own_bias && k + 1 < self.parts.len() {
            let from = self.shared + 3 * k;
            local[BIAS].copy_from_slice(&x[from..from + 3]);
        }
        local
    }

    /// Returns the model's parameters that are free in recording `k`, where those of the whole are `free`, and the place of
    /// each in `free`.
    pub fn local_columns(&self, k: usize, free: &[usize]) -> (Vec<usize>, Vec<usize>) {
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

impl<D: ModelScalar, R: Residual<D>> Residual<D> for OwnBias<R> {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (k, part) in self.parts.iter().enumerate() {
            part.residuals(&self.local(x, k), out);
        }
    }
}
