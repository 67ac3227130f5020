//! The lines before the rows: which of them names the columns, and which holds their units.

use sensor::Sensor;

use super::dialect::{Cell, Dialect};
use super::unit_row;
use crate::header::Layout;
use crate::recording::options::ReadOptions;
use crate::rows::number::{self, Dialects, Fault};

/// A line kept for looking at it again.
pub(crate) struct Kept {
    /// Number, from 1.
    pub number: u64,
    /// It is a comment.
    pub comment: bool,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Lines before the rows that say what is in them.
#[derive(Clone, Copy, Default)]
pub(crate) struct Preface<'a> {
    /// The names of the columns.
    pub header: Option<&'a Kept>,
    /// The units below them.
    pub units: Option<&'a Kept>,
    /// The last of what a program said before rows without names, or below the names and the units.
    pub said: Option<&'a Kept>,
}

/// True for lines that are no rows: comments of the usual kinds.
pub(crate) fn is_comment(line: &[u8]) -> bool {
    // What terminals write: `=~=~=~ PuTTY log`, `--- Miniterm on COM3`.
    let marks: [&[u8]; 5] = [b"#", b"%", b"//", b"=~=~", b"--- "];
    marks.iter().any(|mark| line.starts_with(mark))
}

/// True for the name of a section: `[data]`.
fn is_section(line: &[u8]) -> bool {
    let name = line.trim_ascii().strip_prefix(b"[");
    let name = name.and_then(|name| name.strip_suffix(b"]"));
    name.is_some_and(|name| !name.is_empty() && name.iter().all(u8::is_ascii_alphabetic))
}

/// The line without the mark of a comment.
pub(crate) fn without_comment_mark(line: &[u8]) -> &[u8] {
    let marks = line
        .iter()
        .take_while(|b| matches!(b, b'#' | b'%' | b'/' | b' '))
        .count();
    if is_comment(line) {
        &line[marks..]
    } else {
        line
    }
}

/// The cells of a line.
pub(crate) fn cells(line: &[u8], dialect: Dialect) -> Vec<Cell> {
    let mut cells = Vec::new();
    let _ = dialect.split(line, &mut cells);
    cells
}

/// Bytes of a cell as text, by Latin-1 where they are no UTF-8.
pub(crate) fn decode(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

/// The cells of a line that may be a comment, as text.
pub(crate) fn words(line: &[u8], dialect: Dialect) -> Vec<String> {
    let line = without_comment_mark(line);
    let cells = cells(line, dialect).into_iter();
    cells.map(|cell| decode(&line[cell])).collect()
}

/// True if at least half of the cells are numbers.
pub(crate) fn is_row(line: &[u8], dialect: Dialect) -> bool {
    let cells = cells(line, dialect);
    let number = |cell: &Cell| {
        let value = number::parse(
            &line[cell.clone()],
            dialect.decimal_comma,
            &mut Dialects::default(),
        );
        matches!(
            value,
            Ok(_) | Err(Fault::NotFinite | Fault::Thousands | Fault::DecimalComma)
        )
    };
    let numbers = cells.iter().filter(|cell| number(cell)).count();
    numbers >= 1 && 2 * numbers >= cells.len()
}

/// Looks for the preface of a text.
pub(crate) struct Finder<'a> {
    /// Separator and decimal mark of the text.
    pub dialect: Dialect,
    /// The one sensor in it, if that is known.
    pub only: Option<Sensor>,
    /// Options of the user.
    pub options: &'a ReadOptions,
}

