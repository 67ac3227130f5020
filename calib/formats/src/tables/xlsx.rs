//! Excel workbooks: a table per sheet that is shown, its lines those of the sheet.

use std::io::{self, Read, Seek, Write};

use calamine::{
    Cell as Found, DataRef, Reader as _, SheetType, SheetVisible, Xlsx as Workbook, XlsxError,
};

use findings::{Finding, Kind, Remedy};

use super::reader::{Listed, Reader};
use super::rows::{self, Cell};
use crate::container::archive::Archive;
use crate::error::{counted, unreadable};
use crate::shown::shown;
use crate::store::{Store, Stored};
use crate::{Error, Limits};

/// `.xlsx` workbooks.
pub(super) const READER: Reader = Reader { tables, write };

/// Excel has no more columns, nor more rows: "Excel specifications and limits", Microsoft.
const COLUMNS: u32 = 16_384;
const ROWS: u32 = 1_048_576;
/// Bytes of what is held in memory beside a sheet: shared words, styles.
const HELD: u64 = 256 << 20;

fn tables(store: &Store, limits: Limits) -> Result<Listed, Error> {
    check(store, limits)?;
    let workbook = open(store)?;
    let mut listed = Listed::default();
    for sheet in workbook.sheets_metadata() {
        match (sheet.typ, sheet.visible) {
            (SheetType::WorkSheet, SheetVisible::Visible) => {
                listed.names.push(sheet.name.clone());
            }
            (SheetType::WorkSheet, _) => listed
                .warnings
                .push(Finding::of(Kind::SHEET_HIDDEN).detail("sheet", shown(&sheet.name))),
            _ => {}
        }
    }
    match listed.names.is_empty() {
        true => Err(Error::refused(Finding::of(Kind::NO_SHEET))),
        false => Ok(listed),
    }
}

fn write(store: &Store, name: &str, limits: Limits, out: &mut dyn Write) -> Result<(), Error> {
    let mut workbook = open(store)?;
    let mut cells = workbook.worksheet_cells_reader(name).map_err(damaged)?;
    let mut sheet = Sheet {
        name,
        first: cells.dimensions().start.1,
        row: 0,
        line: String::new(),
        columns: 0,
        numbers: false,
        date: None,
        out,
    };
    while let Some(cell) = cells.next_cell().map_err(damaged)? {
        // Rows beyond those of Excel are damage, and told so.
        let rows = u64::from(cell.get_position().0) + 1;
        rows::check(rows.min(u64::from(ROWS)), limits.rows)?;
        sheet.add(&cell)?;
    }
    sheet.end_line()
}

fn damaged(error: XlsxError) -> Error {
    unreadable("workbook", &error)
}

fn open(store: &Store) -> Result<Workbook<Box<dyn Stored>>, Error> {
    let mut file = store.open()?;
    file.rewind()?;
    Workbook::new(file).map_err(damaged)
}

/// Unpacks what the parser holds in memory, so that no entry is longer than it says.
fn check(store: &Store, limits: Limits) -> Result<(), Error> {
    let archive = Archive::open(store.clone(), limits)?;
    for (name, packed) in &archive.entries {
        let is_sheet = name.to_ascii_lowercase().starts_with("xl/worksheets/sheet");
        let mut content = archive.content(name, packed)?;
        if is_sheet {
            continue;
        }
        let mut words = Words::default();
        let unpacked = io::copy(&mut (&mut content).take(HELD), &mut words);
        let unpacked =
            unpacked.map_err(|error| unreadable(format!("part {}", shown(name)), &error))?;
        if unpacked == HELD {
            let found = Finding::of(Kind::UNPACKS_TOO_LARGE).detail("what", shown(name));
            let found = counted(found, "limit", HELD);
            return Err(Error::refused(found.only_remedies([Remedy::SaveAsCsv])));
        }
        if words.most > unpacked.max(MANY) {
            let found = Finding::of(Kind::WORDS_TOO_MANY).detail("part", shown(name));
            let found = counted(found, "words", words.most);
            return Err(Error::refused(counted(found, "bytes", unpacked)));
        }
    }
    Ok(())
}

/// Number of shared strings that an entry of any size may announce.
const MANY: u64 = 1 << 20;

/// The most words that an entry announces: the parser makes room for them at once, and the program would end for want of
/// memory.
#[derive(Debug, Default)]
struct Words {
    most: u64,
    /// Bytes of [`Words::NAME`] that were just read.
    matched: usize,
    /// The number that is being read, and whether its digits have begun.
    number: u64,
    begun: bool,
}

