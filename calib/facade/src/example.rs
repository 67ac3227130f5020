//! A short session to try things on, where there is no recording at hand.

use sensor::Sensor;

use crate::{Recording, simulate};

/// Simulation specification that [`session`] uses.
pub const SPEC: &str = "\
seed = 7
grade = \"consumer\"
rate = 50.0
[motion.hand_held]
placements = 16
[temperature]
ambient = 25.0
";

/// Stamps (s, `n`), specific force (m/s², `n × 3`), angular rate (rad/s, `n × 3`) and temperature (°C, `n`).
pub type Session = (Vec<f64>, Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<f64>);

/// A simulated session by hand, as arrays: 16 placements, 50 Hz, a consumer-grade device.
///
/// # Examples
/// ```
/// let (t, accel, gyro, celsius) = stillpoint::example::session();
/// assert!(t.len() == accel.len() && t.len() == gyro.len() && t.len() == celsius.len());
/// ```
pub fn session() -> Session {
    let recording = simulate(SPEC, None).map(|simulated| simulated.recording);
    let recording = recording.unwrap_or_default();
    let t = recording.stamps(Sensor::Accelerometer).to_vec();
    let values = |sensor| recording.values(sensor).collect();
    let celsius = t.iter().map(|&t| celsius(&recording, t)).collect();
    (
        t.clone(),
        values(Sensor::Accelerometer),
        values(Sensor::Gyroscope),
        celsius,
    )
}

fn celsius(recording: &Recording, t: f64) -> f64 {
    recording.temperature_at(t).unwrap_or(25.0)
}
