//! Delays of the axes of a sensor, counted from the axis that is the first.

use nalgebra::DMatrix;
use sensor::Nature;

use crate::calibration::{Calibration, EffectValues};

/// Counts the delays of every effect from its earliest axis.
///
/// What all axes share is not visible, so that a fit holds one of them at 0. None is early: with `m` the earliest, `dᵢ − d_m`
/// are the delays, and the covariance goes with them.
pub fn count_from_the_earliest(calibration: &mut Calibration) {
    for k in 0..calibration.effects.len() {
        let values = &calibration.effects[k];
        let (Some(reference), Some(earliest)) = (reference(values), earliest(values)) else {
            continue;
        };
        let name = |axis: usize| format!("{}.{}", values.name, values.parameters[axis].name);
        let place = |axis: usize| {
            let name = name(axis);
            calibration.parameters.iter().position(|own| *own == name)
        };
        let Some(first) = place(earliest).filter(|_| earliest != reference) else {
            continue;
        };
        let n = calibration.parameters.len();
        let mut change = DMatrix::identity(n, n);
        for own in (0..values.parameters.len()).filter_map(place) {
            change[(own, first)] = -1.0;
        }
        let covariance = &change * calibration.covariance_matrix() * change.transpose();
        calibration.parameters[first] = name(reference);
        let delays = &mut calibration.effects[k].parameters;
        let least = delays[earliest].value;
        delays.iter_mut().for_each(|delay| delay.value -= least);
        delays[earliest].std = None;
        let values = calibration.parameter_values();
        calibration.write_parameters(&values, &covariance);
    }
}

/// The place of the axis that a fit holds at 0.
fn reference(values: &EffectValues) -> Option<usize> {
    let effect = values.effect().ok()?;
    let reference = effect
        .reference()
        .filter(|_| effect.nature() == Nature::Delay)?;
    values
        .parameters
        .iter()
        .position(|own| own.name == reference)
}

fn earliest(values: &EffectValues) -> Option<usize> {
    let delays = values.parameters.iter().enumerate();
    let (axis, _) = delays.min_by(|(_, a), (_, b)| a.value.total_cmp(&b.value))?;
    Some(axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::EffectParameter;
    use crate::gravity::GravitySource;

    #[test]
    fn one_late_axis_is_late_and_the_others_are_not_early() {
        let delay = |name: &str, value, std| EffectParameter {
            name: name.into(),
            value,
            std,
            unit: "s".into(),
        };
        let mut calibration = Calibration::by("joint", 9.81, GravitySource::Given);
        calibration.effects.push(EffectValues {
            name: "gyro_delay".into(),
            definition: None,
            parameters: vec![
                delay("x", -8e-3, Some(2e-4)),
                delay("y", -7e-3, Some(1e-4)),
                delay("z", 0.0, None),
            ],
            outside: None,
        });
        calibration.parameters = vec!["gyro_delay.x".into(), "gyro_delay.y".into()];
        calibration.covariance = vec![vec![4e-8, 1e-8], vec![1e-8, 1e-8]];
        count_from_the_earliest(&mut calibration);
        assert_eq!(calibration.parameters, ["gyro_delay.z", "gyro_delay.y"]);
        let own = &calibration.effects[0].parameters;
        let found: Vec<(f64, Option<f64>)> = own.iter().map(|p| (p.value, p.std)).collect();
        assert_eq!(found[0], (0.0, None));
        assert!((found[1].0 - 1e-3).abs() < 1e-15 && (found[2].0 - 8e-3).abs() < 1e-15);
        // y − x has the variance 1 + 4 − 2 of 1e-8, z − x that of x.
        let [y, z] = [1, 2].map(|k| found[k].1.unwrap());
        assert!((y * y - 3e-8).abs() < 1e-15 && (z * z - 4e-8).abs() < 1e-15);
        assert!((calibration.covariance[0][1] - 3e-8).abs() < 1e-15);
    }
}
