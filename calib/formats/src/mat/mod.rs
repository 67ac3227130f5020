//! MAT files, level 5 (`save -v6` and `-v7`): the timetables of MATLAB Mobile, and plain matrices.

mod element;
mod objects;
mod value;

use std::io::Read;

use crate::bytes::Bytes;
use crate::format::Format;
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Quantity, Wanted};
use element::{COMPRESSED, Element, Elements, MATRIX, Raw};
use objects::{Objects, numbers};
use value::{Value, Variable};

/// MAT files with an accelerometer and a gyroscope.
#[derive(Debug)]
pub(crate) struct Mat;

const MAGIC: &[u8] = b"MATLAB 5.0 MAT-file";
const HEADER: u64 = 128;
/// Nanoseconds in a millisecond.
const MILLI: f64 = 1e6;

impl Format for Mat {
    fn name(&self) -> &'static str {
        "mat"
    }

    fn about(&self) -> &'static str {
        "a MATLAB file (v5 to v7): timetables of MATLAB Mobile, or matrices named after a sensor (t, x, y, z)"
    }

    fn recognises(&self, head: &[u8]) -> bool {
        head.starts_with(MAGIC)
    }

    fn read(
        &self,
        reader: &mut dyn Read,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        let mut bytes = Bytes::new(reader, limits);
        let header = bytes
            .take(HEADER)?
            .ok_or_else(|| Error::at(0, "the header of the MATLAB file is cut short"))?;
        if header.get(126..128) == Some(b"MI") {
            return Err(Error::refused(
                "a MATLAB file of a big-endian machine, which is not read; save it again with today's MATLAB",
            ));
        }
        let offset = header
            .get(116..124)
            .and_then(|bytes| bytes.try_into().ok())
            .map_or(0, u64::from_le_bytes);
        let mut parts = Parts::read(&mut bytes, offset, limits)?;
        let subsystem = parts.subsystem.take();
        let mut file = File {
            recorder: Recorder::new(wanted, limits),
            others: Vec::new(),
        };
        file.recorder.content.cut = parts.cut;
        let subsystem_bytes = subsystem
            .as_deref()
            .map(subsystem_bytes)
            .transpose()?
            .flatten();
        let objects = match subsystem_bytes {
            Some(bytes) => Objects::read(bytes, offset)?,
            None => None,
        };
        for (at, bytes) in &parts.variables {
            let variable = Value::read(
                Element {
                    kind: MATRIX,
                    bytes,
                },
                *at,
                0,
            )?;
            file.variable(variable, objects.as_ref())?;
        }
        Ok(file.finish())
    }
}

/// The top elements, unpacked.
struct Parts {
    variables: Vec<(u64, Vec<u8>)>,
    subsystem: Option<Vec<u8>>,
    cut: Option<String>,
}

impl Parts {
    fn read(bytes: &mut Bytes<'_>, subsystem: u64, limits: Limits) -> Result<Self, Error> {
        let mut parts = Self {
            variables: Vec::new(),
            subsystem: None,
            cut: None,
        };
        let mut unpacked_in_all: u64 = 0;
        loop {
            let at = bytes.at();
            if bytes.peek(8)?.len() < 8 {
                return Ok(parts);
            }
            let tag = bytes.take(8)?.unwrap_or_default();
            let word = |at: usize| {
                tag.get(at..at + 4)
                    .and_then(|b| b.try_into().ok())
                    .map_or(0, u32::from_le_bytes)
            };
            let (kind, length) = (word(0), word(4));
            if kind != MATRIX && kind != COMPRESSED {
                return Err(Error::at(
                    at,
                    format!(
                        "a data element of type {kind}, where a matrix was expected: the MATLAB file is damaged"
                    ),
                ));
            }
            let length = u64::from(length);
            let mut cut = || {
                parts.cut = Some(format!(
                    "byte {at}: the MATLAB file ends within a variable; those before it are read"
                ));
            };
            let content = if kind == COMPRESSED {
                let mut body = bytes.part(length);
                let unpacked = unpack(&mut body, length, at, limits);
                if !body.pass()? {
                    cut();
                    return Ok(parts);
                }
                unpacked?
            } else if let Some(body) = bytes.take(length)? {
                Some(body.to_vec())
            } else {
                cut();
                return Ok(parts);
            };
            let Some(content) = content else { continue };
            unpacked_in_all = unpacked_in_all.saturating_add(content.len() as u64);
            if unpacked_in_all > limits.bytes {
                return Err(Error::refused(format!(
                    "the MATLAB file unpacks to more than {} bytes",
                    limits.bytes
                )));
            }
            match at == subsystem {
                true => parts.subsystem = Some(content),
                false => parts.variables.push((at, content)),
            }
        }
    }
}

/// Deflate packs no tighter: RFC 1951, section 3.2.5, a length of 258 in two bits.
const TIGHTEST: u64 = 1032;

