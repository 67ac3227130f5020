//! Cells of a row of comma-separated text.

use std::fmt::Write as _;
use std::io::Write;

use findings::{Finding, Kind};

use crate::Error;
use crate::error::counted;

/// A cell before it is written.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    /// Nothing.
    Empty,
    /// A whole number.
    Whole(i64),
    /// The same beyond 2⁶³.
    Unsigned(u64),
    /// A number of 32 bits, written in as few digits as tell it from its neighbours.
    Single(f32),
    /// A number of 64 bits, written in the same way.
    Double(f64),
    /// Words.
    Text(String),
}

impl Cell {
    /// Adds the cell to `row`.
    pub fn write(&self, row: &mut String) {
        // Writing to a string does not fail.
        let _ = match self {
            Self::Empty => Ok(()),
            Self::Whole(number) => write!(row, "{number}"),
            Self::Unsigned(number) => write!(row, "{number}"),
            // With an exponent where there would be many zeros.
            Self::Single(number) => write!(row, "{number:?}"),
            Self::Double(number) => write!(row, "{number:?}"),
            Self::Text(words) => {
                row.push_str(&quoted(words));
                Ok(())
            }
        };
    }
}

/// Words as a cell: in quotes where a separator is within, on one line, so that a row stays a line.
pub(super) fn quoted(words: &str) -> String {
    let line: String = words
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    match line.contains([',', ';', '"']) {
        true => format!("\"{}\"", line.replace('"', "\"\"")),
        false => line,
    }
}

/// Writes `cells` as a row; `line` is scratch space.
pub(super) fn write<'a>(
    out: &mut dyn Write,
    line: &mut String,
    cells: impl Iterator<Item = &'a Cell>,
) -> Result<(), Error> {
    line.clear();
    for (at, cell) in cells.enumerate() {
        line.push_str(if at == 0 { "" } else { "," });
        cell.write(line);
    }
    line.push('\n');
    out.write_all(line.as_bytes())?;
    Ok(())
}

/// A line of names.
pub(super) fn header(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
    names.join(",") + "\n"
}

/// A name with its unit in brackets, unless it has one.
pub(super) fn with_unit(name: &str, unit: Option<&str>) -> String {
    match unit.map(str::trim).filter(|unit| !unit.is_empty()) {
        Some(unit) if !name.trim_end().ends_with([')', ']']) => format!("{name} ({unit})"),
        _ => name.to_owned(),
    }
}

/// Refuses more rows than the limit.
pub(super) fn check(rows: u64, limit: u64) -> Result<(), Error> {
    match rows > limit {
        true => {
            let found = counted(Finding::of(Kind::TABLE_TOO_LONG), "rows", rows);
            Err(Error::refused(counted(found, "limit", limit)))
        }
        false => Ok(()),
    }
}

/// Refuses more cells than a file of `length` bytes holds of readings, however well it is packed: their text takes time.
#[cfg(any(feature = "parquet", feature = "hdf5"))]
pub(super) fn check_cells(
    rows: u64,
    columns: usize,
    length: u64,
    limits: crate::Limits,
) -> Result<(), Error> {
    /// Number of cells that is allowed in a file of any length.
    const ALWAYS: u64 = 1 << 20;
    let cells = rows.saturating_mul(columns as u64);
    match cells > ALWAYS && cells / limits.ratio > length {
        true => {
            let found = counted(Finding::of(Kind::CELLS_TOO_MANY), "cells", cells);
            Err(Error::refused(counted(found, "length", length)))
        }
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_back_as_they_were() {
        for number in [0.1, -9.806_65, 1e-300, 1.7e18, f64::MIN_POSITIVE, 3.0] {
            let mut row = String::new();
            Cell::Double(number).write(&mut row);
            assert_eq!(row.parse::<f64>(), Ok(number));
        }
    }

    #[test]
    fn numbers_of_32_bits_have_no_more_digits_than_tell_them_apart() {
        let mut row = String::new();
        Cell::Single(0.1).write(&mut row);
        assert_eq!(row, "0.1");
    }

    #[test]
    fn words_stay_one_cell_of_one_line() {
        assert_eq!(quoted("a, \"b\"\nc"), "\"a, \"\"b\"\" c\"");
        assert_eq!(with_unit("time", Some("ns")), "time (ns)");
        assert_eq!(with_unit("ax (g)", Some("g")), "ax (g)");
    }
}
