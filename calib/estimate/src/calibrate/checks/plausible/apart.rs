//! The base of a sensor as a fit has it.

use nalgebra::Matrix3;
use recording::Recording;
use sensor::{Base, Sensor, base_names};

use crate::methods::{Fitted, RawUnit};

/// An accelerometer as a fit has it.
pub(in crate::calibrate) struct ForceFit<'a> {
    pub base: Base<f64>,
    /// Standard errors of the diagonal of `T`.
    pub std: [Option<f64>; 3],
    pub unit: RawUnit,
    /// Local gravity, m/s².
    pub gravity: f64,
    pub recordings: &'a [&'a Recording],
}

/// A gyroscope as a fit has it.
pub(in crate::calibrate) struct RateFit<'a> {
    pub base: Base<f64>,
    /// Standard errors of the diagonal of `T`.
    pub std: [Option<f64>; 3],
    /// SI units per raw unit.
    pub scale: f64,
    /// By how much the turns miss gravity after the fit, rad.
    pub missed: f64,
    /// True where the accelerometer reads m/s².
    pub force_is_si: bool,
    pub recordings: &'a [&'a Recording],
}

impl<'a> ForceFit<'a> {
    /// Builds it from a fit in `unit`, under the local gravity, m/s².
    pub fn of(
        fitted: &Fitted,
        unit: RawUnit,
        gravity: f64,
        recordings: &'a [&'a Recording],
    ) -> Self {
        Self {
            base: Base::from_parameters(fitted.parameters.values()),
            std: diagonal_std(fitted, Sensor::Accelerometer),
            unit,
            gravity,
            recordings,
        }
    }
}

impl<'a> RateFit<'a> {
    /// Builds it from a fit in `unit` that misses gravity by `missed`, rad, beside an accelerometer in `force_unit`.
    pub fn of(
        fitted: &Fitted,
        unit: &RawUnit,
        missed: f64,
        force_unit: &RawUnit,
        recordings: &'a [&'a Recording],
    ) -> Self {
        Self {
            base: Base::from_parameters(fitted.parameters.values()),
            std: diagonal_std(fitted, Sensor::Gyroscope),
            scale: unit.scale,
            missed,
            force_is_si: force_unit.is_si(),
            recordings,
        }
    }

    /// `T` of readings near SI units.
    pub(super) fn near_si(&self) -> Matrix3<f64> {
        self.base.t / self.scale
    }
}

/// Standard errors of the diagonal of `T`.
fn diagonal_std(fitted: &Fitted, sensor: Sensor) -> [Option<f64>; 3] {
    let names = base_names(sensor);
    [0, 1, 2].map(|k| fitted.standard_error(&names[k]))
}
