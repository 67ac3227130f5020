//! A sensor of one dimension that the program does not know: calibrated beside the others, written, read again, applied.
//! `cargo run -p stillpoint-imu --example barometer`

use std::sync::Arc;

use stillpoint::effect::{Kinematics, Param, Quantity, Scalar};
use stillpoint::{Calibration, Catalogue, Error, Recording, Request, ScalarSensor};
use stillpoint::{Sensor, apply, calibrate, example};

/// A barometer with a zero that goes with the temperature and with the force on its membrane: `P = p + b + c dT + k f_z`.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | `P`, `p` | pressure read, true pressure | Pa |
/// | `b` | zero | Pa |
/// | `c` | its change with the temperature over 25 °C, `dT` | Pa/K |
/// | `k` | its change with the specific force along z, `f_z` | Pa/(m/s²) |
struct Barometer;

impl ScalarSensor for Barometer {
    const NAME: &'static str = "barometer";
    const UNIT: &'static str = "Pa";
    const EQUATION: &'static str = "P = p + b + c dT + k f_z";
    const PARAMS: &'static [Param] = &[
        Param::new("b", "Pa", 0.0),
        Param::new("c", "Pa/K", 0.0),
        Param::new("k", "Pa/(m/s^2)", 0.0),
    ];
    const NEEDS: &'static [Quantity] = &[Quantity::SpecificForce, Quantity::Temperature];

    fn reading<D: Scalar>(&self, signal: D, truth: &Kinematics<f64>, p: &[D]) -> D {
        signal + p[0] + p[1] * (truth.temperature - 25.0) + p[2] * truth.specific_force.z
    }
}

fn main() -> Result<(), Error> {
    let catalogue = Catalogue::default().with_sensor(Arc::new(Barometer))?;
    let (t, accel, gyro, _) = example::session();
    let celsius: Vec<f64> = t.iter().map(|t| 31.0 - 6.0 * (-t / 60.0).exp()).collect();
    // The weather station says 101 325 Pa; the barometer reads it with errors of b = 80, c = −3 and k = 0.4, and some noise.
    let noise = |k: usize| (k as f64 * 12.9898).sin();
    let reads = |k: usize| 101_405.0 - 3.0 * (celsius[k] - 25.0) + 0.4 * accel[k][2] + noise(k);
    let pressure: Vec<f64> = (0..t.len()).map(reads).collect();
    let recording = Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?.with_scalar(
        Barometer::NAME,
        &t,
        &pressure,
        &vec![101_325.0; t.len()],
    )?;

    let request = Request {
        catalogue: catalogue.clone(),
        ..Request::default()
    };
    let calibration = calibrate(std::slice::from_ref(&recording), &request)?;
    for p in calibration
        .parameters()
        .iter()
        .filter(|p| p.name.starts_with("barometer"))
    {
        println!(
            "{} = {:.3} ± {:.3} {}",
            p.name,
            p.value,
            p.std.unwrap_or(f64::NAN),
            p.unit
        );
    }
    let again = Calibration::from_json(&calibration.to_json()?, &catalogue)?;
    let corrected = [&calibration, &again].map(|c| apply(c, &recording));
    let [one, other] = corrected.map(|r| r.map(|r| r.scalar(Barometer::NAME).map(<[f64]>::to_vec)));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    println!(
        "mean of {} readings: {:.1} Pa",
        recording.rows(Sensor::Gyroscope),
        mean(&pressure)
    );
    println!(
        "corrected: {:.1} Pa",
        one.as_ref()
            .map_or(f64::NAN, |v| mean(v.as_deref().unwrap_or(&[])))
    );
    println!("read again it corrects the same: {}", one? == other?);
    Ok(())
}
