//! Objects of MATLAB classes: what references in the variables lead to.
//!
//! They live in the subsystem of the file, a MAT stream of its own. Its `MCOS` cells begin with a table (u32 version,
//! u32 number of names, eight u32 offsets; NUL-separated names from byte 40; then regions of classes, properties of
//! objects that save themselves, objects, properties of the others), an empty cell, and the values of properties.
//! MathWorks does not document it; found on files of MATLAB Mobile and R2018 to R2023.

use super::element::{Elements, MATRIX, Raw};
use super::value::Value;
use crate::Error;

/// Bytes of the stream before its first element.
const STREAM_HEADER: usize = 8;
/// Bytes of the table before its names.
const TABLE_HEADER: usize = 40;
/// Cells before the values of properties.
const BEFORE_VALUES: usize = 2;
/// A property whose value is a cell.
const IN_CELL: u32 = 1;

/// The objects of a file.
#[derive(Debug)]
pub(super) struct Objects<'a> {
    cells: Vec<Value<'a>>,
    names: Vec<String>,
    /// Class names by class number.
    classes: Vec<String>,
    /// Of every object: class, number among those that save themselves, number among the others.
    objects: Vec<[u32; 3]>,
    /// Properties of both kinds of objects: name and cell.
    properties: [Vec<Vec<(u32, u32)>>; 2],
}

impl<'a> Objects<'a> {
    /// The objects in the subsystem's bytes; `None` where there is no table of them.
    pub fn read(subsystem: &'a [u8], at: u64) -> Result<Option<Self>, Error> {
        let stream = subsystem.get(STREAM_HEADER..).unwrap_or_default();
        let mut elements = Elements::new(stream, at + STREAM_HEADER as u64);
        while let Some(element) = elements.next()? {
            let place = elements.at;
            if element.kind != MATRIX {
                continue;
            }
            let variable = Value::read(element, place, 0)?;
            let Value::Structure(fields) = variable.value else {
                continue;
            };
            let cells = fields.into_iter().find(|(name, _)| name == "MCOS");
            if let Some((_, Value::Cells(cells))) = cells {
                return Ok(Self::of(cells));
            }
        }
        Ok(None)
    }

    fn of(cells: Vec<Value<'a>>) -> Option<Self> {
        let Some(Value::Numbers { real, .. }) = cells.first() else {
            return None;
        };
        let table = Table(real.0.bytes);
        let count = table.word(4)? as usize;
        let names: Vec<String> = table
            .0
            .get(TABLE_HEADER..)?
            .split(|byte| *byte == 0)
            .take(count)
            .map(|name| String::from_utf8_lossy(name).into_owned())
            .collect();
        let name = |index: u32| {
            (index as usize)
                .checked_sub(1)
                .and_then(|at| names.get(at))
                .cloned()
                .unwrap_or_default()
        };
        // The first entry of every region stands for none.
        let classes = table.rows::<4>(8, 12)?.map(|row| name(row[1])).collect();
        let objects = table
            .rows::<6>(16, 20)?
            .map(|row| [row[0], row[3], row[4]])
            .collect();
        let properties = [table.properties(12, 16)?, table.properties(20, 24)?];
        Some(Self {
            classes,
            objects,
            properties,
            names,
            cells,
        })
    }

    /// Class and properties of the object with this reference: dimensions, object numbers and a class.
    pub fn get(&self, reference: &[u32]) -> Option<(&str, Vec<(&str, &Value<'a>)>)> {
        let dims = *reference.first()? as usize;
        let id = *reference.get(dims.checked_add(1)?)? as usize;
        let [class, own, usual] = *self.objects.get(id)?;
        let class = self.classes.get(class as usize)?;
        let (properties, at) = if own > 0 {
            (&self.properties[0], own)
        } else {
            (&self.properties[1], usual)
        };
        let named = |(name, cell): &(u32, u32)| {
            let name = self.names.get((*name as usize).checked_sub(1)?)?;
            Some((
                name.as_str(),
                self.cells
                    .get((*cell as usize).checked_add(BEFORE_VALUES)?)?,
            ))
        };
        let properties = properties.get(at as usize)?.iter().filter_map(named);
        Some((class, properties.collect()))
    }

    /// The value of an object's property.
    pub fn property(&self, value: &Value<'_>, name: &str) -> Option<&Value<'a>> {
        let Value::Object(reference) = value else {
            return None;
        };
        let (_, properties) = self.get(reference)?;
        properties
            .into_iter()
            .find(|(property, _)| *property == name)
            .map(|(_, value)| value)
    }
}

/// The table of names, classes, objects and properties.
struct Table<'a>(&'a [u8]);

impl Table<'_> {
    fn word(&self, at: usize) -> Option<u32> {
        let bytes = self.0.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    }

    /// The region between the offsets at these two places of the header.
    fn region(&self, from: usize, to: usize) -> Option<&[u8]> {
        self.0
            .get(self.word(from)? as usize..self.word(to)? as usize)
    }

    /// The region as rows of `N` numbers.
    fn rows<const N: usize>(
        &self,
        from: usize,
        to: usize,
    ) -> Option<impl Iterator<Item = [u32; N]>> {
        let region = Table(self.region(from, to)?);
        let rows = region.0.len() / (4 * N);
        Some(
            (0..rows).map(move |row| {
                std::array::from_fn(|k| region.word(4 * (N * row + k)).unwrap_or(0))
            }),
        )
    }

    /// The region as lists of properties, each behind its length and on a boundary of eight bytes.
    fn properties(&self, from: usize, to: usize) -> Option<Vec<Vec<(u32, u32)>>> {
        let region = Table(self.region(from, to)?);
        let mut lists = Vec::new();
        let mut at = 0;
        while let Some(count) = region.word(at) {
            let mut list = Vec::new();
            at += 4;
            for _ in 0..count {
                let (Some(name), Some(kind), Some(cell)) =
                    (region.word(at), region.word(at + 4), region.word(at + 8))
                else {
                    return Some(lists);
                };
                if kind == IN_CELL {
                    list.push((name, cell));
                }
                at += 12;
            }
            lists.push(list);
            at = at.next_multiple_of(8);
        }
        Some(lists)
    }
}

/// Numbers of a value, its imaginary part and its rows.
pub(super) fn numbers<'v>(value: &'v Value<'_>) -> Option<(Raw<'v>, Option<Raw<'v>>)> {
    match value {
        Value::Numbers {
            real, imaginary, ..
        } => Some((*real, *imaginary)),
        _ => None,
    }
}
