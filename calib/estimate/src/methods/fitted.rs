//! A fit carried back to the unit of the readings.

use sensor::BASE_PARAMETERS;
use solver::{Parameters, Report};

use crate::truth::RawUnit;

/// Parameters with their covariance, raw units.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// All parameters: those of the model, then the biases of earlier recordings.
    pub parameters: Parameters,
    /// Names of the free ones, in the order of the covariance.
    pub free: Vec<String>,
    /// Covariance of the free parameters, scaled to the scatter of the residuals.
    pub covariance: Vec<Vec<f64>>,
    /// Rank of the Jacobian.
    pub rank: usize,
    /// Its condition number, with unit columns.
    pub condition: f64,
    /// Combinations of parameters that the data cannot see.
    pub unobservable: Vec<String>,
}

impl Fitted {
    /// Carries a report on readings near SI back to raw units; `sigma` is the standard deviation of
    /// one of its residuals, `shared` the number of parameters of the model.
    pub fn in_raw_units(report: &Report, unit: &RawUnit, shared: usize, sigma: f64) -> Self {
        let near_si = &report.parameters;
        let place = |k: usize| if k < shared { k } else { 9 + (k - shared) % 3 };
        let mut parameters = near_si.clone();
        for (k, value) in parameters.values_mut().iter_mut().enumerate() {
            *value = *value * unit.factor(place(k)) + unit.offset(place(k));
        }
        let free = report.uncertainty.names.clone();
        let factors: Vec<f64> = free
            .iter()
            .map(|name| near_si.index(name).map_or(1.0, |k| unit.factor(place(k))))
            .collect();
        let covariance = report
            .uncertainty
            .covariance
            .iter()
            .zip(&factors)
            .map(|(row, a)| {
                row.iter()
                    .zip(&factors)
                    .map(|(v, b)| v * a * b * sigma * sigma)
                    .collect()
            })
            .collect();
        Self {
            parameters,
            free,
            covariance,
            rank: report.uncertainty.rank,
            condition: report.uncertainty.condition,
            unobservable: report.uncertainty.unobservable.clone(),
        }
    }

    /// Standard error of the parameter called `name`; `None` where it was held fixed.
    pub fn standard_error(&self, name: &str) -> Option<f64> {
        let k = self.free.iter().position(|free| free == name)?;
        Some(self.covariance[k][k].max(0.0).sqrt())
    }

    /// The model's parameters for recording `k` of several, of which all but the last may have a
    /// bias of their own behind the `shared` parameters of the model.
    pub fn local(&self, shared: usize, k: usize) -> Vec<f64> {
        let values = self.parameters.values();
        let mut local = values[..shared].to_vec();
        if let Some(bias) = values.get(shared + 3 * k..shared + 3 * k + 3) {
            local[9..BASE_PARAMETERS].copy_from_slice(bias);
        }
        local
    }
}
