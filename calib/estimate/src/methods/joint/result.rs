//! The fit in the unit of the readings, and its figures.

mod allowed_scatter;
pub(crate) mod analysis;
pub(crate) mod apart;
pub(crate) mod channel;
pub(crate) mod influence;
mod known_noise;
pub(crate) mod left_out;
pub(crate) mod marginal;
pub(crate) mod misfit;
pub(crate) mod missing;
mod noise_levels;
pub(crate) mod over_time;
pub(crate) mod prediction;
pub(crate) mod row_residuals;
mod time_constant;

use nalgebra::DMatrix;
use sensor::{BASE_PARAMETERS, Sensor};
use solver::Uncertainty;

use super::fit::JointFit;
use crate::methods::chance;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::noise::weights::{ComponentKind, NoiseLevel};
use crate::methods::joint::result::marginal::marginal;
use crate::methods::joint::result::prediction::Prediction;
use crate::methods::joint::result::row_residuals::RowResiduals;
use crate::methods::small_sample::{LEAST_SPARE, UNREMARKABLE, widening};
use crate::methods::{Fitted, RawUnit};

impl JointFit {
    /// Covariance, rank, condition and unobservable combinations of all models' parameters and biases,
    /// the directions and disturbances projected out; near SI units.
    pub fn shared_uncertainty(&self) -> Uncertainty {
        self.marginal_where(|_| true)
    }

    /// The covariance of the shared parameters if the noise were what the weights say.
    pub(crate) fn covariance_of_weights(&self) -> Vec<Vec<f64>> {
        let count = self.reduced.ncols();
        let places: Vec<usize> = (0..count).collect();
        let nothing = Columns::none(self.reduced.groups());
        let names = vec![String::new(); count];
        marginal(&self.reduced, &places, names, (&nothing, &nothing)).covariance
    }

