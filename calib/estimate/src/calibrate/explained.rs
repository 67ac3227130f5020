//! Findings that another explains are taken back.

use findings::{Finding, Findings, Kind};
use sensor::Sensor;

/// Takes back what a finding beside it explains, and returns it. Of readings that are cut off half a step is what the model misses, and what goes on
/// like a bias; where a sensor is read otherwise from some time on, no model of it holds; what was found and left out when the readings were looked
/// at is not found once more.
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
    let of_readings = [
        Kind::CUT_TOWARDS_ZERO,
        Kind::SAMPLES_LOST,
        Kind::FROZEN,
        Kind::SATURATED,
    ];
    of_readings.contains(&found.kind) || is_read_otherwise(found)
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
    let is_lost = matches!(cause.kind, Kind::SAMPLES_LOST | Kind::FROZEN);
    match found.kind {
        Kind::EFFECT_MISSING => is_cut || is_read_otherwise(cause),
        Kind::SETTLES_AFTER_TURNS => is_read_otherwise(cause),
        Kind::MISFIT => is_cut,
        Kind::SAMPLES_MISSING => is_lost && are_of_one_stream(cause, found),
        Kind::RANGE_REACHED => cause.kind == Kind::SATURATED && are_of_one_stream(cause, found),
        Kind::BIAS_MOVED | Kind::BIAS_WANDERED | Kind::BIAS_UNSTEADY => {
            is_cut && found.place.sensor == Some(Sensor::Accelerometer)
        }
        _ => false,
    }
}

/// Returns true of findings of one recording and one sensor; those that name none may be of each.
fn are_of_one_stream(a: &Finding, b: &Finding) -> bool {
    let sensors = a.place.sensor.zip(b.place.sensor);
    a.place.recording == b.place.recording && sensors.is_none_or(|(one, other)| one == other)
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
    fn samples_that_are_known_to_be_lost_are_missing_once_and_those_of_the_other_sensor_are_said() {
        let mut found: Findings = vec![
            of(Kind::SAMPLES_LOST, Sensor::Gyroscope),
            of(Kind::SAMPLES_MISSING, Sensor::Gyroscope),
            of(Kind::SAMPLES_MISSING, Sensor::Accelerometer),
            of(Kind::RANGE_REACHED, Sensor::Gyroscope),
            of(Kind::EFFECT_MISSING, Sensor::Gyroscope),
        ]
        .into();
        assert_eq!(withdraw_explained(&mut found).len(), 1);
        assert_eq!(found.iter().count(), 4);
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
