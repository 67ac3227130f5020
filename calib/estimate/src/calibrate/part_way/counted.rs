//! Standard errors of scale factors that change part of the way, and of the biases as read: a calibration of both parts lies between them.

use findings::{Finding, Kind};
use sensor::{PLACES, base_names};

use crate::calibration::Calibration;

findings::tuning! {
    /// Share of a change by which the scale factor of either part lies off one in the middle.
    OF_A_CHANGE: f64 = 0.5;
}

/// Adds the square of half of the change to the variances of the scale factors of which a finding says that they change, and of their biases, which
/// are read as much larger.
pub fn count_scale_changes<'a>(
    calibration: &mut Calibration,
    found: impl IntoIterator<Item = &'a Finding>,
) {
    let own = |found: &&Finding| found.kind == Kind::SCALE_CHANGE;
    let found: Vec<&Finding> = found.into_iter().filter(own).collect();
    if found.is_empty() || calibration.covariance.len() != calibration.parameters.len() {
        return;
    }
    let values = calibration.parameter_values();
    let mut covariance = calibration.covariance_matrix();
    for found in found {
        let Some((sensor, share)) = found.place.sensor.zip(found.value("size")) else {
            continue;
        };
        let Some(triad) = calibration.triad(sensor) else {
            continue;
        };
        let axes = ["x", "y", "z"];
        let is_of_one = axes.iter().any(|axis| found.word("axis") == Some(axis));
        let names = base_names(sensor);
        let (scales, biases) = (&names[..3], &names[PLACES.len()..]);
        for (k, axis) in axes.iter().enumerate() {
            let is_changed = !is_of_one || found.word("axis") == Some(axis);
            for (name, value) in [(&scales[k], triad.t[k][k]), (&biases[k], triad.bias[k])] {
                let place = calibration.parameters.iter().position(|own| own == name);
                if let Some(place) = place.filter(|_| is_changed) {
                    covariance[(place, place)] += (OF_A_CHANGE.get() * share * value).powi(2);
                }
            }
        }
    }
    calibration.write_parameters(&values, &covariance);
}

#[cfg(test)]
mod tests {
    use sensor::{Base, Sensor};

    use super::*;
    use crate::calibration::Triad;
    use crate::gravity::GravitySource;

    #[test]
    fn the_scale_factor_that_changes_is_known_to_half_of_the_change_and_no_other_is() {
        let own = base_names(Sensor::Gyroscope);
        let mut calibration = Calibration {
            gyroscope: Some(Triad::of(Sensor::Gyroscope, &Base::identity())),
            parameters: own[..3].to_vec(),
            covariance: vec![vec![0.0; 3]; 3],
            ..Calibration::by("joint", 9.8, GravitySource::Given)
        };
        let found = Finding::of(Kind::SCALE_CHANGE)
            .of_sensor(Sensor::Gyroscope)
            .detail("axis", "y")
            .number("size", -0.004, "share");
        count_scale_changes(&mut calibration, [&found]);
        let stds = [0, 1, 2].map(|k| calibration.covariance[k][k].sqrt());
        assert!(stds[0] == 0.0 && (stds[1] - 0.002).abs() < 1e-12 && stds[2] == 0.0);
    }
}
