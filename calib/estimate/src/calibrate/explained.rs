//! Findings that another explains are taken back.

use findings::{Finding, Findings, Kind};
use sensor::Sensor;

/// Takes back what a finding beside it explains, and returns it. Of readings that are cut off half a step is what the model misses, and what goes on
/// like a bias; where a sensor is read otherwise from some time on, no model of it holds.
pub fn withdraw_explained(warnings: &mut Findings) -> Vec<Finding> {
    let causes: Vec<Finding> = warnings
        .iter()
        .filter(|own| is_cause(own))
        .cloned()
        .collect();
    let is_explained = |found: &Finding| causes.iter().any(|cause| explains(cause, found));
    let own = warnings.iter().filter(|found| is_explained(found));
    let own = own.cloned().collect();
    warnings.retain(|found| !is_explained(found));
    own
}

fn is_cause(found: &Finding) -> bool {
    found.kind == Kind::CUT_TOWARDS_ZERO || is_read_otherwise(found)
}

/// Returns true of a sensor that is read otherwise from some time on.
pub fn is_read_otherwise(found: &Finding) -> bool {
    let kinds = [
        Kind::SCALE_CHANGE,
        Kind::SIGN_CHANGE,
        Kind::COLUMNS_SWAP_PART_WAY,
    ];
    kinds.contains(&found.kind)
}

fn explains(cause: &Finding, found: &Finding) -> bool {
    let is_cut = cause.kind == Kind::CUT_TOWARDS_ZERO;
    match found.kind {
        Kind::EFFECT_MISSING => true,
        Kind::SETTLES_AFTER_TURNS => !is_cut,
        Kind::MISFIT => is_cut,
        Kind::BIAS_MOVED | Kind::BIAS_WANDERED | Kind::BIAS_UNSTEADY => {
            is_cut && found.place.sensor == Some(Sensor::Accelerometer)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: Kind, sensor: Sensor) -> Finding {
        Finding::of(kind).of_sensor(sensor)
    }

    #[test]
    fn of_a_cut_nothing_else_is_said_of_the_accelerometer_and_the_gyroscope_keeps_its_own() {
        let mut found: Findings = vec![
            of(Kind::BIAS_UNSTEADY, Sensor::Accelerometer),
            of(Kind::BIAS_UNSTEADY, Sensor::Gyroscope),
            of(Kind::MISFIT, Sensor::Accelerometer),
        ]
        .into();
        assert!(withdraw_explained(&mut found).is_empty());
        found.push(of(Kind::CUT_TOWARDS_ZERO, Sensor::Accelerometer));
        assert_eq!(withdraw_explained(&mut found).len(), 2);
        assert_eq!(found.iter().count(), 2);
    }

    #[test]
    fn beside_a_sign_that_changes_nothing_is_missing_and_the_misfit_stays() {
        let mut found: Findings = vec![
            of(Kind::SIGN_CHANGE, Sensor::Gyroscope),
            of(Kind::EFFECT_MISSING, Sensor::Accelerometer),
            of(Kind::SETTLES_AFTER_TURNS, Sensor::Accelerometer),
            of(Kind::BIAS_WANDERED, Sensor::Accelerometer),
            of(Kind::MISFIT, Sensor::Accelerometer),
        ]
        .into();
        assert_eq!(withdraw_explained(&mut found).len(), 2);
        assert!(found.has(Kind::BIAS_WANDERED) && found.has(Kind::MISFIT));
    }
}
