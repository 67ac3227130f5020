//! Record of what a calibration was made from.

use recording::{AppliedBefore, Recording};
use sensor::Sensor;

use super::checks;
use super::outcome::Outcome;
use super::request::Request;
use crate::calibration::Options;

/// Writes the recordings and the options into the provenance of the calibration, and seals it.
pub(super) fn state(outcome: &mut Outcome, recordings: &[&Recording], request: &Request) {
    let cut = outcome.choices.iter().map(|c| Some(&c.segmentation));
    let cut = cut.chain(std::iter::repeat(None));
    let multipliers = outcome.choices.iter().map(|c| c.segmentation.multiplier);
    let options = Options::of(request, multipliers.collect());
    let all = recordings.iter().copied().zip(cut);
    let reads_zero: Vec<bool> = all
        .clone()
        .map(|(recording, cut)| cut.is_some_and(|cut| checks::reads_zero_at_rest(recording, cut)))
        .collect();
    let calibration = &mut outcome.calibration;
    calibration.state_inputs(all, Some(options));
    let inputs = calibration.provenance.inputs.iter_mut();
    for (input, _) in inputs.zip(reads_zero).filter(|(_, reads_zero)| *reads_zero) {
        let gyroscope = AppliedBefore::by(AppliedBefore::UNKNOWN, Sensor::Gyroscope);
        let claims = &mut input.applied_before;
        if !claims.iter().any(|claim| claim.sensor == gyroscope.sensor) {
            claims.push(gyroscope);
        }
    }
    let mixed = calibration.mixed_corrections();
    calibration.warnings.extend(mixed);
    calibration.seal();
}
