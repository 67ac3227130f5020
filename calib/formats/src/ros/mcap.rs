//! MCAP, as ROS 2 writes it: <https://mcap.dev/spec>.

use findings::{Finding, Kind};
use std::collections::HashMap;
use std::io::Read;

use crate::bytes::{Bytes, Fields};
use crate::error::{contradicted, damaged};
use crate::format::{Format, Reads};
use crate::ros::imu::{Encoding, Topics};
use crate::stream::{Recorder, chunk_damaged, cut_at};
use crate::unpack::Chunks;
use crate::{Content, Error, Limits, Wanted};

/// MCAP files; chunks by lz4, zstd or as they are. Indices are not needed.
pub(crate) static MCAP: Format = Format {
    name: "mcap",
    about: "an MCAP file with sensor_msgs/Imu, of ROS 2, ROS 1 or in JSON",
    begins: |head| head.starts_with(MAGIC),
    reads: Reads::Forward(read),
};

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
const FOOTER: u8 = 0x02;
const SCHEMA: u8 = 0x03;
const CHANNEL: u8 = 0x04;
const MESSAGE: u8 = 0x05;
const CHUNK: u8 = 0x06;
const DATA_END: u8 = 0x0f;

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut bytes = Bytes::new(reader, limits);
    bytes.take(MAGIC.len() as u64)?;
    let mut file = File {
        recorder: Recorder::new(wanted, limits),
        schemas: HashMap::new(),
        channels: Topics::default(),
        chunks: Chunks::new(limits),
    };
    loop {
        let at = bytes.at();
        let Some(head) = bytes.take(9)? else {
            file.cut(at, bytes.peek(1)?.is_empty());
            break;
        };
        let mut head = Fields(head);
        let (op, length) = (head.u8().unwrap_or(0), head.u64().unwrap_or(0));
        if matches!(op, FOOTER | DATA_END) {
            break;
        }
        let Some(body) = bytes.take(length)? else {
            file.cut(at, false);
            break;
        };
        file.record(op, body, at)?;
    }
    Ok(file.channels.finish(file.recorder))
}

struct File {
    recorder: Recorder,
    /// Names of the kinds of messages.
    schemas: HashMap<u16, String>,
    channels: Topics<u16>,
    chunks: Chunks,
}

impl File {
    fn cut(&mut self, at: u64, between_records: bool) {
        self.recorder.content.cut = Some(match between_records {
            true => Finding::of(Kind::FILE_NOT_CLOSED).count("byte", at as usize),
            false => cut_at(at, "a record"),
        });
    }

    fn record(&mut self, op: u8, body: &[u8], at: u64) -> Result<(), Error> {
        match op {
            SCHEMA => self
                .schema(body)
                .ok_or_else(|| Error::at(at, damaged("schema record"))),
            CHANNEL => self
                .channel(body)
                .ok_or_else(|| Error::at(at, damaged("channel record"))),
            MESSAGE => self.message(body, at),
            CHUNK => self.chunk(body, at),
            _ => Ok(()),
        }
    }

    fn schema(&mut self, body: &[u8]) -> Option<()> {
        let mut fields = Fields(body);
        let id = fields.u16()?;
        let name = fields.text()?;
        self.schemas.insert(id, name);
        Some(())
    }

    fn channel(&mut self, body: &[u8]) -> Option<()> {
        let mut fields = Fields(body);
        let (id, schema) = (fields.u16()?, fields.u16()?);
        let (topic, encoding) = (fields.text()?, fields.text()?);
        if self.channels.has(&id) {
            return Some(());
        }
        let name = self.schemas.get(&schema).cloned().unwrap_or_default();
        let encoding = match encoding.as_str() {
            "cdr" => Some(Encoding::Cdr),
            "ros1" => Some(Encoding::Ros1),
            "json" => Some(Encoding::Json),
            _ => None,
        };
        self.channels
            .add(id, topic, name, encoding, &mut self.recorder);
        Some(())
    }

    fn message(&mut self, body: &[u8], at: u64) -> Result<(), Error> {
        let mut fields = Fields(body);
        let head = (fields.u16(), fields.u32(), fields.u64(), fields.u64());
        let (Some(channel), .., Some(_)) = head else {
            return Err(Error::at(at, damaged("message record")));
        };
        self.channels
            .take(&channel, fields.0, at, &mut self.recorder)
    }

    fn chunk(&mut self, body: &[u8], at: u64) -> Result<(), Error> {
        let mut fields = Fields(body);
        let mut parts = || {
            let _times = (fields.u64()?, fields.u64()?);
            Some((
                fields.u64()?,
                fields.u32()?,
                fields.text()?,
                fields.u64()?,
                fields.0,
            ))
        };
        let (size, crc, compression, length, records) =
            parts().ok_or_else(|| Error::at(at, damaged("chunk")))?;
        let packed = records.get(..length.min(usize::MAX as u64) as usize);
        let packed =
            packed.ok_or_else(|| Error::at(at, contradicted("chunk", "longer", "its record")))?;
        let unpacked = match self.chunks.unpack(at, &compression, packed, size)? {
            Ok(unpacked) => unpacked,
            Err(error) => return self.skip(at, error.finding()),
        };
        let mut sum = flate2::Crc::new();
        sum.update(&unpacked);
        if crc != 0 && sum.sum() != crc {
            let found = Finding::of(Kind::CHECK_SUM_WRONG).detail("part", "chunk");
            return self.skip(at, found);
        }
        let mut records = Fields(&unpacked);
        while !records.0.is_empty() {
            let head = records.u8().zip(records.u64());
            let body = head
                .and_then(|(op, length)| Some((op, records.bytes(usize::try_from(length).ok()?)?)));
            let Some((op, body)) = body else {
                return self.skip(at, Finding::of(Kind::ENDS_WITHIN_RECORD));
            };
            if op != CHUNK {
                self.record(op, body, at)?;
            }
        }
        Ok(())
    }

    /// Leaves the rest of a damaged chunk out.
    fn skip(&mut self, at: u64, why: Finding) -> Result<(), Error> {
        let damaged = chunk_damaged(at).because(why);
        self.recorder.content.warnings.push(damaged);
        Ok(())
    }
}
