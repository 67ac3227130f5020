//! ArduPilot's dataflash logs: self-describing binary messages (libraries/AP_Logger/LogStructure.h).

use findings::{Finding, Kind as Cause};
use std::collections::HashMap;
use std::io::Read;

use crate::bytes::{Bytes, Fields};
use crate::format::{Format, Reads};
use crate::stream::Recorder;
use crate::{Content, Correction, Error, Limits, Quantity, Wanted};

/// `.BIN` logs: raw batches `ACC` and `GYR` where they are, else `IMU`, which is corrected.
pub(crate) static ARDUPILOT: Format = Format {
    name: "ardupilot",
    about: "an ArduPilot dataflash log (.BIN) with IMU, or ACC and GYR",
    begins: |head| head.starts_with(&MAGIC) && head.get(2) == Some(&FORMAT),
    reads: Reads::Forward(read),
};

const MAGIC: [u8; 2] = [0xa3, 0x95];
const FORMAT: u8 = 128;
/// Bytes of a message that describes others, with its head.
const FORMAT_SIZE: usize = 89;

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut bytes = Bytes::new(reader, limits);
    let mut file = File {
        recorder: Recorder::new(wanted, limits),
        kinds: HashMap::new(),
        parameters: HashMap::new(),
        last: 0,
        backwards: 0,
    };
    let mut skipped: u64 = 0;
    let mut first_skipped = None;
    loop {
        let at = bytes.at();
        let (known, length) = match bytes.peek(3)? {
            [] => break,
            [a, b, kind] if [*a, *b] == MAGIC => (Some(*kind), file.length(*kind)),
            _ => (None, None),
        };
        let (Some(kind), Some(length)) = (known, length) else {
            skipped += 1;
            first_skipped.get_or_insert(at);
            bytes.take(1)?;
            continue;
        };
        let Some(message) = bytes.take(length as u64)? else {
            file.recorder.cut(at, "a message");
            break;
        };
        file.message(kind, &message[3..])?;
    }
    if let Some(first) = first_skipped {
        let skipped = Finding::of(Cause::BYTES_SKIPPED).count("count", skipped as usize);
        let skipped = skipped.count("byte", first as usize);
        file.recorder.content.warnings.push(skipped);
    }
    Ok(file.finish())
}

/// A kind of message.
struct Kind {
    name: String,
    length: usize,
    /// Fields by name: type and place behind the head.
    fields: Vec<(String, u8, usize)>,
    count: u64,
}

struct File {
    recorder: Recorder,
    kinds: HashMap<u8, Kind>,
    parameters: HashMap<String, f64>,
    /// Last stamp of any message, µs.
    last: u64,
    backwards: u64,
}

fn size(kind: u8) -> Option<usize> {
    Some(match kind {
        b'b' | b'B' | b'M' => 1,
        b'h' | b'H' | b'c' | b'C' | b'g' => 2,
        b'i' | b'I' | b'f' | b'n' | b'e' | b'E' | b'L' => 4,
        b'd' | b'q' | b'Q' => 8,
        b'N' => 16,
        b'Z' | b'a' => 64,
        _ => return None,
    })
}

fn text(bytes: &[u8]) -> String {
    let end = bytes
        .iter()
        .position(|byte| *byte == 0)
        .unwrap_or(bytes.len());
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}

impl Kind {
    fn of(body: &[u8]) -> Option<(u8, Self)> {
        let mut fields = Fields(body);
        let (id, length) = (fields.u8()?, usize::from(fields.u8()?));
        let name = text(fields.bytes(4)?);
        let types = text(fields.bytes(16)?);
        let labels = text(fields.bytes(64)?);
        let mut at = 0;
        let mut described = Vec::new();
        for (kind, label) in types.bytes().zip(labels.split(',')) {
            described.push((label.to_owned(), kind, at));
            at += size(kind)?;
        }
        (length >= 3 && at + 3 <= length).then_some((
            id,
            Self {
                name,
                length,
                fields: described,
                count: 0,
            },
        ))
    }

