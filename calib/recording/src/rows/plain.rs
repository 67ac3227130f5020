//! Rows of plain numbers, parsed without a look at anything else.
//!
//! Nearly all rows of nearly all recordings are plain: as many cells as the header has names, finite
//! decimal numbers in those that are read. Whatever else a line may be is left to
//! `Rows`, which understands or refuses it.

use std::ops::Range;

use rayon::prelude::*;

use super::number::{LARGEST, LATEST};
pub use crate::clock::Stamps;
use crate::clock::since;
use crate::header::Layout;
use crate::header::dialect::{Dialect, Separator};
use crate::source::batches::{Batch, is_too_long};
use crate::source::lines::{end_of_line, lines};

/// The numbers of a row, in the file's units, by place; those without a column are 0.
pub type Row = [f64; 14];
/// Place of the stamp.
pub const STAMP: usize = 0;
/// First place of the accelerometer.
pub const ACCEL: usize = 1;
/// First place of the gyroscope.
pub const GYRO: usize = 4;
/// Place of the temperature.
pub const TEMPERATURE: usize = 7;
/// First place of the magnetometer.
pub const FIELD: usize = 8;
/// First place of gravity in columns of its own.
pub const GRAVITY: usize = 11;

/// Use of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    Nothing,
    Number(usize),
    Since(i64),
    /// A word, to be looked at again; which one of them.
    Label(usize),
}

/// Format of the plain rows of a text.
#[derive(Clone, Debug)]
pub struct Plain {
    dialect: Dialect,
    slots: Vec<Slot>,
    /// Cells of every row that are to be looked at again.
    labels: usize,
}

/// A part of a batch: its plain rows, and the lines between them.
#[derive(Debug, Default)]
pub struct Block {
    /// Plain rows.
    pub rows: Vec<Row>,
    /// Byte ranges in the batch of the cells that are to be looked at again, as many of every row.
    pub labels: Vec<Range<usize>>,
    /// Lines that are none.
    pub odd: Vec<Odd>,
}

/// A line that is no plain row.
#[derive(Debug)]
pub struct Odd {
    /// Plain rows of the block before it.
    pub after: usize,
    /// Byte range of the line in the batch.
    pub line: Range<usize>,
}

impl Plain {
    /// The plain rows of `layout`, and of each the cells in the columns `labels`; `None` where a column is read twice, or
    /// where a row like `header` would be one.
    pub(crate) fn new(
        dialect: Dialect,
        layout: &Layout,
        stamps: Stamps,
        header: Option<&[u8]>,
        labels: &[usize],
    ) -> Option<Self> {
        let mut slots = vec![Slot::Nothing; layout.width];
        let mut set = |column: usize, slot| {
            let old = std::mem::replace(slots.get_mut(column)?, slot);
            (old == Slot::Nothing).then_some(())
        };
        for (first, triad) in [
            (ACCEL, layout.accel),
            (GYRO, layout.gyro),
            (FIELD, layout.field),
            (GRAVITY, layout.gravity.map(|split| split.gravity)),
        ] {
            for (place, column) in (first..).zip(triad.into_iter().flatten()) {
                set(column, Slot::Number(place))?;
            }
        }
        if let Some(column) = layout.temperature {
            set(column, Slot::Number(TEMPERATURE))?;
        }
        match (stamps, layout.time) {
            (Stamps::Numbers, Some(column)) => set(column, Slot::Number(STAMP))?,
            (Stamps::Since(origin), Some(column)) => set(column, Slot::Since(origin))?,
            _ => {}
        }
        for (k, column) in labels.iter().enumerate() {
            set(*column, Slot::Label(k))?;
        }
        let plain = Self {
            dialect,
            slots,
            labels: labels.len(),
        };
        let is_row = |header: &[u8]| {
            let line = [header, b"\n"].concat();
            !plain.block(&line, 0..line.len()).rows.is_empty()
        };
        (!header.is_some_and(is_row)).then_some(plain)
    }

    /// Comma-separated rows of `width` cells, the first `read` of which go to their own places.
    pub fn in_first_columns(width: usize, read: usize) -> Self {
        let slot = |column| match column < read.min(Row::default().len()) {
            true => Slot::Number(column),
            false => Slot::Nothing,
        };
        Self {
            dialect: Dialect {
                separator: Separator::Byte(b','),
                decimal_comma: false,
            },
            slots: (0..width).map(slot).collect(),
            labels: 0,
        }
    }

    /// The blocks of `batch` from `start` on, in order.
    pub fn parse(&self, batch: &Batch, start: usize) -> Vec<Block> {
        if batch.is_binary() {
            return vec![Block::odd(&batch.bytes, start)];
        }
        let mut pieces = Vec::new();
        let mut start = start;
        while start < batch.bytes.len() {
            let enough = batch.bytes.len().min(start + batch.piece);
            let feed = memchr::memchr(b'\n', &batch.bytes[enough..]);
            let end = feed.map_or(batch.bytes.len(), |at| enough + at + 1);
            pieces.push(start..end);
            start = end;
        }
        match pieces.as_slice() {
            [piece] => vec![self.block(&batch.bytes, piece.clone())],
            _ => pieces
                .into_par_iter()
                .map(|piece| self.block(&batch.bytes, piece))
                .collect(),
        }
    }

