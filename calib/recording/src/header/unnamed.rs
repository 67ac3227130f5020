//! Columns without a header: what the first rows say of them.

use sensor::Sensor;

use super::dialect::{Cell, Dialect};
use super::preface::{Kept, cells};
use super::row_shape::{ends_empty, usual_width};
use crate::averages::median;
use crate::recording::options::Role;
use crate::rows::number::{self, Dialects};

/// Columns without names as the first rows show them.
pub(crate) struct Unnamed {
    /// The median of every triple of columns' norm: `norms[i]` is that of columns i, i+1, i+2, the time first.
    norms: Vec<f64>,
    /// The columns that may be a sensor's or the time, in their order; the others hold words, or few whole numbers.
    columns: Vec<usize>,
    /// The last column goes up from row to row and the first does not: it is the time.
    time_last: bool,
}

impl Unnamed {
    /// Looks at `rows`.
    pub fn of(rows: &[&Kept], dialect: Dialect) -> Self {
        let width = usual_width(rows, dialect).unwrap_or(0);
        let mut columns = without_labels(rows, dialect, width);
        // A separator at the end of the rows makes no column.
        if ends_empty(rows, dialect) && columns.last() == Some(&width.saturating_sub(1)) {
            columns.pop();
        }
        let mut table = numbers(rows, dialect, width, &columns);
        let width = columns.len();
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
            columns,
            time_last,
        }
    }

    /// Columns that may be a sensor's or the time.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Returns the actual index of column `column`, which is counted with the time first and without other columns.
    fn placed(&self, (role, column): (Role, usize)) -> (Role, usize) {
        let column = match (self.time_last, column) {
            (false, column) => column,
            (true, 0) => self.width() - 1,
            (true, column) => column - 1,
        };
        (role, self.columns[column])
    }

    /// Roles by the known sensor, or by which triad has the length of gravity.
    pub fn roles(&self, only: Option<Sensor>) -> Option<Vec<(Role, usize)>> {
        let roles = unnamed_roles(self.width(), only, &self.norms)?;
        Some(roles.into_iter().map(|role| self.placed(role)).collect())
    }

    /// Roles of both sensors, until it is known which is which: the accelerometer first.
    pub fn two_triads(&self) -> Vec<(Role, usize)> {
        let roles = two_triads(self.width()).into_iter();
        roles.map(|role| self.placed(role)).collect()
    }
}

/// Entries of columns for eight unnamed columns of which the one numbered `slow`, from 1, is no sensor's axis but a
/// temperature's.
pub(crate) fn with_temperature(slow: usize) -> String {
    const AXES: [&str; 6] = ["ax", "ay", "az", "gx", "gy", "gz"];
    let free = (2..=8).filter(|column| *column != slow);
    let axes = AXES.iter().zip(free);
    let axes: Vec<String> = axes
        .map(|(axis, column)| format!("{axis}={column}"))
        .collect();
    format!("t=1,{},temp={slow}", axes.join(","))
}

/// The rows of `width` cells that hold numbers in `columns`: those numbers.
fn numbers(rows: &[&Kept], dialect: Dialect, width: usize, columns: &[usize]) -> Vec<Vec<f64>> {
    rows.iter()
        .filter_map(|row| {
            let cells = cells(&row.bytes, dialect);
            let number = |at: &usize| number_in(row, cells.get(*at)?, dialect);
            let numbers: Option<Vec<f64>> = columns.iter().map(number).collect();
            numbers.filter(|_| cells.len() == width)
        })
        .collect()
}

pub(super) fn number_in(row: &Kept, cell: &Cell, dialect: Dialect) -> Option<f64> {
    let bytes = &row.bytes[cell.clone()];
    number::parse(bytes, dialect.decimal_comma, &mut Dialects::default()).ok()
}

findings::tuning! {
    /// Whole numbers below this may say which device a row is of.
    DEVICES: f64 = 16.0;
    /// Words of which more than one in so many rows is another are no names of devices but stamps.
    ROWS_PER_WORD: usize = 3;
}

