//! Accelerometer first, then the gyroscope.

mod gyro_data;

use findings::{Finding, Findings, Kind};
use nalgebra::Vector3;
use recording::intervals::Segmentation;
use recording::watch::Stage;
use recording::{Error, Recording};
use sensor::{EffectRef, Quantity, Sensor};

use super::cut::Cut;
use super::outcome::Outcome;
use super::request::Request;
use super::same_device::{celsius, same_accelerometer};
use super::{assemble, checks};
use crate::calibration::{Calibration, RecordingClock};
use crate::methods::joint::ClockMode;
use crate::methods::{
    AccelerometerFit, AccelerometerRequest, GyroscopeData, GyroscopeFit, GyroscopeRequest,
    accelerometer_unit, fit_accelerometer, fit_gyroscope, static_means, static_means_by,
};
use crate::residuals::StaticMean;
use crate::truth::{Models, Sensing, Truth};

findings::tuning! {
    /// Fits at most after which the signs of changes of force are settled.
    HISTORIES: usize = 4;
}

/// Accelerometer first, then the gyroscope.
pub(super) fn stepwise(
    recordings: &Cut<'_>,
    separate: &Cut<'_>,
    request: &Request,
    mut warnings: Findings,
) -> Result<Outcome, Error> {
    if request.static_means.is_empty() {
        checks::refuse_unknowable(recordings.each(), &request.effects)?;
        checks::refuse_attitude(&request.effects)?;
    }
    let is_separate = !separate.recordings.is_empty();
    let turning = if is_separate { separate } else { recordings };
    let turning: Vec<(&Recording, &Segmentation)> = turning.each().collect();
    let accelerometer = accelerometer(recordings, request, &mut warnings)?;
    if is_separate {
        checks::refuse_unknowable(turning.iter().copied(), &request.effects)?;
    }
    let gyroscope = gyroscope(
        &turning,
        !is_separate,
        accelerometer.as_ref(),
        request,
        &mut warnings,
    )?;
    let even = request.clock == ClockMode::Even;
    let clocks = turning
        .iter()
        .filter(|(recording, _)| recording.gyroscope.is_some());
    let clocks = clocks
        .map(|(recording, _)| RecordingClock::given(&recording.name, even))
        .collect();
    let fits = (accelerometer.as_ref(), gyroscope.as_ref());
    let mut calibration = assemble::calibration(recordings, &turning, fits, request, warnings)?;
    calibration.carry_gravity(request.gravity_source);
    Ok(Outcome {
        calibration: Calibration {
            clocks,
            ..calibration
        },
        choices: recordings.choices.clone(),
        accelerometer,
        gyroscope,
        joint: None,
    })
}

/// The accelerometer's fit; `None` where no recording has one.
fn accelerometer(
    cut: &Cut<'_>,
    request: &Request,
    warnings: &mut Findings,
) -> Result<Option<AccelerometerFit>, Error> {
    let recordings = &cut.recordings;
    if request.static_means.is_empty() && recordings.iter().all(|r| r.accelerometer.is_none()) {
        warnings.push(Finding::of(Kind::NO_ACCELEROMETER));
        return Ok(None);
    }
    let mut names = Vec::new();
    let mut means = Vec::new();
    if request.static_means.is_empty() {
        for (recording, segmentation) in cut.each() {
            names.push(recording.name.clone());
            means.push(static_means(recording, segmentation));
        }
    } else {
        names.push("static means".into());
        means.push(
            request
                .static_means
                .iter()
                .copied()
                .map(StaticMean::bare)
                .collect(),
        );
    }
    checks::enough_rests(recordings, &cut.choices, &means)?;
    checks::not_in_one_plane(&means)?;
    let model = request.model(Sensor::Accelerometer);
    let raw: Vec<Vector3<f64>> = means.iter().flatten().map(|m| m.raw).collect();
    let unit = accelerometer_unit(&raw, request.gravity);
    if let Some(unit) = unit.filter(|_| !model.effects().is_empty()) {
        if !request.static_means.is_empty() {
            checks::force_is_all_they_need(model.effects())?;
        } else {
            let first = Sensing::first(model.clone(), unit);
            means = known_means(cut, |_| first.clone());
        }
        checks::the_norm_tells_them(&model, &means, &unit, request.gravity)?;
    }
    let (force_device, watch) = (request.force_device, &request.watch);
    let mut request = AccelerometerRequest {
        recordings: means,
        names,
        model,
        gravity: request.gravity,
    };
    if !force_device {
        let celsius: Vec<_> = recordings.iter().map(|r| celsius(r)).collect();
        warnings.extend(same_accelerometer(&request, &celsius)?);
    }
    watch.step(Stage::Fitting)?;
    let mut fit = fit_accelerometer(&request)?;
    if recordings.len() == request.recordings.len()
        && request.model.effects().iter().any(looks_back)
    {
        let shared = request.model.parameter_count();
        for _ in 0..HISTORIES.get() {
            let by = |k: usize| Sensing::new(request.model.clone(), fit.fitted.local(shared, k));
            let again = known_means(cut, by);
            let same = again
                .iter()
                .flatten()
                .zip(request.recordings.iter().flatten());
            let same = same
                .into_iter()
                .all(|(a, b)| a.rest.last_change == b.rest.last_change);
            request.recordings = again;
            watch.step(Stage::Fitting)?;
            fit = fit_accelerometer(&request)?;
            if same {
                break;
            }
        }
    }
    checks::accelerometer_is_determined(&checks::ForceEvidence::of(&fit, &request), warnings)?;
    Ok(Some(fit))
}