    /// The field called `label` as a number.
    fn number(&self, body: &[u8], label: &str) -> Option<f64> {
        let (_, kind, at) = self.fields.iter().find(|(name, ..)| name == label)?;
        let mut field = Fields(body.get(*at..)?);
        Some(match kind {
            b'f' => f64::from(field.f32()?),
            b'd' => field.f64()?,
            b'B' | b'M' => f64::from(field.u8()?),
            b'b' => f64::from(field.i8()?),
            b'h' => f64::from(field.i16()?),
            b'H' => f64::from(field.u16()?),
            b'c' => f64::from(field.i16()?) * 0.01,
            b'C' => f64::from(field.u16()?) * 0.01,
            b'e' => f64::from(field.i32()?) * 0.01,
            b'E' => f64::from(field.u32()?) * 0.01,
            b'i' | b'L' => f64::from(field.i32()?),
            b'I' => f64::from(field.u32()?),
            b'q' => field.i64()? as f64,
            b'Q' => field.u64()? as f64,
            _ => return None,
        })
    }

    fn text(&self, body: &[u8], label: &str) -> Option<String> {
        let (_, kind, at) = self.fields.iter().find(|(name, ..)| name == label)?;
        body.get(*at..at + size(*kind)?).map(text)
    }

    fn triad(&self, body: &[u8], axes: [&str; 3]) -> Option<[f64; 3]> {
        let [x, y, z] = axes.map(|axis| self.number(body, axis));
        Some([x?, y?, z?])
    }
}

/// A message's name without the number behind it, and that number less one: `IMU2` is the second.
fn numbered(name: &str) -> (&str, u32) {
    match name.strip_suffix(['1', '2', '3']) {
        Some(stem) if !stem.is_empty() => {
            let digit = name.as_bytes().last().map_or(b'1', |digit| *digit);
            (stem, u32::from(digit - b'1'))
        }
        _ => (name, 0),
    }
}

impl File {
    fn length(&self, kind: u8) -> Option<usize> {
        match kind {
            FORMAT => Some(FORMAT_SIZE),
            other => self.kinds.get(&other).map(|kind| kind.length),
        }
    }

    fn message(&mut self, id: u8, body: &[u8]) -> Result<(), Error> {
        if id == FORMAT {
            // A description that contradicts itself leaves its messages to be skipped.
            if let Some((id, kind)) = Kind::of(body) {
                self.kinds.entry(id).or_insert(kind);
            }
            return Ok(());
        }
        let Some(kind) = self.kinds.get_mut(&id) else {
            return Ok(());
        };
        kind.count += 1;
        let kind = &self.kinds[&id];
        if kind.name == "PARM" {
            let found = kind.text(body, "Name").zip(kind.number(body, "Value"));
            self.parameters.extend(found);
            return Ok(());
        }
        let (stem, number) = numbered(&kind.name);
        if !matches!(stem, "IMU" | "ACC" | "GYR" | "MAG") {
            return Ok(());
        }
        let instance = kind
            .number(body, "I")
            .map_or(number, |instance| instance as u32);
        // Raw batches have the stamp of the reading beside that of the message.
        let stamp = kind
            .number(body, "SampleUS")
            .or_else(|| kind.number(body, "TimeUS"));
        let Some(stamp) = stamp.or_else(|| Some(1e3 * kind.number(body, "TimeMS")?)) else {
            return Ok(());
        };
        let force = kind.triad(body, ["AccX", "AccY", "AccZ"]);
        let rate = kind.triad(body, ["GyrX", "GyrY", "GyrZ"]);
        let temperature = kind.number(body, "T").filter(|_| stem == "IMU");
        let processed = stem == "IMU";
        let name = stem.to_owned();
        if (stamp as u64) < self.last.saturating_sub(1_000_000) {
            self.backwards += 1;
        }
        self.last = self.last.max(stamp as u64);
        let nanoseconds = (stamp as i64).saturating_mul(1000);
        let values = [
            (Quantity::SpecificForce, force),
            (Quantity::AngularRate, rate),
            (
                Quantity::Temperature,
                temperature.map(|celsius| [celsius, 0.0, 0.0]),
            ),
        ];
        if stem != "MAG" && (force.is_none() && stem != "GYR" || rate.is_none() && stem != "ACC") {
            let unclear = &mut self.recorder.content.unclear;
            if !unclear.contains(&name) {
                unclear.push(name.clone());
            }
        }
        let field = kind.triad(body, ["MagX", "MagY", "MagZ"]);
        if let Some(field) = field {
            return match self.recorder.field(&name, instance, "mgauss") {
                Some(stream) => self.recorder.push(stream, nanoseconds, field),
                None => Ok(()),
            };
        }
        for (quantity, value) in values {
            let Some(value) = value else { continue };
            if let Some(stream) = self.recorder.stream(&name, instance, quantity) {
                self.recorder.at(stream).processed = processed;
                self.recorder.push(stream, nanoseconds, value)?;
            }
        }
        Ok(())
    }

