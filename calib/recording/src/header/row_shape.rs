//! Common shape of the rows at the beginning of a text.

use super::dialect::Dialect;
use super::preface::{Kept, cells, is_row};
use crate::rows::number::{self, Dialects, Fault};

/// The first row that is as wide as most are: a line of a preface may hold numbers too.
pub(super) fn first_row(kept: &[Kept], dialect: Dialect) -> Option<usize> {
    let rows = kept
        .iter()
        .filter(|k| !k.comment && is_row(&k.bytes, dialect));
    let rows: Vec<&Kept> = rows.collect();
    let width = usual_width(&rows, dialect)?;
    let first = rows
        .iter()
        .find(|k| cells(&k.bytes, dialect).len() == width)?;
    kept.iter().position(|k| k.number == first.number)
}

/// The number of cells that most rows have.
pub(super) fn usual_width(rows: &[&Kept], dialect: Dialect) -> Option<usize> {
    let mut widths: Vec<usize> = rows
        .iter()
        .map(|row| cells(&row.bytes, dialect).len())
        .collect();
    widths.sort_unstable();
    widths
        .chunk_by(|a, b| a == b)
        .max_by_key(|run| run.len())
        .and_then(|run| run.first().copied())
}

/// True if the first cells count the rows from 0 or 1, in quotes or not.
pub(super) fn rows_are_numbered(rows: &[&Kept], dialect: Dialect) -> bool {
    let first = |row: &Kept| {
        let cell = cells(&row.bytes, dialect).first()?.clone();
        std::str::from_utf8(&row.bytes[cell])
            .ok()?
            .parse::<usize>()
            .ok()
    };
    let count_from = |begin: usize| {
        let mut rows = rows.iter().enumerate();
        rows.all(|(at, row)| first(row) == Some(at + begin))
    };
    rows.len() > 1 && [0, 1].into_iter().any(count_from)
}

/// True if the rows end with a separator, which makes an empty last cell.
pub(super) fn ends_empty(rows: &[&Kept], dialect: Dialect) -> bool {
    rows.iter().all(|row| {
        cells(&row.bytes, dialect)
            .last()
            .is_some_and(|cell| cell.is_empty())
    })
}

/// True if no row has a number in a column, but a word for a missing one.
pub(super) fn is_empty(rows: &[&Kept], dialect: Dialect, column: usize) -> bool {
    let is_missing = |row: &&Kept| {
        let Some(cell) = cells(&row.bytes, dialect).get(column).cloned() else {
            return false;
        };
        let read = number::parse(
            &row.bytes[cell],
            dialect.decimal_comma,
            &mut Dialects::default(),
        );
        matches!(read, Err(Fault::Missing | Fault::NotFinite))
    };
    rows.len() >= FEWEST_STANDING.get() && rows.iter().all(is_missing)
}

/// True if no row has a decimal point.
pub(super) fn only_integers(rows: &[&Kept]) -> bool {
    rows.iter().all(|row| !row.bytes.contains(&b'.'))
}

findings::tuning! {
    /// Fewest rows that show that a column stands still.
    FEWEST_STANDING: usize = 5;
}

/// True if the cells of a column are the same in all rows.
pub(super) fn stands_still(rows: &[&Kept], dialect: Dialect, column: usize) -> bool {
    let cell = |row: &&Kept| {
        let own = cells(&row.bytes, dialect).get(column)?.clone();
        Some(row.bytes[own].to_vec())
    };
    let first = rows.first().and_then(cell);
    rows.len() >= FEWEST_STANDING.get() && rows.iter().all(|row| cell(row) == first)
}

/// True if most rows have the cell of the row before them in the column `time`, which changes, and a larger number than that row in
/// the column `other`.
pub(super) fn is_finer(rows: &[&Kept], dialect: Dialect, other: usize, time: usize) -> bool {
    let cell = |row: &Kept, column: usize| {
        let own = cells(&row.bytes, dialect).get(column)?.clone();
        Some(row.bytes[own].to_vec())
    };
    let number = |row: &Kept| {
        let cell = cell(row, other)?;
        number::parse(&cell, dialect.decimal_comma, &mut Dialects::default()).ok()
    };
    let pairs = || rows.windows(2).map(|pair| (pair[0], pair[1]));
    let changes = pairs().filter(|(a, b)| cell(a, time) != cell(b, time));
    let changes = changes.count();
    let goes_on = |(a, b)| matches!((number(a), number(b)), (Some(a), Some(b)) if a < b);
    changes > 0 && 2 * changes < rows.len() && pairs().all(goes_on)
}
