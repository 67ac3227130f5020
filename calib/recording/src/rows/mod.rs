//! Rows of a text into the columns of a table.

pub(crate) mod number;
#[cfg(test)]
pub(crate) mod oracle;
pub(crate) mod parts;
pub mod plain;
mod read;
pub(crate) mod sort;
pub(crate) mod table;

mod careful;

use findings::{Finding, Kind, OptionName, Remedy};
use std::io::Read;
use std::ops::Range;

use nalgebra::Vector3;

use crate::Error;
use crate::devices::labels::{Labels, cell_of};
use crate::header::dialect::Cell;
use crate::header::preface::is_comment;
use crate::header::sniff::Start;
use crate::recording::memory::one_more;
use crate::recording::options::ReadOptions;
use crate::rows::number::Dialects;
use crate::rows::plain::{Block, Plain, Row, Stamps};
use crate::rows::table::Table;
use crate::source::batches::{Batch, Batches, Stop};
use crate::source::lines::{Line, end_of_line, lines};
use crate::source::pipeline::parse_all;
use crate::source::place::{at_column, at_line, in_file};

/// A header that comes again so often is the habit of a logger; once or twice, and tables are in one file.
const A_HABIT: usize = 3;

/// Refuses a header that comes again at some lines, where that is no habit of the logger.
///
/// # Errors
/// [`Error::Input`] at the first of the lines.
pub(crate) fn refuse_lone_header(
    name: &str,
    header_line: u64,
    headers: &[u64],
) -> Result<(), Error> {
    match headers.first() {
        Some(first) if headers.len() < A_HABIT => {
            let again = Finding::of(Kind::HEADER_AGAIN);
            let again = again.count("header_line", header_line as usize);
            Err(at_column(name, *first, 1, again))
        }
        _ => Ok(()),
    }
}

/// Why a row is not used.
enum Trouble {
    /// The file cannot be read further.
    Refused(Error),
    /// The row is broken; it may be the last one, cut short.
    Broken(Error),
    /// A number is missing; `--na drop` applies.
    Missing(Error),
    /// A line of words, as a logger writes before its header.
    Words(Error),
    /// The header again: some loggers write it every so many rows, or as often as they start.
    Header,
    /// The units below it.
    Units,
}

/// Readings of a row beside those of the accelerometer and the gyroscope.
#[derive(Clone, Copy, Debug, Default)]
struct Others {
    temperature: Option<f64>,
    field: Option<Vector3<f64>>,
    /// Gravity, which the accelerometer's columns lack.
    gravity: Option<Vector3<f64>>,
}

/// The loop over rows.
pub(crate) struct Rows<'a> {
    table: &'a mut Table,
    start: &'a Start,
    options: &'a ReadOptions,
    cells: Vec<Cell>,
    spellings: Dialects,
    /// Lines met.
    lines: u64,
    rows: u64,
    skipped: usize,
    dropped: usize,
    /// Lines with the header again.
    headers: Vec<u64>,
    /// The trouble of the row before, which is forgiven if no row follows.
    pending: Option<Error>,
    /// Lines of words before this one, of which that is the first.
    words: usize,
}

impl<'a> Rows<'a> {
    /// Rows into `table`, as `start` says.
    pub fn new(table: &'a mut Table, start: &'a Start, options: &'a ReadOptions) -> Self {
        table.labels = Labels::of(&start.labels, &start.layout.names);
        Self {
            table,
            start,
            options,
            cells: Vec::new(),
            spellings: Dialects::default(),
            lines: 0,
            rows: 0,
            skipped: 0,
            dropped: 0,
            headers: Vec::new(),
            pending: None,
            words: 0,
        }
    }

    /// Reads `batches` to their end: line by line until the stamps are known, then by plain rows.
    pub fn read(mut self, mut batches: Batches<impl Read + Send>) -> Result<(), Error> {
        while let Some(batch) = batches.next(Vec::new()) {
            if let Some((plain, after)) = self.until_plain(&batch)? {
                self.take(&batch, &plain.parse(&batch, after))?;
                parse_all(&mut batches, &plain, |batch, blocks| {
                    self.take(batch, blocks)
                })?;
            }
        }
        self.end(batches.stop())
    }

    /// Reads `batches` to their end, line by line: what [`Rows::read`] is to agree with.
    #[cfg(test)]
    pub fn read_line_by_line(mut self, mut batches: Batches<impl Read>) -> Result<(), Error> {
        while let Some(batch) = batches.next(Vec::new()) {
            for line in lines(&batch.bytes, 0) {
                self.line(&batch, line)?;
            }
        }
        self.end(batches.stop())
    }

    fn end(self, stop: Stop) -> Result<(), Error> {
        let name = &self.table.name;
        match stop {
            Stop::End => self.finish(),
            Stop::Line(found) => Err(at_line(name, self.lines + 1, *found)),
            Stop::Text(found) => Err(in_file(name, *found)),
        }
    }

