//! The sensors of a calibration from a joint fit.

use recording::Recording;
use sensor::{BASE_PARAMETERS, Sensor};

use crate::calibrate::assemble::triad;
use crate::calibration::{BiasTime, RecordingBias, Triad};
use crate::methods::Fitted;
use crate::methods::joint::JointFit;

/// The accelerometer.
pub fn force_triad(fit: &JointFit, fitted: &Fitted, recordings: &[&Recording]) -> Triad {
    let mut triad = triad(Sensor::Accelerometer, fitted);
    triad.residual_rms = fit.norm_rms();
    triad.bias_time = bias_time(fit, Sensor::Accelerometer, &triad.bias);
    triad.static_intervals = Some(fit.data.rests.len());
    let shared = fit.models[0].parameter_count();
    if fit.own_force_bias {
        triad.recordings = own_biases(Sensor::Accelerometer, fitted, shared, recordings);
    }
    triad
}

/// For which time the bias of the last recording holds.
fn bias_time(fit: &JointFit, sensor: Sensor, bias: &[f64; 3]) -> Option<BiasTime> {
    let last = fit.data.sources.len().checked_sub(1)?;
    let moved = fit.bias_motion(sensor, last)?;
    let unit = fit.unit(sensor).scale;
    let change = moved.change / unit;
    let at = |share: f64| std::array::from_fn(|k| bias[k] + share * change[k]);
    Some(BiasTime {
        holds: "mean over the static intervals".into(),
        from: moved.span.from,
        to: moved.span.to,
        start: at(-moved.before),
        end: at(1.0 - moved.before),
        change: change.into(),
        change_std: (moved.std / unit).into(),
    })
}

/// The gyroscope.
pub fn rate_triad(fit: &JointFit, fitted: &Fitted, recordings: &[&Recording]) -> Triad {
    let mut triad = triad(Sensor::Gyroscope, fitted);
    triad.residual_rms = fit.direction_rms().to_degrees();
    triad.bias_time = bias_time(fit, Sensor::Gyroscope, &triad.bias);
    triad.dynamic_intervals = Some(fit.chords.len());
    let shared = fit.models[1].parameter_count();
    triad.recordings = own_biases(Sensor::Gyroscope, fitted, shared, recordings);
    triad
}

/// The bias of every recording, where there are several.
fn own_biases(
    sensor: Sensor,
    fitted: &Fitted,
    shared: usize,
    recordings: &[&Recording],
) -> Vec<RecordingBias> {
    if recordings.len() < 2 {
        return Vec::new();
    }
    let of = |(k, recording): (usize, &&Recording)| {
        let bias = &fitted.local(shared, k)[9..BASE_PARAMETERS];
        let std = ["x", "y", "z"].map(|axis| {
            let common = format!("{}.b_{axis}", sensor.prefix());
            let own = format!("{common}[{}]", recording.name);
            fitted
                .standard_error(&own)
                .or(fitted.standard_error(&common))
        });
        RecordingBias {
            recording: recording.name.clone(),
            bias: [bias[0], bias[1], bias[2]],
            bias_std: std,
        }
    };
    recordings.iter().enumerate().map(of).collect()
}
