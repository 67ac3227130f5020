//! Test of a calibration's standard errors on a recording that it was not made from.

use findings::{Finding, Kind};
use nalgebra::{DMatrix, DVector};
use recording::intervals::Segmentation;
use recording::{Error, Recording, Stream};
use sensor::{Sensor, base_names, is_bias};

use super::misfits::{Misfits, Miss, misfits, unspoilt};
use crate::calibration::{Calibration, Triad};
use crate::methods::chance;

findings::tuning! {
    /// Chance of that a recording of the same device misses gravity by more than the errors allow.
    BY_CHANCE: f64 = 1e-4;

    /// Static intervals or turns that are judged.
    ENOUGH: usize = 6;

    /// Readings that are corrected, once for each parameter: of more the test is left out.
    MOST_WORK: usize = 30_000_000;
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
    let count = calibration.parameters.len();
    let streams = [&recording.accelerometer, &recording.gyroscope];
    let rows: usize = streams.into_iter().flatten().map(Stream::len).sum();
    if count * rows > MOST_WORK.get() {
        return Ok(Vec::new());
    }
    let stated = calibration.covariance_matrix();
    if stated.nrows() != count || calibration.was_made_from(recording) != Some(false) {
        return Ok(Vec::new());
    }
    let covariance = with_motion_of_biases(calibration, stated.clone());
    let deviations: Vec<f64> = (0..count)
        .map(|k| covariance[(k, k)].max(0.0).sqrt())
        .collect();
    let moved = deviations.iter().enumerate().map(|(k, deviation)| {
        let mut values = calibration.parameter_values();
        values[k] += deviation;
        let mut other = calibration.clone();
        other.write_parameters(&values, &stated);
        misfits(recording, segmentation, Some(&other), gravity)
    });
    let promised = Promised {
        calibration,
        left,
        moved: moved.collect::<Result<_, _>>()?,
        correlation: DMatrix::from_fn(count, count, |i, k| {
            let scale = deviations[i] * deviations[k];
            if scale > 0.0 {
                covariance[(i, k)] / scale
            } else {
                0.0
            }
        }),
    };
    let of_force = promised.missed(Sensor::Accelerometer);
    let of_rate = promised.missed(Sensor::Gyroscope);
    let found = of_force.into_iter().chain(of_rate);
    Ok(found.map(|own| own.in_recording(&recording.name)).collect())
}

/// The covariance of the parameters, that of the biases with their motion in the calibration's own recordings.
fn with_motion_of_biases(calibration: &Calibration, mut covariance: DMatrix<f64>) -> DMatrix<f64> {
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let triad = calibration.triad(sensor);
        let Some(time) = triad.and_then(|own| own.bias_time.as_ref()) else {
            continue;
        };
        let names = base_names(sensor).into_iter().filter(|name| is_bias(name));
        for (axis, name) in names.enumerate() {
            let variance = time.change[axis].powi(2) + time.change_std[axis].powi(2);
            for (k, parameter) in calibration.parameters.iter().enumerate() {
                if parameter.split('[').next() == Some(&name) {
                    covariance[(k, k)] += variance;
                }
            }
        }
    }
    covariance
}

/// Remainders of a recording under a calibration, and their derivatives by its parameters.
struct Promised<'a> {
    calibration: &'a Calibration,
    left: &'a Misfits,
    /// The remainders where a parameter is one standard error larger, for each parameter.
    moved: Vec<Misfits>,
    correlation: DMatrix<f64>,
}

impl Promised<'_> {
    /// The finding about a sensor that misses gravity by more.
    fn missed(&self, sensor: Sensor) -> Option<Finding> {
        let (of, unit, affected): (fn(&Misfits) -> &[Miss], _, _) = match sensor {
            Sensor::Gyroscope => (|own| &own.directions, "rad", "turn"),
            _ => (|own| &own.norms, "m/s^2", "corrected_reading"),
        };
        let (usual, usual_dof) = usual(sensor, self.calibration.triad(sensor)?)?;
        let left = of(self.left);
        let kept = unspoilt(left, Miss::size);
        let is_whole = self.moved.iter().all(|own| of(own).len() == left.len());
        if !is_whole || kept.len() < ENOUGH.get() {
            return None;
        }
        let components = |place: usize| (0..left[place].count).map(move |i| (place, i));
        let rows: Vec<(usize, usize)> = kept.iter().copied().flat_map(components).collect();
        let value = |all: &[Miss], row: usize| all[rows[row].0].value[rows[row].1];
        let precision = |row: usize, _| left[rows[row].0].variance.max(usual).recip();
        let precision = DVector::from_fn(rows.len(), precision);
        let missed = DVector::from_fn(rows.len(), |row, _| value(left, row));
        let by_errors = DMatrix::from_fn(rows.len(), self.moved.len(), |row, k| {
            value(of(&self.moved[k]), row) - value(left, row)
        });
        let square = self.squared(&missed, &by_errors, &precision)?;
        // Of the three components of a turn's miss one is along gravity, and nothing.
        let dof = kept.iter().map(|&k| left[k].count.min(2)).sum::<usize>() as f64;
        if chance::of_f(square / dof, [dof, usual_dof]) > BY_CHANCE.get() {
            return None;
        }
        let rms = (missed.norm_squared() / kept.len() as f64).sqrt();
        let found = Finding::of(Kind::BEYOND_ERRORS)
            .of_sensor(sensor)
            .number("rms", rms, unit)
            .number("ratio", (square / dof).sqrt(), "1");
        Some(found.affects(affected, rms, unit))
    }

    /// `rᵀ (D + B C Bᵀ)⁻¹ r` with `D⁻¹` the `precision` and `C` the correlation of the parameters, by the matrices of the parameters alone
    /// (Woodbury): `rᵀ D⁻¹ r − bᵀ (1 + C G)⁻¹ C b` with `b = Bᵀ D⁻¹ r` and `G = Bᵀ D⁻¹ B`.
    fn squared(
        &self,
        r: &DVector<f64>,
        by_errors: &DMatrix<f64>,
        precision: &DVector<f64>,
    ) -> Option<f64> {
        let mut weighted = by_errors.clone();
        for (mut row, precision) in weighted.row_iter_mut().zip(precision.iter()) {
            row *= *precision;
        }
        let b = weighted.transpose() * r;
        let gram = by_errors.transpose() * &weighted;
        let count = self.correlation.nrows();
        let inner = DMatrix::identity(count, count) + &self.correlation * gram;
        let solved = inner.lu().solve(&(&self.correlation * &b))?;
        Some(r.component_mul(precision).dot(r) - b.dot(&solved))
    }
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
