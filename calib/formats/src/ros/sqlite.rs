//! Rows of the tables in an SQLite file: <https://www.sqlite.org/fileformat2.html>, sections 1.3 to 2.1.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{BufReader, Read, SeekFrom};

use findings::{Finding, Kind};

use crate::Error;
use crate::error::cut;
use crate::format::ReadSeek;

const HEADER: usize = 100;
const INTERIOR: u8 = 0x05;
const LEAF: u8 = 0x0d;
/// Pages on the way from a root to a leaf.
const DEPTH: usize = 40;

/// A value of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value<'a> {
    Null,
    Integer(i64),
    Real(f64),
    Text(&'a [u8]),
    Blob(&'a [u8]),
}

/// Number and payload of a row.
type Row<'a> = (i64, Cow<'a, [u8]>);

/// A file whose pages are read when they are wanted.
pub(crate) struct Database<'a> {
    file: BufReader<&'a mut dyn ReadSeek>,
    /// Its length, and the byte to be read next.
    length: u64,
    at: u64,
    page: usize,
    /// Bytes of a page that hold content.
    usable: usize,
}

/// Callback for a row: its byte in the file, its number and its values.
pub(crate) type Visit<'v> = dyn FnMut(u64, i64, &[Value<'_>]) -> Result<(), Error> + 'v;

fn big_endian(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .fold(0, |sum, byte| sum << 8 | usize::from(*byte))
}

/// A number of one to nine bytes, and how many.
fn varint(bytes: &[u8]) -> Option<(u64, usize)> {
    let mut value: u64 = 0;
    for (at, byte) in bytes.iter().take(9).enumerate() {
        if at == 8 {
            return Some((value << 8 | u64::from(*byte), 9));
        }
        value = value << 7 | u64::from(byte & 0x7f);
        if byte & 0x80 == 0 {
            return Some((value, at + 1));
        }
    }
    None
}

impl<'a> Database<'a> {
    /// The database in `file`.
    pub fn new(file: &'a mut dyn ReadSeek) -> Result<Self, Error> {
        let length = file.seek(SeekFrom::End(0))?;
        file.seek(SeekFrom::Start(0))?;
        let mut header = [0; HEADER];
        if length < HEADER as u64 {
            return Err(Error::at(length, cut("header", "database")));
        }
        file.read_exact(&mut header)?;
        let page = match big_endian(&header[16..18]) {
            1 => 65_536,
            size => size,
        };
        let usable = page.saturating_sub(usize::from(header[20]));
        if !page.is_power_of_two() || page < 512 || usable < 480 {
            return Err(Error::at(
                16,
                Finding::of(Kind::PAGE_SIZE_WRONG).count("bytes", page),
            ));
        }
        Ok(Self {
            file: BufReader::new(file),
            length,
            at: HEADER as u64,
            page,
            usable,
        })
    }

    /// Byte and content of a page, numbered from 1.
    fn page(&mut self, number: usize) -> Result<(u64, Vec<u8>), Error> {
        let size = self.page as u64;
        let at = (number as u64)
            .checked_sub(1)
            .and_then(|k| k.checked_mul(size));
        let whole = |at: &u64| at.checked_add(size).is_some_and(|end| end <= self.length);
        let at = at.filter(whole).ok_or_else(|| {
            Error::at(
                self.length,
                Finding::of(Kind::PAGE_MISSING).count("page", number),
            )
        })?;
        // Pages follow each other mostly, so that the buffer is kept.
        self.file.seek_relative(at as i64 - self.at as i64)?;
        let mut page = vec![0; self.page];
        self.file.read_exact(&mut page)?;
        self.at = at + size;
        Ok((at, page))
    }

    /// The root pages of the tables, by name.
    pub fn tables(&mut self) -> Result<HashMap<String, usize>, Error> {
        let mut tables = HashMap::new();
        self.rows(1, &mut |_, _, row| {
            if let [
                Value::Text(b"table"),
                Value::Text(name),
                _,
                Value::Integer(root),
                ..,
            ] = row
                && let Ok(root) = usize::try_from(*root)
            {
                tables.insert(String::from_utf8_lossy(name).into_owned(), root);
            }
            Ok(())
        })?;
        Ok(tables)
    }

    /// Visits the rows of the table with this root in the order of their numbers.
    pub fn rows(&mut self, root: usize, visit: &mut Visit<'_>) -> Result<(), Error> {
        // Pages that lead to each other in a circle are more than there are.
        let mut left = self.length / self.page as u64 + 1;
        self.walk(root, 0, &mut left, visit)
    }