    /// Reads `batch` line by line until it is known what plain rows look like, and where the next
    /// line begins.
    fn until_plain(&mut self, batch: &Batch) -> Result<Option<(Plain, usize)>, Error> {
        for line in lines(&batch.bytes, 0) {
            let after = line.end + end_of_line(&batch.bytes[line.end..]);
            self.line(batch, line)?;
            if self.rows == 1
                && let Some(plain) = self.plain()
            {
                return Ok(Some((plain, after)));
            }
        }
        Ok(None)
    }

    /// Builds the parser of plain rows; `None` if stamps are not plain numbers.
    fn plain(&self) -> Option<Plain> {
        let Start {
            dialect,
            layout,
            header,
            ..
        } = self.start;
        let stamps = match layout.time {
            Some(_) if self.options.rate.is_none() => self.table.clock.form()?,
            _ => Stamps::Counted,
        };
        let labels: Vec<usize> = self.start.labels.iter().map(|(at, _)| *at).collect();
        Plain::new(*dialect, layout, stamps, header.as_deref(), &labels)
    }

    /// Takes a parsed batch over: its plain rows, and the lines between them one by one.
    fn take(&mut self, batch: &Batch, blocks: &[Block]) -> Result<(), Error> {
        for block in blocks {
            let mut taken = 0;
            for odd in &block.odd {
                self.plain_rows(batch, block, taken..odd.after)?;
                self.line(batch, odd.line.clone())?;
                taken = odd.after;
            }
            self.plain_rows(batch, block, taken..block.rows.len())?;
        }
        Ok(())
    }

    fn plain_rows(
        &mut self,
        batch: &Batch,
        block: &Block,
        range: Range<usize>,
    ) -> Result<(), Error> {
        let layout = &self.start.layout;
        let triad =
            |row: &Row, first: usize| Vector3::new(row[first], row[first + 1], row[first + 2]);
        let labels = self.start.labels.len();
        for (at, row) in range.clone().zip(&block.rows[range]) {
            self.settle_pending()?;
            self.lines += 1;
            let line = Line {
                number: self.lines,
                bytes: &[],
                below: &[],
                ended: true,
            };
            let t = match layout.time {
                Some(_) if self.options.rate.is_none() => row[plain::STAMP],
                _ => self.counted(),
            };
            let accel = layout.accel.map(|_| triad(row, plain::ACCEL));
            let gyro = layout.gyro.map(|_| triad(row, plain::GYRO));
            let others = Others {
                temperature: layout.temperature.map(|_| row[plain::TEMPERATURE]),
                field: layout.field.map(|_| triad(row, plain::FIELD)),
                gravity: layout.gravity.map(|_| triad(row, plain::GRAVITY)),
            };
            let kept = self.keep(t, accel, gyro, others, line);
            if kept.is_ok() && labels > 0 {
                let cells = &block.labels[at * labels..(at + 1) * labels];
                let cell = |k: usize| &batch.bytes[cells[k].clone()];
                self.table.labels.push(line.number, cell);
            }
            self.count(kept, line.number)?;
        }
        Ok(())
    }

    /// Any line, looked at with care.
    fn line(&mut self, batch: &Batch, range: Range<usize>) -> Result<(), Error> {
        self.lines += 1;
        let number = self.lines;
        if let Some(found) = batch.fault(&range) {
            return Err(at_line(&self.table.name, number, found));
        }
        let behind = &batch.bytes[range.end..];
        let end = end_of_line(behind);
        let bytes = &batch.bytes[range];
        if number <= self.start.after || bytes.trim_ascii_start().is_empty() || is_comment(bytes) {
            return Ok(());
        }
        let kept = self.row(Line {
            number,
            bytes,
            below: &behind[end..],
            ended: end > 0,
        });
        match &kept {
            // Words before words, or before the header, that are no damage until a row follows.
            Err(Trouble::Words(_)) if self.words > 0 => {
                self.words += 1;
                return Ok(());
            }
            Err(Trouble::Header) if self.words > 0 => {
                (self.pending, self.words) = (None, 0);
            }
            _ => self.settle_pending()?,
        }
        self.count(kept, number)
    }

