//! One row, cell by cell.

use nalgebra::Vector3;

use super::super::lines::Line;
use super::super::number::{self, Fault, LARGEST};
use super::super::place::shown;
use super::{Rows, Trouble};
use crate::Error;

impl Rows<'_> {
    /// Takes the row in, or says what is wrong with which cell.
    pub(super) fn row(&mut self, line: Line<'_>) -> Result<(), Trouble> {
        let layout = &self.start.layout;
        if self.start.header.as_deref() == Some(line.bytes) {
            return Err(Trouble::Refused(self.at(
                line,
                0,
                format!(
                    "the header of line {} again: two tables in one file; split it here",
                    self.start.after
                ),
            )));
        }
        self.start
            .dialect
            .split(line.bytes, &mut self.cells)
            .map_err(|at| {
                Trouble::Broken(self.at(
                    line,
                    at,
                    "a quote is opened here and never closed".to_owned(),
                ))
            })?;
        if self.cells.len() == layout.width + 1 && self.cells.last().is_some_and(|c| c.is_empty()) {
            self.cells.pop();
        }
        if self.cells.len() != layout.width {
            return Err(Trouble::Broken(self.ragged(line)));
        }
        let accel = self.triad(line, layout.accel)?;
        let gyro = self.triad(line, layout.gyro)?;
        if accel.is_none() && gyro.is_none() {
            let words = "every cell of the sensors is empty; --na drop leaves such rows out";
            return Err(Trouble::Missing(self.at(line, 0, words.to_owned())));
        }
        let temperature = match layout
            .temperature
            .map(|column| (column, &line.bytes[self.cells[column].clone()]))
        {
            Some((column, cell)) if !cell.is_empty() => Some(self.number(line, column)?),
            _ => None,
        };
        let t = self.stamp(line)?;
        self.keep(t, accel, gyro, temperature, line)
    }

    fn stamp(&mut self, line: Line<'_>) -> Result<f64, Trouble> {
        let column = match self.start.layout.time {
            Some(column) if self.options.rate.is_none() => column,
            _ => return Ok(self.counted()),
        };
        let cell = &line.bytes[self.cells[column].clone()];
        let decimal_comma = self.start.dialect.decimal_comma;
        let stamp = self.table.clock.read(cell, decimal_comma, line.number);
        stamp.map_err(|fault| self.fault(line, column, fault))
    }

    /// The sample in three columns, `None` where all three are empty.
    fn triad(
        &mut self,
        line: Line<'_>,
        columns: Option<[usize; 3]>,
    ) -> Result<Option<Vector3<f64>>, Trouble> {
        let Some(columns @ [x, y, z]) = columns else {
            return Ok(None);
        };
        if columns.iter().all(|&column| self.cells[column].is_empty()) {
            return Ok(None);
        }
        Ok(Some(Vector3::new(
            self.number(line, x)?,
            self.number(line, y)?,
            self.number(line, z)?,
        )))
    }

    fn number(&mut self, line: Line<'_>, column: usize) -> Result<f64, Trouble> {
        let cell = &line.bytes[self.cells[column].clone()];
        match number::parse(cell, self.start.dialect.decimal_comma, &mut self.spellings) {
            Ok(value) if value.abs() < LARGEST => Ok(value),
            Ok(_) => Err(self.fault(line, column, Fault::Absurd)),
            Err(fault) => Err(self.fault(line, column, fault)),
        }
    }

    fn fault(&self, line: Line<'_>, column: usize, fault: Fault) -> Trouble {
        let cell = self.cells[column].clone();
        let content = shown(&String::from_utf8_lossy(&line.bytes[cell.clone()]));
        let column = self.start.layout.column(column);
        let error = self.at(
            line,
            cell.start,
            format!("`{content}` in {column}: {}", fault.advice()),
        );
        match fault {
            Fault::Missing | Fault::NotFinite => Trouble::Missing(error),
            Fault::Text => Trouble::Broken(error),
            _ => Trouble::Refused(error),
        }
    }

    fn ragged(&self, line: Line<'_>) -> Error {
        let (found, expected) = (self.cells.len(), self.start.layout.width);
        let words = format!(
            "{found} cells, {expected} expected; --skip-bad-rows N leaves up to N such rows out"
        );
        self.at(line, 0, words)
    }
}
