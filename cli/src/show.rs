//! Tables and numbers for people.

use std::io::Write;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, LineStyle, Table};

use crate::exit::{Failure, OUTPUT};

/// A table whose columns after the first are aligned right.
pub fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING.header_separator(LineStyle::new('─', '─', '─', '─')));
    table.set_header(header.to_vec());
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Prints a result. A reader that has closed the pipe (`| head`) is no error.
///
/// # Errors
/// Status 6 where standard output cannot be written, such as a file on a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::new(
            OUTPUT,
            format!("standard output cannot be written: {e}"),
        )),
        _ => Ok(()),
    }
}

/// A note or a warning.
pub fn warn(text: &str) {
    eprintln!("warning: {}", printable(text));
}

/// The text with control characters shown instead of obeyed: a file name may hold any.
pub fn printable(text: &str) -> String {
    text.chars()
        .map(|c| {
            if c.is_control() && c != '\n' {
                c.escape_default().to_string()
            } else {
                c.into()
            }
        })
        .collect()
}

/// A number with as many decimals as its standard error warrants (two significant figures of it).
pub fn value(value: f64, std: Option<f64>) -> String {
    let decimals = match std {
        Some(s) if s > 0.0 && s.is_finite() => (1.0 - s.log10().floor()).clamp(0.0, 12.0) as usize,
        _ => 6,
    };
    format!("{value:.decimals$}")
}

/// A standard error to two significant figures.
pub fn error(std: Option<f64>) -> String {
    match std {
        None => "fixed".into(),
        Some(s) if s > 0.0 && s.is_finite() => value(s, Some(s)),
        Some(s) => format!("{s}"),
    }
}
