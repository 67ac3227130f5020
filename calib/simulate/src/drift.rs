//! Mean of the drifting bias during each placement.

use nalgebra::Vector3;
use sensor::Sensor;

/// Means of the drift over the placements, collected while the samples go by.
#[derive(Clone, Debug)]
pub(crate) struct DriftMeans {
    rests: Vec<(f64, f64)>,
    sums: [Vec<(Vector3<f64>, f64)>; 3],
    at: [usize; 3],
}

impl DriftMeans {
    /// For placements from and to these times, ascending, s.
    pub fn new(rests: Vec<(f64, f64)>) -> Self {
        let empty = vec![(Vector3::zeros(), 0.0); rests.len()];
        Self {
            rests,
            sums: [empty.clone(), empty.clone(), empty],
            at: [0; 3],
        }
    }

    /// Adds the drift in the next sample of `sensor`, taken at `true_time`, s.
    pub fn add(&mut self, sensor: Sensor, true_time: f64, drift: &Vector3<f64>) {
        let which = sensor as usize;
        while let Some(&(start, end)) = self.rests.get(self.at[which]) {
            if true_time < end {
                if true_time >= start {
                    let (sum, count) = &mut self.sums[which][self.at[which]];
                    *sum += drift;
                    *count += 1.0;
                }
                return;
            }
            self.at[which] += 1;
        }
    }

    /// Mean over placement `k`; zero where it has no samples.
    pub fn mean(&self, sensor: Sensor, k: usize) -> Vector3<f64> {
        let (sum, count) = self.sums[sensor as usize][k];
        sum / f64::max(count, 1.0)
    }
}
