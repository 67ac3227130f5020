//! PX4 logs: <https://docs.px4.io/main/en/dev_log/ulog_file_format.html>.

mod calibration;
mod layout;
mod topics;

use findings::{Finding, Kind};
use std::io::Read;

use calibration::Parameters;
use layout::Layouts;
use topics::Topic;

use crate::bytes::{Bytes, Fields};
use crate::error::damaged;
use crate::format::{Format, Reads};
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Wanted};

/// ULog files: `sensor_accel`, `sensor_gyro`, their FIFOs, and `sensor_combined` where those are not there.
pub(crate) static ULOG: Format = Format {
    name: "ulog",
    about: "a PX4 log (.ulg) with sensor_accel and sensor_gyro",
    begins: |head| head.starts_with(MAGIC),
    reads: Reads::Forward(read),
};

const MAGIC: &[u8] = b"ULog\x01\x12\x35";
const HEADER: u64 = 16;
/// No log is silent for so long, µs.
const HOUR: u64 = 3_600_000_000;
/// Dropouts that are told with their times.
const LISTED: usize = 3;

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut bytes = Bytes::new(reader, limits);
    let mut file = File {
        recorder: Recorder::new(wanted, limits),
        layouts: Layouts::default(),
        logged: Vec::new(),
        parameters: Parameters::default(),
        dropouts: Vec::new(),
        last: 0,
    };
    bytes.take(HEADER)?;
    loop {
        let at = bytes.at();
        if bytes.peek(1)?.is_empty() {
            break;
        }
        let Some(head) = bytes.take(3)? else {
            file.recorder.cut(at, "a message");
            break;
        };
        let mut head = Fields(head);
        let (size, kind) = (head.u16().unwrap_or(0), head.u8().unwrap_or(0));
        let Some(body) = bytes.take(u64::from(size))? else {
            file.recorder.cut(at, "a message");
            break;
        };
        file.message(kind, body, at)?;
    }
    Ok(file.finish())
}

/// A topic that is logged.
struct Logged {
    name: String,
    instance: u8,
    /// Its messages.
    count: u64,
    /// Reader of its messages; `None` if they are not read.
    topic: Option<Topic>,
}

struct File {
    recorder: Recorder,
    layouts: Layouts,
    /// By the number of the subscription: every message is looked up here.
    logged: Vec<Option<Box<Logged>>>,
    parameters: Parameters,
    /// Time and length of dropouts, s.
    dropouts: Vec<(f64, f64)>,
    /// The last stamp, µs.
    last: u64,
}

impl File {
    fn message(&mut self, kind: u8, body: &[u8], at: u64) -> Result<(), Error> {
        let broken = |what: &str| Error::at(at, damaged(&format!("{what} message")));
        match kind {
            b'F' => self.layouts.add(body).ok_or_else(|| broken("format")),
            b'A' => self.subscribe(body).ok_or_else(|| broken("subscription")),
            b'P' => {
                self.parameters.add(body);
                Ok(())
            }
            b'O' => {
                let length = Fields(body).u16().ok_or_else(|| broken("dropout"))?;
                self.dropouts
                    .push((self.last as f64 * 1e-6, f64::from(length) * 1e-3));
                Ok(())
            }
            b'D' => self.data(body, at),
            b'B' | b'I' | b'M' | b'Q' | b'R' | b'L' | b'C' | b'S' => Ok(()),
            other => Err(Error::at(
                at,
                Finding::of(Kind::MESSAGE_KIND_UNKNOWN).detail("code", format!("0x{other:02x}")),
            )),
        }
    }

    fn subscribe(&mut self, body: &[u8]) -> Option<()> {
        let mut fields = Fields(body);
        let (instance, id) = (fields.u8()?, fields.u16()?);
        let name = String::from_utf8_lossy(fields.0).into_owned();
        let topic = Topic::new(&name, instance, &self.layouts, &mut self.recorder);
        if topic.is_none() && self.may_be_sensor(&name) {
            self.recorder.content.unclear.push(name.clone());
        }
        let id = usize::from(id);
        if self.logged.len() <= id {
            self.logged.resize_with(id + 1, || None);
        }
        self.logged[id] = Some(Box::new(Logged {
            name,
            instance,
            count: 0,
            topic,
        }));
        Some(())
    }

    /// True for a topic that is not known and is called like a sensor's, and for a sensor's without its fields.
    fn may_be_sensor(&self, name: &str) -> bool {
        let axes = ["x", "y", "z"];
        let has_axes = || {
            axes.iter()
                .all(|axis| self.layouts.offset(name, axis, "float").is_some())
        };
        let is_known = name == "sensor_mag";
        matches!(name, "sensor_accel" | "sensor_gyro")
            || name.starts_with("sensor_") && !is_known && has_axes()
    }

    fn data(&mut self, body: &[u8], at: u64) -> Result<(), Error> {
        let mut fields = Fields(body);
        let id = fields
            .u16()
            .ok_or_else(|| Error::at(at, damaged("data message")))?;
        // Every message begins with its stamp, but for those of topics that leave it empty.
        if let Some(stamp) = Fields(fields.0).u64()
            && (self.last == 0 || (self.last..self.last.saturating_add(HOUR)).contains(&stamp))
        {
            self.last = stamp;
        }
        let Some(Some(logged)) = self.logged.get_mut(usize::from(id)) else {
            return Ok(());
        };
        logged.count += 1;
        match &mut logged.topic {
            Some(topic) => topic.take(fields.0, at, &mut self.recorder),
            None => Ok(()),
        }
    }

    fn finish(mut self) -> Content {
        if let Some((first, _)) = self.dropouts.first() {
            let lost: f64 = self.dropouts.iter().map(|(_, length)| length).sum();
            let times: Vec<String> = self
                .dropouts
                .iter()
                .take(LISTED)
                .map(|(t, length)| format!("{length:.3} s at {t:.3} s"))
                .collect();
            let more = if self.dropouts.len() > LISTED {
                ", .."
            } else {
                ""
            };
            let lost = Finding::of(Kind::LOG_DROPOUTS)
                .from_time(*first)
                .count("count", self.dropouts.len())
                .number("missing", lost, "s")
                .detail("listed", times.join(", ") + more);
            self.recorder.content.warnings.push(lost);
        }
        let logged = || self.logged.iter().flatten();
        let selection = logged().find_map(|logged| logged.topic.as_ref()?.selected());
        calibration::undo(&mut self.recorder.content, &self.parameters, selection);
        let mut listed: Vec<String> = logged()
            .map(|logged| {
                let Logged {
                    name,
                    instance,
                    count,
                    ..
                } = &**logged;
                format!("{name} {instance} ({count} messages)")
            })
            .collect();
        listed.sort();
        self.recorder.content.listed = listed;
        self.recorder.finish()
    }
}
