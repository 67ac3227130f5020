//! Thrift's compact protocol, of which Parquet's metadata is made: read past, with a look at chosen fields.
//! "Thrift Compact protocol encoding", <https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md>.

use std::io::{self, Read};

/// Types of fields.
pub(super) const I32: u8 = 5;
pub(super) const BINARY: u8 = 8;
pub(super) const LIST: u8 = 9;
pub(super) const STRUCTURE: u8 = 12;
const TRUE: u8 = 1;
const FALSE: u8 = 2;
pub(super) const BYTE: u8 = 3;
pub(super) const I16: u8 = 4;
pub(super) const I64: u8 = 6;
pub(super) const DOUBLE: u8 = 7;
const SET: u8 = 10;
const MAP: u8 = 11;

/// Structures within structures.
const DEPTH: usize = 64;

/// Bytes of the protocol, and how many of them were read.
#[derive(Debug)]
pub(super) struct Thrift<R> {
    reader: R,
    pub taken: u64,
}

/// A field before its value is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Field {
    pub number: i64,
    pub kind: u8,
}

/// Expected type of a value.
#[derive(Debug)]
pub(super) enum Shape {
    /// A value of this Thrift type.
    Plain(u8),
    /// True or false.
    Truth,
    /// Elements of one shape.
    List(&'static Shape),
    /// Fields, by their numbers from 1; others are not read.
    Structure(&'static [Shape]),
    /// Anything, as it is passed over.
    Unread,
}

impl Shape {
    /// Returns the shape of field `number`; [`Shape::Unread`] for a field that is not listed.
    pub fn of(fields: &'static [Self], number: i64) -> &'static Self {
        let at = usize::try_from(number.saturating_sub(1)).ok();
        at.and_then(|at| fields.get(at)).unwrap_or(&Self::Unread)
    }
}

fn damaged() -> io::Error {
    io::Error::from(io::ErrorKind::InvalidData)
}

impl<R: Read> Thrift<R> {
    pub fn new(reader: R) -> Self {
        Self { reader, taken: 0 }
    }

    fn byte(&mut self) -> io::Result<u8> {
        let mut byte = [0];
        self.reader.read_exact(&mut byte)?;
        self.taken += 1;
        Ok(byte[0])
    }

    fn unsigned(&mut self) -> io::Result<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(damaged())
    }

    /// A number whose lowest bit is its sign.
    pub fn number(&mut self) -> io::Result<i64> {
        let folded = self.unsigned()?;
        Ok((folded >> 1) as i64 ^ -((folded & 1) as i64))
    }

    /// The next field of a structure whose last one was `before`; none at its end.
    pub fn field(&mut self, before: i64) -> io::Result<Option<Field>> {
        let head = self.byte()?;
        if head == 0 {
            return Ok(None);
        }
        let number = match head >> 4 {
            0 => self.number()?,
            step => before.saturating_add(i64::from(step)),
        };
        // Numbers of fields have 16 bits; a parser that cuts longer ones takes the field for another.
        if i16::try_from(number).is_err() {
            return Err(damaged());
        }
        let kind = head & 0xf;
        Ok(Some(Field { number, kind }))
    }

    /// The type and number of the elements of a list.
    pub fn list(&mut self) -> io::Result<(u8, u64)> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.unsigned()?,
            count => u64::from(count),
        };
        Ok((head & 0xf, count))
    }

    /// Passes the value of a field of this type.
    pub fn pass(&mut self, kind: u8) -> io::Result<()> {
        self.pass_within(kind, DEPTH)
    }

    /// Passes a value of this type, which is read as `shape`.
    pub fn pass_as(&mut self, kind: u8, shape: &'static Shape) -> io::Result<()> {
        match (shape, kind) {
            (Shape::Unread, _) => self.pass(kind),
            (Shape::Plain(known), _) if *known == kind => self.pass(kind),
            (Shape::Truth, TRUE | FALSE) => Ok(()),
            (Shape::List(shape), LIST) => {
                let (kind, count) = self.list()?;
                (0..count).try_for_each(|_| self.pass_as(kind, shape))
            }
            (Shape::Structure(fields), STRUCTURE) => {
                let mut before = 0;
                while let Some(Field { number, kind }) = self.field(before)? {
                    before = number;
                    self.pass_as(kind, Shape::of(fields, number))?;
                }
                Ok(())
            }
            _ => Err(damaged()),
        }
    }

    fn pass_within(&mut self, kind: u8, depth: usize) -> io::Result<()> {
        let depth = depth.checked_sub(1).ok_or_else(damaged)?;
        match kind {
            // Their value is their type.
            TRUE | FALSE => Ok(()),
            BYTE => self.byte().map(drop),
            I16 | I32 | I64 => self.unsigned().map(drop),
            DOUBLE => self.pass_bytes(8),
            BINARY => {
                let length = self.unsigned()?;
                self.pass_bytes(length)
            }
            LIST | SET => {
                let (kind, count) = self.list()?;
                // Parquet's metadata has none of truths, and its parser passes over as many as there claim to be.
                if matches!(kind, TRUE | FALSE) && count > 0 {
                    return Err(damaged());
                }
                (0..count).try_for_each(|_| self.pass_within(kind, depth))
            }
            // Nor has it any map of something.
            MAP => match self.unsigned()? {
                0 => Ok(()),
                _ => Err(damaged()),
            },
            STRUCTURE => {
                let mut before = 0;
                while let Some(field) = self.field(before)? {
                    self.pass_within(field.kind, depth)?;
                    before = field.number;
                }
                Ok(())
            }
            _ => Err(damaged()),
        }
    }

    fn pass_bytes(&mut self, length: u64) -> io::Result<()> {
        let passed = io::copy(&mut (&mut self.reader).take(length), &mut io::sink())?;
        self.taken += passed;
        match passed == length {
            true => Ok(()),
            false => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Field 1: −3; field 3: `{1: "ab"}`; field 20: a list of two truths.
    const BYTES: [u8; 13] = [0x15, 5, 0x2c, 0x18, 2, b'a', b'b', 0, 0x09, 40, 0x21, 1, 0];

    #[test]
    fn fields_are_read_and_passed() {
        let mut thrift = Thrift::new(&BYTES[..]);
        let field = |number, kind| Some(Field { number, kind });
        assert_eq!(thrift.field(0).unwrap(), field(1, I32));
        assert_eq!(thrift.number().unwrap(), -3);
        assert_eq!(thrift.field(1).unwrap(), field(3, STRUCTURE));
        thrift.pass(STRUCTURE).unwrap();
        assert_eq!(thrift.field(3).unwrap(), field(20, LIST));
        assert!(thrift.pass(LIST).is_err());
    }

    #[test]
    fn a_list_of_other_elements_than_are_read_is_damage() {
        const NUMBERS: Shape = Shape::List(&Shape::Structure(&[Shape::Plain(I32)]));
        let pass = |bytes: &[u8]| Thrift::new(bytes).pass_as(LIST, &NUMBERS).is_ok();
        assert!(pass(&[0x1c, 0x15, 5, 0]));
        assert!(pass(&[0]));
        // Two numbers instead of two structures; a structure whose number is a text.
        assert!(!pass(&[0x25, 5, 0]));
        assert!(!pass(&[0x1c, 0x18, 0, 0]));
        // A field of which nothing is known.
        assert!(pass(&[0x1c, 0x28, 1, b'a', 0]));
    }

    #[test]
    fn structures_within_structures_end_somewhere() {
        let endless = [0x1c; 100_000];
        assert!(Thrift::new(&endless[..]).pass(STRUCTURE).is_err());
    }
}
