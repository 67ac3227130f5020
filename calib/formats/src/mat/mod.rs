//! MAT files, level 5 (`save -v6` and `-v7`): the timetables of MATLAB Mobile, and plain matrices.

mod body;
mod element;
mod loose;
mod named_after;
mod object_table;
mod objects;
mod value;
mod variables;

use std::io::Read;

use findings::{Finding, Kind};

use body::{Body, Tag};
use element::{COMPRESSED, Element, MATRIX};
use objects::Objects;
use value::{Value, Variable};
use variables::Variables;

use crate::bytes::Bytes;
use crate::error::cut;
use crate::format::{Format, Reads};
use crate::stream::cut_at;
use crate::{Content, Error, Limits, Wanted};
#[cfg(feature = "hdf5")]
pub(crate) use named_after::quantity;

/// MAT files with an accelerometer and a gyroscope.
pub(crate) static MAT: Format = Format {
    name: "mat",
    about: "a MATLAB file (v5 to v7): timetables of MATLAB Mobile, or matrices named after a sensor (t, x, y, z)",
    begins: |head| head.starts_with(MAGIC),
    reads: Reads::Forward(read),
};

const MAGIC: &[u8] = b"MATLAB 5.0 MAT-file";
const HEADER: u64 = 128;

fn read(reader: &mut dyn Read, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut bytes = Bytes::new(reader, limits);
    let header = bytes
        .take(HEADER)?
        .ok_or_else(|| Error::at(0, cut("header", "MATLAB file")))?;
    if header.get(126..128) == Some(b"MI") {
        return Err(Error::refused(Finding::of(Kind::MATLAB_BIG_ENDIAN)));
    }
    let offset = header
        .get(116..124)
        .and_then(|bytes| bytes.try_into().ok())
        .map_or(0, u64::from_le_bytes);
    let mut file = File {
        variables: Variables::new(wanted, limits),
        references: Vec::new(),
        objects: None,
        subsystem: offset,
        limits,
        unpacked: 0,
    };
    while file.element(&mut bytes)? {}
    file.finish()
}

/// The file while it is read.
struct File {
    variables: Variables,
    /// Variables whose values stand in the subsystem.
    references: Vec<Variable<'static>>,
    objects: Option<Objects>,
    /// Byte where the subsystem begins.
    subsystem: u64,
    limits: Limits,
    /// Bytes unpacked so far.
    unpacked: u64,
}

impl File {
    /// Reads the next element at the top; false at the end.
    fn element(&mut self, bytes: &mut Bytes<'_>) -> Result<bool, Error> {
        let at = bytes.at();
        let Some(tag) = bytes.peek(8)?.first_chunk().copied().map(Tag::of) else {
            return Ok(false);
        };
        bytes.take(8)?;
        if tag.kind != MATRIX && tag.kind != COMPRESSED {
            return Err(Error::at(
                at,
                Finding::of(Kind::ELEMENT_UNEXPECTED).count("type", tag.kind as usize),
            ));
        }
        let mut part = bytes.part(tag.length);
        let read = match Body::open(&mut part, tag, at, self.limits) {
            Ok(Some(body)) => self.matrix(body),
            Ok(None) => Ok(()),
            Err(error) => Err(error),
        };
        if !part.pass()? {
            self.variables.cut(cut_at(at, "a variable"));
            return Ok(false);
        }
        read.map(|()| true)
    }

    fn matrix(&mut self, mut body: Body<'_>) -> Result<(), Error> {
        self.unpacked = self.unpacked.saturating_add(body.size);
        if self.unpacked > self.limits.bytes {
            return Err(self.limits.too_large("the MATLAB file"));
        }
        if body.at == self.subsystem {
            let of_sensors = |one: &&Variable<'_>| named_after::quantity(&one.name).is_some();
            let wanted = self.references.iter().filter(of_sensors);
            let wanted: Vec<&Value<'_>> = wanted.map(|one| &one.value).collect();
            let objects = Objects::read(&mut body, &wanted)?;
            body.finish()?;
            self.objects = objects;
            return Ok(());
        }
        let at = body.at;
        let content = body.rest()?;
        body.finish()?;
        let element = Element {
            kind: MATRIX,
            bytes: &content,
        };
        let variable = Value::read(element, at, 0)?;
        match variable {
            Variable {
                name,
                class,
                value: Value::Object(reference),
            } => self.references.push(Variable {
                name,
                class,
                value: Value::Object(reference),
            }),
            variable => self.variables.add(&variable, None)?,
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Content, Error> {
        for (at, variable) in self.references.iter().enumerate() {
            self.variables.add(variable, self.objects.as_ref())?;
            let later = self.references.iter().skip(at + 1);
            if let Some(objects) = &mut self.objects {
                objects.forget(&variable.value, later.map(|variable| &variable.value));
            }
        }
        self.variables.finish()
    }
}
