//! Noise that readings within rests show and means over rests do not.
//!
//! Coloured noise is extrapolated from batches of at most a second. A device that sways in a hand moves for seconds and comes
//! back: batches spread by it, means over rests hardly do. The fit knows, since it leaves less of the means than their
//! noise would make by chance.

use recording::Error;
use sensor::Sensor;

use crate::methods::chance;
use crate::methods::joint::data::Data;
use crate::methods::joint::minimum::{Point, Run};
use crate::methods::joint::result::row_residuals::RowResiduals;

findings::tuning! {
    /// Noise makes what is left of the means so small in fewer cases than this.
    UNLIKELY: f64 = 1e-3;

    /// Fewer degrees of freedom than this say little of a variance: one in five is off by two fifths of it.
    LEAST_FREEDOM: f64 = 20.0;
}

const SENSORS: [Sensor; 2] = [Sensor::Accelerometer, Sensor::Gyroscope];

impl Data {
    /// Returns true if the noise of any sensor is coloured: long means are expected to spread by more than white noise.
    pub(crate) fn is_coloured(&self) -> bool {
        let mut noises = self
            .sources
            .iter()
            .flat_map(|s| SENSORS.map(|k| s.noise(k)));
        noises.any(|noise| noise.is_some_and(|n| n.long_run.max() > 1.0))
    }

    /// Lowers the noise of means to these shares of their variance, for every recording accelerometer and gyroscope.
    pub(crate) fn lower_noise(&mut self, shares: &[[f64; 2]]) {
        for (source, own) in self.sources.iter_mut().zip(shares) {
            let [force, rate] = own;
            for (noise, share) in [
                (&mut source.accelerometer, force),
                (&mut source.gyroscope, rate),
            ] {
                if let Some(noise) = noise {
                    noise.long_run *= share.sqrt();
                }
            }
            source.noise_shares = *own;
        }
    }
}

impl Run<'_> {
    /// For every recording the share of the variance of the means of accelerometer and gyroscope that a fit under the measured
    /// noise leaves, where chance does not make so little; 1 elsewhere. And that fit.
    ///
    /// # Errors
    /// What the solver refuses.
    pub(crate) fn shares_of_noise(
        &self,
        before: Option<&Point>,
    ) -> Result<(Vec<[f64; 2]>, Point), Error> {
        let weights = self.weights_near(before);
        let point = self.approach(&weights, before)?;
        let rows = self.rows(&[]);
        let free = point.mask.free_indices();
        let white = &weights.whitening.white;
        let (residuals, jacobian) = point.linear.whitened_by(&free, white);
        let left = RowResiduals::of(&jacobian, &residuals);
        let mut sums = vec![[(0.0, 0.0); 2]; self.data.sources.len()];
        for (place, sensor) in SENSORS.into_iter().enumerate() {
            for own in rows.means(sensor) {
                let recording = self.data.rests[own.chunk.rest].recording;
                let (square, spare) = &mut sums[recording][place];
                for row in own.row..own.row + 3 {
                    *square += left.square(row);
                    *spare += left.spare(row);
                }
            }
        }
        Ok((sums.into_iter().map(|own| own.map(share)).collect(), point))
    }
}

/// The share of the variance that a sum of squares with so many degrees of freedom shows; 1 where chance may have made it.
fn share((square, freedom): (f64, f64)) -> f64 {
    let below = 1.0 - chance::of_chi2(square, freedom);
    if freedom >= LEAST_FREEDOM.get() && square > 0.0 && below < UNLIKELY.get() {
        square / freedom
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::{Spec, Unsteady};

    use crate::methods::joint::{JointFit, JointRequest, fit_joint};

    fn fit(change: impl Fn(&mut Spec)) -> JointFit {
        let mut spec = Spec::hand_held(2);
        change(&mut spec);
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let recordings = vec![(&recording, &segmentation)];
        fit_joint(&JointRequest::new(recordings, spec.gravity)).unwrap()
    }

    #[test]
    fn a_sway_that_comes_back_is_no_noise_of_means_over_rests() {
        let fit = fit(|spec| {
            spec.unsteady = Some(Unsteady {
                tremor: 5e-3,
                sway: 5e-4,
                share: 1.0,
                ..Unsteady::default()
            });
        });
        let rows = fit.first_rows[1];
        let square: f64 = fit.residuals[..rows].iter().map(|r| r * r).sum();
        // Means less the two directions of every rest and twelve parameters; a standard deviation is a tenth of them.
        let freedom = (rows - 2 * fit.data.rests.len() - 12) as f64;
        assert!(
            (0.6..1.4).contains(&(square / freedom)),
            "{square} of {freedom}"
        );
    }

    #[test]
    fn noise_that_is_correlated_from_sample_to_sample_is_kept() {
        let noise = |k: f64| move |spec: &mut Spec| spec.accelerometer.correlation = k;
        let fit = fit(noise(0.9));
        let measured = fit.data.sources[0].accelerometer.unwrap();
        // White noise of the same density at low frequency has 0.02 m/s² per sample.
        let long = measured.white.component_mul(&measured.long_run);
        assert!(long.min() > 0.015, "{long}");
    }
}
