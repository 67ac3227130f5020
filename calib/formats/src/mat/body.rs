//! The bytes of a variable, unpacked while they are read.

use std::io::{BufRead, Read};

use findings::{Finding, Kind};
use flate2::{Decompress, FlushDecompress, Status};

use super::element::{COMPRESSED, MATRIX};
use crate::error::{contradicted, cut};
use crate::{Error, Limits};

/// The packed content of an element in a sentence.
const VARIABLE: &str = "compressed variable";
/// Bytes of a tag.
const TAG: u64 = 8;
/// Deflate packs no tighter: RFC 1951, section 3.2.5, a length of 258 in two bits.
const TIGHTEST: u64 = 1032;

/// Header of a data element: type and length in bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag {
    pub kind: u32,
    pub length: u64,
}

/// Content of up to four bytes, which stands within the tag.
type Short = Option<Vec<u8>>;

impl Tag {
    pub fn of(bytes: [u8; 8]) -> Self {
        let [a, b, c, d, rest @ ..] = bytes;
        Self {
            kind: u32::from_le_bytes([a, b, c, d]),
            length: u64::from(u32::from_le_bytes(rest)),
        }
    }
}

/// The content of a matrix at the top of the file.
pub(super) struct Body<'a> {
    part: &'a mut dyn BufRead,
    /// Decompressor of the content; `None` if it is not compressed.
    inflate: Option<Decompress>,
    /// Byte of the file where the variable begins.
    pub at: u64,
    /// Bytes of the matrix in all.
    pub size: u64,
    /// Bytes that are left of them.
    left: u64,
}

impl<'a> Body<'a> {
    /// The matrix behind `tag` at byte `at`, whose content is `part`; `None` for a packed element of another type.
    ///
    /// # Errors
    /// Damage, or more than the limits allow.
    pub fn open(
        part: &'a mut dyn BufRead,
        tag: Tag,
        at: u64,
        limits: Limits,
    ) -> Result<Option<Self>, Error> {
        let mut body = Self {
            part,
            inflate: (tag.kind == COMPRESSED).then(|| Decompress::new(true)),
            at,
            size: tag.length,
            left: tag.length,
        };
        if body.inflate.is_some() {
            let mut inner = [0; TAG as usize];
            body.left = TAG;
            body.fill(&mut inner)?;
            let inner = Tag::of(inner);
            limits.check_unpacked(&format!("the {VARIABLE}"), tag.length, inner.length)?;
            if inner.kind != MATRIX {
                return Ok(None);
            }
            body.size = inner.length.min(tag.length.saturating_mul(TIGHTEST));
            body.left = body.size;
        }
        Ok(Some(body))
    }

    /// Place of the next byte, in the file or in what the variable unpacks to.
    pub fn place(&self) -> u64 {
        self.at + TAG + self.size - self.left
    }

    /// The next tag and, where the content stands within the tag, that content; `None` at the end.
    ///
    /// # Errors
    /// Damage.
    pub fn tag(&mut self) -> Result<Option<(Tag, Short)>, Error> {
        // Fewer bytes than a tag are padding.
        if self.left < TAG {
            return Ok(None);
        }
        let mut bytes = [0; TAG as usize];
        self.fill(&mut bytes)?;
        let tag = Tag::of(bytes);
        let short = u64::from(tag.kind >> 16);
        if short == 0 {
            return Ok(Some((tag, None)));
        }
        let tag = Tag {
            kind: tag.kind & 0xffff,
            length: short,
        };
        let content = bytes.get(4..4 + short as usize);
        let content = content.ok_or_else(|| self.cut())?.to_vec();
        Ok(Some((tag, Some(content))))
    }

    /// The content behind a tag of `length` bytes, and its padding passed.
    ///
    /// # Errors
    /// Damage.
    pub fn content(&mut self, length: u64) -> Result<Vec<u8>, Error> {
        if length > self.left {
            return Err(self.cut());
        }
        let bytes = self.bytes(length)?;
        self.pass((length.next_multiple_of(8) - length).min(self.left))?;
        Ok(bytes)
    }

