//! Checks that the data determine the parameters of a joint fit.

use findings::Findings;
use nalgebra::Vector3;
use recording::Error;
use sensor::Sensor;

use crate::calibrate::checks;
use crate::calibrate::unusable_turns::TurnCount;
use crate::methods::Fitted;
use crate::methods::joint::{JointFit, Rest};

/// Refuses a fit that leaves combinations of parameters open: no effect beside them closes those.
///
/// # Errors
/// [`Error::NotEnough`] with the placements and turns to add.
pub fn refuse_unobservable(fit: &JointFit) -> Result<(), Error> {
    let is_open = |fitted: &Fitted| fitted.rank < fitted.free.len();
    let unsaid = &mut Findings::new();
    let force = fit.fitted(Sensor::Accelerometer);
    if is_open(&force) {
        check_force(fit, &force, unsaid)?;
    }
    let rate = fit.has_gyroscope().then(|| fit.fitted(Sensor::Gyroscope));
    if let Some(rate) = rate.filter(is_open) {
        check_rate(fit, &rate, unsaid).map_err(|error| for_lost_turns(fit, error))?;
    }
    Ok(())
}

/// The refusal of a gyroscope, for the turns that cannot be used where there are any.
fn for_lost_turns(fit: &JointFit, refused: Error) -> Error {
    let lost = &fit.data.lost;
    let count = fit.data.turns.len() + lost.len();
    match refused {
        Error::NotEnough(refused) if !lost.is_empty() => {
            let count = TurnCount::of(count, lost.iter().map(|turn| &turn.fault));
            Error::not_enough(count.finding().because(*refused))
        }
        other => other,
    }
}

/// Returns true if the data determine the parameters of a fit.
pub fn is_determined(fit: &JointFit) -> bool {
    let unsaid = &mut Findings::new();
    let force = fit.fitted(Sensor::Accelerometer);
    let rate = fit.has_gyroscope().then(|| fit.fitted(Sensor::Gyroscope));
    check_force(fit, &force, unsaid).is_ok()
        && rate.is_none_or(|rate| check_rate(fit, &rate, unsaid).is_ok())
}

/// Refuses an accelerometer that the directions of its readings do not determine; warns of one that they hardly do.
///
/// # Errors
/// [`Error::NotEnough`] with the placements to add.
pub fn check_force(fit: &JointFit, fitted: &Fitted, warnings: &mut Findings) -> Result<(), Error> {
    let evidence = checks::ForceEvidence {
        fitted,
        directions: fit.directions(),
        seen: seen(fit),
        scale: fit.force_unit.scale,
        gravity: fit.gravity,
        ending: fit.ending,
    };
    checks::accelerometer_is_determined(&evidence, warnings)
}

/// The direction of the mean reading in every static interval.
fn seen(fit: &JointFit) -> Vec<Vector3<f64>> {
    let of_rest = |rest: &Rest| {
        let chunks = fit.data.chunks[rest.chunks.clone()].iter();
        let means = chunks.filter_map(|chunk| chunk.accelerometer);
        let sum: Vector3<f64> = means.map(|m| m.value * m.count as f64).sum();
        sum.try_normalize(0.0)
    };
    fit.data.rests.iter().filter_map(of_rest).collect()
}

/// Refuses a gyroscope that the turns do not determine; warns of one that they hardly do.
///
/// # Errors
/// [`Error::NotEnough`] with the turns to add.
pub fn check_rate(fit: &JointFit, fitted: &Fitted, warnings: &mut Findings) -> Result<(), Error> {
    let evidence = checks::RateEvidence {
        fitted,
        turns: fit.chords.len(),
        scale: fit.rate_unit.scale,
        rms: fit.missed(),
        ending: fit.ending,
    };
    if fit.chords.is_empty() {
        return Ok(());
    }
    checks::gyroscope_is_determined(&evidence, warnings)
}
