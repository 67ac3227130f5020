//! Columns without a header: what the first rows say of them.

use sensor::Sensor;

use super::dialect::{Cell, Dialect};
use super::preface::{Kept, cells};
use super::sniff::usual_width;
use crate::averages::median;
use crate::recording::options::Role;
use crate::rows::number::{self, Dialects};

/// The median of every triple of columns' norm: `norms[i]` is that of columns i, i+1, i+2.
pub(crate) fn medians(rows: &[&Kept], dialect: Dialect) -> Vec<f64> {
    let width = usual_width(rows, dialect).unwrap_or(0);
    let table: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| {
            let value = |cell: Cell| {
                number::parse(
                    &row.bytes[cell],
                    dialect.decimal_comma,
                    &mut Dialects::default(),
                )
            };
            cells(&row.bytes, dialect)
                .into_iter()
                .filter_map(|cell| value(cell).ok())
                .collect()
        })
        .filter(|row: &Vec<f64>| row.len() == width)
        .collect();
    (0..width.saturating_sub(2))
        .filter_map(|i| {
            let norm = |row: &Vec<f64>| row[i].hypot(row[i + 1]).hypot(row[i + 2]);
            median(table.iter().map(norm))
        })
        .collect()
}

/// Roles of unnamed columns of both sensors, until it is known which is which: the accelerometer first.
pub(crate) fn two_triads(width: usize) -> Vec<(Role, usize)> {
    let time = usize::from(width > 6);
    let stamps = (0..time).map(|i| (Role::Time, i));
    let axes = (0..3).flat_map(|i| [(Role::Accel(i), time + i), (Role::Gyro(i), time + 3 + i)]);
    stamps.chain(axes).collect()
}

/// Roles of unnamed columns: by the known sensor, or by which triad has the length of gravity.
pub(crate) fn unnamed_roles(
    width: usize,
    only: Option<Sensor>,
    norms: &[f64],
) -> Option<Vec<(Role, usize)>> {
    let gravity = |i: usize| {
        norms
            .get(i)
            .is_some_and(|n| (7.0..13.0).contains(n) || (0.8..1.25).contains(n))
    };
    let accel = |at: usize| (0..3).map(move |i| (Role::Accel(i), at + i));
    let gyro = |at: usize| (0..3).map(move |i| (Role::Gyro(i), at + i));
    let time = usize::from(matches!(width, 4 | 7));
    let mut roles: Vec<(Role, usize)> = (0..time).map(|i| (Role::Time, i)).collect();
    match (width, only) {
        (3 | 4, Some(Sensor::Accelerometer)) => roles.extend(accel(time)),
        (3 | 4, Some(Sensor::Gyroscope)) => roles.extend(gyro(time)),
        (3 | 4, None) if gravity(time) => roles.extend(accel(time)),
        (6 | 7, None) => match (gravity(time), gravity(time + 3)) {
            (true, false) => roles.extend(accel(time).chain(gyro(time + 3))),
            (false, true) => roles.extend(gyro(time).chain(accel(time + 3))),
            _ => return None,
        },
        _ => return None,
    }
    Some(roles)
}
