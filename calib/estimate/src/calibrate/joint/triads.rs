//! The sensors of a calibration from a joint fit.

use recording::Recording;
use recording::averages::root_mean_square;
use sensor::{BASE_PARAMETERS, Base, Sensor};

use crate::calibrate::assemble::triad;
use crate::calibrate::checks;
use crate::calibration::{BiasTime, RecordingBias, Triad};
use crate::methods::Fitted;
use crate::methods::joint::JointFit;

/// The accelerometer as it is held against gravity.
pub fn force_fit<'a>(
    fit: &JointFit,
    fitted: &Fitted,
    recordings: &'a [&'a Recording],
) -> checks::ForceFit<'a> {
    checks::ForceFit {
        base: Base::from_parameters(fitted.parameters.values()),
        std: checks::diagonal_std(fitted, Sensor::Accelerometer),
        unit: fit.force_unit,
        gravity: fit.gravity,
        recordings,
    }
}

/// The gyroscope as it is held against the turns.
pub fn rate_fit<'a>(
    fit: &JointFit,
    fitted: &Fitted,
    recordings: &'a [&'a Recording],
) -> checks::RateFit<'a> {
    checks::RateFit {
        base: Base::from_parameters(fitted.parameters.values()),
        std: checks::diagonal_std(fitted, Sensor::Gyroscope),
        scale: fit.rate_unit.scale,
        missed: root_mean_square(&fit.chords),
        force_is_si: fit.force_unit.is_si(),
        recordings,
    }
}

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
