//! The table of a file's objects: which cell holds the value of which property.

use super::element::{Element, MATRIX};
use super::value::Value;
use crate::Error;

/// The property that holds what a timetable consists of.
pub(super) const TIMETABLE: &str = "any";

/// Bytes of the table before its names.
const HEADER: usize = 40;
/// Cells before the values of properties, behind the table: an empty one.
const BEFORE_VALUES: usize = 1;
/// A property whose value is a cell.
const IN_CELL: u32 = 1;

/// Names, classes, objects and their properties.
#[derive(Debug)]
pub(super) struct Table {
    names: Vec<String>,
    /// Class names by class number.
    classes: Vec<String>,
    /// Every object: number of its class, number among those that save themselves, number among the others (`n × 3`).
    objects: Vec<[u32; 3]>,
    /// Properties of both kinds of objects: name and cell.
    properties: [Vec<Vec<(u32, u32)>>; 2],
}

impl Table {
    /// The table in this matrix, whose content ends at byte `at`; `None` for another matrix.
    ///
    /// # Errors
    /// Damage.
    pub fn of(matrix: &[u8], at: u64) -> Result<Option<Self>, Error> {
        let element = Element {
            kind: MATRIX,
            bytes: matrix,
        };
        let value = Value::read(element, at.saturating_sub(matrix.len() as u64), 0)?.value;
        let Value::Numbers { real, .. } = value else {
            return Ok(None);
        };
        Ok(Self::of_bytes(&Bytes(real.0.bytes)))
    }

    fn of_bytes(table: &Bytes<'_>) -> Option<Self> {
        let count = table.word(4)? as usize;
        let names: Vec<String> = table
            .0
            .get(HEADER..)?
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
        })
    }

    /// The cell, counted behind the table, with this property of the object that `value` refers to.
    pub fn cell(&self, value: &Value<'_>, name: &str) -> Option<usize> {
        let object = self.objects.get(number(value)?)?;
        self.cell_of(object, name)
    }

    /// Name and cell of an object's properties.
    fn properties(&self, [_, own, usual]: &[u32; 3]) -> impl Iterator<Item = (&str, usize)> {
        let (properties, at) = if *own > 0 {
            (&self.properties[0], *own)
        } else {
            (&self.properties[1], *usual)
        };
        let properties = properties.get(at as usize).map(Vec::as_slice);
        properties
            .unwrap_or_default()
            .iter()
            .filter_map(|(name, cell)| {
                let name = self.names.get((*name as usize).checked_sub(1)?)?;
                Some((name.as_str(), (*cell as usize).checked_add(BEFORE_VALUES)?))
            })
    }

    fn cell_of(&self, object: &[u32; 3], name: &str) -> Option<usize> {
        self.properties(object)
            .find(|(property, _)| *property == name)
            .map(|(_, cell)| cell)
    }

    /// The cells with timetables that no `wanted` reference leads to, and nothing else.
    pub fn unwanted(&self, wanted: &[&Value<'_>]) -> Vec<usize> {
        let is_timetable = |object: &[u32; 3]| {
            let class = self.classes.get(object[0] as usize);
            class.is_some_and(|class| class == "timetable")
        };
        let wanted: Vec<usize> = wanted.iter().filter_map(|one| number(one)).collect();
        let (unwanted, others): (Vec<_>, Vec<_>) = self
            .objects
            .iter()
            .enumerate()
            .partition(|(at, object)| is_timetable(object) && !wanted.contains(at));
        let used: Vec<usize> = others
            .iter()
            .flat_map(|(_, object)| self.properties(object))
            .map(|(_, cell)| cell)
            .collect();
        unwanted
            .iter()
            .filter_map(|(_, object)| self.cell_of(object, TIMETABLE))
            .filter(|cell| !used.contains(cell))
            .collect()
    }
}

/// The number of the object that `value` refers to by dimensions, object numbers and a class.
fn number(value: &Value<'_>) -> Option<usize> {
    let Value::Object(reference) = value else {
        return None;
    };
    let dims = *reference.first()? as usize;
    Some(*reference.get(dims.checked_add(1)?)? as usize)
}

/// The table as bytes.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
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
        let region = Bytes(self.region(from, to)?);
        let rows = region.0.len() / (4 * N);
        Some(
            (0..rows).map(move |row| {
                std::array::from_fn(|k| region.word(4 * (N * row + k)).unwrap_or(0))
            }),
        )
    }

    /// The region as lists of properties, each behind its length and on a boundary of eight bytes.
    fn properties(&self, from: usize, to: usize) -> Option<Vec<Vec<(u32, u32)>>> {
        let region = Bytes(self.region(from, to)?);
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
