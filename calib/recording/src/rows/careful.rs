//! One row, cell by cell.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;

use super::{Others, Rows, Trouble, cell_of};
use crate::Error;
use crate::clock::other_order;
use crate::clock::patterns::pattern_of;
use crate::header::dialect::Cell;
use crate::header::names::role_of;
use crate::header::preface::decode;
use crate::header::quotes::open_quote;
use crate::rows::number::{self, Dialects, Fault, LARGEST};
use crate::shown::{shown_cell, shown_list};
use crate::source::cut::is_cut;
use crate::source::lines::{Line, lines};
use crate::spelling::is_number_with_unit;

impl Rows<'_> {
    /// Takes the row in, or says what is wrong with which cell.
    pub(super) fn row(&mut self, line: Line<'_>) -> Result<(), Trouble> {
        let layout = &self.start.layout;
        if self.start.header.as_deref() == Some(line.bytes) {
            return Err(Trouble::Header);
        }
        if self.start.units.as_deref() == Some(line.bytes) {
            return Err(Trouble::Units);
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
        if let Some(names) = self.other_header(line) {
            let other = Finding::of(Kind::OTHER_HEADER)
                .count("header_line", self.start.header_line as usize)
                .detail("names", names);
            return Err(Trouble::Refused(self.at(line, 0, other)));
        }
        if self.cells.len() != layout.width {
            let ragged = self.ragged(line);
            return Err(match self.holds_words(line) {
                true => Trouble::Words(ragged),
                false => Trouble::Broken(ragged),
            });
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
            let empty = Finding::of(Kind::ROW_EMPTY);
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
            read.filter(|value| value.abs() < LARGEST.get())
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
        let cut = Finding::of(Kind::NUMBER_CUT)
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
            Ok(value) if value.abs() < LARGEST.get() => Ok(value),
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
        let is_measure = || is_number_with_unit(&line.bytes[cell.clone()]);
        let kind = match fault {
            Fault::Text if is_measure() => Kind::UNIT_OF_CELL,
            _ => fault.kind(),
        };
        let found = Finding::of(kind)
            .detail("cell", content)
            .detail("column", column);
        let found = match fault {
            Fault::Date | Fault::OtherDate => {
                found.only_remedies([match pattern_of(&line.bytes[cell.clone()]) {
                    Some(pattern) => Remedy::such_as(OptionName::TimeFormat, pattern),
                    None => Remedy::set(OptionName::TimeFormat),
                }])
            }
            Fault::OtherOrder => {
                let given = self.options.time_format.as_deref().unwrap_or_default();
                let other = Remedy::such_as(OptionName::TimeFormat, other_order(given));
                found.only_remedies([other])
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

    /// True if no cell of a line is a number, and none is empty.
    fn holds_words(&self, line: Line<'_>) -> bool {
        let is_word = |cell: &Cell| {
            let cell = &line.bytes[cell.clone()];
            let first = cell.first().is_some_and(u8::is_ascii_alphabetic);
            first && matches!(self.parsed(cell), Err(Fault::Text))
        };
        self.start.header.is_some() && self.cells.iter().all(is_word)
    }

    fn parsed(&self, cell: &[u8]) -> Result<f64, Fault> {
        let decimal_comma = self.start.dialect.decimal_comma;
        number::parse(cell, decimal_comma, &mut Dialects::default())
    }

    /// Names of a line that holds those of a sensor's axes and no number, as the header of another table does.
    fn other_header(&self, line: Line<'_>) -> Option<String> {
        let is_number = |cell: &Cell| self.parsed(&line.bytes[cell.clone()]).is_ok();
        if self.start.header.is_none() || self.cells.iter().any(is_number) {
            return None;
        }
        let names = self
            .cells
            .iter()
            .map(|cell| decode(&line.bytes[cell.clone()]));
        let names: Vec<String> = names.collect();
        let is_axis =
            |name: &&String| role_of(name, None).is_some_and(|role| role.reading().is_some());
        let axes = names.iter().filter(is_axis).count();
        (axes >= 3).then(|| shown_list(names.iter()))
    }

    fn ragged(&self, line: Line<'_>) -> Error {
        let (found, expected) = (self.cells.len(), self.start.layout.width);
        let ragged = Finding::of(Kind::ROW_RAGGED)
            .count("found", found)
            .count("expected", expected);
        self.at(line, 0, ragged)
    }
}
