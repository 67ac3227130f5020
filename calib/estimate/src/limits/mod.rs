//! Limits of a calibration: a line per limit with its value, pass or fail.
//!
//! ```text
//! Limits (a TOML file, or built in) ──► judge(calibration) ──► Vec<LimitLine> ──► cal.json `limits`
//! ```
//!
//! ```toml
//! required = ["accelerometer", "gyroscope"]
//!
//! [accelerometer]
//! residual_mm_s2 = 5.0       # root mean square of |f| − g at static intervals
//! reduced_chi2 = 9.0
//! scale = 1e-3               # largest standard error of a scale factor, relative
//! misalignment = 1e-3        # of a misalignment, rad
//! bias = 0.01                # of a bias, m/s²
//! intervals = 12             # static intervals, at least
//!
//! [gyroscope]                # residual_deg, reduced_chi2, scale, misalignment, bias (rad/s), intervals (turns)
//! residual_deg = 0.5
//!
//! [effects]
//! gyro_g_sensitivity = 1e-4  # largest parameter, in the unit of the effect
//!
//! [standard_errors]
//! "accel.s_x" = 5e-4
//!
//! [values]
//! "gyro.b_z" = [-0.02, 0.02] # least and greatest
//! ```

mod built_in;
mod file;
mod judge;
mod line;
mod quantity;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use built_in::{
    LARGEST_ANGLE, LARGEST_RESIDUAL, LARGEST_UNEXPLAINED_ANGLE, LARGEST_UNEXPLAINED_RESIDUAL,
    built_in,
};
pub use file::{parse_limits, read_limits};
pub use judge::{Residuals, judge, judge_on};
pub use line::{Bound, Limit, LimitLine, not_kept};
pub use quantity::parameter;

/// Limits, as a file says them; what is left out has none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Sensors that must be calibrated.
    pub required: Vec<RequiredSensor>,
    /// Limits of the accelerometer.
    pub accelerometer: ForceLimits,
    /// Limits of the gyroscope.
    pub gyroscope: RateLimits,
    /// Largest magnitude of any parameter of an effect, in its unit.
    pub effects: BTreeMap<String, f64>,
    /// Largest standard error of a parameter by its name in `parameters`, in its unit.
    pub standard_errors: BTreeMap<String, f64>,
    /// Least and greatest value of a parameter by its name, in its unit.
    pub values: BTreeMap<String, [f64; 2]>,
}

/// A sensor that must be calibrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RequiredSensor {
    /// The accelerometer.
    Accelerometer,
    /// The gyroscope.
    Gyroscope,
}

/// Limits of an accelerometer's calibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ForceLimits {
    /// Largest root mean square of `|f| − g` at static intervals, mm/s².
    pub residual_mm_s2: Option<f64>,
    /// Largest `χ²` per degree of freedom against the noise within the intervals.
    pub reduced_chi2: Option<f64>,
    /// Largest standard error of a scale factor, relative.
    pub scale: Option<f64>,
    /// Largest standard error of a misalignment, rad.
    pub misalignment: Option<f64>,
    /// Largest standard error of a bias, m/s².
    pub bias: Option<f64>,
    /// Fewest static intervals.
    pub intervals: Option<f64>,
}

/// Limits of a gyroscope's calibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RateLimits {
    /// Largest root mean square angle by which gravity is missed through turns, °.
    pub residual_deg: Option<f64>,
    /// Largest `χ²` per degree of freedom against the noise within the intervals.
    pub reduced_chi2: Option<f64>,
    /// Largest standard error of a scale factor, relative.
    pub scale: Option<f64>,
    /// Largest standard error of a misalignment, rad.
    pub misalignment: Option<f64>,
    /// Largest standard error of a bias, rad/s.
    pub bias: Option<f64>,
    /// Fewest turns.
    pub intervals: Option<f64>,
}
