//! Columns without a header: what the first rows say of them.

use sensor::Sensor;

use super::dialect::{Cell, Dialect};
use super::preface::{Kept, cells};
use super::row_shape::usual_width;
use crate::averages::median;
use crate::recording::options::Role;
use crate::rows::number::{self, Dialects};

/// Columns without names as the first rows show them.
pub(crate) struct Unnamed {
    /// The median of every triple of columns' norm: `norms[i]` is that of columns i, i+1, i+2, the time first.
    norms: Vec<f64>,
    width: usize,
    /// The last column goes up from row to row and the first does not: it is the time.
    time_last: bool,
}

impl Unnamed {
    /// Looks at `rows`.
    pub fn of(rows: &[&Kept], dialect: Dialect) -> Self {
        let width = usual_width(rows, dialect).unwrap_or(0);
        let mut table = numbers(rows, dialect, width);
        let goes_up = |column: usize| {
            let pairs = table.windows(2);
            let mut steps = pairs.map(|pair| pair[1][column] - pair[0][column]);
            table.len() > 2 && steps.all(|step| step > 0.0)
        };
        let time_last = matches!(width, 4 | 7 | 8) && !goes_up(0) && goes_up(width - 1);
        if time_last {
            table.iter_mut().for_each(|row| row.rotate_right(1));
        }
        let norms = (0..width.saturating_sub(2))
            .filter_map(|i| {
                let norm = |row: &Vec<f64>| row[i].hypot(row[i + 1]).hypot(row[i + 2]);
                median(table.iter().map(norm))
            })
            .collect();
        Self {
            norms,
            width,
            time_last,
        }
    }

    /// Where a column is that would be `column` if the time came first.
    fn placed(&self, (role, column): (Role, usize)) -> (Role, usize) {
        match (self.time_last, column) {
            (false, column) => (role, column),
            (true, 0) => (role, self.width - 1),
            (true, column) => (role, column - 1),
        }
    }

    /// Roles by the known sensor, or by which triad has the length of gravity.
    pub fn roles(&self, only: Option<Sensor>) -> Option<Vec<(Role, usize)>> {
        let roles = unnamed_roles(self.width, only, &self.norms)?;
        Some(roles.into_iter().map(|role| self.placed(role)).collect())
    }

    /// Roles of both sensors, until it is known which is which: the accelerometer first.
    pub fn two_triads(&self) -> Vec<(Role, usize)> {
        let roles = two_triads(self.width).into_iter();
        roles.map(|role| self.placed(role)).collect()
    }
}

/// A `--columns` line for eight unnamed columns of which the one numbered `slow`, from 1, is no sensor's axis but a
/// temperature's.
pub(crate) fn with_temperature(slow: usize) -> String {
    const AXES: [&str; 6] = ["ax", "ay", "az", "gx", "gy", "gz"];
    let free = (2..=8).filter(|column| *column != slow);
    let axes = AXES.iter().zip(free);
    let axes: Vec<String> = axes
        .map(|(axis, column)| format!("{axis}={column}"))
        .collect();
    format!("--columns 't=1,{},temp={slow}'", axes.join(","))
}

/// The rows that are `width` numbers.
fn numbers(rows: &[&Kept], dialect: Dialect, width: usize) -> Vec<Vec<f64>> {
    rows.iter()
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
        .collect()
}

/// Roles of unnamed columns of both sensors, until it is known which is which: the accelerometer first.
fn two_triads(width: usize) -> Vec<(Role, usize)> {
    let time = usize::from(width > 6);
    let stamps = (0..time).map(|i| (Role::Time, i));
    let axes = (0..3).flat_map(|i| [(Role::Accel(i), time + i), (Role::Gyro(i), time + 3 + i)]);
    stamps.chain(axes).collect()
}

/// Roles of unnamed columns: by the known sensor, or by which triad has the length of gravity.
fn unnamed_roles(width: usize, only: Option<Sensor>, norms: &[f64]) -> Option<Vec<(Role, usize)>> {
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
