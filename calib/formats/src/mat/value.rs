//! Matrices, cells, structures and references to objects.

use super::element::{Element, Elements, MATRIX, Raw};
use crate::Error;

/// A value; numbers stay as they are stored until they are asked for.
#[derive(Debug)]
pub(super) enum Value<'a> {
    /// Numbers by columns, with an imaginary part or without.
    Numbers {
        dims: Vec<usize>,
        real: Raw<'a>,
        imaginary: Option<Raw<'a>>,
    },
    /// Characters.
    Text(String),
    /// Values in cells.
    Cells(Vec<Value<'a>>),
    /// A structure by field; of an array of them the first.
    Structure(Vec<(String, Value<'a>)>),
    /// An object: the numbers of its reference.
    Object(Vec<u32>),
    /// Anything else, by its class.
    Other(u8),
    /// Nothing.
    Empty,
}

/// A value with its name, and the class of an object.
#[derive(Debug)]
pub(super) struct Variable<'a> {
    pub name: String,
    pub class: Option<String>,
    pub value: Value<'a>,
}

/// Values within values.
const DEPTH: usize = 24;
pub(super) const CELL: u8 = 1;
pub(super) const STRUCTURE: u8 = 2;
const TEXT: u8 = 4;
pub(super) const OPAQUE: u8 = 17;
const COMPLEX: u32 = 0x800;
/// An object's reference begins with this.
pub(super) const REFERENCE: u32 = 0xdd00_0000;

fn text(element: Element<'_>) -> String {
    let end = element
        .bytes
        .iter()
        .position(|byte| *byte == 0)
        .unwrap_or(element.bytes.len());
    String::from_utf8_lossy(&element.bytes[..end]).into_owned()
}

fn class_name(class: u8) -> &'static str {
    match class {
        3 => "an old object",
        5 => "a sparse matrix",
        16 => "a function handle",
        _ => "of another class",
    }
}

impl<'a> Value<'a> {
    /// The matrix in `element`; `at` is its byte for messages.
    pub fn read(element: Element<'a>, at: u64, depth: usize) -> Result<Variable<'a>, Error> {
        let unnamed = |value| Variable {
            name: String::new(),
            class: None,
            value,
        };
        if element.kind != MATRIX || element.bytes.is_empty() {
            return Ok(unnamed(Value::Empty));
        }
        if depth == DEPTH {
            return Err(Error::at(
                at,
                findings::Finding::of(findings::Kind::NESTED_TOO_DEEP)
                    .count("limit", DEPTH)
                    .detail("things", "values"),
            ));
        }
        let mut parts = Elements::new(element.bytes, at);
        let flags = Raw(parts.need()?).whole(0).unwrap_or(0);
        let class = (flags & 0xff) as u8;
        if class == OPAQUE {
            return Self::opaque(&mut parts, depth);
        }
        let sizes = Raw(parts.need()?);
        let dims: Vec<usize> = (0..sizes.len())
            .filter_map(|k| sizes.whole(k))
            .map(|n| n as usize)
            .collect();
        let name = text(parts.need()?);
        let value = match class {
            CELL => Value::Cells(Self::all(&mut parts, depth)?),
            STRUCTURE => Self::structure(&mut parts, depth)?,
            TEXT => {
                let characters = Raw(parts.need()?);
                let codes =
                    (0..characters.len()).filter_map(|k| char::from_u32(characters.whole(k)?));
                Value::Text(codes.collect())
            }
            6..=15 => {
                let real = Raw(parts.need()?);
                let imaginary = match flags & COMPLEX {
                    0 => None,
                    _ => parts.next()?.map(Raw),
                };
                match real.whole(0) == Some(REFERENCE) && imaginary.is_none() {
                    true => Value::Object((1..real.len()).filter_map(|k| real.whole(k)).collect()),
                    false => Value::Numbers {
                        dims,
                        real,
                        imaginary,
                    },
                }
            }
            other => Value::Other(other),
        };
        Ok(Variable {
            name,
            class: None,
            value,
        })
    }

    fn opaque(parts: &mut Elements<'a>, depth: usize) -> Result<Variable<'a>, Error> {
        let (name, _kind, class) = (text(parts.need()?), parts.need()?, text(parts.need()?));
        let at = parts.at;
        let value = Self::read(parts.need()?, at, depth + 1)?.value;
        Ok(Variable {
            name,
            class: Some(class),
            value,
        })
    }

    fn all(parts: &mut Elements<'a>, depth: usize) -> Result<Vec<Value<'a>>, Error> {
        let mut values = Vec::new();
        loop {
            let at = parts.at;
            let Some(element) = parts.next()? else {
                return Ok(values);
            };
            values.push(Self::read(element, at, depth + 1)?.value);
        }
    }

    fn structure(parts: &mut Elements<'a>, depth: usize) -> Result<Value<'a>, Error> {
        let length = Raw(parts.need()?).whole(0).unwrap_or(0) as usize;
        let names = parts.need()?.bytes;
        let names: Vec<String> = match length {
            0 => Vec::new(),
            _ => names
                .chunks(length)
                .map(|bytes| text(Element { kind: 1, bytes }))
                .collect(),
        };
        let values = Self::all(parts, depth)?;
        Ok(Value::Structure(names.into_iter().zip(values).collect()))
    }

    /// Numbers and their imaginary part.
    pub fn numbers(&self) -> Option<(Raw<'_>, Option<Raw<'_>>)> {
        match self {
            Value::Numbers {
                real, imaginary, ..
            } => Some((*real, *imaginary)),
            _ => None,
        }
    }

    /// The field of a structure.
    pub fn field(&self, name: &str) -> Option<&Value<'a>> {
        match self {
            Value::Structure(fields) => fields
                .iter()
                .find(|(field, _)| field == name)
                .map(|(_, value)| value),
            _ => None,
        }
    }

    /// The cells.
    pub fn cells(&self) -> &[Value<'a>] {
        match self {
            Value::Cells(cells) => cells,
            _ => &[],
        }
    }

    /// Describes the value for a list of variables.
    pub fn described(&self) -> String {
        match self {
            Value::Numbers { dims, .. } => {
                let dims: Vec<String> = dims.iter().map(ToString::to_string).collect();
                format!("numbers, {}", dims.join(" × "))
            }
            Value::Text(_) => "text".to_owned(),
            Value::Cells(cells) => format!("{} cells", cells.len()),
            Value::Structure(_) => "a structure".to_owned(),
            Value::Object(_) => "an object".to_owned(),
            Value::Other(class) => class_name(*class).to_owned(),
            Value::Empty => "nothing".to_owned(),
        }
    }
}
