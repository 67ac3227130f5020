//! Columns as the first rows of a table show them, where no name does: an example of `--columns` to be checked.

use findings::{OptionName, Remedy};

use super::suggest::{entry, suggestion, time as by_name};
use crate::averages::median;
use crate::header::dialect::{Cell, Dialect};
use crate::header::preface::{Kept, cells};
use crate::header::row_shape::usual_width;
use crate::header::unnamed::number_in;
use crate::recording::options::Role;

/// Lengths of gravity, m/s².
const IN_SI: std::ops::Range<f64> = 7.0..13.0;

findings::tuning! {
    /// A gyroscope at the beginning of a recording is at rest and reads less than this, in degrees per second or less.
    SLOWEST: f64 = 20.0;
    /// Rows that show that a column goes up.
    FEWEST: usize = 5;
}

/// The numbers of every column in the rows that are as wide as most; `None` for a column that holds another thing, or one number.
fn changing(rows: &[&Kept], dialect: Dialect) -> Option<Vec<Option<Vec<f64>>>> {
    let width = usual_width(rows, dialect)?;
    let each = rows.iter().map(|row| (row, cells(&row.bytes, dialect)));
    let whole: Vec<_> = each.filter(|(_, cells)| cells.len() == width).collect();
    let column = |at: usize| -> Option<Vec<f64>> {
        let number = |(row, cells): &(&&Kept, Vec<Cell>)| number_in(row, &cells[at], dialect);
        let numbers: Vec<f64> = whole.iter().map(number).collect::<Option<_>>()?;
        let first = *numbers.first()?;
        numbers.iter().any(|n| *n != first).then_some(numbers)
    };
    Some((0..width).map(column).collect())
}

/// True for numbers that never fall.
fn goes_up(numbers: &[f64]) -> bool {
    numbers.len() >= FEWEST.get() && numbers.windows(2).all(|pair| pair[0] <= pair[1])
}

/// True for numbers that go up from row to row by other steps than one, as no counter of rows does.
fn ticks(numbers: &[f64]) -> bool {
    let counts = || numbers.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
    goes_up(numbers) && numbers.windows(2).all(|pair| pair[0] < pair[1]) && !counts()
}

/// Returns the first free column whose numbers go up as those of a clock do.
pub(crate) fn rising(
    rows: &[&Kept],
    dialect: Dialect,
    is_free: impl Fn(usize) -> bool,
) -> Option<usize> {
    let changing = changing(rows, dialect)?;
    (0..changing.len()).find(|at| is_free(*at) && is_so(&changing[*at], ticks))
}

/// True for a column of numbers of this kind.
fn is_so(column: &Option<Vec<f64>>, kind: fn(&[f64]) -> bool) -> bool {
    column.as_deref().is_some_and(kind)
}

/// True if the first cell of every row is a time of day, with its date or without.
fn begins_with_clock(rows: &[&Kept], dialect: Dialect) -> bool {
    let is_clock = |row: &&Kept| {
        let cell = cells(&row.bytes, dialect).first().cloned();
        let cell = cell.map_or(&b""[..], |cell| &row.bytes[cell]);
        cell.first().is_some_and(u8::is_ascii_digit) && cell.contains(&b':')
    };
    rows.len() >= FEWEST.get() && rows.iter().all(is_clock)
}

/// The column of the time: a clock's in front, or numbers that go up, be it with the rows.
fn time(rows: &[&Kept], dialect: Dialect, changing: &[Option<Vec<f64>>]) -> Option<usize> {
    if begins_with_clock(rows, dialect) {
        return Some(0);
    }
    let first = |kind| changing.iter().position(|column| is_so(column, kind));
    first(ticks).or_else(|| first(goes_up))
}

/// True if every cell of the rows is a number.
fn are_numbers(rows: &[&Kept], dialect: Dialect) -> bool {
    let is_number = |row: &Kept, cell: &Cell| number_in(row, cell, dialect).is_some();
    rows.iter().all(|row| {
        let cells = cells(&row.bytes, dialect);
        cells.iter().all(|cell| is_number(row, cell))
    })
}

