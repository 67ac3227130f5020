//! A calibration after more data: values, errors and covariance of parameters by their names.

use nalgebra::DMatrix;
use sensor::{PLACES, Sensor, base_names};

use super::{Calibration, Triad};

impl Calibration {
    /// Moves the parameters `names` (all of its own, in order) by `shift` and gives them another covariance.
    pub(crate) fn move_by(&mut self, names: &[String], shift: &[f64], covariance: &DMatrix<f64>) {
        for (k, (name, by)) in names.iter().zip(shift).enumerate() {
            self.move_one(name, *by, covariance[(k, k)].max(0.0).sqrt());
        }
        let row = |i: usize| (0..names.len()).map(|j| covariance[(i, j)]).collect();
        self.covariance = (0..names.len()).map(row).collect();
    }

    fn move_one(&mut self, name: &str, by: f64, std: f64) {
        for sensor in Sensor::ALL {
            let Some(triad) = self.triad_mut(sensor) else {
                continue;
            };
            let (base, recording) = match name.strip_suffix(']').and_then(|n| n.split_once('[')) {
                Some((base, recording)) => (base, Some(recording)),
                None => (name, None),
            };
            if let Some(k) = base_names(sensor).iter().position(|own| own == base) {
                triad.move_one(k, recording, by, std);
                return;
            }
        }
        for effect in &mut self.effects {
            let own = name.strip_prefix(effect.name.as_str());
            let Some(own) = own.and_then(|rest| rest.strip_prefix('.')) else {
                continue;
            };
            if let Some(parameter) = effect.parameters.iter_mut().find(|p| p.name == own) {
                parameter.value += by;
                parameter.std = Some(std);
            }
        }
    }
}

impl Triad {
    /// Moves base parameter `k`: of a recording its own bias, else that of the device and of its last recording.
    fn move_one(&mut self, k: usize, recording: Option<&str>, by: f64, std: f64) {
        if let Some(&(i, j)) = PLACES.get(k) {
            self.t[i][j] += by;
            self.t_std[i][j] = Some(std);
            return;
        }
        let axis = k - PLACES.len();
        let own = match recording {
            Some(name) => self.recordings.iter_mut().find(|r| r.recording == name),
            None => {
                self.bias[axis] += by;
                self.bias_std[axis] = Some(std);
                self.recordings.last_mut()
            }
        };
        if let Some(own) = own {
            own.bias[axis] += by;
            own.bias_std[axis] = Some(std);
        }
    }
}
