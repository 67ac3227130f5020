//! Start of the joint fit: units, a first accelerometer, directions.

use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{BASE_PARAMETERS, Base, Model};

use super::JointRequest;
use super::data::Data;
use super::data::budget::Steps;
use crate::calibrate::few_directions;
use crate::methods::joint::rows::chart::Chart;
use crate::methods::{
    AccelerometerRequest, RawUnit, accelerometer_unit, fit_accelerometer, gyroscope_guess,
    static_means,
};
use crate::residuals::TurnData;

findings::tuning! {
    /// Norms of specific force that scatter by more than this share of gravity about a fit that does not end are those of a device
    /// in motion: no other fit of them ends, and all take long.
    NOT_STILL: f64 = 0.05;
}

/// Units and first values.
#[derive(Clone, Debug)]
pub struct Start {
    /// Unit of the accelerometer.
    pub force_unit: RawUnit,
    /// Unit of the gyroscope.
    pub rate_unit: RawUnit,
    /// True if the accelerometer has a bias of its own in every recording: where the recordings determine it with little
    /// loss in the other standard errors, or refute a common one. A difference too small for a refutation can still
    /// shift a common bias by several standard errors.
    pub own_force_bias: bool,
    /// Parameters of the accelerometer's model near SI, for each recording.
    pub accelerometer: Vec<Vec<f64>>,
    /// `T` of the gyroscope near SI at the start: the identity, or how the sensor is mounted.
    pub axes: Matrix3<f64>,
    /// Steps that the solver may still take on the way to the last fit.
    pub steps: Steps,
}

/// The stepwise accelerometer without effects, which are small, and the gyroscope's unit, from the static
/// means alone.
///
/// # Errors
/// Means that lie on no sphere, and what the solver refuses.
pub fn start(request: &JointRequest<'_>) -> Result<Start, Error> {
    let means: Vec<_> = request
        .recordings
        .iter()
        .map(|(recording, segmentation)| static_means(recording, segmentation))
        .collect();
    let raw: Vec<Vector3<f64>> = means.iter().flatten().map(|m| m.raw).collect();
    let force_unit = accelerometer_unit(&raw, request.gravity).ok_or_else(|| {
        Error::not_enough(
            Finding::of(Kind::NO_SPHERE)
                .count("count", raw.len())
                .because(plan::REQUIREMENT.finding()),
        )
    })?;
    let names = request
        .recordings
        .iter()
        .map(|(r, _)| r.name.clone())
        .collect();
    let fit = fit_accelerometer(&AccelerometerRequest {
        recordings: means,
        names,
        model: Model::base(sensor::Sensor::Accelerometer),
        gravity: request.gravity,
    })?;
    let (first, gravity) = (&fit.first, request.gravity);
    let left = (2.0 * first.cost / first.residuals.len().max(1) as f64).sqrt();
    if !first.termination.converged() && left > NOT_STILL.get() * gravity {
        if let Some(reason) = few_directions(&raw) {
            return Err(Error::not_enough(reason));
        }
        return Err(Error::not_converged(
            Finding::of(Kind::FIT_STOPPED)
                .of_sensor(sensor::Sensor::Accelerometer)
                .count("steps", first.iterations.len())
                .detail("ending", format!("{:?}", first.termination))
                .number("left", left, "m/s^2")
                .number("gravity", gravity, "m/s^2"),
        ));
    }
    let nominal = request.accelerometer.parameters();
    let near_si = fit.first.parameters.values();
    let determined = fit.fitted.rank == fit.fitted.free.len() && fit.first.termination.converged();
    let accelerometer: Vec<Vec<f64>> = (0..request.recordings.len())
        .map(|k| {
            let mut local = nominal.values().to_vec();
            if !determined {
                return local;
            }
            local[..BASE_PARAMETERS].copy_from_slice(&near_si[..BASE_PARAMETERS]);
            let own = BASE_PARAMETERS + 3 * k;
            if let Some(own) = near_si.get(own..own + 3) {
                local[9..BASE_PARAMETERS].copy_from_slice(own);
            }
            local
        })
        .collect();
    let turns: Vec<TurnData> = request
        .recordings
        .iter()
        .zip(&accelerometer)
        .flat_map(|((recording, segmentation), p)| {
            let p = &p[..BASE_PARAMETERS];
            unbiased_turns(recording, segmentation, |raw| {
                Base::from_parameters(p).correct(&force_unit.to_si(raw))
            })
        })
        .collect();
    let (scale, axes) = if turns.is_empty() {
        (RawUnit::SI, Matrix3::identity())
    } else {
        let guess = gyroscope_guess(&turns);
        (guess.unit, guess.axes)
    };
    Ok(Start {
        own_force_bias: fit.own_bias || fit.own_bias_is_cheap,
        force_unit,
        rate_unit: RawUnit {
            zero: mean_rate(request),
            ..scale
        },
        accelerometer,
        axes,
        steps: Steps::default(),
    })
}

/// The mean raw rate over all rests.
fn mean_rate(request: &JointRequest<'_>) -> Vector3<f64> {
    let moments = request
        .recordings
        .iter()
        .flat_map(|(_, s)| s.statics.iter().filter_map(|rest| rest.gyroscope));
    let (sum, count) = moments.fold((Vector3::zeros(), 0.0), |(sum, n), m| {
        (sum + m.mean * m.count as f64, n + m.count as f64)
    });
    if count > 0.0 {
        sum / count
    } else {
        Vector3::zeros()
    }
}

/// The sound turns less the bias of the rests beside them.
fn unbiased_turns(
    recording: &Recording,
    segmentation: &Segmentation,
    force: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Vec<TurnData> {
    let Some(stream) = &recording.gyroscope else {
        return Vec::new();
    };
    segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter_map(|turn| {
            let before = segmentation.statics.get(turn.from)?;
            let after = segmentation.statics.get(turn.from + 1)?;
            let bias = 0.5 * (before.gyroscope?.mean + after.gyroscope?.mean);
            Some(TurnData {
                t: stream.t[turn.samples.clone()].to_vec(),
                readings: stream.values[turn.samples.clone()]
                    .iter()
                    .map(|w| w - bias)
                    .collect(),
                rest: Vec::new(),
                before: force(&before.accelerometer?.mean).normalize(),
                after: force(&after.accelerometer?.mean).normalize(),
            })
        })
        .collect()
}

/// Coordinates around the direction that the first accelerometer shows in every rest.
///
/// # Errors
/// A rest without a direction.
pub fn charts(data: &Data, model: &Model, start: &Start) -> Result<Vec<Chart>, Error> {
    data.rests
        .iter()
        .map(|rest| {
            let p = &start.accelerometer[rest.recording];
            let mean = data.mean_force(rest);
            mean.and_then(|mean| Chart::around(&model.correct(&mean, &rest.known, p)))
                .filter(|c| c.reference.iter().all(|v| v.is_finite()))
                .ok_or_else(|| {
                    Error::not_enough(
                        Finding::of(Kind::NO_GRAVITY_AT_REST)
                            .in_recording(&data.sources[rest.recording].name)
                            .of_sensor(sensor::Sensor::Accelerometer)
                            .at_interval(rest.interval)
                            .between(rest.span.from, rest.span.to),
                    )
                })
        })
        .collect()
}
