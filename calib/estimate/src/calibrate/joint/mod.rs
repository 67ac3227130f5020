//! `--method joint`: recordings to a calibration by one weighted problem.

mod determined;
mod doubts;
mod latitude;
mod triads;
mod written_down;

use findings::{Finding, Findings, Kind};
use recording::{Error, Recording};

pub use self::determined::refuse_unobservable;
pub use self::latitude::LatitudeDoubt;
pub use self::written_down::{Account, written_down};
use super::checks;
use super::cut::cut;
use super::outcome::Outcome;
use super::request::Request;
use super::same_device::{gyroscope_of_one_device, of_one_device};
use crate::calibration::Calibration;
use crate::methods::Choice;
use crate::methods::earth::{self, on_the_earth};
use crate::methods::joint::{JointRequest, fit_joint};

/// Calibrates by the joint method.
pub fn calibrate(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    choices: Vec<Choice>,
    request: &Request,
    mut warnings: Findings,
) -> Result<Outcome, Error> {
    if !request.static_means.is_empty() || recordings.iter().any(|r| r.accelerometer.is_none()) {
        return Err(Error::usage(Finding::of(Kind::MethodNeedsForce)));
    }
    let means: Vec<_> = recordings
        .iter()
        .zip(&choices)
        .map(|(recording, choice)| crate::methods::static_means(recording, &choice.segmentation))
        .collect();
    checks::enough_rests(recordings, &choices, &means)?;
    checks::not_in_one_plane(&means)?;
    if !request.force_device {
        warnings.extend(of_one_device(recordings, &means, request.gravity)?);
    }
    let mut recordings = recordings.to_vec();
    let mut choices = choices;
    for recording in gyro_recordings {
        let choice = cut(recording, request, None)?;
        warnings.extend(checks::of_the_detector(recording, &choice));
        choices.push(choice);
        recordings.push(recording);
    }
    let cut = choices.iter().map(|c| &c.segmentation);
    checks::refuse_unknowable(recordings.iter().copied().zip(cut), &request.effects)?;
    let (mut accelerometer, mut gyroscope) = (accelerometer::model(), gyroscope::model());
    for effect in &request.effects {
        accelerometer = accelerometer.with(*effect);
        gyroscope = gyroscope.with(*effect);
    }
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
        ..JointRequest::new(
            recordings
                .iter()
                .copied()
                .zip(choices.iter().map(|c| &c.segmentation))
                .collect(),
            request.gravity,
        )
    })?;
    warnings.extend(gyroscope_of_one_device(
        &fit,
        &recordings,
        request.force_device,
    )?);
    let chosen: Vec<&Choice> = choices.iter().collect();
    let account = Account {
        gravity: request.gravity,
        gravity_source: request.gravity_source,
        latitude: request.latitude,
        keeps_the_earth: request.latitude.is_some(),
        frame: request.frame,
        names_what_is_missing: false,
    };
    let calibration = written_down(&fit, &recordings, &chosen, &account, &mut warnings)?;
    let mut calibration = Calibration {
        warnings,
        ..calibration
    };
    calibration.carry_gravity(request.gravity_source);
    Ok(Outcome {
        calibration,
        choices,
        accelerometer: None,
        gyroscope: None,
        joint: Some(fit),
    })
}
