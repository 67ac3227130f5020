//! `--method joint`: recordings to a calibration by one weighted problem.

mod delays;
mod determined;
mod doubts;
mod latitude;
mod misfits;
mod temperature;
mod triads;
mod written_down;

use findings::{Finding, Findings, Kind};
use recording::{Error, Recording};
use sensor::Sensor;

pub use self::determined::{is_determined, refuse_unobservable};
pub use self::latitude::LatitudeDoubt;
pub use self::written_down::{Account, written_down};
use super::bias::count_motion_of;
use super::checks;
use super::cut::Cut;
use super::explained::withdraw_explained;
use super::outcome::Outcome;
use super::request::Request;
use super::same_device::{differences, of_one_device};
use crate::calibration::Calibration;
use crate::methods::earth::{self, on_the_earth};
use crate::methods::joint::{JointRequest, STATIC_INTERVALS, fit_joint};
use crate::methods::{Choice, static_means};

/// Calibrates by the joint method.
pub(super) fn calibrate(
    recordings: &Cut<'_>,
    turning: &Cut<'_>,
    request: &Request,
    mut warnings: Findings,
) -> Result<Outcome, Error> {
    let no_force = |r: &&Recording| r.accelerometer.is_none();
    if !request.static_means.is_empty() || recordings.recordings.iter().any(no_force) {
        return Err(Error::usage(Finding::of(Kind::METHOD_NEEDS_FORCE)));
    }
    let means = recordings.each().map(|(r, cut)| static_means(r, cut));
    let means: Vec<_> = means.collect();
    checks::enough_rests(&recordings.recordings, &recordings.choices, &means)?;
    checks::not_in_one_plane(&means)?;
    if !request.force_device {
        of_one_device(&recordings.recordings, &means, request.gravity)?;
    }
    let whole = recordings.with_choices().chain(turning.with_choices());
    let parts = whole.flat_map(|(own, choice)| {
        let parts = choice.in_parts(STATIC_INTERVALS).into_iter();
        parts.map(move |part| (own, part))
    });
    let parts: Vec<(&Recording, Choice)> = parts.collect();
    let cut = parts
        .iter()
        .map(|(own, choice)| (*own, &choice.segmentation));
    let cut: Vec<_> = cut.collect();
    checks::refuse_unknowable(cut.iter().copied(), &request.effects)?;
    let accelerometer = request.model(Sensor::Accelerometer);
    let mut gyroscope = request.model(Sensor::Gyroscope);
    // Where nobody says the latitude and no effect estimates it, the earth's rotation is uncertainty.
    let earth = request.latitude.is_none() && !earth::is_among(&request.effects);
    let held = match request.latitude {
        Some(latitude) => {
            let (with_it, vertical) = on_the_earth(gyroscope, latitude);
            gyroscope = with_it;
            vec![vertical]
        }
        None => Vec::new(),
    };
    let fit = fit_joint(&JointRequest {
        accelerometer,
        gyroscope,
        held,
        clock: request.clock,
        earth,
        watch: request.watch.clone(),
        ..JointRequest::new(cut, request.gravity)
    })?;
    let chosen = recordings.choices.iter().chain(&turning.choices);
    let (of_parts, choices): (Vec<&Recording>, Vec<&Choice>) =
        parts.iter().map(|(own, choice)| (*own, choice)).unzip();
    let differ = differences(&fit, &of_parts, request.force_device)?;
    let account = Account {
        gravity: request.gravity,
        gravity_source: request.gravity_source,
        latitude: request.latitude,
        keeps_the_earth: request.latitude.is_some(),
        frame: request.frame,
        names_what_is_missing: false,
    };
    let mut calibration = written_down(&fit, &of_parts, &choices, &account, &mut warnings)?;
    let differ = differ.beside(&warnings);
    differ.enlarge(&mut calibration, &fit);
    differ.withdraw_effects(&mut warnings);
    warnings.extend(differ.findings());
    // That is no effect of the sensor.
    warnings.extend(checks::cut_towards_zero(&fit, &of_parts));
    let of_a_cut = withdraw_explained(&mut warnings);
    let mut calibration = Calibration {
        warnings,
        ..calibration
    };
    count_motion_of(&mut calibration, &of_a_cut);
    calibration.carry_gravity(request.gravity_source);
    Ok(Outcome {
        calibration,
        choices: chosen.cloned().collect(),
        accelerometer: None,
        gyroscope: None,
        joint: Some(fit),
    })
}
