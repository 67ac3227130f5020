//! Whether a recording meets gravity as well as a calibration's standard errors promise.

use findings::{Finding, Kind};
use nalgebra::{Cholesky, DMatrix, DVector};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{Sensor, base_names, is_bias};

use super::misfits::{Misfits, Miss, misfits};
use crate::calibration::{Calibration, Triad};
use crate::methods::chance;

findings::tuning! {
    /// Chance of that a recording of the same device misses gravity by more than the errors allow.
    BY_CHANCE: f64 = 1e-4;

    /// One static interval or turn in so many may be spoilt, and is no error of the calibration.
    MAY_BE_SPOILT: usize = 8;

    /// Static intervals or turns that are judged.
    ENOUGH: usize = 6;
}

/// Sensors that miss gravity in a recording which the calibration was not made from by more than its errors, the motion of its biases, what
/// it left of its own recordings and the noise of this one make.
///
/// With `r` what is missed, `D` the noise of that and `J P Jᵀ` what the covariance `P` of the parameters makes of it,
/// `rᵀ (D + J P Jᵀ)⁻¹ r / n ~ F` of `n` and the degrees of freedom that the calibration was left with.
///
/// # Errors
/// As [`misfits`].
pub(super) fn beyond_errors(
    recording: &Recording,
    segmentation: &Segmentation,
    calibration: &Calibration,
    (gravity, left): (f64, &Misfits),
) -> Result<Vec<Finding>, Error> {
    let mut covariance = calibration.covariance_matrix();
    let count = calibration.parameters.len();
    if covariance.nrows() != count || calibration.was_made_from(recording) != Some(false) {
        return Ok(Vec::new());
    }
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let time = calibration
            .triad(sensor)
            .and_then(|own| own.bias_time.as_ref());
        let names = base_names(sensor).into_iter().filter(|name| is_bias(name));
        for (axis, name) in names.enumerate() {
            let is_own = |k: &usize| calibration.parameters[*k].split('[').next() == Some(&name);
            for (k, time) in (0..count).filter(is_own).zip(time.into_iter().cycle()) {
                covariance[(k, k)] += time.change[axis].powi(2) + time.change_std[axis].powi(2);
            }
        }
    }
    // A column is what one standard deviation of a parameter makes.
    let values = calibration.parameter_values();
    let deviations: Vec<f64> = (0..count)
        .map(|k| covariance[(k, k)].max(0.0).sqrt())
        .collect();
    let mut moved = Vec::with_capacity(count);
    for (k, &deviation) in deviations.iter().enumerate() {
        let mut by_one = values.clone();
        by_one[k] += deviation;
        let mut other = calibration.clone();
        other.write_parameters(&by_one, &calibration.covariance_matrix());
        moved.push(misfits(recording, segmentation, Some(&other), gravity)?);
    }
    let together = DMatrix::from_fn(count, count, |i, k| {
        let scale = deviations[i] * deviations[k];
        if scale > 0.0 {
            covariance[(i, k)] / scale
        } else {
            0.0
        }
    });
    let judge = |sensor: Sensor, of: fn(&Misfits) -> &[Miss], unit: &'static str| {
        let own = calibration.triad(sensor)?;
        let usual = usual(sensor, own)?;
        let (missed, all) = (of(left), moved.iter().map(of).collect::<Vec<_>>());
        let is_whole = all.iter().all(|own| own.len() == missed.len());
        let spoilt = missed.len() / MAY_BE_SPOILT.get();
        let mut kept: Vec<usize> = (0..missed.len()).collect();
        kept.sort_by(|&a, &b| missed[a].size().total_cmp(&missed[b].size()));
        kept.truncate(missed.len() - spoilt);
        if !is_whole || kept.len() < ENOUGH.get() {
            return None;
        }
        let rows: Vec<(usize, usize)> = kept
            .iter()
            .flat_map(|&k| (0..missed[k].count).map(move |i| (k, i)))
            .collect();
        let by = DMatrix::from_fn(rows.len(), count, |row, k| {
            let (place, i) = rows[row];
            all[k][place].value[i] - missed[place].value[i]
        });
        let mut scatter = &by * &together * by.transpose();
        for (row, (place, _)) in rows.iter().enumerate() {
            scatter[(row, row)] += missed[*place].variance.max(usual.0);
        }
        let value =
            DVector::from_iterator(rows.len(), rows.iter().map(|&(k, i)| missed[k].value[i]));
        let square = value.dot(&Cholesky::new(scatter)?.solve(&value));
        // Of the three components of a turn's miss one is along gravity, and nothing.
        let dof = kept.iter().map(|&k| missed[k].count.min(2)).sum::<usize>() as f64;
        if chance::of_f(square / dof, [dof, usual.1]) > BY_CHANCE.get() {
            return None;
        }
        let rms = (value.norm_squared() / kept.len() as f64).sqrt();
        let affected = if sensor == Sensor::Gyroscope {
            "turn"
        } else {
            "corrected_reading"
        };
        let found = Finding::of(Kind::BEYOND_ERRORS)
            .in_recording(&recording.name)
            .of_sensor(sensor)
            .number("rms", rms, unit)
            .number("ratio", (square / dof).sqrt(), "1");
        Some(found.affects(affected, rms, unit))
    };
    let of_force = judge(Sensor::Accelerometer, |own| &own.norms, "m/s^2");
    let of_rate = judge(Sensor::Gyroscope, |own| &own.directions, "rad");
    Ok(of_force.into_iter().chain(of_rate).collect())
}

/// The variance of a component of what a calibration left of its own recordings, as if it had left all of the noise, and the degrees of
/// freedom that this is known by; `None` where they do not say.
fn usual(sensor: Sensor, own: &Triad) -> Option<(f64, f64)> {
    let (rms, count) = match sensor {
        Sensor::Gyroscope => (
            own.residual_rms.to_radians() / 2_f64.sqrt(),
            2 * own.dynamic_intervals?,
        ),
        _ => (own.residual_rms, own.static_intervals?),
    };
    let dof = count.checked_sub(own.rank).filter(|&dof| dof > 0)? as f64;
    Some((rms * rms * count as f64 / dof, dof))
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::calibrate::{Request, calibrate};

    #[test]
    fn a_calibration_is_doubted_where_its_scale_factors_are_twenty_errors_off_and_else_not() {
        let spec = Spec::hand_held(3);
        let mut recording = spec.run().unwrap().recording;
        let request = Request {
            gravity: spec.gravity,
            ..Request::default()
        };
        let made = calibrate(std::slice::from_ref(&recording), &[], &request);
        let mut calibration = made.unwrap().calibration;
        // A sample less is another recording of the same device.
        let streams = [&mut recording.accelerometer, &mut recording.gyroscope];
        for stream in streams.into_iter().flatten() {
            stream.t.pop();
            stream.values.pop();
        }
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let doubts = |calibration: &Calibration| -> Vec<Option<Sensor>> {
            let left = misfits(&recording, &segmentation, Some(calibration), spec.gravity);
            let left = (spec.gravity, &left.unwrap());
            let found = beyond_errors(&recording, &segmentation, calibration, left).unwrap();
            found.iter().map(|found| found.place.sensor).collect()
        };
        assert_eq!(doubts(&calibration), []);
        let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
        for sensor in sensors {
            let own = calibration.triad_mut(sensor).unwrap();
            for (axis, errors) in [20.0, -20.0, 20.0].into_iter().enumerate() {
                own.t[axis][axis] += errors * own.t_std[axis][axis].unwrap();
            }
        }
        assert_eq!(doubts(&calibration), sensors.map(Some));
    }
}
