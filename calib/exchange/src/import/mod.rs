//! Calibrations of other tools as ours, so that `evaluate` and `apply` take them.

mod imu_tk;
mod kalibr;
mod yaml;

pub use imu_tk::imu_tk;
pub use kalibr::kalibr;

use calib::Calibration;
use calib::calibrate::STANDARD_GRAVITY;
use calib::calibration::{EffectParameter, EffectValues, Provenance, SCHEMA, Triad};
use calib::effects::force_sensitivity;
use calib::gravity::GravitySource;
use findings::Findings;
use nalgebra::Matrix3;
use sensor::{Base, Sensor};

use crate::source::rows;

/// A calibration without errors, of another tool.
fn calibration(
    tool: &str,
    accelerometer: Option<&Base<f64>>,
    gyroscope: Option<&Base<f64>>,
    g_sensitivity: Option<&Matrix3<f64>>,
    warnings: Findings,
) -> Calibration {
    let effects = g_sensitivity.filter(|g| g.amax() > 0.0);
    let mut calibration = Calibration {
        schema: SCHEMA.into(),
        created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION"), " import").into(),
        gravity: STANDARD_GRAVITY,
        // The files do not say it.
        gravity_source: GravitySource::Assumed,
        method: tool.into(),
        accelerometer: accelerometer.map(|base| triad(Sensor::Accelerometer, base)),
        gyroscope: gyroscope.map(|base| triad(Sensor::Gyroscope, base)),
        magnetometer: None,
        magnetic_field: None,
        scalars: Vec::new(),
        not_calibrated: Vec::new(),
        effects: effects.map(of_g_sensitivity).into_iter().collect(),
        parameters: Vec::new(),
        covariance: Vec::new(),
        misfit: Vec::new(),
        left_out: Vec::new(),
        warnings,
        failed_gates: Findings::new(),
        limits: Vec::new(),
        prior: None,
        clocks: Vec::new(),
        history: Vec::new(),
        next: None,
        provenance: Provenance::of(Vec::new(), None),
    };
    calibration.state_units();
    calibration.seal();
    calibration
}

/// A triad without a fit, so without a rank or a condition.
fn triad(sensor: Sensor, base: &Base<f64>) -> Triad {
    Triad {
        condition: 0.0,
        ..Triad::of(sensor, base)
    }
}

fn of_g_sensitivity(g: &Matrix3<f64>) -> EffectValues {
    let effect = force_sensitivity();
    let params = effect.params();
    let parameters = params
        .iter()
        .zip(rows(g))
        .map(|(param, value)| EffectParameter {
            name: param.name.to_string(),
            value,
            std: None,
            unit: param.unit.to_string(),
        });
    EffectValues {
        name: effect.name().into(),
        definition: None,
        parameters: parameters.collect(),
        outside: None,
    }
}
