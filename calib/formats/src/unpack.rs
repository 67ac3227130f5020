//! Chunks that are compressed by one of the usual ways.

use std::borrow::Cow;
use std::io::Read;

use findings::{Finding, Kind};

use crate::error::counted;
use crate::shown::shown;
use crate::{Error, Limits};

/// The chunks of a file, which together unpack to no more than the limit.
#[derive(Debug)]
pub(crate) struct Chunks {
    limits: Limits,
    unpacked: u64,
}

impl Chunks {
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            unpacked: 0,
        }
    }

    /// The `size` bytes of the chunk at byte `at`; the inner error is what is wrong with this chunk alone.
    ///
    /// # Errors
    /// More than the limits allow.
    pub fn unpack<'a>(
        &mut self,
        at: u64,
        method: &str,
        packed: &'a [u8],
        size: u64,
    ) -> Result<Result<Cow<'a, [u8]>, Error>, Error> {
        let what = format!("the chunk at byte {at}");
        self.limits
            .check_unpacked(&what, packed.len() as u64, size)?;
        self.unpacked = self.unpacked.saturating_add(size);
        if self.unpacked > self.limits.bytes {
            return Err(self.limits.too_large("the chunks"));
        }
        Ok(unpack(method, packed, size))
    }
}

/// The `size` bytes that `packed` holds, compressed by the method called so in bags and MCAP files.
fn unpack<'a>(method: &str, packed: &'a [u8], size: u64) -> Result<Cow<'a, [u8]>, Error> {
    let mut unpacked = Vec::new();
    let damaged = |error: String| {
        let found = Finding::of(Kind::PART_UNPACKS_NOT).detail("part", format!("{method} chunk"));
        Error::refused(found.detail("reason", error))
    };
    let reader: Box<dyn Read> = match method {
        "" | "none" => return Ok(packed.into()),
        "lz4" => Box::new(lz4_flex::frame::FrameDecoder::new(packed)),
        "bz2" => Box::new(bzip2::read::MultiBzDecoder::new(packed)),
        "zstd" => {
            let decoder = ruzstd::decoding::StreamingDecoder::new(packed);
            Box::new(decoder.map_err(|error| damaged(error.to_string()))?)
        }
        other => {
            let found = Finding::of(Kind::COMPRESSION_UNKNOWN).detail("part", "chunk");
            let found = found.detail("method", shown(other));
            return Err(Error::refused(found.detail("known", "lz4, bz2, zstd")));
        }
    };
    let read = reader
        .take(size.saturating_add(1))
        .read_to_end(&mut unpacked);
    read.map_err(|error| damaged(error.to_string()))?;
    if unpacked.len() as u64 != size {
        let found = Finding::of(Kind::UNPACKED_LENGTH).detail("part", format!("{method} chunk"));
        let found = found.count("bytes", unpacked.len());
        return Err(Error::refused(counted(found, "expected", size)));
    }
    Ok(unpacked.into())
}
