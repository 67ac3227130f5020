//! A table of static means.

use std::path::Path;

use nalgebra::Vector3;
use recording::shown::shown_path;
use recording::{Error, read_text};

/// Reads the columns `ax,ay,az` of a CSV table of static means.
///
/// # Errors
/// An unreadable table or a cell that is no number; the message names file, line and column.
pub fn read_static_means(path: &Path) -> Result<Vec<Vector3<f64>>, Error> {
    let fail =
        |line: u64, what: String| Error::Input(format!("{}:{line}: {what}", shown_path(path)));
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader
        .headers()
        .map_err(|e| fail(1, e.to_string()))?
        .clone();
    let mut columns = [0; 3];
    for (column, name) in columns.iter_mut().zip(["ax", "ay", "az"]) {
        *column = header.iter().position(|h| h == name).ok_or_else(|| {
            let found = header.iter().collect::<Vec<_>>().join(",");
            fail(1, format!("columns {found} found; ax,ay,az expected"))
        })?;
    }
    let mut means = Vec::new();
    for row in reader.records() {
        let row =
            row.map_err(|e| fail(e.position().map_or(0, csv::Position::line), e.to_string()))?;
        let line = row.position().map_or(0, csv::Position::line);
        let mut mean = Vector3::zeros();
        for (axis, &column) in columns.iter().enumerate() {
            let cell = row.get(column).unwrap_or("");
            mean[axis] = cell
                .parse()
                .ok()
                .filter(|v: &f64| v.is_finite())
                .ok_or_else(|| {
                    fail(
                        line,
                        format!("column {}: number expected, \"{cell}\" found", column + 1),
                    )
                })?;
        }
        means.push(mean);
    }
    if means.is_empty() {
        return Err(fail(1, "header found, no rows of static means".to_owned()));
    }
    Ok(means)
}
