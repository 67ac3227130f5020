//! An effect of another crate: hidden in a simulated recording, calibrated by both methods, written, read again, applied.
//! `cargo run -p stillpoint-imu --example own_effect`

use std::sync::Arc;

use stillpoint::effect::{Effect, Kinematics, Param, Quantity, Scalar, Sensor, Vector3, params};
use stillpoint::{
    Calibration, Catalogue, Error, Method, Recording, Request, apply, calibrate, simulate_with,
};

/// A bias that is the same in warming and in cooling: `eᵢ = cᵢ (dT/dt)²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | coefficient | (rad/s)/(K/s)² | 3 |
/// | `dT/dt` | derivative of the temperature | K/s | 1 |
struct TemperatureRateSquared;

impl Effect for TemperatureRateSquared {
    const NAME: &'static str = "gyro_temperature_rate_squared";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i (dT/dt)^2";
    const PARAMS: &'static [Param] = &params("rad*s/K^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 0.5;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::TemperatureRate]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.temperature_rate.powi(2))
    }
}

/// A session in which the temperature goes up and down.
const SPEC: &str = r#"
seed = 5
rate = 50.0
[motion.hand_held]
placements = 30
[temperature]
self_heating = 8.0
swing = 4.0
period = 600.0
[effects.gyro_temperature_rate_squared]
x = 0.5
y = -0.3
z = 0.2
"#;

fn main() -> Result<(), Error> {
    let catalogue = Catalogue::default().with(Arc::new(TemperatureRateSquared))?;
    let simulated = simulate_with(SPEC, &catalogue, None)?;
    for method in [Method::Stepwise, Method::Joint] {
        let request = Request {
            method,
            gravity: Some(9.80665),
            effects: vec!["gyro_temperature_rate_squared".into()],
            catalogue: catalogue.clone(),
            ..Request::default()
        };
        let recording = &simulated.recording;
        let calibration = calibrate(std::slice::from_ref(recording), &request)?;
        println!("{method:?}");
        for p in calibration.parameters().iter().skip(24) {
            let (truth, std) = (simulated.truth.get(&p.name), p.std.unwrap_or(0.0));
            println!(
                "{} = {:.3} ± {std:.3} {}, truth {:.3}",
                p.name,
                p.value,
                p.unit,
                truth.unwrap_or(0.0)
            );
        }
        let again = Calibration::from_json(&calibration.to_json()?, &catalogue)?;
        let same = corrected(&calibration, recording)? == corrected(&again, recording)?;
        println!("read again it corrects the same: {same}");
    }
    Ok(())
}

/// Corrected rates, rad/s (`n × 3`).
fn corrected(calibration: &Calibration, recording: &Recording) -> Result<Vec<[f64; 3]>, Error> {
    Ok(apply(calibration, recording)?
        .values(Sensor::Gyroscope)
        .collect())
}