/// The matrix in a compressed element of `length` bytes; `None` for an element of another type.
fn unpack(
    body: &mut dyn Read,
    length: u64,
    at: u64,
    limits: Limits,
) -> Result<Option<Vec<u8>>, Error> {
    let mut decoder = flate2::read::ZlibDecoder::new(body);
    let mut tag = [0; 8];
    let damaged =
        |error: std::io::Error| Error::at(at, format!("a compressed variable is damaged: {error}"));
    decoder.read_exact(&mut tag).map_err(damaged)?;
    let [a, b, c, d, rest @ ..] = tag;
    let (kind, size) = (
        u32::from_le_bytes([a, b, c, d]),
        u64::from(u32::from_le_bytes(rest)),
    );
    limits.check_unpacked(&format!("the variable at byte {at}"), length, size)?;
    if kind != MATRIX {
        return Ok(None);
    }
    let mut content = Vec::with_capacity(size.min(length.saturating_mul(TIGHTEST)) as usize);
    decoder
        .take(size)
        .read_to_end(&mut content)
        .map_err(damaged)?;
    if (content.len() as u64) < size {
        return Err(Error::at(
            at,
            "a compressed variable is shorter than it says",
        ));
    }
    Ok(Some(content))
}

/// The bytes of the stream within the subsystem's matrix.
fn subsystem_bytes(matrix: &[u8]) -> Result<Option<&[u8]>, Error> {
    let mut parts = Elements::new(matrix, 0);
    let _flags_dims_name = (parts.need()?, parts.need()?, parts.need()?);
    Ok(parts.next()?.map(|element| element.bytes))
}

struct File {
    recorder: Recorder,
    /// Variables that are no sensor's, with what they are.
    others: Vec<String>,
}

/// The quantity that a variable is named after.
fn quantity(name: &str) -> Option<Quantity> {
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if has(&["acc"]) {
        Some(Quantity::SpecificForce)
    } else if has(&["angularvel", "angular_vel", "gyr", "omega"]) {
        Some(Quantity::AngularRate)
    } else if has(&["mag"]) {
        Some(Quantity::MagneticField)
    } else {
        None
    }
}

impl File {
    fn variable(
        &mut self,
        variable: Variable<'_>,
        objects: Option<&Objects<'_>>,
    ) -> Result<(), Error> {
        let Variable { name, class, value } = variable;
        let what = match &class {
            Some(class) => format!("an object of class {class}"),
            None => value.described(),
        };
        let read = match (&value, objects, quantity(&name)) {
            (Value::Object(_), Some(objects), Some(quantity)) => {
                self.timetable(&name, &value, objects, quantity)?
            }
            (Value::Object(_), Some(_), None) if class.as_deref() == Some("timetable") => {
                let known = ["orientation", "position"]
                    .iter()
                    .any(|word| name.to_lowercase().contains(word));
                self.recorder
                    .content
                    .unclear
                    .extend((!known).then(|| name.clone()));
                false
            }
            (Value::Numbers { dims, real, .. }, _, _) => self.matrix(&name, dims, *real)?,
            _ => false,
        };
        if let Some(class) = class.filter(|class| !read && class != "timetable") {
            let words = format!(
                "the variable {} is an object of class {} and is not read",
                name.escape_default(),
                class.escape_default()
            );
            self.recorder.content.warnings.push(words);
        }
        self.others
            .extend((!read).then(|| format!("{name} ({what})")));
        Ok(())
    }

    /// A timetable with the variables X, Y and Z.
    fn timetable(
        &mut self,
        name: &str,
        value: &Value<'_>,
        objects: &Objects<'_>,
        quantity: Quantity,
    ) -> Result<bool, Error> {
        let Some(table) = objects.property(value, "any") else {
            return Ok(false);
        };
        let names: Vec<&str> = table
            .field("varNames")
            .map(Value::cells)
            .unwrap_or_default()
            .iter()
            .map(|name| match name {
                Value::Text(name) => name.as_str(),
                _ => "",
            })
            .collect();
        let data = table.field("data").map(Value::cells).unwrap_or_default();
        let axis = |axis: &str| {
            let at = names
                .iter()
                .position(|name| name.eq_ignore_ascii_case(axis))?;
            Some(numbers(data.get(at)?)?.0)
        };
        let (Some(x), Some(y), Some(z)) = (axis("X"), axis("Y"), axis("Z")) else {
            return Ok(false);
        };
        let Some(stamps) = table
            .field("rowTimes")
            .and_then(|times| Stamps::of(times, objects))
        else {
            let words = format!("{name}: its row times are neither datetime nor duration");
            return Err(Error::refused(words));
        };
        let stream = match quantity {
            // MATLAB Mobile's own unit.
            Quantity::MagneticField => self.recorder.field(name, 0, "µT"),
            _ => self.recorder.stream(name, 0, quantity),
        };
        let Some(stream) = stream else {
            return Ok(true);
        };
        let rows = x.len();
        if y.len() != rows || z.len() != rows || stamps.len() != rows {
            let words = format!(
                "{name}: columns of {rows}, {}, {} rows and {} stamps",
                y.len(),
                z.len(),
                stamps.len()
            );
            return Err(Error::refused(words));
        }
        let whole = stamps.are_whole();
        self.recorder.reserve(stream, rows);
        for row in 0..rows {
            let stamp = stamps
                .get(row)
                .map(|stamp| if whole { rounded(stamp) } else { stamp });
            let value = (x.get(row), y.get(row), z.get(row), stamp);
            if let (Some(x), Some(y), Some(z), Some(stamp)) = value {
                self.recorder.push(stream, stamp, [x, y, z])?;
            }
        }
        Ok(true)
    }