/// Returns an example for a table whose rows do not tell the sensors: the time by its numbers, and columns of numbers in their order;
/// `None` where fewer than three hold any and others hold words.
pub(crate) fn example(rows: &[&Kept], dialect: Dialect, names: &[String]) -> Option<Remedy> {
    let changing = changing(rows, dialect)?;
    let time = by_name(names).or_else(|| time(rows, dialect, &changing));
    let may_be = |at: &usize| {
        let is_time = Some(*at) == time;
        let numbers = changing[*at].as_ref();
        *at < names.len() && !is_time && numbers.is_some_and(|n| !goes_up(n))
    };
    let free: Vec<usize> = (0..changing.len()).filter(may_be).collect();
    let axes = match free.len() {
        // Of a table of numbers any example shows how it is said.
        0..3 => return are_numbers(rows, dialect).then(|| suggestion(names)),
        3..6 => 3,
        _ => 6,
    };
    let roles = ["ax", "ay", "az", "gx", "gy", "gz"].into_iter();
    let sensors = roles.zip(free).take(axes);
    let time = time.filter(|at| *at < names.len()).map(|at| ("t", at));
    let entries = time.into_iter().chain(sensors);
    let entries: Vec<String> = entries
        .map(|(role, at)| format!("{role}={}", entry(names, at)))
        .collect();
    Some(Remedy::such_as(OptionName::Columns, entries.join(",")))
}

