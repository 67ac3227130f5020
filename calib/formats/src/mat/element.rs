//! Data elements of MAT files, level 5: MathWorks, "MAT-File Format", R2024, chapter 1.

use crate::Error;
use crate::error::cut;

pub(super) const COMPRESSED: u32 = 15;
pub(super) const MATRIX: u32 = 14;
pub(super) const U32: u32 = 6;
const DOUBLE: u32 = 9;

/// A data element: its type, its bytes and where they begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'a> {
    pub kind: u32,
    pub bytes: &'a [u8],
}

/// Elements one after another.
#[derive(Clone, Debug)]
pub(super) struct Elements<'a> {
    bytes: &'a [u8],
    /// Place of the first byte in the file, or in what it was unpacked from.
    pub at: u64,
}

impl<'a> Elements<'a> {
    pub fn new(bytes: &'a [u8], at: u64) -> Self {
        Self { bytes, at }
    }

    fn number(&self, at: usize) -> Option<u32> {
        let bytes = self.bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    }

    /// The next element; `None` at the end.
    pub fn next(&mut self) -> Result<Option<Element<'a>>, Error> {
        let cut = |at: u64| Error::at(at, cut("data element", "MATLAB file"));
        // Fewer bytes than a tag are padding.
        if self.bytes.len() < 8 {
            return Ok(None);
        }
        let tag = self.number(0).ok_or_else(|| cut(self.at))?;
        // Up to four bytes stand within the tag.
        let (kind, start, length) = match tag >> 16 {
            0 => (
                tag,
                8_usize,
                self.number(4).ok_or_else(|| cut(self.at))? as usize,
            ),
            length => (tag & 0xffff, 4, length as usize),
        };
        let end = start.checked_add(length).ok_or_else(|| cut(self.at))?;
        let bytes = self.bytes.get(start..end).ok_or_else(|| cut(self.at))?;
        let taken = match (start, kind) {
            (4, _) => 8,
            (_, COMPRESSED) => end,
            _ => end.next_multiple_of(8),
        };
        let taken = taken.min(self.bytes.len());
        self.bytes = &self.bytes[taken..];
        self.at += taken as u64;
        Ok(Some(Element { kind, bytes }))
    }

    /// The next element, which has to be there.
    pub fn need(&mut self) -> Result<Element<'a>, Error> {
        let at = self.at;
        self.next()?
            .ok_or_else(|| Error::at(at, cut("matrix", "MATLAB file")))
    }
}

/// Numbers in whatever type they are stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raw<'a>(pub Element<'a>);

impl Raw<'_> {
    /// Bytes of a number; `None` for what is none.
    fn size(self) -> Option<usize> {
        match self.0.kind {
            1 | 2 | 16 => Some(1),
            3 | 4 | 17 => Some(2),
            5..=7 | 18 => Some(4),
            9 | 12 | 13 => Some(8),
            _ => None,
        }
    }

    /// Returns the number of numbers.
    pub fn len(self) -> usize {
        self.size().map_or(0, |size| self.0.bytes.len() / size)
    }

    /// The number at `index`.
    #[inline]
    pub fn get(self, index: usize) -> Option<f64> {
        // Nearly all of them are doubles.
        if self.0.kind == DOUBLE {
            let bytes = self.0.bytes.get(index.checked_mul(8)?..)?;
            return bytes.first_chunk().map(|bytes| f64::from_le_bytes(*bytes));
        }
        self.of_any_type(index)
    }

    fn of_any_type(self, index: usize) -> Option<f64> {
        let size = self.size()?;
        let bytes = self.0.bytes.get(index * size..)?.get(..size)?;
        let mut wide = [0; 8];
        wide[..size].copy_from_slice(bytes);
        let unsigned = u64::from_le_bytes(wide);
        Some(match self.0.kind {
            1 => f64::from(unsigned as u8 as i8),
            3 => f64::from(unsigned as u16 as i16),
            5 => f64::from(unsigned as u32 as i32),
            7 => f64::from(f32::from_bits(unsigned as u32)),
            12 => unsigned as i64 as f64,
            _ => unsigned as f64,
        })
    }

    /// The number at `index` as a whole one.
    pub fn whole(self, index: usize) -> Option<u32> {
        let number = self.get(index)?;
        (0.0..=f64::from(u32::MAX))
            .contains(&number)
            .then_some(number as u32)
    }
}