    /// A matrix with the columns t, x, y, z of the sensor that it is named after, or t and both sensors.
    fn matrix(&mut self, name: &str, dims: &[usize], numbers: Raw<'_>) -> Result<bool, Error> {
        let [rows, columns] = *dims else {
            return Ok(false);
        };
        if rows < 2 || numbers.len() != rows.saturating_mul(columns) {
            return Ok(false);
        }
        let sensors: &[(Quantity, usize)] = match (columns, quantity(name)) {
            (4, Some(quantity)) => &[(quantity, 1)],
            (7, _) => &[(Quantity::SpecificForce, 1), (Quantity::AngularRate, 4)],
            (4, None) => &[],
            _ => return Ok(false),
        };
        let at = |row: usize, column: usize| numbers.get(column * rows + row);
        let increases = (1..rows).all(|row| at(row - 1, 0) < at(row, 0));
        if !increases {
            return Ok(false);
        }
        if sensors.is_empty() {
            self.recorder.content.unclear.push(name.to_owned());
            return Ok(false);
        }
        for (quantity, first) in sensors {
            let Some(stream) = self.recorder.stream(name, 0, *quantity) else {
                continue;
            };
            self.recorder.at(stream).in_si = false;
            self.recorder.reserve(stream, rows);
            for row in 0..rows {
                let values = (
                    at(row, 0),
                    at(row, *first),
                    at(row, first + 1),
                    at(row, first + 2),
                );
                if let (Some(t), Some(x), Some(y), Some(z)) = values {
                    self.recorder
                        .push(stream, (t * 1e9).round() as i64, [x, y, z])?;
                }
            }
        }
        Ok(true)
    }

    fn finish(mut self) -> Content {
        self.recorder.content.listed = self.others;
        self.recorder.finish()
    }
}

/// Half of the resolution of days in a double at today's dates, ns, and what rounding adds.
const DAYS_IN_DOUBLE: i64 = 6_000;

/// A stamp to whole milliseconds, ns.
fn rounded(stamp: i64) -> i64 {
    stamp
        .saturating_add(500_000)
        .div_euclid(1_000_000)
        .saturating_mul(1_000_000)
}

/// Row times: datetimes as milliseconds since 1970 with a correction in the imaginary part, or durations in
/// milliseconds.
struct Stamps<'v> {
    real: Raw<'v>,
    imaginary: Option<Raw<'v>>,
}

impl<'v> Stamps<'v> {
    fn of(times: &'v Value<'_>, objects: &'v Objects<'_>) -> Option<Self> {
        let data = objects
            .property(times, "data")
            .or_else(|| objects.property(times, "millis"))?;
        let (real, imaginary) = numbers(data)?;
        Some(Self { real, imaginary })
    }

    fn len(&self) -> usize {
        self.real.len()
    }

    /// True if every stamp is a whole millisecond to the resolution of a date that went through a double of days, as
    /// MATLAB Mobile's do: 2⁻³³ days are 10 µs.
    fn are_whole(&self) -> bool {
        let near = |stamp: i64| (stamp - rounded(stamp)).abs() <= DAYS_IN_DOUBLE;
        (0..self.len()).all(|row| self.get(row).is_some_and(near))
    }

    /// A stamp, ns. Whole milliseconds are counted apart: a double holds those of this century to 0.2 µs only.
    fn get(&self, row: usize) -> Option<i64> {
        let milliseconds = self.real.get(row)?;
        let correction = self
            .imaginary
            .and_then(|imaginary| imaginary.get(row))
            .unwrap_or(0.0);
        let whole = milliseconds.trunc();
        let rest = ((milliseconds - whole) * MILLI + correction * MILLI).round();
        (whole.abs() < 1e12 * 9.0 && rest.is_finite()).then(|| {
            (whole as i64)
                .saturating_mul(1_000_000)
                .saturating_add(rest as i64)
        })
    }
}