    /// Counts a row in, or remembers what is wrong with it.
    fn count(&mut self, kept: Result<(), Trouble>, line: u64) -> Result<(), Error> {
        match kept {
            Ok(()) => self.rows += 1,
            Err(Trouble::Header) => self.headers.push(line),
            Err(Trouble::Units) => {}
            Err(Trouble::Words(error)) => (self.pending, self.words) = (Some(error), 1),
            Err(Trouble::Missing(_)) if self.options.na_drop => self.dropped += 1,
            Err(Trouble::Missing(error) | Trouble::Broken(error)) => self.pending = Some(error),
            Err(Trouble::Refused(error)) => return Err(error),
        }
        if self.rows > self.options.max_rows {
            let limit = self.options.max_rows as usize;
            let more = Remedy::such_as(OptionName::MaxRows, limit.saturating_mul(2).to_string());
            let found = Finding::of(Kind::TOO_MANY_ROWS).count("limit", limit);
            let found = found.only_remedies([more]);
            return Err(at_line(&self.table.name, line, found));
        }
        Ok(())
    }

    /// A broken row with others after it is one of those allowed, or the end.
    fn settle_pending(&mut self) -> Result<(), Error> {
        let rows = std::mem::take(&mut self.words).max(1);
        match self.pending.take() {
            None => Ok(()),
            Some(_) if self.skipped + rows <= self.options.skip_bad_rows => {
                self.skipped += rows;
                Ok(())
            }
            Some(error) => Err(error),
        }
    }

    fn keep(
        &mut self,
        t: f64,
        accel: Option<Vector3<f64>>,
        gyro: Option<Vector3<f64>>,
        others: Others,
        line: Line<'_>,
    ) -> Result<(), Trouble> {
        let Others {
            temperature,
            field,
            gravity,
        } = others;
        let table = &mut *self.table;
        let sensors = [
            (&mut table.accel, accel),
            (&mut table.gyro, gyro),
            (&mut table.gravity, gravity),
            (&mut table.magnetometer, field),
        ];
        let mut room = Ok(());
        for (samples, value) in sensors {
            let Some(value) = value else { continue };
            room = room.and_then(|()| samples.make_room());
            if room.is_ok() {
                samples.append(t, value, line.number);
            }
        }
        if let Some(temperature) = temperature {
            room = room.and_then(|()| one_more(&mut table.temperature_t));
            room = room.and_then(|()| one_more(&mut table.temperature));
            room = room.and_then(|()| table.temperature_lines.make_room());
            if room.is_ok() {
                table
                    .temperature_lines
                    .push(table.temperature_t.len(), line.number);
                table.temperature_t.push(t);
                table.temperature.push(temperature);
            }
        }
        room.map_err(|()| Trouble::Refused(self.at(line, 0, Finding::of(Kind::OUT_OF_MEMORY))))
    }

    /// The stamp of a row without one: rows so far, or their time at the given rate.
    fn counted(&self) -> f64 {
        self.rows as f64 / self.options.rate.unwrap_or(1.0)
    }

    fn at(&self, line: Line<'_>, byte: usize, found: Finding) -> Error {
        at_column(&self.table.name, line.number, byte + 1, found)
    }

    fn finish(mut self) -> Result<(), Error> {
        self.table.headers = std::mem::take(&mut self.headers);
        self.table.header_line = self.start.header_line;
        let name = &self.table.name;
        let warnings = &mut self.table.warnings;
        if self.rows == 0 {
            return Err(self
                .pending
                .unwrap_or_else(|| in_file(name, Finding::of(Kind::NO_ROWS))));
        }
        let spelt = |spelling: &str, read_as: &str| {
            Finding::of(Kind::NUMBER_SPELLING)
                .in_recording(name)
                .detail("spelling", spelling)
                .detail("read_as", read_as)
        };
        if let Some(error) = self.pending {
            if self.words > 1 && self.skipped + self.words > self.options.skip_bad_rows {
                return Err(error);
            }
            warnings.push(
                Finding::of(Kind::ROW_CUT)
                    .in_recording(name)
                    .detail("which", "last")
                    .detail("why", error.to_string()),
            );
        }
        let headers = &self.table.headers;
        if let Some(first) = headers.first() {
            let header_line = self.table.header_line;
            // Stamps say whether the tables are recordings of their own.
            let has_time = self.start.layout.time.is_some() && self.options.rate.is_none();
            if !has_time {
                refuse_lone_header(name, header_line, headers)?;
            }
            warnings.push(
                Finding::of(Kind::HEADERS_LEFT_OUT)
                    .count("header_line", header_line as usize)
                    .in_recording(name)
                    .count("count", headers.len())
                    .count("line", *first as usize),
            );
        }
        if self.skipped > 0 {
            let broken = Finding::of(Kind::ROWS_BROKEN).in_recording(name);
            warnings.push(broken.count("count", self.skipped));
        }
        if self.dropped > 0 {
            let without = Finding::of(Kind::ROWS_WITHOUT_NUMBERS).in_recording(name);
            warnings.push(without.count("count", self.dropped));
        }
        if self.spellings.fortran {
            warnings.push(spelt("exponents with D", "exponents with E"));
        }
        if self.spellings.unicode_minus {
            warnings.push(spelt("minus signs U+2212", "-"));
        }
        Ok(())
    }
}
