//! The angular rate of a device at rest.

use sensor::{Model, ModelScalar};
use solver::{Residual, lit};

use super::StaticMean;

/// `r_k = ω_k / σ` per static interval and axis, `ω_k` the corrected mean rate, rad/s: a device at
/// rest does not turn (the earth's 7.3e-5 rad/s apart).
///
/// The component of gyro g-sensitivity along gravity is invisible to propagated gravity; these rows
/// see it. Parameters: those of the model.
#[derive(Clone, Copy, Debug)]
pub struct StaticRate<'a> {
    /// The gyroscope's model.
    pub model: &'a Model,
    /// Static means of the gyroscope; `rest` holds the corrected specific force.
    pub means: &'a [StaticMean],
    /// Standard deviation of a row, rad/s.
    pub sigma: f64,
}

impl<D: ModelScalar> Residual<D> for StaticRate<'_> {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let weight = self.sigma.recip();
        for mean in self.means {
            let rate = self
                .model
                .correct(&mean.raw.map(lit::<D>), &mean.rest.lift(), x);
            out.extend(rate.iter().map(|&w| w * weight));
        }
    }
}
