//! Accelerometer and gyroscope under each other's names.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;

use super::decide::length_of_gravity;
use super::{GyroUnit, STANDARD_GRAVITY, rests};
use crate::Error;
use crate::recording::Stream;
use crate::recording::options::{ReadOptions, Role};
use crate::recording::samples::Samples;
use crate::rows::table::Table;
use crate::shown::significant;
use crate::source::place::in_file;

findings::tuning! {
    /// The mean direction of readings is no longer than this where they turn.
    TURNED: f64 = 0.9;

    /// Readings whose length differs from the usual one by less than this share of it keep it.
    KEEPS: f64 = 0.1;
}

/// The length of gravity that readings of several directions keep. A gyroscope at rest keeps that of its bias, in the bias's direction:
/// the directions it takes while it turns are of other lengths.
fn turning_gravity(values: &[Vector3<f64>]) -> Option<f64> {
    let length = length_of_gravity(values)?;
    let keeps = |value: &&Vector3<f64>| (value.norm() - length).abs() < KEEPS.get() * length;
    let directions = values.iter().filter(keeps);
    let directions: Vec<Vector3<f64>> = directions.map(|value| value / value.norm()).collect();
    let mean = directions.iter().sum::<Vector3<f64>>() / directions.len().max(1) as f64;
    (mean.norm() < TURNED.get()).then_some(length)
}

findings::tuning! {
    /// Largest part by which the length of readings at rest differs from that of gravity: biases and scale factors of an accelerometer
    /// that nobody has calibrated make less.
    NEAR: f64 = 0.08;
}

/// The length of gravity in m/s² or in g, near to which all readings are.
fn resting_gravity(values: &[Vector3<f64>]) -> Option<f64> {
    let mean = values.iter().sum::<Vector3<f64>>().norm() / values.len().max(1) as f64;
    let lengths = [1.0, STANDARD_GRAVITY].into_iter();
    let length =
        lengths.min_by(|a, b| (mean / a - 1.0).abs().total_cmp(&(mean / b - 1.0).abs()))?;
    let is_near = |v: f64| (v / length - 1.0).abs() < NEAR.get();
    let far = values.iter().filter(|v| !is_near(v.norm())).count();
    (is_near(mean) && 20 * far < values.len()).then_some(mean)
}

/// Refuses a gyroscope whose readings keep the length of gravity in several directions, in no unit that anybody says: they are an
/// accelerometer's, or gravity beside it.
fn refuse_force(table: &Table, is_alone: bool, options: &ReadOptions) -> Result<(), Error> {
    let said = options.gyro_unit.or(table.stated.gyro);
    let values = &table.gyro.values;
    // Alone and at rest no rate is as long as gravity but by chance.
    let length = match is_alone {
        true => turning_gravity(values).or_else(|| resting_gravity(values)),
        false => turning_gravity(values),
    };
    let Some(length) = length.filter(|_| said.is_none()) else {
        return Ok(());
    };
    let force = Finding::of(Kind::FORCE_AS_RATE).detail("length", significant(length, 3));
    let columns = exchanged(table).filter(|_| is_alone);
    let columns = columns
        .as_deref()
        .map(|columns| (OptionName::Columns, columns));
    let unit = (OptionName::GyroUnit, GyroUnit::RadiansPerSecond.name());
    let remedy = Remedy::examples(columns.into_iter().chain([unit]));
    Err(in_file(&table.name, force.only_remedies([remedy])))
}

/// Refuses sensors whose names are each other's: a mean that turns from rest to rest is an accelerometer's. Their units play no
/// part.
///
/// # Errors
/// [`Error::Input`] with the columns as they should be read.
pub(crate) fn refuse(tables: &[Table], options: &ReadOptions) -> Result<(), Error> {
    let accel = tables.iter().find(|table| !table.accel.t.is_empty());
    let gyro = tables.iter().find(|table| !table.gyro.t.is_empty());
    let (of_accel, of_gyro) = match (accel, gyro) {
        (Some(accel), Some(gyro)) => (accel, gyro),
        (None, Some(gyro)) => return refuse_force(gyro, true, options),
        _ => return Ok(()),
    };
    let (accel, gyro) = (&of_accel.accel, &of_gyro.gyro);
    if turning_gravity(&accel.values).is_some() {
        refuse_force(of_gyro, false, options)?;
    }
    let same_rows = accel.t.len() == gyro.t.len();
    let matched = match same_rows {
        true => None,
        false => at_stamps(accel, &gyro.t),
    };
    let first = match (&matched, same_rows) {
        (Some(matched), _) => matched,
        (None, true) => &accel.values,
        (None, false) => return Ok(()),
    };
    // On a rate table the rate is another in every placement, but gravity is where it should be. Without it, a rate is still of
    // no length of its own.
    let swapped = rests::accelerometer([first, &gyro.values]) == Some(1)
        && !rests::has_gravity(first)
        && rests::is_gravity(first, &gyro.values);
    if !swapped {
        return Ok(());
    }
    let one_table = std::ptr::eq(of_accel, of_gyro);
    let swapped = Finding::of(Kind::SENSORS_SWAPPED);
    Err(in_file(
        &of_gyro.name,
        match exchanged(of_accel).filter(|_| one_table) {
            Some(columns) => swapped.remedy(Remedy::set_to(OptionName::Columns, columns)),
            None => swapped
                .detail("files", "the files")
                .remedy(Remedy::set(OptionName::Columns)),
        },
    ))
}

