//! Values and covariance of all parameters of a calibration, by their names.

use nalgebra::{DMatrix, DVector};
use sensor::{PLACES, Sensor, base_names};

use super::{Calibration, Triad};
use crate::limits::parameter;

impl Calibration {
    /// The values of all parameters in the order of the covariance, biases of single recordings among them.
    pub(crate) fn parameter_values(&self) -> DVector<f64> {
        let value = |name: &String| {
            let own = self.bias_of_the_last(name);
            let own = own.or_else(|| Some(parameter(self, name)?.0));
            own.or_else(|| self.bias_of_recording(name)).unwrap_or(0.0)
        };
        DVector::from_iterator(self.parameters.len(), self.parameters.iter().map(value))
    }

    /// The covariance of all parameters.
    pub(crate) fn covariance_matrix(&self) -> DMatrix<f64> {
        let n = self.covariance.len();
        DMatrix::from_fn(n, n, |i, j| self.covariance[i][j])
    }

    /// Writes values and covariance into every place that has them.
    pub(crate) fn write_parameters(&mut self, values: &DVector<f64>, covariance: &DMatrix<f64>) {
        let n = values.len();
        for (k, name) in self.parameters.clone().iter().enumerate() {
            self.set(name, values[k], covariance[(k, k)].max(0.0).sqrt());
        }
        let row = |i: usize| (0..n).map(|j| covariance[(i, j)]).collect();
        self.covariance = (0..n).map(row).collect();
        for sensor in Sensor::ALL {
            if let Some(triad) = self
                .triad_mut(sensor)
                .filter(|own| !own.recordings.is_empty())
            {
                let recordings = std::mem::take(&mut triad.recordings);
                triad.state_biases(recordings);
            }
        }
    }

    /// The bias of the last of several recordings, which has the name of the sensor's own.
    fn bias_of_the_last(&self, name: &str) -> Option<f64> {
        let (sensor, axis) = axis_of_bias(name)?;
        Some(self.triad(sensor)?.recordings.last()?.bias[axis])
    }

    fn bias_of_recording(&self, name: &str) -> Option<f64> {
        let (sensor, axis, recording) = own_bias(name)?;
        let mut own = self.triad(sensor)?.recordings.iter();
        Some(own.find(|r| r.recording == recording)?.bias[axis])
    }

    fn set(&mut self, name: &str, value: f64, std: f64) {
        for sensor in Sensor::ALL {
            let place = base_names(sensor).iter().position(|own| own == name);
            let own = own_bias(name).filter(|(of, ..)| *of == sensor);
            let Some(triad) = self.triad_mut(sensor) else {
                continue;
            };
            if let Some(k) = place {
                triad.set(k, value, std);
            } else if let Some((_, axis, recording)) = own
                && let Some(own) = triad
                    .recordings
                    .iter_mut()
                    .find(|r| r.recording == recording)
            {
                (own.bias[axis], own.bias_std[axis]) = (value, Some(std));
            }
        }
        let Some((effect, parameter)) = name.split_once('.') else {
            return;
        };
        let effects = self.effects.iter_mut().filter(|e| e.name == effect);
        for found in effects
            .flat_map(|e| &mut e.parameters)
            .filter(|p| p.name == parameter)
        {
            (found.value, found.std) = (value, Some(std));
        }
    }
}

impl Triad {
    /// Sets base parameter `k`.
    fn set(&mut self, k: usize, value: f64, std: f64) {
        match PLACES.get(k) {
            Some(&(i, j)) => (self.t[i][j], self.t_std[i][j]) = (value, Some(std)),
            None => {
                let axis = k - PLACES.len();
                (self.bias[axis], self.bias_std[axis]) = (value, Some(std));
                // Without a name of its own the last recording's bias is the device's.
                if let Some(last) = self.recordings.last_mut() {
                    (last.bias[axis], last.bias_std[axis]) = (value, Some(std));
                }
            }
        }
    }
}

/// `accel.b_x[evening]` taken apart: sensor, axis, recording.
fn own_bias(name: &str) -> Option<(Sensor, usize, &str)> {
    let (base, recording) = name.split_once('[')?;
    let recording = recording.strip_suffix(']')?;
    let (sensor, axis) = axis_of_bias(base)?;
    Some((sensor, axis, recording))
}

/// `accel.b_x` taken apart: sensor and axis; `None` of any other parameter.
fn axis_of_bias(name: &str) -> Option<(Sensor, usize)> {
    Sensor::ALL.into_iter().find_map(|sensor| {
        let k = base_names(sensor).iter().position(|own| own == name)?;
        Some((sensor, k.checked_sub(PLACES.len())?))
    })
}
