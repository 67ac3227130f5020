//! Arrays to a calibration: `cargo run -p stillpoint-imu --example calibrate_arrays`.

use stillpoint::{Error, Recording, Request, apply, calibrate, evaluate, example};

fn main() -> Result<(), Error> {
    // In your program these come from your logger: s, m/s², rad/s, °C.
    let (t, accel, gyro, celsius) = example::session();
    let recording = Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?.named("session");
    let request = Request {
        gravity: Some(9.80665),
        ..Request::default()
    };
    let calibration = calibrate(std::slice::from_ref(&recording), &request)?;
    for p in calibration.parameters() {
        let std = p.std.map_or("fixed".into(), |std| format!("{std:.2e}"));
        println!("{:<16} {:>12.6} ± {std:<8} {}", p.name, p.value, p.unit);
    }
    let corrected = apply(&calibration, &recording)?;
    let left = evaluate(&recording, Some(&calibration), &request)?;
    println!(
        "{} s corrected; the norm of specific force is off by {:.1} mm/s² rms",
        corrected.duration().round(),
        1e3 * left.modulus_rms.unwrap_or(f64::NAN)
    );
    Ok(())
}
