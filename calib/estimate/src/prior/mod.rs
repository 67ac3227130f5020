//! Prior distribution of the parameters of a device type, and its use in a calibration.
//!
//! A device's parameters are drawn from its type, `θ ~ N(μ, Σ)`; a session sees them with its own error, `y = θ + e`,
//! `e ~ N(0, C)`. The session's information and that of the type add up:
//!
//! ```text
//! θ⁺ = y + C Sᵀ (S C Sᵀ + Σ)⁻¹ (μ − S y)        S picks the parameters that the type knows
//! C⁺ = C − C Sᵀ (S C Sᵀ + Σ)⁻¹ S C
//! ```
//!
//! `Σ` is widened by what is not known of it, as it is estimated from a number of devices. A device that is not of the type is told by
//! `μ − S y` against `S C Sᵀ + Σ`, with the errors of `μ` and `Σ`, and left as its session found it.

mod belonging;
mod inform;

pub use belonging::{Belonging, EstimatedType, belonging};

use std::path::Path;

use findings::{Finding, Kind};
use nalgebra::DMatrix;
use recording::Error;
use recording::shown::{shown, shown_path};
use serde::{Deserialize, Serialize};

use crate::unreadable::of_json;

/// Schema of prior.json.
pub const PRIOR_SCHEMA: &str = "stillpoint.prior/1";

/// The distribution of a type's parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prior {
    /// [`PRIOR_SCHEMA`].
    pub schema: String,
    /// Program and version.
    pub created_by: String,
    /// Devices that it was estimated from.
    pub devices: usize,
    /// Devices that were left out as not of the type.
    pub outsiders: Vec<String>,
    /// Devices without a calibration or without all parameters.
    pub without: usize,
    /// Effects among the parameters: calibrations with this prior fit them.
    pub effects: Vec<String>,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// `μ`.
    pub mean: Vec<f64>,
    /// `Σ`: the spread from device to device, measurement errors taken off.
    pub covariance: Vec<Vec<f64>>,
    /// Covariance of the error of `μ`.
    pub mean_covariance: Vec<Vec<f64>>,
}

/// Contribution of the prior to a calibration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PriorUse {
    /// Devices that the prior was estimated from.
    pub devices: usize,
    /// True if the device belongs to the type; if not the prior was not used.
    pub belongs: bool,
    /// Chance of a device of the type being so far from its mean; that mean and spread are estimated counts.
    pub p_value: f64,
    /// The parameter that is furthest, and by how many standard deviations of type and session.
    pub furthest: Option<(String, f64)>,
    /// Parameter by parameter.
    pub parameters: Vec<PriorShare>,
}

/// Estimates of one parameter by prior and session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PriorShare {
    /// Name.
    pub name: String,
    /// Mean of the type.
    pub prior: f64,
    /// Spread of the type.
    pub prior_std: f64,
    /// Estimate of the session alone.
    pub data: f64,
    /// Its standard error.
    pub data_std: f64,
    /// Both together.
    pub value: f64,
    /// Its standard error.
    pub std: f64,
    /// Share of the information that the prior gave: 0 nothing, 1 everything.
    pub by_prior: f64,
}

/// The finding about a file of another kind.
fn other_schema(found: &str) -> Finding {
    Finding::of(Kind::ENTRY_OTHER)
        .detail("key", "schema")
        .detail("found", shown(found))
        .detail("expected", PRIOR_SCHEMA)
}

impl Prior {
    /// The prior of the file at `path`.
    ///
    /// # Errors
    /// [`Error::Io`], or [`Error::Input`] for what is no prior or has a covariance that is none.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = recording::read_text(path)?;
        let of_file = |found: Finding| Error::input(found.in_file(shown_path(path)));
        let whole: serde_json::Value =
            serde_json::from_str(&text).map_err(|e| of_file(of_json(Kind::NOT_JSON, &e)))?;
        let schema = whole.get("schema").and_then(|schema| schema.as_str());
        if schema != Some(PRIOR_SCHEMA) {
            return Err(of_file(other_schema(schema.unwrap_or("no schema"))));
        }
        // The text has lines and columns.
        let prior: Self =
            serde_json::from_str(&text).map_err(|e| of_file(of_json(Kind::UNREADABLE, &e)))?;
        match prior.fault() {
            None => Ok(prior),
            Some(found) => Err(of_file(found)),
        }
    }

    fn fault(&self) -> Option<Finding> {
        let n = self.parameters.len();
        let square = |m: &[Vec<f64>]| m.len() == n && m.iter().all(|row| row.len() == n);
        let fits =
            self.mean.len() == n && square(&self.covariance) && square(&self.mean_covariance);
        let numbers = self.mean.iter().chain(self.covariance.iter().flatten());
        let is_usable = fits && numbers.clone().all(|v| v.is_finite());
        (!is_usable).then(|| Finding::of(Kind::PRIOR_UNUSABLE).count("count", n))
    }

    /// Covariance of a further device: `Σ` and the error of `μ`.
    pub fn spread(&self) -> DMatrix<f64> {
        let n = self.parameters.len();
        DMatrix::from_fn(n, n, |i, j| {
            self.covariance[i][j] + self.mean_covariance[i][j]
        })
    }
}
