//! Standard errors that an effect left out would enlarge.

use super::effect::LeftOut;
use crate::calibration::Calibration;

/// A standard error as stated, and the root mean square of the error if the sensor has an effect that the model leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct Enlarged<'a> {
    /// The effect and the parameter.
    pub by: &'a LeftOut,
    /// Stated standard error.
    pub std_error: f64,
    /// If the sensor has the effect.
    pub std_error_with: f64,
}

impl Enlarged<'_> {
    /// Returns the factor by which the effect would enlarge the error.
    pub fn ratio(&self) -> f64 {
        self.std_error_with / self.std_error
    }
}

impl Calibration {
    /// The standard errors that an effect left out would enlarge by more than `ratio`, the worst first.
    pub fn enlarged_by_more_than(&self, ratio: f64) -> Vec<Enlarged<'_>> {
        let known = self.left_out.iter();
        let known = known.filter_map(|by| Some((by, self.standard_error_of(&by.parameter)?)));
        let each = known.map(|(by, std_error)| Enlarged {
            by,
            std_error,
            std_error_with: std_error.hypot(by.std_added),
        });
        let mut all: Vec<Enlarged<'_>> = each.collect();
        all.retain(|own| own.ratio() > ratio);
        all.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
        all
    }

    /// The stated standard error of a parameter.
    pub(crate) fn standard_error_of(&self, parameter: &str) -> Option<f64> {
        let k = self.parameters.iter().position(|p| p == parameter)?;
        Some(self.covariance.get(k)?.get(k)?.max(0.0).sqrt())
    }
}
