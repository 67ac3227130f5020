//! One row, cell by cell.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;

use super::{Others, Rows, Trouble, cell_of};
use crate::Error;
use crate::clock::patterns::pattern_of;
use crate::header::quotes::open_quote;
use crate::rows::number::{self, Fault, LARGEST};
use crate::shown::shown_cell;
use crate::source::cut::is_cut;
use crate::source::lines::{Line, lines};

impl Rows<'_> {
    /// Takes the row in, or says what is wrong with which cell.
    pub(super) fn row(&mut self, line: Line<'_>) -> Result<(), Trouble> {
        let layout = &self.start.layout;
        if self.start.header.as_deref() == Some(line.bytes) {
            return Err(Trouble::Header);
        }
        self.start
            .dialect
            .split(line.bytes, &mut self.cells)
            .map_err(|at| {
                let below = (line.number + 1..).zip(lines(line.below, 0));
                let below = below.map(|(number, range)| (number, &line.below[range]));
                Trouble::Broken(self.at(line, at, open_quote(below)))
            })?;
        if self.cells.len() == layout.width + 1 && self.cells.last().is_some_and(|c| c.is_empty()) {
            self.cells.pop();
        }
        if self.cells.len() != layout.width {
            return Err(Trouble::Broken(self.ragged(line)));
        }
        self.whole(line)?;
        let accel = self.triad(line, layout.accel)?;
        let gyro = self.triad(line, layout.gyro)?;
        let gravity = self.triad(line, layout.gravity.map(|split| split.gravity))?;
        let field = self.field(line);
        let temperature = match layout
            .temperature
            .map(|column| (column, &line.bytes[self.cells[column].clone()]))
        {
            Some((column, cell)) if !cell.is_empty() => Some(self.number(line, column)?),
            _ => None,
        };
        // A file of a thermometer has no others.
        let alone = temperature.filter(|_| !layout.has_sensor());
        if accel.is_none() && gyro.is_none() && field.is_none() && alone.is_none() {
            let empty = Finding::of(Kind::RowEmpty);
            return Err(Trouble::Missing(self.at(line, 0, empty)));
        }
        let t = self.stamp(line)?;
        let others = Others {
            temperature,
            field,
            gravity,
        };
        self.keep(t, accel, gyro, others, line)?;
        if !self.start.labels.is_empty() {
            let (cells, columns) = (&self.cells, &self.start.labels);
            let cell = |k: usize| cell_of(line.bytes, cells, columns[k].0);
            self.table.labels.push(line.number, cell);
        }
        Ok(())
    }

    /// The magnetometer's reading; `None` where a number is missing, which is no reason to leave the row out.
    fn field(&mut self, line: Line<'_>) -> Option<Vector3<f64>> {
        let [x, y, z] = self.start.layout.field?;
        let decimal_comma = self.start.dialect.decimal_comma;
        let mut number = |column: usize| {
            let cell = &line.bytes[self.cells[column].clone()];
            let read = number::parse(cell, decimal_comma, &mut self.spellings).ok();
            read.filter(|value| value.abs() < LARGEST)
        };
        Some(Vector3::new(number(x)?, number(y)?, number(z)?))
    }

    /// Refuses a last row that ends within its last number.
    fn whole(&self, line: Line<'_>) -> Result<(), Trouble> {
        let (Some(usual), false, Some(cell)) = (self.start.tail, line.ended, self.cells.last())
        else {
            return Ok(());
        };
        let content = &line.bytes[cell.clone()];
        if !is_cut(content, self.start.dialect.mark(), usual) {
            return Ok(());
        }
        let column = self.start.layout.column(self.start.layout.width - 1);
        let cut = Finding::of(Kind::NumberCut)
            .detail("cell", shown_cell(content))
            .detail("column", column)
            .count("digits", usual);
        Err(Trouble::Broken(self.at(line, cell.start, cut)))
    }

    fn stamp(&mut self, line: Line<'_>) -> Result<f64, Trouble> {
        let column = match self.start.layout.time {
            Some(column) if self.options.rate.is_none() => column,
            _ => return Ok(self.counted()),
        };
        let cell = &line.bytes[self.cells[column].clone()];
        let decimal_comma = self.start.dialect.decimal_comma;
        let stamp = self.table.clock.read(cell, decimal_comma);
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
        // Of a row that one sensor wrote the other's numbers are left out, not the row.
        if self.options.na_drop && columns.iter().all(|&column| self.is_missing(line, column)) {
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

    fn is_missing(&self, line: Line<'_>, column: usize) -> bool {
        let cell = &line.bytes[self.cells[column].clone()];
        let read = number::parse(
            cell,
            self.start.dialect.decimal_comma,
            &mut number::Dialects::default(),
        );
        matches!(read, Err(Fault::Missing | Fault::NotFinite))
    }

    fn fault(&self, line: Line<'_>, column: usize, fault: Fault) -> Trouble {
        let cell = self.cells[column].clone();
        let content = shown_cell(&line.bytes[cell.clone()]);
        let column = self.start.layout.column(column);
        let found = Finding::of(fault.kind())
            .detail("cell", content)
            .detail("column", column);
        let found = match fault {
            Fault::Date | Fault::OtherDate => {
                found.only_remedies([match pattern_of(&line.bytes[cell.clone()]) {
                    Some(pattern) => Remedy::such_as(OptionName::TimeFormat, pattern),
                    None => Remedy::set(OptionName::TimeFormat),
                }])
            }
            _ => found,
        };
        let error = self.at(line, cell.start, found);
        match fault {
            Fault::Missing | Fault::NotFinite => Trouble::Missing(error),
            Fault::Text => Trouble::Broken(error),
            _ => Trouble::Refused(error),
        }
    }

    fn ragged(&self, line: Line<'_>) -> Error {
        let (found, expected) = (self.cells.len(), self.start.layout.width);
        let ragged = Finding::of(Kind::RowRagged)
            .count("found", found)
            .count("expected", expected);
        self.at(line, 0, ragged)
    }
}