    fn walk(
        &mut self,
        number: usize,
        depth: usize,
        left: &mut u64,
        visit: &mut Visit<'_>,
    ) -> Result<(), Error> {
        let (at, page) = self.page(number)?;
        let of_page = |kind: Kind| Finding::of(kind).count("page", number);
        let damaged = |part: &str| Error::at(at, of_page(Kind::PAGE_DAMAGED).detail("part", part));
        *left = left
            .checked_sub(1)
            .filter(|_| depth < DEPTH)
            .ok_or_else(|| Error::at(at, of_page(Kind::PAGES_IN_CIRCLE)))?;
        let start = if number == 1 { HEADER } else { 0 };
        let header = &page[start..];
        let (kind, cells) = (header[0], big_endian(&header[3..5]));
        let pointers = match kind {
            INTERIOR => 12,
            LEAF => 8,
            _ => return Err(damaged("kind")),
        };
        for k in 0..cells {
            let pointer = header
                .get(pointers + 2 * k..pointers + 2 * k + 2)
                .ok_or_else(|| damaged("cells"))?;
            let offset = big_endian(pointer);
            let cell = page
                .get(offset..self.usable)
                .ok_or_else(|| damaged("cell"))?;
            if kind == LEAF {
                self.leaf(cell, at + offset as u64, visit)?
                    .ok_or_else(|| damaged("row"))?;
            } else {
                let child = big_endian(cell.get(..4).ok_or_else(|| damaged("pointer"))?);
                self.walk(child, depth + 1, left, visit)?;
            }
        }
        if kind == INTERIOR {
            self.walk(big_endian(&header[8..12]), depth + 1, left, visit)?;
        }
        Ok(())
    }

    /// Visits the row in a cell; `None` for one that contradicts itself.
    fn leaf(&mut self, cell: &[u8], at: u64, visit: &mut Visit<'_>) -> Result<Option<()>, Error> {
        let Some((id, payload)) = self.payload(cell)? else {
            return Ok(None);
        };
        match values(&payload) {
            Some(row) => visit(at, id, &row).map(Some),
            None => Ok(None),
        }
    }

    /// Number and payload of a row, gathered from overflow pages where it is long.
    fn payload<'c>(&mut self, cell: &'c [u8]) -> Result<Option<Row<'c>>, Error> {
        let parse = || {
            let (length, first) = varint(cell)?;
            let (id, second) = varint(cell.get(first..)?)?;
            Some((
                usize::try_from(length).ok()?,
                id as i64,
                cell.get(first + second..)?,
            ))
        };
        let Some((length, id, content)) =
            parse().filter(|(length, ..)| *length as u64 <= self.length)
        else {
            return Ok(None);
        };
        let most = self.usable - 35;
        if length <= most {
            return Ok(content.get(..length).map(|content| (id, content.into())));
        }
        let least = (self.usable - 12) * 32 / 255 - 23;
        let kept = least + (length - least) % (self.usable - 4);
        let kept = if kept <= most { kept } else { least };
        let Some((local, next)) = content.get(..kept).zip(content.get(kept..kept + 4)) else {
            return Ok(None);
        };
        let mut payload = local.to_vec();
        let mut next = big_endian(next);
        while payload.len() < length {
            let (_, page) = self.page(next)?;
            next = big_endian(&page[..4]);
            let part = (length - payload.len()).min(self.usable - 4);
            payload.extend_from_slice(&page[4..4 + part]);
        }
        Ok(Some((id, payload.into())))
    }
}

/// The values of a record.
fn values(payload: &[u8]) -> Option<Vec<Value<'_>>> {
    let (size, mut at) = varint(payload)?;
    let size = usize::try_from(size).ok()?;
    let mut body = payload.get(size..)?;
    let mut values = Vec::new();
    while at < size {
        let (kind, length) = varint(payload.get(at..size)?)?;
        at += length;
        let length = match kind {
            0 | 8 | 9 => 0,
            1..=4 => kind as usize,
            5 => 6,
            6 | 7 => 8,
            10 | 11 => return None,
            _ => usize::try_from((kind - 12) / 2).ok()?,
        };
        let (bytes, rest) = body.split_at_checked(length)?;
        body = rest;
        values.push(match kind {
            0 => Value::Null,
            1..=6 => {
                let negative = bytes.first().is_some_and(|byte| byte & 0x80 != 0);
                let start = if negative { -1 } else { 0 };
                Value::Integer(
                    bytes
                        .iter()
                        .fold(start, |sum: i64, byte| sum << 8 | i64::from(*byte)),
                )
            }
            7 => Value::Real(f64::from_be_bytes(bytes.try_into().ok()?)),
            8 => Value::Integer(0),
            9 => Value::Integer(1),
            kind if kind % 2 == 0 => Value::Blob(bytes),
            _ => Value::Text(bytes),
        });
    }
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_length_are_read() {
        assert_eq!(varint(&[0x05]), Some((5, 1)));
        assert_eq!(varint(&[0x81, 0x00]), Some((128, 2)));
        assert_eq!(varint(&[0xff; 9]), Some((u64::MAX, 9)));
        assert_eq!(varint(&[0x80]), None);
        let record = [6, 1, 2, 8, 15, 16, 0xff, 1, 0, b'a', 7, 8];
        let expected = [
            Value::Integer(-1),
            Value::Integer(256),
            Value::Integer(0),
            Value::Text(b"a"),
            Value::Blob(&[7, 8]),
        ];
        assert_eq!(values(&record), Some(expected.to_vec()));
    }
}
