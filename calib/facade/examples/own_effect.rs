//! An effect of another crate: calibrated, written, read again, applied.
//! `cargo run -p stillpoint-imu --example own_effect`

use std::sync::Arc;

use stillpoint::effect::{AnyEffect, Effect, Kinematics, Param, Scalar, Sensor, Vector3, params};
use stillpoint::{
    Calibration, Catalogue, Error, Method, Recording, Request, apply, calibrate, example,
};

/// Specific force along x leaks into every axis of the rate.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `k` | leakage | (rad/s)/(m/s²) | 3 |
/// | `f_x` | specific force along x | m/s² | 1 |
struct Tug;

impl Effect for Tug {
    const NAME: &'static str = "gyro_tug";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i f_x";
    const PARAMS: &'static [Param] = &params("(rad/s)/(m/s²)", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-4;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::new(p[0], p[1], p[2]) * truth.specific_force.x
    }
}

fn main() -> Result<(), Error> {
    let effect: Arc<dyn AnyEffect> = Arc::new(Tug);
    let catalogue = Catalogue::default().with(effect)?;
    let (t, accel, gyro, _) = example::session();
    let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
    let request = Request {
        method: Method::Joint,
        effects: vec!["gyro_tug".into()],
        catalogue: catalogue.clone(),
        ..Request::default()
    };
    let calibration = calibrate(std::slice::from_ref(&recording), &request)?;
    for p in calibration.parameters().iter().skip(24) {
        println!(
            "{} = {:.2e} ± {:.0e} {}",
            p.name,
            p.value,
            p.std.unwrap_or(0.0),
            p.unit
        );
    }
    let again = Calibration::from_json(&calibration.to_json()?, &catalogue)?;
    let rows = |c: &Calibration| -> Result<Vec<[f64; 3]>, Error> {
        Ok(apply(c, &recording)?.values(Sensor::Gyroscope).collect())
    };
    let same = rows(&calibration)? == rows(&again)?;
    println!("read again it corrects the same: {same}");
    Ok(())
}