    /// The lines in `piece` of `text`.
    fn block(&self, text: &[u8], piece: Range<usize>) -> Block {
        let points = self.dialect.decimal_comma.then(|| {
            let point = |&byte: &u8| if byte == b',' { b'.' } else { byte };
            text[piece.clone()].iter().map(point).collect::<Vec<u8>>()
        });
        let spelled = points.as_deref().unwrap_or(&text[piece.clone()]);
        let mut block = Block::default();
        let mut row = Row::default();
        let mut labels = vec![0..0; self.labels];
        let mut at = 0;
        while at < spelled.len() {
            let length = match self.row(&spelled[at..], &mut row, &mut labels) {
                Some(length) if !is_too_long(length) => {
                    block.rows.push(row);
                    let start = piece.start + at;
                    let in_batch = |cell: &Range<usize>| start + cell.start..start + cell.end;
                    block.labels.extend(labels.iter().map(in_batch));
                    length
                }
                _ => {
                    let line = lines(spelled, at).next().unwrap_or(at..spelled.len());
                    block.odd.push(Odd {
                        after: block.rows.len(),
                        line: piece.start + line.start..piece.start + line.end,
                    });
                    line.len() + end_of_line(&spelled[line.end..])
                }
            };
            at += length;
        }
        block
    }

    /// The row that `text` begins with, and its length with the line end; `None` for any other line.
    #[inline]
    fn row(&self, text: &[u8], row: &mut Row, labels: &mut [Range<usize>]) -> Option<usize> {
        if matches!(text, [b'#' | b'%' | b'/', ..]) {
            return None;
        }
        let mut rest = self.without_blanks(text);
        for (column, slot) in self.slots.iter().enumerate() {
            if column > 0 {
                rest = self.next_cell(rest)?;
            }
            let length = match *slot {
                Slot::Number(place) => {
                    let (number, length) = fast_float2::parse_partial::<f64, _>(rest).ok()?;
                    if !is_possible(number, place) {
                        return None;
                    }
                    row[place] = number;
                    length
                }
                Slot::Since(origin) => {
                    let cell = self.cell(rest)?;
                    row[STAMP] = since(origin, cell, false)?;
                    cell.len()
                }
                Slot::Nothing => self.cell(rest)?.len(),
                Slot::Label(k) => {
                    let (cell, from) = (self.cell(rest)?, text.len() - rest.len());
                    *labels.get_mut(k)? = from..from + cell.trim_ascii_end().len();
                    cell.len()
                }
            };
            rest = &rest[length..];
        }
        rest = self.without_blanks(rest);
        // A separator at the end of the row makes no cell.
        if let Separator::Byte(separator) = self.dialect.separator
            && let Some(behind) = rest.strip_prefix(&[separator])
        {
            rest = self.without_blanks(behind);
        }
        // A row without an end may be cut short.
        let end = end_of_line(rest);
        (end > 0).then(|| text.len() - rest.len() + end)
    }

    /// The text from the next cell on, where `rest` begins behind a cell.
    #[inline]
    fn next_cell<'a>(&self, rest: &'a [u8]) -> Option<&'a [u8]> {
        let rest = match self.dialect.separator {
            Separator::Byte(separator) => self.without_blanks(rest).strip_prefix(&[separator])?,
            Separator::Blanks => rest.strip_prefix(b" ").or(rest.strip_prefix(b"\t"))?,
        };
        Some(self.without_blanks(rest))
    }

    /// `text` without the blanks before a cell.
    #[inline]
    fn without_blanks<'a>(&self, mut text: &'a [u8]) -> &'a [u8] {
        while let [byte @ (b' ' | b'\t'), behind @ ..] = text
            && self.dialect.separator != Separator::Byte(*byte)
        {
            text = behind;
        }
        text
    }

    /// The cell that `text` begins with, whatever it holds; `None` for quotes.
    fn cell<'a>(&self, text: &'a [u8]) -> Option<&'a [u8]> {
        let ends = |&byte: &u8| match self.dialect.separator {
            _ if matches!(byte, b'\n' | b'\r' | b'"') => true,
            Separator::Byte(separator) => byte == separator,
            Separator::Blanks => matches!(byte, b' ' | b'\t'),
        };
        let length = text.iter().position(ends).unwrap_or(text.len());
        let empty = length == 0 && self.dialect.separator == Separator::Blanks;
        (!empty && text.get(length) != Some(&b'"')).then(|| &text[..length])
    }
}

/// True for a number that can stand at `place` without a question.
#[inline]
fn is_possible(number: f64, place: usize) -> bool {
    number.abs()
        < if place == STAMP {
            LATEST.get()
        } else {
            LARGEST.get()
        }
}

impl Block {
    /// All lines of `text` from `start` on, none taken for plain.
    fn odd(text: &[u8], start: usize) -> Self {
        let odd = lines(text, start).map(|line| Odd { after: 0, line });
        Self {
            odd: odd.collect(),
            ..Self::default()
        }
    }
}
