//! Part of a calibration that the form of a target holds.

use nalgebra::Matrix3;
use sensor::Base;

use crate::source::{Source, diagonal};

/// Corrections that the tool of a target applies to a reading, in the frame of the calibration.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// `f = T (A − b)` of the accelerometer, if it is corrected.
    pub accelerometer: Option<Base<f64>>,
    /// `w = T (W − b)` of the gyroscope.
    pub gyroscope: Option<Base<f64>>,
    /// `m = T (M − b)` of the magnetometer.
    pub magnetometer: Option<Base<f64>>,
    /// True if the form subtracts the g-sensitivity `G f` from the rate.
    pub g_sensitivity: bool,
    /// True if the form holds the effects that are formulas of one instant.
    pub formulas: bool,
    /// True if the form holds every effect of the calibration.
    pub effects: bool,
    /// True if the form holds standard errors and covariance.
    pub errors: bool,
}

impl Kept {
    /// Accelerometer and gyroscope in full.
    pub fn base_of(source: &Source<'_>) -> Self {
        Self {
            accelerometer: source.accelerometer,
            gyroscope: source.gyroscope,
            ..Self::default()
        }
    }

    /// Offsets of both sensors and the accelerometer's scale factors: flight controllers.
    pub fn offsets_and_scales_of(source: &Source<'_>) -> Self {
        let offset_and_scale = |base: &Base<f64>| Base {
            t: diagonal(&base.t),
            bias: base.bias,
        };
        let offset_alone = |base: &Base<f64>| Base {
            t: Matrix3::identity(),
            bias: base.bias,
        };
        Self {
            accelerometer: source.accelerometer.as_ref().map(offset_and_scale),
            gyroscope: source.gyroscope.as_ref().map(offset_alone),
            ..Self::default()
        }
    }

    /// All sensors in full.
    pub fn sensors_of(source: &Source<'_>) -> Self {
        Self {
            magnetometer: source.magnetometer,
            ..Self::base_of(source)
        }
    }

    /// Everything.
    pub fn all_of(source: &Source<'_>) -> Self {
        Self {
            g_sensitivity: true,
            effects: true,
            errors: true,
            ..Self::sensors_of(source)
        }
    }
}
