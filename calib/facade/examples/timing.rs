//! How long a calibration of arrays takes, for comparison with other languages: the least of several runs, in ms.

use std::time::Instant;

use stillpoint::{Error, Recording, Request, calibrate, simulate};

fn main() -> Result<(), Error> {
    let spec = "seed = 7\nrate = 200.0\n[motion.hand_held]\nplacements = 30\n";
    let simulated = simulate(spec, None)?.recording;
    let t = simulated.stamps(stillpoint::Sensor::Accelerometer).to_vec();
    let accel: Vec<[f64; 3]> = simulated
        .values(stillpoint::Sensor::Accelerometer)
        .collect();
    let gyro: Vec<[f64; 3]> = simulated.values(stillpoint::Sensor::Gyroscope).collect();
    let mut least = f64::INFINITY;
    for _ in 0..20 {
        let begin = Instant::now();
        let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
        calibrate(&[recording], &Request::default())?.to_json()?;
        least = least.min(1e3 * begin.elapsed().as_secs_f64());
    }
    println!("{least:.2}");
    Ok(())
}
