//! Checks of the sizes that a Parquet file states, before its parser allocates memory for them.

use std::io::{BufReader, Read, Seek, SeekFrom};

use parquet::file::metadata::ColumnChunkMetaData;

use findings::{Finding, Kind};

use super::layout::{ELEMENT, FILE, PAGE};
use super::thrift::{Field, I32, LIST, STRUCTURE, Shape, Thrift};
use crate::error;
use crate::shown::shown;
use crate::store::{Store, Stored};
use crate::{Error, Limits};

/// Groups within groups of columns.
const DEPTH: usize = 64;
/// Bytes behind the metadata: its length and the mark.
const TAIL: u64 = 8;
/// The field with the number of children.
const CHILDREN: i64 = 5;
/// The field of the metadata with the schema.
const SCHEMA: i64 = 2;

fn damaged(what: &str) -> Error {
    let found = error::damaged(what).detail("whole", "Parquet file");
    Error::refused(found)
}

/// Refuses a schema with more children than it has elements, or deeper than any recording's: the parser would make room
/// for the former, and call itself for the latter. Refuses metadata with values of another type than is read: the parser
/// would take what follows for the number of things to pass over.
///
/// # Errors
/// Damage.
pub(super) fn check_metadata(file: &mut dyn Stored) -> Result<(), Error> {
    let length = file.seek(SeekFrom::End(0))?;
    let Some(tail) = length.checked_sub(TAIL) else {
        return Ok(());
    };
    file.seek(SeekFrom::Start(tail))?;
    let mut size = [0; 4];
    file.read_exact(&mut size)?;
    let size = u64::from(u32::from_le_bytes(size));
    // The parser says what is wrong with the length.
    let Some(start) = tail.checked_sub(size) else {
        return Ok(());
    };
    file.seek(SeekFrom::Start(start))?;
    let mut thrift = Thrift::new(BufReader::new(file.take(size)));
    let mut before = 0;
    let broken = |_| damaged("metadata");
    while let Some(field) = thrift.field(before).map_err(broken)? {
        before = field.number;
        if field.number != SCHEMA {
            let shape = Shape::of(FILE, field.number);
            thrift.pass_as(field.kind, shape).map_err(broken)?;
            continue;
        }
        let (kind, count) = thrift.list().map_err(broken)?;
        if field.kind != LIST || kind != STRUCTURE {
            return Err(damaged("schema"));
        }
        elements(&mut thrift, count)?;
    }
    Ok(())
}

/// Reads the elements of a schema, parents before their children.
fn elements(thrift: &mut Thrift<impl Read>, count: u64) -> Result<(), Error> {
    // Children still to come, of every group that is open.
    let mut open: Vec<u64> = Vec::new();
    for read in 1..=count {
        let children = children(thrift).map_err(|_| damaged("schema"))?;
        while open.last() == Some(&0) {
            open.pop();
        }
        if let Some(left) = open.last_mut() {
            *left -= 1;
        }
        if children > count - read || open.len() == DEPTH {
            return Err(damaged("schema"));
        }
        if children > 0 {
            open.push(children);
        }
    }
    Ok(())
}

/// The number of children of the next element of a schema.
fn children(thrift: &mut Thrift<impl Read>) -> std::io::Result<u64> {
    let (mut before, mut children) = (0, 0);
    while let Some(Field { number, kind }) = thrift.field(before)? {
        before = number;
        match number {
            CHILDREN if kind == I32 => {
                children = u64::try_from(thrift.number()?).unwrap_or(u64::MAX);
            }
            _ => thrift.pass_as(kind, Shape::of(ELEMENT, number))?,
        }
    }
    Ok(children)
}

/// Refuses pages that unpack to more than their packed bytes can hold, or announce what does not follow: the parser makes
/// room for the former, and counts the latter.
///
/// # Errors
/// Damage, or a page beyond the limits.
pub(super) fn check_pages(
    store: &Store,
    chunk: &ColumnChunkMetaData,
    limits: Limits,
) -> Result<(), Error> {
    let column = shown(&chunk.column_path().string());
    let what = format!("a page of {column}");
    let (start, mut left) = chunk.byte_range();
    let mut file = BufReader::new(store.open()?);
    file.seek(SeekFrom::Start(start))?;
    while left > 0 {
        let mut thrift = Thrift::new(&mut file);
        let header = page(&mut thrift).map_err(|_| damaged(&format!("page of {column}")))?;
        let [unpacked, packed] = header.sizes;
        if header
            .encoding
            .is_some_and(|encoding| DELTA_TEXTS.contains(&encoding))
        {
            let found = Finding::of(Kind::TEXTS_AS_DIFFERENCES);
            return Err(Error::refused(found.detail("what", what)));
        }
        limits.check_unpacked(&what, packed, unpacked)?;
        let length = thrift.taken.saturating_add(packed);
        left = left
            .checked_sub(length)
            .ok_or_else(|| damaged(&format!("page of {column}")))?;
        // Most headers lie in the bytes that are there already.
        let step = i64::try_from(packed).map_err(|_| damaged(&format!("page of {column}")))?;
        file.seek_relative(step)?;
    }
    Ok(())
}

/// The header of a page, as far as it is looked at.
struct Page {
    /// Bytes, unpacked and packed.
    sizes: [u64; 2],
    /// Encoding of its values, by its number in the format.
    encoding: Option<i32>,
}

/// Texts without the beginnings that they share, and behind all of their lengths: the parser makes room for as many as
/// the page says.
const DELTA_TEXTS: [i32; 2] = [6, 7];

/// The header of a page: sizes in fields 2 and 3, the encoding in field 2 of the fifth, or 4 of the eighth.
fn page(thrift: &mut Thrift<impl Read>) -> std::io::Result<Page> {
    let damaged = std::io::ErrorKind::InvalidData;
    let (mut before, mut sizes, mut encoding) = (0, [None; 2], None);
    while let Some(Field { number, kind }) = thrift.field(before)? {
        before = number;
        match (number, kind) {
            (2 | 3, I32) => {
                let size = u64::try_from(thrift.number()?).map_err(|_| damaged)?;
                if sizes[usize::from(number == 3)].replace(size).is_some() {
                    return Err(damaged.into());
                }
            }
            (5 | 8, STRUCTURE) => {
                let Shape::Structure(fields) = Shape::of(PAGE, number) else {
                    return Err(damaged.into());
                };
                let wanted = if number == 5 { 2 } else { 4 };
                let mut before = 0;
                while let Some(Field { number, kind }) = thrift.field(before)? {
                    before = number;
                    match (number == wanted, kind) {
                        (true, I32) => {
                            // The parser keeps 32 bits, and of two the last.
                            if encoding.replace(thrift.number()? as i32).is_some() {
                                return Err(damaged.into());
                            }
                        }
                        _ => thrift.pass_as(kind, Shape::of(fields, number))?,
                    }
                }
            }
            _ => thrift.pass_as(kind, Shape::of(PAGE, number))?,
        }
    }
    let [Some(unpacked), Some(packed)] = sizes else {
        return Err(damaged.into());
    };
    Ok(Page {
        sizes: [unpacked, packed],
        encoding,
    })
}