impl Finder<'_> {
    /// The preface of `kept`, the first row of which has the index `row`.
    pub fn preface<'k>(&self, kept: &'k [Kept], row: Option<usize>) -> Preface<'k> {
        let before = &kept[..row.unwrap_or(kept.len())];
        let header = match row {
            Some(row) => self.header(before, &kept[row]),
            None => kept.iter().find(|k| !k.comment),
        };
        let units = header.and_then(|header| {
            let below = before.iter().find(|k| k.number > header.number)?;
            let cells = words(&below.bytes, self.dialect);
            let as_wide = cells.len() == words(&header.bytes, self.dialect).len();
            (as_wide && unit_row::holds_units(&cells)).then_some(below)
        });
        let is_text = |k: &&Kept| !k.comment && !self.is_broken_row(k);
        let nameless = row.is_some() && header.is_none();
        let said = match units.or(header).filter(|_| row.is_some()) {
            // Where a column comes from, and the name of a section, are no rows.
            Some(names) => before.iter().rfind(|k| {
                let is_said = units.is_some() && self.is_words(k, names);
                !k.comment && k.number > names.number && (is_said || is_section(&k.bytes))
            }),
            None => before.iter().rfind(|k| nameless && is_text(k)),
        };
        Preface {
            header,
            units,
            said,
        }
    }

    /// The line that names the columns of `row`: the text line before it, or a comment with as many
    /// cells; but one above that names sensors, where that line does not.
    fn header<'k>(&self, before: &'k [Kept], row: &Kept) -> Option<&'k Kept> {
        let width = |k: &Kept| words(&k.bytes, self.dialect).len();
        let as_wide = |k: &Kept| width(k) == width(row);
        let above = |line: &Kept| {
            let mut above = before.iter().filter(|k| k.number < line.number);
            above.rfind(|k| as_wide(k) && self.names_sensors(k))
        };
        if let Some(text) = before.iter().rfind(|k| !k.comment) {
            return match self.names_sensors(text) {
                // Cells that are units may be told apart as sensors, and are no names where there are some above.
                true => self.above_units(text, before).or(Some(text)),
                false => above(text)
                    .or_else(|| self.above_units(text, before))
                    .or_else(|| self.unnamed(before))
                    .filter(|header| self.may_name(header, width(row))),
            };
        }
        let comment = before.last()?;
        let bytes = without_comment_mark(&comment.bytes);
        let is_header = as_wide(comment)
            && bytes.iter().any(u8::is_ascii_alphabetic)
            && !is_row(bytes, self.dialect);
        let units = is_header && unit_row::holds_units(&words(bytes, self.dialect));
        let named = units.then(|| above(comment)).flatten();
        named.or(Some(comment).filter(|_| is_header))
    }

    /// The line above a row of units: its names are not understood, and are names all the same.
    fn above_units<'k>(&self, units: &Kept, before: &'k [Kept]) -> Option<&'k Kept> {
        let cells = words(&units.bytes, self.dialect);
        if !unit_row::holds_units(&cells) {
            return None;
        }
        let mut above = before
            .iter()
            .filter(|k| k.number < units.number && !k.comment);
        above.rfind(|k| words(&k.bytes, self.dialect).len() == cells.len())
    }

    /// False for what a program says before its rows: one cell, and no names of `width` columns glued together.
    fn may_name(&self, line: &Kept, width: usize) -> bool {
        let cells = words(&line.bytes, self.dialect);
        let separates = |c: char| matches!(c, ',' | ';' | '\t' | ' ' | '|');
        let glued = || {
            let text = decode(&line.bytes);
            text.split(separates)
                .filter(|word| !word.is_empty())
                .count()
        };
        let one = cells.len() == 1 && width >= 3;
        !one || glued().abs_diff(width) <= 1
            || self.dialect.split(&line.bytes, &mut Vec::new()).is_err()
    }

    /// Returns the likely header where no line as wide as the rows names sensors: the last text before them that is no broken row, or
    /// the line where a cell over two lines begins.
    fn unnamed<'k>(&self, before: &'k [Kept]) -> Option<&'k Kept> {
        let texts = || before.iter().filter(|k| !k.comment);
        let header = texts().rfind(|k| !self.is_broken_row(k))?;
        let is_open = |k: &&Kept| self.dialect.split(&k.bytes, &mut Vec::new()).is_err();
        let begin = texts().rfind(|k| k.number < header.number && is_open(k));
        Some(begin.filter(|_| is_open(&header)).unwrap_or(header))
    }

    /// True for a line as wide as `other` with words and no number in its cells.
    fn is_words(&self, line: &Kept, other: &Kept) -> bool {
        let words_of = |line: &Kept| words(&line.bytes, self.dialect);
        let own = words_of(line);
        let is_number = |word: &String| word.trim().parse::<f64>().is_ok();
        own.len() == words_of(other).len()
            && own.iter().any(|word| word.contains(char::is_alphabetic))
            && !own.iter().any(is_number)
    }

    /// True if most of its cells begin like numbers.
    fn is_broken_row(&self, line: &Kept) -> bool {
        let words = words(&line.bytes, self.dialect);
        let is_begun = |word: &&String| {
            let digits = word.trim_start_matches(['+', '-', '.']);
            // A channel may be called after the number of its device: `6251.12345:scaledAccelX`.
            let letters = word.chars().filter(|c| c.is_alphabetic()).count();
            digits.starts_with(|c: char| c.is_ascii_digit()) && 2 * letters <= word.len()
        };
        2 * words.iter().filter(is_begun).count() > words.len()
    }

    fn names_sensors(&self, line: &Kept) -> bool {
        let names = words(&line.bytes, self.dialect);
        Layout::of_names(names, &self.options.columns, self.only).is_ok()
    }
}
