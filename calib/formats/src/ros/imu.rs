//! Messages of ROS: `sensor_msgs/Imu` and `sensor_msgs/MagneticField`, of ROS 1 packed and of ROS 2 in CDR.

use std::collections::HashMap;
use std::hash::Hash;
use std::io::Read;

use findings::{Finding, Kind as Cause};

use super::json;
use crate::bytes::Fields;
use crate::error::{cut, damaged};
use crate::stream::{Handle, Recorder};
use crate::{Content, Error, Quantity};

/// Encoding of messages, by version of ROS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// ROS 1: packed, with a sequence number.
    Ros1,
    /// ROS 2: CDR with its 4 bytes of encapsulation.
    Cdr,
    /// JSON with the names of either.
    Json,
}

/// A kind of message that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Imu,
    MagneticField,
}

impl Kind {
    /// The kind called `name`, in the spelling of either ROS.
    fn of(name: &str) -> Option<Self> {
        match name.replace('.', "/").as_str() {
            "sensor_msgs/Imu" | "sensor_msgs/msg/Imu" => Some(Self::Imu),
            "sensor_msgs/MagneticField" | "sensor_msgs/msg/MagneticField" => {
                Some(Self::MagneticField)
            }
            _ => None,
        }
    }
}

/// A topic with messages that are read.
#[derive(Clone, Debug)]
struct Topic {
    kind: Kind,
    encoding: Encoding,
    streams: [Option<Handle>; 2],
    /// Messages so far.
    count: u64,
}

/// The first bytes of zstd: bags may be compressed message by message.
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";
/// A longer message is no reading.
const LONGEST: u64 = 64 << 10;

/// The message that `packed` holds.
fn unpacked(packed: &[u8]) -> Option<Vec<u8>> {
    let decoder = ruzstd::decoding::StreamingDecoder::new(packed).ok()?;
    let mut message = Vec::new();
    decoder.take(LONGEST).read_to_end(&mut message).ok()?;
    Some(message)
}

const NANO: i64 = 1_000_000_000;

impl Topic {
    /// The topic `name`; `None` where it is not wanted.
    fn new(name: &str, kind: Kind, encoding: Encoding, recorder: &mut Recorder) -> Option<Self> {
        let streams = match kind {
            Kind::Imu => [
                recorder.stream(name, 0, Quantity::SpecificForce),
                recorder.stream(name, 0, Quantity::AngularRate),
            ],
            Kind::MagneticField => [recorder.field(name, 0, "T"), None],
        };
        streams[0].is_some().then_some(Self {
            kind,
            encoding,
            streams,
            count: 0,
        })
    }

    /// Takes a message in; `at` is its byte for messages about it.
    fn take(&mut self, message: &[u8], at: u64, recorder: &mut Recorder) -> Result<(), Error> {
        self.count += 1;
        let short = || Error::at(at, cut(format!("message {}", self.count), "topic"));
        if self.encoding == Encoding::Json {
            let said = json::said(message).ok_or_else(|| Error::at(at, damaged("message")))?;
            for (stream, value) in [said.first, said.second].into_iter().enumerate() {
                if let Some(value) = value {
                    self.push(recorder, stream, said.stamp, value)?;
                }
            }
            return Ok(());
        }
        let (stamp, body) = self.header(message, at)?.ok_or_else(short)?;
        let mut numbers = Fields(body);
        let mut vector = || Some([numbers.f64()?, numbers.f64()?, numbers.f64()?]);
        if self.kind == Kind::MagneticField {
            let field = vector().ok_or_else(short)?;
            return self.push(recorder, 0, stamp, field);
        }
        let mut numbers = Fields(body.get(13 * 8..).ok_or_else(short)?);
        let mut next = || numbers.f64().ok_or_else(short);
        let rate = [next()?, next()?, next()?];
        let rate_covariance = next()?;
        let mut numbers = Fields(body.get(25 * 8..).ok_or_else(short)?);
        let mut next = || numbers.f64().ok_or_else(short);
        let force = [next()?, next()?, next()?];
        let force_covariance = next()?;
        // A first entry of -1 says that the sensor does not measure it.
        if force_covariance != -1.0 {
            self.push(recorder, 0, stamp, force)?;
        }
        if rate_covariance != -1.0 {
            self.push(recorder, 1, stamp, rate)?;
        }
        Ok(())
    }

    fn push(
        &self,
        recorder: &mut Recorder,
        stream: usize,
        stamp: i64,
        value: [f64; 3],
    ) -> Result<(), Error> {
        match self.streams[stream] {
            Some(handle) => recorder.push(handle, stamp, value),
            None => Ok(()),
        }
    }