/// The gyroscope's fit; `None` where no recording has one or there is no gravity to carry.
fn gyroscope(
    turning: &[(&Recording, &Segmentation)],
    same_recordings: bool,
    accelerometer: Option<&AccelerometerFit>,
    request: &Request,
    warnings: &mut Findings,
) -> Result<Option<GyroscopeFit>, Error> {
    let Some(accelerometer) = accelerometer else {
        return Ok(None);
    };
    if turning.iter().all(|(r, _)| r.gyroscope.is_none()) {
        if !turning.is_empty() {
            warnings.push(Finding::of(Kind::NO_GYROSCOPE));
        }
        return Ok(None);
    }
    let model = request.model(Sensor::Gyroscope);
    let mut sources = Vec::new();
    for (k, (recording, segmentation)) in turning.iter().enumerate() {
        if recording.gyroscope.is_none() || recording.accelerometer.is_none() {
            warnings.push(Finding::of(Kind::SENSOR_MISSING).in_recording(&recording.name));
            continue;
        }
        let place = same_recordings.then_some(k);
        sources.push(gyro_data::Source {
            recording,
            segmentation,
            place,
            accelerometer,
            request,
        });
    }
    let mut asked = GyroscopeRequest {
        recordings: gyro_data::collect_all(&sources, &model, warnings),
        model,
        integrator: request.integrator,
    };
    request.watch.step(Stage::Fitting)?;
    let mut fit = fit_gyroscope(&asked)?;
    if asked.model.effects().iter().any(follows_the_fit) {
        let shared = asked.model.parameter_count();
        let p = fit.fitted.parameters.values()[..shared].to_vec();
        let fitted = Sensing::new(asked.model.clone(), p);
        asked.recordings = gyro_data::collect_by(&sources, &fitted);
        request.watch.step(Stage::Fitting)?;
        fit = fit_gyroscope(&asked)?;
    }
    checks::gyroscope_is_determined(&checks::RateEvidence::of(&fit), warnings)?;
    Ok(Some(fit))
}

/// Returns true if the effect depends on the force before, or on vibration: the accelerometer's own fit decides whether a
/// change of force counts.
fn looks_back(effect: &EffectRef) -> bool {
    let looks = [Quantity::LastChange, Quantity::Vibration];
    effect.needs().iter().any(|need| looks.contains(need))
}

/// Returns true if the effect depends on quantities that the gyroscope's own fit provides.
fn follows_the_fit(effect: &EffectRef) -> bool {
    let from_rates = [Quantity::AngularAcceleration, Quantity::Attitude];
    effect.needs().iter().any(|need| from_rates.contains(need))
}

/// The sound turns and the rests of a recording as the gyroscope's fit takes them, with the directions
/// of gravity by `accelerometer`.
pub fn gyroscope_data(
    recording: &Recording,
    segmentation: &Segmentation,
    accelerometer: &AccelerometerFit,
    request: &Request,
) -> GyroscopeData {
    let of = gyro_data::Source {
        recording,
        segmentation,
        place: None,
        accelerometer,
        request,
    };
    let all = gyro_data::collect_all(
        &[of],
        &request.model(Sensor::Gyroscope),
        &mut Findings::new(),
    );
    all.into_iter().next().unwrap_or_default()
}

/// The static means with what effects look at, by an accelerometer for each recording.
fn known_means(cut: &Cut<'_>, by: impl Fn(usize) -> Sensing) -> Vec<Vec<StaticMean>> {
    let of = |(k, (recording, segmentation)): (usize, (&Recording, &Segmentation))| {
        let models = Models {
            accelerometer: Some(by(k)),
            ..Models::default()
        };
        let truth = Truth::as_far_as_known(recording, Some(segmentation), models);
        static_means_by(&truth, segmentation)
    };
    cut.each().enumerate().map(of).collect()
}
