//! The sensors of a calibration from a joint fit.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::calibrate::assemble::{own_biases, triad};
use crate::calibration::{BiasTime, RecordingBias, Triad};
use crate::methods::Fitted;
use crate::methods::joint::{BiasMotion, JointFit, Source};

findings::tuning! {
    /// Chance moves a bias by so much in fewer recordings than this.
    MOVED: f64 = 1e-3;

    /// A bias that moved or wanders leaves more than this of a corrected orientation, ° ([`Finding::severity`]): 9 mm/s² or 18 °/h.
    SHOWS: f64 = 0.05;
}

/// The accelerometer.
pub fn force_triad(fit: &JointFit, fitted: &Fitted, moved: Option<&BiasMotion>) -> Triad {
    let mut triad = triad(Sensor::Accelerometer, fitted);
    triad.residual_rms = fit.norm_rms();
    triad.bias_time = moved.map(|own| bias_time(own, fit.force_unit.scale, &triad.bias));
    triad.static_intervals = Some(fit.data.rests.len());
    if fit.own_force_bias {
        triad.state_biases(biases_of_recordings(fit, Sensor::Accelerometer, fitted));
    }
    triad
}

/// For which time the bias of the last recording holds.
fn bias_time(moved: &BiasMotion, unit: f64, bias: &[f64; 3]) -> BiasTime {
    let change = moved.change / unit;
    let at = |share: f64| std::array::from_fn(|k| bias[k] + share * change[k]);
    BiasTime {
        holds: "mean over the static intervals".into(),
        from: moved.span.from,
        to: moved.span.to,
        start: at(-moved.before),
        end: at(1.0 - moved.before),
        change: change.into(),
        change_std: (moved.std / unit).into(),
    }
}

/// Biases that moved by more than chance makes of it, or wander; a remark where a corrected reading hardly shows it.
pub fn biases_that_moved(
    fit: &JointFit,
    sensor: Sensor,
    motions: &[Option<BiasMotion>],
) -> Vec<Finding> {
    let walk = fit.walk(sensor);
    let of = |(moved, source): (&Option<BiasMotion>, &Source)| {
        let moved = moved.as_ref()?;
        let found = |kind, name, size: f64, leaves: f64| {
            let found = Finding::of(kind).of_sensor(sensor);
            let found = found.in_recording(&source.name);
            found.number(name, size, sensor.unit()).affects(
                "corrected_reading",
                leaves,
                sensor.unit(),
            )
        };
        let change = moved.change.norm();
        let even = found(Kind::BIAS_MOVED, "change", change, 0.5 * change);
        if moved.p_value < MOVED.get() && even.severity() > SHOWS.get() {
            return Some(even);
        }
        // A Brownian path of density q lies q √(T/6) from its mean over T, root mean square.
        let size = walk * (moved.span.length() / 6.0).sqrt();
        let wandering = found(Kind::BIAS_WANDERED, "size", size, size);
        let kind = match wandering.severity() > SHOWS.get() {
            true => Kind::BIAS_WANDERED,
            false => Kind::BIAS_UNSTEADY,
        };
        // A walk is allowed for where none is seen, and is then as large as the noise can hide.
        if size == 0.0 || fit.chance_without_walks(sensor) >= MOVED.get() {
            return None;
        }
        // Of that path the line from its start to its end has half the mean square, (q² T)/12; here the line is known.
        let line = moved.change.amax() / 12f64.sqrt();
        Some(match kind {
            Kind::BIAS_WANDERED => wandering,
            _ => {
                let size = line.hypot(size / 2f64.sqrt());
                found(kind, "size", size, size)
            }
        })
    };
    let sources = &fit.data.sources;
    motions.iter().zip(sources).filter_map(of).collect()
}

/// The gyroscope.
pub fn rate_triad(fit: &JointFit, fitted: &Fitted, moved: Option<&BiasMotion>) -> Triad {
    let mut triad = triad(Sensor::Gyroscope, fitted);
    triad.residual_rms = fit.direction_rms().to_degrees();
    triad.bias_time = moved.map(|own| bias_time(own, fit.rate_unit.scale, &triad.bias));
    triad.dynamic_intervals = Some(fit.chords.len());
    triad.state_biases(biases_of_recordings(fit, Sensor::Gyroscope, fitted));
    triad
}

/// The bias of every recording, where there are several.
fn biases_of_recordings(fit: &JointFit, sensor: Sensor, fitted: &Fitted) -> Vec<RecordingBias> {
    let sources = &fit.data.sources;
    if sources.len() < 2 {
        return Vec::new();
    }
    let model = &fit.models[usize::from(sensor == Sensor::Gyroscope)];
    let names = sources.iter().map(|source| source.name.as_str());
    own_biases(sensor, fitted, model.parameter_count(), names)
}