    /// The next element, which has to be there: its content.
    ///
    /// # Errors
    /// Damage.
    pub fn need(&mut self) -> Result<Vec<u8>, Error> {
        match self.tag()? {
            Some((_, Some(content))) => Ok(content),
            Some((tag, None)) => self.content(tag.length),
            None => Err(self.cut()),
        }
    }

    /// All that is left.
    ///
    /// # Errors
    /// Damage.
    pub fn rest(&mut self) -> Result<Vec<u8>, Error> {
        self.content(self.left)
    }

    /// Passes `length` bytes.
    ///
    /// # Errors
    /// Damage.
    pub fn pass(&mut self, length: u64) -> Result<(), Error> {
        if length > self.left {
            return Err(self.cut());
        }
        let mut passed = vec![0; length.min(64 << 10) as usize];
        let mut left = length;
        while left > 0 {
            let piece = left.min(passed.len() as u64);
            self.fill(&mut passed[..piece as usize])?;
            left -= piece;
        }
        Ok(())
    }

    /// True once the packed bytes end where they should, with the right checksum.
    ///
    /// # Errors
    /// Damage.
    pub fn finish(mut self) -> Result<(), Error> {
        self.pass(self.left)?;
        if self.inflate.is_some() {
            let mut none = [0; 1];
            if self.inflate_into(&mut none)? != 0 {
                let found = contradicted(VARIABLE, "longer", "its header");
                return Err(Error::at(self.at, found));
            }
        }
        Ok(())
    }

    /// The next `length` bytes. Memory grows with what there is.
    fn bytes(&mut self, length: u64) -> Result<Vec<u8>, Error> {
        if self.inflate.is_some() {
            // No longer than what the packed bytes can hold.
            let mut bytes = vec![0; length as usize];
            self.fill(&mut bytes)?;
            return Ok(bytes);
        }
        let mut bytes = Vec::with_capacity(length.min(1 << 20) as usize);
        (&mut *self.part).take(length).read_to_end(&mut bytes)?;
        if (bytes.len() as u64) < length {
            return Err(self.cut());
        }
        self.left -= length;
        Ok(bytes)
    }

    fn cut(&self) -> Error {
        Error::at(self.place(), cut("data element", "MATLAB file"))
    }

    fn fill(&mut self, out: &mut [u8]) -> Result<(), Error> {
        let filled = match self.inflate {
            Some(_) => self.inflate_into(out)?,
            None => {
                self.part.read_exact(out)?;
                out.len()
            }
        };
        if filled < out.len() {
            let found = contradicted(VARIABLE, "shorter", "its header");
            return Err(Error::at(self.at, found));
        }
        self.left -= out.len() as u64;
        Ok(())
    }

    /// Unpacks straight to where the bytes belong; as many as there are.
    fn inflate_into(&mut self, out: &mut [u8]) -> Result<usize, Error> {
        let Some(inflate) = &mut self.inflate else {
            return Ok(0);
        };
        let at = self.at;
        let damaged = |reason: String| {
            let found = Finding::of(Kind::PART_UNPACKS_NOT).detail("part", VARIABLE);
            Error::at(at, found.detail("reason", reason))
        };
        let mut filled = 0;
        while filled < out.len() {
            let packed = self.part.fill_buf()?;
            let ended = packed.is_empty();
            let (read, written) = (inflate.total_in(), inflate.total_out());
            let status = inflate.decompress(packed, &mut out[filled..], FlushDecompress::None);
            let status = status.map_err(|error| damaged(error.to_string()))?;
            let read = (inflate.total_in() - read) as usize;
            let written = (inflate.total_out() - written) as usize;
            self.part.consume(read);
            filled += written;
            if status == Status::StreamEnd {
                break;
            }
            if ended || (read == 0 && written == 0) {
                return Err(Error::at(at, cut(VARIABLE, "MATLAB file")));
            }
        }
        Ok(filled)
    }
}
