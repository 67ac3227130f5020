//! ROS 1 bags, format 2.0: <http://wiki.ros.org/Bags/Format/2.0>.

use std::collections::HashMap;
use std::io::Read;

use crate::bytes::{Bytes, Fields};
use crate::error::damaged;
use crate::format::{Format, Reads};
use crate::ros::imu::{Encoding, Topics};
use crate::stream::{Recorder, chunk_damaged};
use crate::unpack::Chunks;
use crate::{Content, Error, Limits, Wanted};

/// ROS 1 bags; chunks by lz4, bz2 or as they are. Indices are not needed, so that bags that were not closed are read.
pub(crate) static BAG: Format = Format {
    name: "bag",
    about: "a ROS 1 bag with sensor_msgs/Imu, closed or not",
    begins: |head| head.starts_with(MAGIC),
    reads: Reads::Forward(read),
};

const MAGIC: &[u8] = b"#ROSBAG V2.0\n";
const MESSAGE: u8 = 0x02;
const CHUNK: u8 = 0x05;
const CONNECTION: u8 = 0x07;

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut bytes = Bytes::new(reader, limits);
    bytes.take(MAGIC.len() as u64)?;
    let mut file = File {
        recorder: Recorder::new(wanted, limits),
        connections: HashMap::new(),
        topics: Topics::default(),
        chunks: Chunks::new(limits),
    };
    loop {
        let at = bytes.at();
        if bytes.peek(1)?.is_empty() {
            break;
        }
        // Header and data each stand behind their lengths.
        let Some(header) = block(&mut bytes)? else {
            file.recorder.cut(at, "a record");
            break;
        };
        let Some(data) = block_ref(&mut bytes)? else {
            file.recorder.cut(at, "a record");
            break;
        };
        file.record(&header, data, at)?;
    }
    Ok(file.topics.finish(file.recorder))
}

fn block(bytes: &mut Bytes<'_>) -> Result<Option<Vec<u8>>, Error> {
    Ok(block_ref(bytes)?.map(<[u8]>::to_vec))
}

fn block_ref<'b>(bytes: &'b mut Bytes<'_>) -> Result<Option<&'b [u8]>, Error> {
    let Some(length) = bytes.take(4)? else {
        return Ok(None);
    };
    let length = Fields(length).u32().unwrap_or(0);
    bytes.take(u64::from(length))
}

/// The value of a header's field.
fn field<'a>(header: &'a [u8], name: &[u8]) -> Option<&'a [u8]> {
    let mut fields = Fields(header);
    while let Some(entry) = fields.block() {
        let at = entry.iter().position(|byte| *byte == b'=')?;
        if &entry[..at] == name {
            return Some(&entry[at + 1..]);
        }
    }
    None
}

fn number(header: &[u8], name: &[u8]) -> Option<u32> {
    Fields(field(header, name)?).u32()
}

struct File {
    recorder: Recorder,
    /// The topic of every connection; several connections may write to one.
    connections: HashMap<u32, String>,
    topics: Topics<String>,
    chunks: Chunks,
}

impl File {
    fn record(&mut self, header: &[u8], data: &[u8], at: u64) -> Result<(), Error> {
        let op = field(header, b"op").and_then(|op| op.first().copied());
        let broken = |what: &str| Error::at(at, damaged(&format!("{what} record")));
        match op {
            Some(CONNECTION) => self
                .connection(header, data)
                .ok_or_else(|| broken("connection")),
            Some(MESSAGE) => {
                let connection = number(header, b"conn").ok_or_else(|| broken("message"))?;
                self.message(connection, data, at)
            }
            Some(CHUNK) => self.chunk(header, data, at),
            Some(_) => Ok(()),
            None => Err(broken("bag")),
        }
    }

    fn connection(&mut self, header: &[u8], data: &[u8]) -> Option<()> {
        let id = number(header, b"conn")?;
        let topic = String::from_utf8_lossy(field(header, b"topic")?).into_owned();
        let kind = String::from_utf8_lossy(field(data, b"type").unwrap_or_default()).into_owned();
        if self.connections.insert(id, topic.clone()).is_none() && !self.topics.has(&topic) {
            let encoding = Some(Encoding::Ros1);
            self.topics
                .add(topic.clone(), topic, kind, encoding, &mut self.recorder);
        }
        Some(())
    }

    fn message(&mut self, connection: u32, data: &[u8], at: u64) -> Result<(), Error> {
        match self.connections.get(&connection) {
            Some(topic) => self.topics.take(topic, data, at, &mut self.recorder),
            None => Ok(()),
        }
    }

    fn chunk(&mut self, header: &[u8], data: &[u8], at: u64) -> Result<(), Error> {
        let method =
            String::from_utf8_lossy(field(header, b"compression").unwrap_or_default()).into_owned();
        let size = number(header, b"size").map_or(data.len() as u64, u64::from);
        let unpacked = match self.chunks.unpack(at, &method, data, size)? {
            Ok(unpacked) => unpacked,
            Err(error) => {
                let damaged = chunk_damaged(at).because(error.finding());
                self.recorder.content.warnings.push(damaged);
                return Ok(());
            }
        };
        let mut records = Fields(&unpacked);
        while !records.0.is_empty() {
            let Some((header, data)) = records.block().zip(records.block()) else {
                self.recorder.content.warnings.push(chunk_damaged(at));
                break;
            };
            if field(header, b"op") != Some(&[CHUNK]) {
                self.record(header, data, at)?;
            }
        }
        Ok(())
    }
}