impl Words {
    /// The attribute with the number of words.
    const NAME: &[u8] = b"uniqueCount";

    fn read(&mut self, byte: u8) {
        if self.matched < Self::NAME.len() {
            // A space stands before the attribute, so that it never begins within what was matched so far.
            self.matched = match byte == Self::NAME[self.matched] {
                true => self.matched + 1,
                false => usize::from(byte == Self::NAME[0]),
            };
            return;
        }
        match byte {
            b'0'..=b'9' => {
                self.begun = true;
                let digit = u64::from(byte - b'0');
                self.number = self.number.saturating_mul(10).saturating_add(digit);
                self.most = self.most.max(self.number);
            }
            b' ' | b'\t' | b'\r' | b'\n' | b'=' | b'"' | b'\'' | b'+' if !self.begun => {}
            _ => (self.matched, self.number, self.begun) = (0, 0, false),
        }
    }
}

impl Write for Words {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Without the zeros of text in 16 bits.
        let bytes_there = bytes.iter().filter(|byte| **byte != 0);
        bytes_there.for_each(|byte| self.read(*byte));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A sheet while it is written.
struct Sheet<'a> {
    name: &'a str,
    /// The first column that holds anything.
    first: u32,
    /// The row of `line`, from 0.
    row: u32,
    line: String,
    /// Cells in `line`.
    columns: u32,
    /// There is a number in `line`.
    numbers: bool,
    /// The first date in `line`.
    date: Option<(u32, u32)>,
    out: &'a mut dyn Write,
}

impl Sheet<'_> {
    fn add(&mut self, found: &Found<DataRef<'_>>) -> Result<(), Error> {
        let (row, column) = found.get_position();
        let cell = match found.get_value() {
            DataRef::Empty => return Ok(()),
            DataRef::Int(number) => Cell::Whole(*number),
            DataRef::Float(number) => Cell::Double(*number),
            DataRef::String(words) => Cell::Text(words.clone()),
            DataRef::SharedString(words) => Cell::Text((*words).to_owned()),
            DataRef::Bool(yes) => Cell::Whole(i64::from(*yes)),
            DataRef::DateTime(date) => Cell::Double(date.as_f64()),
            DataRef::DateTimeIso(words) | DataRef::DurationIso(words) => Cell::Text(words.clone()),
            DataRef::Error(error) => Cell::Text(error.to_string()),
        };
        if row < self.row || row >= ROWS || column >= COLUMNS || column < self.first {
            return Err(self.refused(Kind::CELL_IMPOSSIBLE, row, column));
        }
        while self.row < row {
            self.end_line()?;
        }
        let at = column - self.first;
        if self.columns > at {
            return Err(self.refused(Kind::CELL_TWICE, row, column));
        }
        for _ in self.columns.max(1)..=at {
            self.line.push(',');
        }
        self.columns = at + 1;
        match found.get_value() {
            DataRef::DateTime(_) | DataRef::DateTimeIso(_) => {
                self.date = self.date.or(Some((row, column)));
            }
            DataRef::Int(_) | DataRef::Float(_) => self.numbers = true,
            _ => {}
        }
        cell.write(&mut self.line);
        Ok(())
    }

    /// Writes the row, blank ones too, so that a line's number is the row's.
    fn end_line(&mut self) -> Result<(), Error> {
        // A date among words is a remark; among numbers it is the stamp of a reading.
        if let (Some((row, column)), true) = (self.date, self.numbers) {
            return Err(self.refused(Kind::CELL_IS_DATE, row, column));
        }
        self.line.push('\n');
        self.out.write_all(self.line.as_bytes())?;
        self.line.clear();
        (self.columns, self.numbers, self.date) = (0, false, None);
        self.row += 1;
        Ok(())
    }

    fn refused(&self, kind: Kind, row: u32, column: u32) -> Error {
        Error::refused(Finding::of(kind).detail("cell", self.place(row, column)))
    }

    /// A cell as Excel calls it: `Raw!B7`.
    fn place(&self, row: u32, column: u32) -> String {
        let (mut letters, mut left) = (Vec::new(), column + 1);
        while left > 0 {
            letters.push(char::from(b'A' + ((left - 1) % 26) as u8));
            left = (left - 1) / 26;
        }
        let letters: String = letters.iter().rev().collect();
        format!("{}!{letters}{}", shown(self.name), u64::from(row) + 1)
    }
}