/// Readings at other stamps; `None` where the clocks do not meet.
fn at_stamps(samples: &Samples, stamps: &[f64]) -> Option<Vec<Vector3<f64>>> {
    let stream = Stream {
        t: samples.t.clone(),
        values: samples.values.clone(),
    };
    stamps.iter().map(|&t| stream.at(t)).collect()
}

/// The columns of both sensors, each under the other's names.
fn exchanged(table: &Table) -> Option<String> {
    let other = |role: &Role| match *role {
        Role::Accel(axis) => Some(Role::Gyro(axis)),
        Role::Gyro(axis) => Some(Role::Accel(axis)),
        _ => None,
    };
    let all = table.roles.iter();
    let all = all.filter_map(|(role, column)| Some(format!("{}={column}", other(role)?.name())));
    let all: Vec<String> = all.collect();
    matches!(all.len(), 3 | 6).then(|| all.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Recording;

    #[test]
    fn an_accelerometer_under_the_names_of_a_gyroscope_is_refused_with_its_columns() {
        let row = |k: u32| {
            let angle = 0.01 * f64::from(k);
            let (t, x, z) = (angle, angle.sin(), angle.cos());
            format!("{t},{x:.4},{:.4},{z:.4}\n", 0.01 * angle)
        };
        let rows: String = (0..500).map(row).collect();
        let read = |names: &str, options: &ReadOptions| {
            let text = format!("{names}\n{rows}");
            Recording::from_bytes("a.csv", text.as_bytes(), options)
        };
        let untold = ReadOptions::default();
        let error = read("t,gx,gy,gz", &untold).unwrap_err();
        let text = error.finding().text(findings::Front::CommandLine);
        assert!(text.contains("ax=gx,ay=gy,az=gz"), "{text}");
        let rates = ReadOptions {
            gyro_unit: Some(GyroUnit::RadiansPerSecond),
            ..Default::default()
        };
        assert!(read("t,gx,gy,gz", &rates).is_ok());
        assert!(read("t,gx (g),gy (g),gz (g)", &untold).is_ok());
        // At rest in one placement, in m/s² and as a rate of another length.
        let at_rest = |up: f64| {
            let noise = |k: u32| 1e-4 * f64::from(k * k * 31 % 101);
            let row = |k: u32| {
                let (t, x, y, z) = (0.01 * f64::from(k), noise(k), noise(k + 7), noise(k + 31));
                format!("{t},{x},{y},{}\n", up + z)
            };
            let rows: String = (0..500).map(row).collect();
            Recording::from_bytes("a.csv", format!("t,gx,gy,gz\n{rows}").as_bytes(), &untold)
        };
        let refused =
            |up| matches!(at_rest(up), Err(error) if error.finding().kind == Kind::FORCE_AS_RATE);
        assert!(refused(9.81) && refused(0.95));
        assert!(at_rest(2.5).is_ok() && at_rest(0.02).is_ok());
    }

    #[test]
    fn a_bias_of_the_length_of_gravity_is_no_gravity() {
        for length in [1.0, 1.19, 9.8] {
            let bias = Vector3::new(0.6, -0.64, 0.48) * length;
            // Rests of 3.2 s and turns of 0.8 s about other axes, at 100 Hz.
            let value = |k: usize| {
                let (phase, turn) = (k % 400, k / 400);
                let axis = Vector3::ith(turn % 3, if turn % 2 == 0 { 60.0 } else { -60.0 });
                let rate = if phase < 320 {
                    0.0
                } else {
                    0.02 * (phase - 320) as f64
                };
                let noise = 0.02 * (k as f64 * 1.7).sin();
                bias + axis * rate + Vector3::repeat(noise)
            };
            let values: Vec<Vector3<f64>> = (0..8000).map(value).collect();
            assert_eq!(turning_gravity(&values), None, "{length}");
        }
    }
}