/// The columns of an accelerometer by its length of gravity, and of a gyroscope beside it, in a table of any width, behind the
/// time where the first goes up; an example to be checked.
pub(crate) fn likely(rows: &[&Kept], dialect: Dialect) -> Option<Vec<(Role, usize)>> {
    let changing = changing(rows, dialect)?;
    let width = changing.len();
    let time = time(rows, dialect, &changing);
    // Behind the sensors it is the last column or so.
    let begin = time.filter(|at| 2 * at < width).map_or(0, |at| at + 1);
    let norm = |from: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| changing.get(from + axis)?.as_ref());
        let (x, y, z) = (x?, y?, z?);
        median((0..x.len()).map(|k| x[k].hypot(y[k]).hypot(z[k])))
    };
    let of_length = |lengths: std::ops::Range<f64>| {
        let is_it = move |from: &usize| norm(*from).is_some_and(|norm| lengths.contains(&norm));
        (begin..width).filter(is_it)
    };
    // A quaternion has the length 1 too, and what is turned into the frame of the earth comes behind what was read.
    let mut in_g = of_length(0.8..1.25);
    let one_in_g = in_g
        .next()
        .filter(|first| in_g.all(|other| other < first + 3));
    let accel = of_length(IN_SI).next().or(one_in_g)?;
    let beside = [Some(accel + 3), accel.checked_sub(3)];
    let beside = beside.into_iter().flatten().filter(|from| *from >= begin);
    let lengths = beside.filter_map(|from| Some((from, norm(from)?)));
    // Of a field and a rate the rate is less.
    let gyro = lengths
        .filter(|(_, length)| *length < SLOWEST.get() && !IN_SI.contains(length))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(from, _)| from);
    let accel = (0..3).map(|axis| (Role::Accel(axis), accel + axis));
    let gyro = gyro.map(|from| (0..3).map(move |axis| (Role::Gyro(axis), from + axis)));
    let sensors = accel.chain(gyro.into_iter().flatten());
    let time = time.map(|at| (Role::Time, at));
    Some(time.into_iter().chain(sensors).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::dialect::Separator;

    const COMMAS: Dialect = Dialect {
        separator: Separator::Byte(b','),
        decimal_comma: false,
    };

    fn twenty(row: &dyn Fn(usize) -> String) -> Vec<Kept> {
        let kept = (0..20).map(|k| Kept {
            number: k as u64 + 1,
            comment: false,
            bytes: row(k).into_bytes(),
        });
        kept.collect()
    }

    #[test]
    fn gravity_shows_the_accelerometer_in_a_wide_table() {
        let likely_of = |row: &dyn Fn(usize) -> String| {
            let rows = twenty(row);
            let found = likely(&rows.iter().collect::<Vec<_>>(), COMMAS)?;
            Some(found.into_iter().map(|(_, at)| at).collect::<Vec<_>>())
        };
        let noise = |k: usize, axis: usize| ((7 * k + 3 * axis) % 11) as f64 * 1e-3;
        let triad = |k: usize, x: f64, z: f64| {
            format!("{},{},{}", x + noise(k, 0), noise(k, 1), z + noise(k, 2))
        };
        // A quaternion, the rate, the specific force, the field.
        let wide = |k: usize| {
            let [rate, force, field] =
                [(0.01, 0.02), (0.1, 9.8), (20.0, -40.0)].map(|(x, z)| triad(k, x, z));
            format!("{k},0.5,0.5,0.5,0.5,{rate},{force},{field}")
        };
        assert_eq!(likely_of(&wide), Some(vec![0, 8, 9, 10, 5, 6, 7]));
        // The field in gauss behind the accelerometer.
        let gauss = |k: usize| {
            let [rate, force, field] =
                [(0.01, 0.02), (0.1, 9.8), (0.2, -0.4)].map(|(x, z)| triad(k, x, z));
            format!("{k},{rate},{force},{field}")
        };
        assert_eq!(likely_of(&gauss), Some(vec![0, 4, 5, 6, 1, 2, 3]));
        // Light, a button and a temperature behind.
        let still = |k: usize| format!("2023-07-22 04:26:{k},{},12,0,25.0", triad(k, 0.01, 1.0));
        assert_eq!(likely_of(&still), Some(vec![0, 1, 2, 3]));
        let untimed = |k: usize| format!("{},{},5,6,7", triad(k, 0.1, 9.8), triad(k, 0.01, 0.02));
        assert_eq!(likely_of(&untimed), Some(vec![0, 1, 2, 3, 4, 5]));
        assert_eq!(likely_of(&|k| format!("{k},{}", triad(k, 3.0, 3.0))), None);
    }

    #[test]
    fn an_example_names_the_time_where_one_goes_up_and_columns_of_numbers() {
        let of = |names: &[&str], row: &dyn Fn(usize) -> String| {
            let rows = twenty(row);
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            let found = example(&rows.iter().collect::<Vec<_>>(), COMMAS, &names)?;
            match found {
                Remedy::Example { any_of } => any_of[0].value.clone(),
                other => panic!("{other:?}"),
            }
        };
        let noise = |k: usize| (7 * k) % 11;
        let triad = |k: usize| format!("{},{},{}", noise(k), noise(k + 1), noise(k + 2));
        // No column is the time, and a word is no number.
        let untimed = of(&["1", "2", "3", "4"], &|k| format!("a,{}", triad(k)));
        assert_eq!(untimed.as_deref(), Some("ax=2,ay=3,az=4"));
        let counted = |k: usize| format!("{k},{},{},{}", 20 * k, triad(k), triad(k + 3));
        let counted = of(&["n", "clk", "a", "b", "c", "d", "e", "f"], &counted);
        assert_eq!(
            counted.as_deref(),
            Some("t=clk,ax=a,ay=b,az=c,gx=d,gy=e,gz=f")
        );
        let dated = of(&["1", "2", "3", "4"], &|k| {
            format!("1/5/24 10:00:{},{}", k, triad(k))
        });
        assert_eq!(dated.as_deref(), Some("t=1,ax=2,ay=3,az=4"));
        assert_eq!(of(&["1", "2"], &|k| format!("{},can0", noise(k))), None);
    }
}