/// A number without decimals, or as tables of floating numbers write whole ones: `1.0`; not `0.000`.
fn is_whole(cell: &[u8]) -> bool {
    let decimals = cell.iter().position(|byte| *byte == b'.');
    decimals.is_none_or(|at| matches!(&cell[at + 1..], b"" | b"0"))
}

/// The columns but for those at the ends, and behind the first, that hold words or a few small whole numbers, as devices
/// and states have; all where the rest is no table of sensors.
fn without_labels(rows: &[&Kept], dialect: Dialect, width: usize) -> Vec<usize> {
    let all: Vec<usize> = (0..width).collect();
    let is_label = |at: usize| {
        let mut last = f64::NEG_INFINITY;
        let mut goes_up = rows.len() > 2;
        let mut words = std::collections::HashSet::new();
        let labels = rows.iter().filter_map(|row| {
            let cells = cells(&row.bytes, dialect);
            let cell = cells.get(at).filter(|_| cells.len() == width)?;
            let number = number_in(row, cell, dialect);
            goes_up &= number.is_some_and(|number| number > last);
            last = number.unwrap_or(last);
            Some(match number {
                None => {
                    words.insert(&row.bytes[cell.clone()]);
                    !row.bytes[cell.clone()].is_empty()
                }
                Some(number) => {
                    (0.0..DEVICES.get()).contains(&number) && is_whole(&row.bytes[cell.clone()])
                }
            })
        });
        let labels: Vec<bool> = labels.collect();
        labels.iter().all(|is_label| *is_label)
            && !goes_up
            && (words.len() <= 2 || ROWS_PER_WORD.get() * words.len() <= rows.len())
    };
    let ends = [0, 1, width.wrapping_sub(2), width.wrapping_sub(1)];
    let may_be = |at: &usize| ends.contains(at) && is_label(*at);
    let labels: Vec<usize> = all.iter().copied().filter(may_be).collect();
    let rest: Vec<usize> = all
        .iter()
        .copied()
        .filter(|at| !labels.contains(at))
        .collect();
    // Six axes may come behind a device; of seven columns that begin with the time none is to spare.
    let is_table = match width {
        7 => labels == [0],
        8 => matches!(labels.len(), 1 | 2),
        9 => labels.len() == 2,
        _ => false,
    };
    match is_table {
        true => rest,
        false => all,
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::dialect::Separator;

    fn width(row: impl Fn(usize) -> String) -> Vec<usize> {
        let rows: Vec<Kept> = (0..20)
            .map(|k| Kept {
                number: k as u64 + 1,
                comment: false,
                bytes: row(k).into_bytes(),
            })
            .collect();
        let dialect = Dialect {
            separator: Separator::Byte(b','),
            decimal_comma: false,
        };
        Unnamed::of(&rows.iter().collect::<Vec<_>>(), dialect).columns
    }

    #[test]
    fn devices_are_no_columns_of_sensors() {
        let axes = "0.1,0.2,9.8,0.01,0.02,0.03";
        let found = width(|k| format!("{},{},{axes}", 20 * (k / 2), k % 2));
        assert_eq!(found, [0, 2, 3, 4, 5, 6, 7]);
        assert_eq!(
            width(|k| format!("{},{axes},1", 20 * k)),
            [0, 1, 2, 3, 4, 5, 6]
        );
        assert_eq!(
            width(|k| format!("left,{},{axes}", 20 * k)),
            [1, 2, 3, 4, 5, 6, 7]
        );
        assert_eq!(width(|k| format!("{},{axes}", k % 2)), [1, 2, 3, 4, 5, 6]);
        assert_eq!(width(|_| format!("{axes},")), [0, 1, 2, 3, 4, 5]);
        // Time, six axes and a temperature.
        assert_eq!(width(|k| format!("{},{axes},25.1", 20 * k)).len(), 8);
        assert_eq!(width(|k| format!("{},{axes}", 20 * k)).len(), 7);
    }
}
