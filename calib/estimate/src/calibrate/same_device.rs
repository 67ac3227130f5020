//! Whether several recordings can come from one device.

use recording::{Error, Recording};
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::methods::{AccelerometerFit, AccelerometerRequest, fit_accelerometer};
use crate::residuals::StaticMean;

/// Devices are told apart where chance makes so much difference in one parameter this rarely.
const LEVEL: f64 = 1e-7;

/// Differences of scale factors and misalignments below this are no other device: a fit's own misfit
/// may explain them.
const SAME: f64 = 1e-3;

/// Refuses recordings whose scale factors or misalignments differ by more than chance and misfit make,
/// each fitted on its own; those too short for that are passed.
pub(super) fn same_device(request: &AccelerometerRequest) -> Result<(), Error> {
    if request.recordings.len() < 2 {
        return Ok(());
    }
    let alone: Vec<(&String, AccelerometerFit)> = (0..request.recordings.len())
        .filter_map(|k| {
            let own = AccelerometerRequest {
                recordings: vec![request.recordings[k].clone()],
                names: vec![request.names[k].clone()],
                ..request.clone()
            };
            let fit = fit_accelerometer(&own).ok()?;
            (spare(&fit) > 1.0 && fit.fitted.rank == fit.fitted.free.len())
                .then_some((&request.names[k], fit))
        })
        .collect();
    for (k, (first, a)) in alone.iter().enumerate() {
        for (second, b) in &alone[k + 1..] {
            if let Some(words) = difference(a, b) {
                return Err(Error::Input(format!(
                    "{first} and {second}: {words}: recordings of different devices? (--force-device \
                     if they are of one)"
                )));
            }
        }
    }
    Ok(())
}

/// The same of recordings with their static means.
pub fn of_one_device<'a>(
    recordings: impl Iterator<Item = (&'a Recording, Vec<StaticMean>)>,
    gravity: f64,
) -> Result<(), Error> {
    let (names, recordings) = recordings
        .map(|(recording, means)| (recording.name.clone(), means))
        .unzip();
    same_device(&AccelerometerRequest {
        recordings,
        names,
        model: accelerometer::model(),
        gravity,
    })
}

fn spare(fit: &AccelerometerFit) -> f64 {
    fit.first.residuals.len() as f64 - fit.first.uncertainty.rank as f64
}

/// The first parameter in which two fits differ beyond chance, in words.
fn difference(a: &AccelerometerFit, b: &AccelerometerFit) -> Option<String> {
    let law = StudentsT::new(0.0, 1.0, spare(a).min(spare(b))).ok()?;
    a.fitted
        .free
        .iter()
        .filter(|name| name.starts_with("accel.") && !name.contains(".b_"))
        .find_map(|name| {
            let (x, y) = (
                a.fitted.parameters.get(name)?,
                b.fitted.parameters.get(name)?,
            );
            let errors = [a, b].map(|fit| fit.fitted.standard_error(name));
            let error = errors[0]?.hypot(errors[1]?);
            let t = (x - y).abs() / error;
            if !t.is_finite() {
                return None;
            }
            let scale = a.unit.scale.max(b.unit.scale);
            let other = (x - y).abs() > SAME * scale && 2.0 * law.sf(t) < LEVEL;
            other.then(|| {
                format!("{name} is {x:.5} in one and {y:.5} in the other ({t:.0} standard errors)")
            })
        })
}
