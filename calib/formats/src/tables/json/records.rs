//! Records one after the other: a value per line, or the elements of an array.

use findings::{Finding, Kind};
use std::cell::Cell;
use std::fmt;
use std::io::{self, BufReader, Read};
use std::rc::Rc;

use serde::de::{Deserializer as _, SeqAccess, Visitor};
use serde_json::{Deserializer, Value};

use super::flat::Row;
use super::packets;
use crate::error::{counted, no_json};
use crate::store::{Store, Stored};
use crate::tables::rows;
use crate::{Error, Limits};

/// No record is longer, bytes, nor a document that is held as a whole.
pub(super) const LONGEST: u64 = 64 << 20;

/// The bytes of a file, of which a value may take so many.
pub(super) struct Budgeted {
    reader: Box<dyn Stored>,
    left: Rc<Cell<u64>>,
}

impl Budgeted {
    /// Those in `store`, without the mark that texts begin with, and what is left for the value that is being read.
    pub fn open(store: &Store) -> Result<(BufReader<Self>, Rc<Cell<u64>>), Error> {
        let left = Rc::new(Cell::new(LONGEST));
        let mut reader = store.open()?;
        let mut mark = [0; 3];
        let read = reader.read(&mut mark)?;
        if &mark[..read] != b"\xef\xbb\xbf" {
            reader.rewind()?;
        }
        let budgeted = Self {
            reader,
            left: left.clone(),
        };
        Ok((BufReader::with_capacity(64 << 10, budgeted), left))
    }
}

/// The first byte of the text in `store` that is no blank; a blank where there is none.
///
/// # Errors
/// What the system fails with.
pub(super) fn first_byte(store: &Store) -> Result<u8, Error> {
    let (mut begin, _) = Budgeted::open(store)?;
    let mut byte = [b' '];
    while byte[0].is_ascii_whitespace() && begin.read(&mut byte)? > 0 {}
    Ok(byte[0])
}

impl Read for Budgeted {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left.get() == 0 {
            let found = counted(Finding::of(Kind::VALUE_TOO_LONG), "limit", LONGEST);
            return Err(Error::refused(found).into());
        }
        let read = self.reader.read(buffer)?;
        self.left.set(self.left.get().saturating_sub(read as u64));
        Ok(read)
    }
}

/// The records of a file.
pub(super) struct Records {
    reader: BufReader<Budgeted>,
    left: Rc<Cell<u64>>,
    is_array: bool,
}

impl Records {
    /// Those in `store`.
    ///
    /// # Errors
    /// What the system fails with.
    pub fn of(store: &Store) -> Result<Self, Error> {
        let is_array = first_byte(store)? == b'[';
        let (reader, left) = Budgeted::open(store)?;
        Ok(Self {
            reader,
            left,
            is_array,
        })
    }

    /// Gives every record to `take`; what is told where the file ends within one.
    ///
    /// # Errors
    /// Damage, more records than the limit, and what `take` refuses.
    pub fn each(
        self,
        limits: Limits,
        take: &mut dyn FnMut(Row) -> Result<(), Error>,
    ) -> Result<Option<Finding>, Error> {
        let mut elements = Elements {
            take,
            left: self.left,
            count: 0,
            limits,
            refused: None,
        };
        let mut json = Deserializer::from_reader(self.reader);
        let read = match self.is_array {
            true => json.deserialize_seq(&mut elements),
            false => json.into_iter::<Value>().try_for_each(|value| {
                elements.take(&value?);
                Ok(())
            }),
        };
        if let Some(error) = elements.refused {
            return Err(error);
        }
        match read {
            Err(error) if error.is_eof() && elements.count > 0 => Ok(Some(
                Finding::of(Kind::FILE_CUT)
                    .detail("within", "a record")
                    .count("line", error.line()),
            )),
            Err(error) => Err(no_json(&error)),
            Ok(()) => Ok(None),
        }
    }
}

struct Elements<'a> {
    take: &'a mut dyn FnMut(Row) -> Result<(), Error>,
    left: Rc<Cell<u64>>,
    count: u64,
    limits: Limits,
    refused: Option<Error>,
}

impl Elements<'_> {
    fn take(&mut self, value: &Value) {
        if self.refused.is_some() {
            return;
        }
        self.left.set(LONGEST);
        let read = packets::rows(value).and_then(|rows| {
            self.count += rows.len() as u64;
            rows::check(self.count, self.limits.rows)?;
            rows.into_iter().try_for_each(|row| (self.take)(row))
        });
        self.refused = read.err();
    }
}

impl<'de> Visitor<'de> for &mut Elements<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut records: A) -> Result<(), A::Error> {
        while let Some(value) = records.next_element::<Value>()? {
            self.take(&value);
        }
        Ok(())
    }
}
