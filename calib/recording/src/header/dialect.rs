//! Separators and decimal marks of texts.

use memchr::memchr;

use crate::rows::number::{self, Dialects, Fault};

/// Separator between two cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    /// One byte: `,`, `;` or a tab.
    Byte(u8),
    /// Any run of spaces and tabs.
    Blanks,
}

/// Separator and decimal mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dialect {
    /// Separator between two cells.
    pub separator: Separator,
    /// `,` is the decimal mark.
    pub decimal_comma: bool,
}

/// Byte range of a cell in its line, without blanks and quotes around it.
pub(crate) type Cell = std::ops::Range<usize>;

/// Every dialect, the likelier first: a tie is decided in this order.
const DIALECTS: [Dialect; 8] = [
    Dialect {
        separator: Separator::Byte(b';'),
        decimal_comma: false,
    },
    Dialect {
        separator: Separator::Byte(b'\t'),
        decimal_comma: false,
    },
    Dialect {
        separator: Separator::Byte(b','),
        decimal_comma: false,
    },
    Dialect {
        separator: Separator::Byte(b';'),
        decimal_comma: true,
    },
    Dialect {
        separator: Separator::Byte(b'\t'),
        decimal_comma: true,
    },
    Dialect {
        separator: Separator::Blanks,
        decimal_comma: false,
    },
    Dialect {
        separator: Separator::Blanks,
        decimal_comma: true,
    },
    // Cells in quotes.
    Dialect {
        separator: Separator::Byte(b','),
        decimal_comma: true,
    },
];

findings::tuning! {
    /// Rows that one separator splits, so that one line more is none for another.
    ENOUGH: usize = 10;
}

impl Dialect {
    /// The decimal mark.
    pub fn mark(self) -> u8 {
        if self.decimal_comma { b',' } else { b'.' }
    }

    /// The dialect in which most of `lines` are rows of numbers; without any, the one whose separator
    /// they hold most of.
    pub fn of(lines: &[&[u8]]) -> Self {
        let mut best = (0, DIALECTS[2]);
        let mut cells = Vec::new();
        for dialect in DIALECTS {
            let reads = |line: &&&[u8]| dialect.reads(line, &mut cells);
            let score = lines.iter().filter(reads).count();
            // Of names such as `Channel 1` blanks make numbers, where another separator splits all rows.
            let names =
                usize::from(dialect.separator == Separator::Blanks && best.0 >= ENOUGH.get());
            if score > best.0 + names {
                best = (score, dialect);
            }
        }
        if best.0 > 0 {
            return best.1;
        }
        let count = |byte: u8| {
            lines
                .iter()
                .map(|line| memchr::memchr_iter(byte, line).count())
                .sum()
        };
        let counts: [usize; 3] = [count(b';'), count(b'\t'), count(b',')];
        match (0..3).max_by_key(|&i| counts[i]) {
            Some(i) if counts[i] > 0 => DIALECTS[i],
            _ => DIALECTS[5],
        }
    }

    /// True if `line` has three numbers or more and nothing that looks like two cells in one.
    fn reads(self, line: &[u8], cells: &mut Vec<Cell>) -> bool {
        // Most lines hold no other separator than their own.
        let separates = match self.separator {
            Separator::Byte(separator) => memchr::memchr_iter(separator, line).count() >= 2,
            Separator::Blanks => memchr::memchr2_iter(b' ', b'\t', line).count() >= 2,
        };
        if !separates || self.split(line, cells).is_err() {
            return false;
        }
        let mut numbers = 0;
        for cell in cells {
            let cell = &line[cell.clone()];
            match number::parse(cell, self.decimal_comma, &mut Dialects::default()) {
                Ok(_) | Err(Fault::NotFinite) => numbers += 1,
                Err(Fault::Missing) => {}
                // A word, a date, `4 / 9`: but `0,5` among points is two cells in one.
                Err(_) if !cell.iter().all(is_of_numbers) => {}
                Err(_) => return false,
            }
        }
        numbers >= 3
    }

    /// Fills `cells` with the cells of `line`.
    ///
    /// # Errors
    /// The position of a quote that is never closed.
    pub fn split(self, line: &[u8], cells: &mut Vec<Cell>) -> Result<(), usize> {
        cells.clear();
        if memchr(b'"', line).is_some() {
            return self.split_quoted(line, cells);
        }
        let mut start = 0;
        match self.separator {
            Separator::Byte(separator) => {
                for at in memchr::memchr_iter(separator, line) {
                    cells.push(trimmed(line, start..at));
                    start = at + 1;
                }
                cells.push(trimmed(line, start..line.len()));
            }
            Separator::Blanks => {
                for at in memchr::memchr2_iter(b' ', b'\t', line) {
                    if at > start {
                        cells.push(start..at);
                    }
                    start = at + 1;
                }
                if line.len() > start {
                    cells.push(start..line.len());
                }
            }
        }
        Ok(())
    }

    /// The same where quotes can hide separators.
    fn split_quoted(self, line: &[u8], cells: &mut Vec<Cell>) -> Result<(), usize> {
        let separates = |byte: u8| match self.separator {
            Separator::Byte(separator) => byte == separator,
            Separator::Blanks => byte == b' ' || byte == b'\t',
        };
        let mut quote = None;
        let mut start = 0;
        for (at, &byte) in line.iter().enumerate() {
            match (byte, quote) {
                (b'"', None) => quote = Some(at),
                (b'"', Some(_)) => quote = None,
                (_, None) if separates(byte) => {
                    cells.push(trimmed(line, start..at));
                    start = at + 1;
                }
                _ => {}
            }
        }
        cells.push(trimmed(line, start..line.len()));
        if self.separator == Separator::Blanks {
            cells.retain(|cell| !cell.is_empty());
        }
        quote.map_or(Ok(()), Err)
    }
}

/// True for what numbers and the separators between them are written with.
fn is_of_numbers(byte: &u8) -> bool {
    matches!(
        byte,
        b'0'..=b'9' | b'+' | b'-' | b'.' | b',' | b';' | b' ' | b'\t' | b'e' | b'E' | b'"'
    )
}

/// `cell` without blanks around it, then without one pair of quotes, then without blanks again.
fn trimmed(line: &[u8], cell: Cell) -> Cell {
    let blank = |byte: u8| byte == b' ' || byte == b'\t';
    let strip = |Cell { mut start, mut end }: Cell| {
        while start < end && blank(line[start]) {
            start += 1;
        }
        while start < end && blank(line[end - 1]) {
            end -= 1;
        }
        start..end
    };
    let cell = strip(cell);
    if cell.len() >= 2 && line[cell.start] == b'"' && line[cell.end - 1] == b'"' {
        return strip(cell.start + 1..cell.end - 1);
    }
    cell
}