    /// Takes off what ArduPilot has corrected: `(raw - INS_ACCOFFS) INS_ACCSCAL` and `raw - INS_GYROFFS`
    /// (AP_InertialSensor_Backend.cpp, `_rotate_and_correct_accel` and `_rotate_and_correct_gyro`).
    fn undo(&mut self) {
        let parameter = |name: String| self.parameters.get(&name).copied();
        let turned =
            parameter("AHRS_ORIENTATION".to_owned()).is_some_and(|rotation| rotation != 0.0);
        let mut undone = false;
        let mut complete = true;
        for stream in self.recorder.content.corrected() {
            let number = match stream.instance {
                0 => String::new(),
                instance => (u64::from(instance) + 1).to_string(),
            };
            let axes =
                |what: &str| ["X", "Y", "Z"].map(|axis| parameter(format!("INS_{what}_{axis}")));
            let (offset, scale) = match stream.quantity {
                Quantity::SpecificForce => (
                    axes(&format!("ACC{number}OFFS")),
                    axes(&format!("ACC{number}SCAL")),
                ),
                Quantity::AngularRate => (axes(&format!("GYR{number}OFFS")), [Some(1.0); 3]),
                _ => continue,
            };
            let mut correction = Correction {
                by: "ardupilot",
                undone: false,
            };
            stream.correction = Some(correction);
            let known = |of: [Option<f64>; 3]| Some([of[0]?, of[1]?, of[2]?]);
            let pair = known(offset)
                .zip(known(scale).map(|scale| scale.map(|s| if s == 0.0 { 1.0 } else { s })));
            let Some((offset, scale)) = pair.filter(|_| !turned) else {
                complete = false;
                continue;
            };
            for sample in &mut stream.values {
                for axis in 0..3 {
                    sample[axis] = sample[axis] / scale[axis] + offset[axis];
                }
            }
            correction.undone = true;
            stream.correction = Some(correction);
            undone = true;
        }
        let kind = match (undone, complete) {
            (true, true) => Cause::CORRECTION_UNDONE,
            (false, true) => return,
            _ => Cause::CORRECTED_BY_SYSTEM,
        };
        let found = Finding::of(kind)
            .detail("system", "ArduPilot")
            .detail("columns", "IMU")
            .detail(
                "parameters",
                "INS_ACC*OFFS, INS_ACC*SCAL and INS_GYR*OFFS are",
            );
        self.recorder.content.warnings.push(found);
    }

    fn finish(mut self) -> Content {
        self.undo();
        if self.backwards > 0 {
            let back = Finding::of(Cause::CLOCK_BACK).count("count", self.backwards as usize);
            self.recorder.content.warnings.push(back);
        }
        let mut listed: Vec<String> = self
            .kinds
            .values()
            .filter(|kind| kind.count > 0)
            .map(|kind| format!("{} ({} messages)", kind.name, kind.count))
            .collect();
        listed.sort();
        self.recorder.content.listed = listed;
        self.recorder.finish()
    }
}