    /// The same for some of them, everything else free.
    fn marginal_where(&self, wanted: impl Fn(&str) -> bool) -> Uncertainty {
        let names = self.parameters.names();
        let shared = (0..self.free.len()).filter(|&k| self.free[k] < self.shared);
        let (places, keep): (Vec<usize>, Vec<usize>) = shared
            .enumerate()
            .filter(|(_, k)| wanted(&names[self.free[*k]]))
            .unzip();
        let kept = keep.iter().map(|&k| names[self.free[k]].clone()).collect();
        let errors = (&self.carried, &self.of_place);
        let mut uncertainty = marginal(&self.reduced, &places, kept, errors);
        let widening = [Sensor::Accelerometer, Sensor::Gyroscope].map(|s| self.widening(s));
        let beyond_linear = self.beyond_linear(&keep);
        let of = |k: usize| {
            let gyroscope = self.of_gyroscope(self.free[keep[k]]);
            let own = beyond_linear.iter().find(|(column, _)| *column == keep[k]);
            widening[usize::from(gyroscope)] * own.map_or(1.0, |(_, factor)| *factor)
        };
        for (i, row) in uncertainty.covariance.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry *= of(i) * of(k);
            }
        }
        uncertainty
    }

    /// Factor on the standard errors of a sensor whose noise was taken from few residuals (Student's t); 1 where it was
    /// measured.
    fn widening(&self, sensor: Sensor) -> f64 {
        let found = |kinds: &[ComponentKind]| {
            let own = |l: &NoiseLevel| l.size > 0.0 && kinds.contains(&l.kind);
            self.levels.iter().any(own)
        };
        let rests = self.data.rests.len();
        match sensor {
            Sensor::Accelerometer => {
                let kinds = [
                    ComponentKind::ForceScatter,
                    ComponentKind::ForceOfOrientation,
                ];
                let spare = rests.saturating_sub(BASE_PARAMETERS - 3);
                let known = spare >= LEAST_SPARE.get() || self.white_noise_explains_force();
                if found(&kinds) || !known {
                    widening(spare.max(1))
                } else {
                    1.0
                }
            }
            Sensor::Gyroscope | Sensor::Magnetometer => {
                let spare = (2 * self.chords.len()).saturating_sub(BASE_PARAMETERS - 3);
                let turns = found(&[ComponentKind::TurnScatter]);
                let kinds = [ComponentKind::RateScatter, ComponentKind::RateOfOrientation];
                if turns {
                    widening(spare.max(1))
                } else if found(&kinds) {
                    widening((3 * rests).saturating_sub(3).max(1))
                } else {
                    1.0
                }
            }
        }
    }

    /// Returns true if the white noise measured within the static intervals explains the residuals of the
    /// accelerometer's means.
    ///
    /// Where it does not, the fit has another component of noise that does. Without spare placements an effect that the
    /// model lacks leaves residuals as small, and cannot be seen.
    fn white_noise_explains_force(&self) -> bool {
        let left = RowResiduals::of(&self.white_jacobian, &self.white_residuals);
        let rows = 0..self.first_rows[0];
        let square: f64 = rows.clone().map(|i| left.square(i)).sum();
        chance::of_chi2(square, rows.map(|i| left.spare(i)).sum()) > UNREMARKABLE.get()
    }

    /// Returns true if the shared parameter `k` is one of the gyroscope's.
    fn of_gyroscope(&self, k: usize) -> bool {
        let (_, first, count) = self.of_sensor(Sensor::Gyroscope);
        (first..first + count).contains(&k)
            || self.parameters.names()[k].starts_with(Sensor::Gyroscope.prefix())
    }

    /// Returns the unit that brings the readings of a sensor near SI units.
    pub fn unit(&self, sensor: Sensor) -> RawUnit {
        self.of_sensor(sensor).0
    }

    /// The unit and the number of parameters of a sensor, and where they begin.
    fn of_sensor(&self, sensor: Sensor) -> (RawUnit, usize, usize) {
        let accelerometer = self.models[0].parameter_count();
        match sensor {
            Sensor::Accelerometer => (self.force_unit, 0, accelerometer),
            Sensor::Gyroscope | Sensor::Magnetometer => {
                let count = self.models[1].parameter_count();
                (self.rate_unit, accelerometer, count)
            }
        }
    }

    /// Returns true if the gyroscope was part of the fit.
    pub fn has_gyroscope(&self) -> bool {
        self.first_rows[0] < self.first_rows[1]
    }

    /// One sensor in raw units: its model's parameters, then the biases of earlier recordings.
    pub fn fitted(&self, sensor: Sensor) -> Fitted {
        let prefix = format!("{}.", sensor.prefix());
        let (_, first, count) = self.of_sensor(sensor);
        let effects: Vec<String> = self.parameters.names()[first..first + count].to_vec();
        self.fitted_where(|name| name.starts_with(&prefix) || effects.iter().any(|e| e == name))
    }

    /// Both sensors in raw units, with the covariance between them.
    pub fn all_fitted(&self) -> Fitted {
        self.fitted_where(|_| true)
    }

    /// Those of the shared parameters that are `wanted`, in raw units, everything else free.
    pub fn fitted_where(&self, wanted: impl Fn(&str) -> bool) -> Fitted {
        let uncertainty = self.marginal_where(&wanted);
        let mut parameters = solver::Parameters::new();
        let mut factors = Vec::new();
        for k in 0..self.shared {
            let name = &self.parameters.names()[k];
            if !wanted(name) {
                continue;
            }
            let (unit, place) = self.unit_of(k);
            let value = self.parameters.values()[k] * unit.factor(place) + unit.offset(place);
            parameters.push(name.clone(), self.parameters.units()[k].clone(), value);
            if self.free.contains(&k) {
                factors.push(unit.factor(place));
            }
        }
        let covariance = uncertainty
            .covariance
            .iter()
            .zip(&factors)
            .map(|(row, a)| row.iter().zip(&factors).map(|(v, b)| v * a * b).collect())
            .collect();
        Fitted {
            parameters,
            free: uncertainty.names,
            covariance,
            rank: uncertainty.rank,
            condition: uncertainty.condition,
            unobservable: uncertainty.unobservable,
        }
    }

    /// Unit of a shared parameter and its place among those of its model.
    pub fn unit_of(&self, k: usize) -> (RawUnit, usize) {
        let (force, rate) = (
            self.of_sensor(Sensor::Accelerometer),
            self.of_sensor(Sensor::Gyroscope),
        );
        let gyroscope = if self.has_gyroscope() { rate.2 } else { 0 };
        if k < force.2 {
            (self.force_unit, k)
        } else if k < force.2 + gyroscope {
            (self.rate_unit, k - force.2)
        } else {
            let own = k - force.2 - gyroscope;
            let force_biases = if self.own_force_bias { 3 } else { 0 };
            let per_recording = force_biases + if gyroscope > 0 { 3 } else { 0 };
            let unit = if own % per_recording < force_biases {
                self.force_unit
            } else {
                self.rate_unit
            };
            (unit, 9 + own % 3)
        }
    }

    /// Returns the sensor's model with the covariance of its parameters, near SI units: it predicts the errors of
    /// corrected readings.
    pub fn prediction(&self, sensor: Sensor) -> Prediction {
        let (_, first, count) = self.of_sensor(sensor);
        let uncertainty = self.shared_uncertainty();
        let model = &self.models[usize::from(sensor == Sensor::Gyroscope)];
        let places: Vec<Option<usize>> = (first..first + count)
            .map(|k| self.free.iter().position(|&f| f == k))
            .collect();
        Prediction {
            model: model.clone(),
            parameters: self.parameters.values()[first..first + count].to_vec(),
            covariance: DMatrix::from_fn(
                count.max(BASE_PARAMETERS),
                count.max(BASE_PARAMETERS),
                |i, j| match (
                    places.get(i).copied().flatten(),
                    places.get(j).copied().flatten(),
                ) {
                    (Some(a), Some(b)) => uncertainty.covariance[a][b],
                    _ => 0.0,
                },
            ),
        }
    }
}
