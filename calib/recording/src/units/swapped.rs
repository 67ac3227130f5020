//! Accelerometer and gyroscope under each other's names.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;

use super::rests;
use crate::Error;
use crate::recording::Stream;
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::rows::table::Table;
use crate::source::place::in_file;

/// Refuses sensors whose names are each other's: a mean that turns from rest to rest is an accelerometer's. Their units play no
/// part.
///
/// # Errors
/// [`Error::Input`] with the columns as they should be read.
pub(crate) fn refuse(tables: &[Table]) -> Result<(), Error> {
    let accel = tables.iter().find(|table| !table.accel.t.is_empty());
    let gyro = tables.iter().find(|table| !table.gyro.t.is_empty());
    let (Some(of_accel), Some(of_gyro)) = (accel, gyro) else {
        return Ok(());
    };
    let (accel, gyro) = (&of_accel.accel, &of_gyro.gyro);
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
    let swapped = Finding::of(Kind::SensorsSwapped);
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
    (all.len() == 6).then(|| all.join(","))
}
