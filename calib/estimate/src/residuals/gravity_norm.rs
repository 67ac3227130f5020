//! The norm of static specific force.

use sensor::{Model, ModelScalar};
use solver::{Residual, lit};

use super::StaticMean;

/// `r_k = |f_k| − g` per static interval, m/s², with `f_k` the corrected mean reading
/// (Liu et al. 2021, section 4.1; the cost is `Σ (|f| − g)²`).
///
/// Parameters: those of the model.
#[derive(Clone, Copy, Debug)]
pub struct GravityNorm<'a> {
    /// The accelerometer's model.
    pub model: &'a Model,
    /// Static means of the accelerometer.
    pub means: &'a [StaticMean],
    /// Local gravity, m/s².
    pub gravity: f64,
}

impl<D: ModelScalar> Residual<D> for GravityNorm<'_> {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for mean in self.means {
            let force = self
                .model
                .correct(&mean.raw.map(lit::<D>), &mean.rest.lift(), x);
            out.push(force.dot(&force).sqrt() - self.gravity);
        }
    }
}
