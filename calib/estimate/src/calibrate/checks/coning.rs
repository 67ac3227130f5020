//! Turns that are too fast for the rate of the samples.

use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use recording::intervals::{Segmentation, Turn};
use recording::{Recording, Stream};
use sensor::Sensor;

findings::tuning! {
    /// Turning between two samples from which on a turn is looked at, rad.
    FAST: f64 = 0.3;

    /// Least unknown rotation by coning between two samples that is reported, rad.
    WORTH: f64 = 2e-3;
}

/// Says where the device turns so far between two samples that the order of the rotations is not known; `t` carries the
/// readings to rad/s.
pub fn too_fast(
    recording: &Recording,
    segmentation: &Segmentation,
    t: &Matrix3<f64>,
) -> Option<Finding> {
    let stream = recording.gyroscope.as_ref()?;
    let sound = segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none());
    let found: Vec<(&Turn, f64, f64)> = sound
        .map(|turn| {
            let (step, coning) = of_turn(stream, turn, t);
            (turn, step, coning)
        })
        .filter(|(_, step, coning)| *step > FAST.get() && *coning > WORTH.get())
        .collect();
    let (turn, step, coning) = found.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let needed = stream.median_step()?.recip() * step / (0.3 * FAST.get());
    Some(
        Finding::of(Kind::TURNS_TOO_FAST)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Gyroscope)
            .at_turn(turn.from)
            .between(turn.span.from, turn.span.to)
            .count("count", found.len())
            .count("all", segmentation.turns.len())
            .number("rate", stream.median_step()?.recip(), "Hz")
            .number("step", *step, "rad")
            .number("coning", *coning, "rad")
            .number("needed", needed, "Hz")
            .affects("turn", *coning, "rad"),
    )
}

/// The largest rotation in a step, and the size of `Σ θₖ × θₖ₊₁ / 12`, what the first correction for coning adds (Savage
/// 1998, equation 33): all of it is unknown where the rate changes from sample to sample.
fn of_turn(stream: &Stream, turn: &Turn, t: &Matrix3<f64>) -> (f64, f64) {
    let stamps = stream.t[turn.samples.clone()].windows(2);
    let values = stream.values[turn.samples.clone()].windows(2);
    let angles: Vec<Vector3<f64>> = stamps
        .zip(values)
        .map(|(t2, v)| t * (0.5 * (v[0] + v[1])) * (t2[1] - t2[0]))
        .collect();
    let largest = angles.iter().map(Vector3::norm).fold(0.0, f64::max);
    let crossed = angles.windows(2).map(|pair| pair[0].cross(&pair[1]));
    let size: f64 = crossed.map(|c| c.norm_squared()).sum::<f64>().sqrt();
    (largest, size / 12.0)
}