    /// The stamp of the header, ns, and what follows it.
    fn header<'a>(&self, message: &'a [u8], at: u64) -> Result<Option<(i64, &'a [u8])>, Error> {
        let mut fields = Fields(message);
        if self.encoding == Encoding::Cdr {
            match fields.bytes(4) {
                Some([0, 1, ..]) => {}
                Some([0, 0, ..]) => {
                    return Err(Error::at(at, Finding::of(Cause::MESSAGE_BIG_ENDIAN)));
                }
                Some([a, b, ..]) => {
                    let found = Finding::of(Cause::ENCAPSULATION_UNKNOWN);
                    return Err(Error::at(
                        at,
                        found.detail("code", format!("0x{a:02x}{b:02x}")),
                    ));
                }
                _ => return Ok(None),
            }
        }
        Ok((|| {
            if self.encoding == Encoding::Ros1 {
                fields.u32()?;
            }
            let stamp = i64::from(fields.u32()?) * NANO + i64::from(fields.u32()?);
            fields.block()?;
            if self.encoding == Encoding::Cdr {
                let taken = message.len() - 4 - fields.0.len();
                fields.bytes(taken.wrapping_neg() & 7)?;
            }
            Some((stamp, fields.0))
        })())
    }
}

/// The topics of a bag by the number or name that its messages call them.
#[derive(Debug, Default)]
pub(crate) struct Topics<K>(HashMap<K, Counted>);

#[derive(Debug)]
struct Counted {
    name: String,
    kind: String,
    messages: u64,
    /// Reader of its messages; `None` if they are not read.
    read: Option<Topic>,
}

impl Counted {
    /// True for messages that are not read and may be a sensor's: of three values, or of a type that is not known.
    fn may_be_sensor(&self) -> bool {
        let name = self.kind.rsplit('/').next().unwrap_or_default();
        let is_one = matches!(
            name,
            "Vector3" | "Vector3Stamped" | "AccelStamped" | "TwistStamped"
        );
        let others = ["Info", "Extrinsics", "Bias", "Status", "Temperature"];
        let is_other = others.iter().any(|end| name.ends_with(end));
        (is_one || self.is_of_others() && !is_other) && self.messages > 1
    }

    /// True for messages of a package of one's own that are called like a sensor's.
    fn is_of_others(&self) -> bool {
        const USUAL: [&str; 8] = [
            "sensor_msgs",
            "geometry_msgs",
            "std_msgs",
            "nav_msgs",
            "tf2_msgs",
            "rcl_interfaces",
            "diagnostic_msgs",
            "rosgraph_msgs",
        ];
        let package = self.kind.split('/').next().unwrap_or_default();
        let called = format!("{} {}", self.name, self.kind).to_lowercase();
        let is_called = ["imu", "gyr", "acc", "inertial"]
            .iter()
            .any(|word| called.contains(word));
        self.read.is_none() && is_called && !USUAL.contains(&package)
    }
}

impl<K: Eq + Hash> Topics<K> {
    /// True for a topic that is known.
    pub fn has(&self, key: &K) -> bool {
        self.0.contains_key(key)
    }

    /// Adds a topic whose messages are of the kind called so; those of an unknown encoding are counted alone.
    pub fn add(
        &mut self,
        key: K,
        name: String,
        kind: String,
        encoding: Option<Encoding>,
        recorder: &mut Recorder,
    ) {
        let read = Kind::of(&kind)
            .zip(encoding)
            .and_then(|(kind, encoding)| Topic::new(&name, kind, encoding, recorder));
        let topic = Counted {
            name,
            kind,
            messages: 0,
            read,
        };
        self.0.insert(key, topic);
    }

    /// Counts a message of a topic and takes it in; one of no known topic is passed over.
    pub fn take(
        &mut self,
        key: &K,
        message: &[u8],
        at: u64,
        recorder: &mut Recorder,
    ) -> Result<(), Error> {
        let Some(topic) = self.0.get_mut(key) else {
            return Ok(());
        };
        topic.messages += 1;
        let Some(read) = &mut topic.read else {
            return Ok(());
        };
        if read.encoding == Encoding::Cdr && message.starts_with(ZSTD) {
            let message = unpacked(message)
                .ok_or_else(|| Error::at(at, Finding::of(Cause::MESSAGE_COMPRESSED)))?;
            return read.take(&message, at, recorder);
        }
        read.take(message, at, recorder)
    }

    /// The streams of the topics, and a list of all topics.
    pub fn finish(&self, mut recorder: Recorder) -> Content {
        without_empty(&mut recorder);
        let listed = self.0.values().map(|topic| {
            let Counted {
                name,
                kind,
                messages,
                ..
            } = topic;
            format!("{name} ({kind}, {messages} messages)")
        });
        let vectors = self.0.values().filter(|topic| topic.may_be_sensor());
        recorder.content.unclear = vectors.map(|topic| topic.name.clone()).collect();
        recorder.content.unclear.sort();
        recorder.content.listed = listed.collect();
        recorder.content.listed.sort();
        recorder.finish()
    }
}

/// Leaves out streams of nothing but zeros: a topic of one sensor fills in the other's place so.
fn without_empty(recorder: &mut Recorder) {
    let is_empty = |stream: &crate::Stream| {
        let zero = |value: &[f64; 3]| value.iter().all(|v| *v == 0.0);
        stream.values.iter().all(zero)
    };
    recorder.content.streams.retain(|stream| !is_empty(stream));
}
