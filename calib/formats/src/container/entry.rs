//! The content of an entry of a zip archive.

use std::io::{self, BufReader, Read, Seek, SeekFrom};

use findings::{Finding, Kind};
use flate2::Crc;
use flate2::bufread::DeflateDecoder;

use super::directory::Packed;
use crate::Error;
use crate::error::{contradicted, counted};
use crate::store::Stored;

const LOCAL: &[u8] = b"PK\x03\x04";
const LOCAL_SIZE: usize = 30;

/// The bytes of the entry that `packed` describes.
pub(super) fn unpacked(
    mut archive: Box<dyn Stored>,
    packed: &Packed,
) -> Result<Box<dyn Read + Send>, Error> {
    archive.seek(SeekFrom::Start(packed.at))?;
    let mut header = [0; LOCAL_SIZE];
    let missing = || Error::at(packed.at, Finding::of(Kind::ZIP_ENTRY_MISSING));
    archive
        .read_exact(&mut header)
        .map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => missing(),
            _ => error.into(),
        })?;
    if !header.starts_with(LOCAL) {
        return Err(missing());
    }
    let length = |at: usize| i64::from(u16::from_le_bytes([header[at], header[at + 1]]));
    archive.seek(SeekFrom::Current(length(26) + length(28)))?;
    let content = archive.take(packed.packed_size);
    let content: Box<dyn Read + Send> = match packed.method {
        0 => Box::new(content),
        8 => Box::new(DeflateDecoder::new(BufReader::new(content))),
        other => {
            let found = Finding::of(Kind::ZIP_METHOD_UNKNOWN);
            return Err(Error::refused(found.count("method", other.into())));
        }
    };
    Ok(Box::new(Checked {
        content,
        left: packed.size,
        crc: Crc::new(),
        expected: packed.crc,
    }))
}

/// Content whose length and check sum are those that the directory states.
struct Checked {
    content: Box<dyn Read + Send>,
    left: u64,
    crc: Crc,
    expected: u32,
}

impl Read for Checked {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        let read = self.content.read(buffer)?;
        if read as u64 > self.left {
            let found = contradicted("zip entry", "longer", "the directory");
            return Err(Error::refused(found).into());
        }
        self.left -= read as u64;
        self.crc.update(&buffer[..read]);
        if read == 0 && self.left > 0 {
            let found = counted(Finding::of(Kind::ZIP_ENTRY_CUT), "missing", self.left);
            let cut = io::ErrorKind::UnexpectedEof;
            return Err(io::Error::new(cut, Error::refused(found)));
        }
        if read == 0 && self.crc.sum() != self.expected {
            let found = Finding::of(Kind::CHECK_SUM_WRONG).detail("part", "zip entry");
            return Err(Error::refused(found).into());
        }
        Ok(read)
    }
}
