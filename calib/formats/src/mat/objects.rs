//! Objects of MATLAB classes: what references in the variables lead to.
//!
//! They live in the subsystem of the file, a MAT stream of its own. Its `MCOS` cells begin with a table (u32 version,
//! u32 number of names, eight u32 offsets; NUL-separated names from byte 40; then regions of classes, properties of
//! objects that save themselves, objects, properties of the others), an empty cell, and the values of properties.
//! MathWorks does not document it; found on files of MATLAB Mobile and R2018 to R2023.

use super::body::Body;
use super::element::{Element, MATRIX, Raw, U32};
use super::object_table::{TIMETABLE, Table};
use super::value::{CELL, OPAQUE, STRUCTURE, Value};
use crate::Error;

/// Bytes of the stream before its first element.
const STREAM_HEADER: u64 = 8;

/// The objects of a file.
#[derive(Debug)]
pub(super) struct Objects {
    table: Table,
    cells: Vec<Cell>,
}

/// The cell with the value of a property.
#[derive(Debug)]
struct Cell {
    /// Its first byte in the file, or in what that unpacks to.
    at: u64,
    /// The matrix in it; nothing where it was passed or let go of.
    matrix: Option<Vec<u8>>,
}

impl Objects {
    /// The objects in the subsystem, but for the content of timetables that no `wanted` reference leads to; `None`
    /// where there is no table of objects.
    ///
    /// # Errors
    /// Damage.
    pub fn read(body: &mut Body<'_>, wanted: &[&Value<'_>]) -> Result<Option<Self>, Error> {
        let _flags_dims_name = (body.need()?, body.need()?, body.need()?);
        let Some((_, None)) = body.tag()? else {
            return Ok(None);
        };
        body.pass(STREAM_HEADER)?;
        while let Some((tag, content)) = body.tag()? {
            let end = body.place().saturating_add(tag.length);
            match content {
                Some(_) => {}
                None if tag.kind == MATRIX => {
                    if let Some(end) = find_cells(body)? {
                        return Self::of_cells(body, end, wanted);
                    }
                    body.pass(end.saturating_sub(body.place()))?;
                }
                None => drop(body.content(tag.length)?),
            }
        }
        Ok(None)
    }

    /// The cells from here to `end`.
    fn of_cells(
        body: &mut Body<'_>,
        end: u64,
        wanted: &[&Value<'_>],
    ) -> Result<Option<Self>, Error> {
        let first = body.need()?;
        let Some(table) = Table::of(&first, body.place())? else {
            return Ok(None);
        };
        let passed = table.unwanted(wanted);
        let mut cells = Vec::new();
        while body.place() < end {
            let Some((tag, content)) = body.tag()? else {
                break;
            };
            let at = body.place();
            let matrix = match content {
                Some(content) => Some(content),
                None if passed.contains(&cells.len()) => {
                    body.pass(tag.length)?;
                    None
                }
                None => Some(body.content(tag.length)?),
            };
            cells.push(Cell { at, matrix });
        }
        Ok(Some(Self { table, cells }))
    }

    /// The value of an object's property; `None` where it has none of this name.
    ///
    /// # Errors
    /// Damage, or a value that was passed.
    pub fn property(&self, value: &Value<'_>, name: &str) -> Result<Option<Value<'_>>, Error> {
        let cell = self.table.cell(value, name);
        let Some(cell) = cell.and_then(|cell| self.cells.get(cell)) else {
            return Ok(None);
        };
        let Some(bytes) = cell.matrix.as_deref() else {
            return Err(Error::at(
                cell.at,
                findings::Finding::of(findings::Kind::TIMETABLE_TOO_EARLY),
            ));
        };
        let element = Element {
            kind: MATRIX,
            bytes,
        };
        Ok(Some(Value::read(element, cell.at, 0)?.value))
    }

    /// Lets go of a timetable's content, unless one of `others` shares it.
    pub fn forget<'v>(
        &mut self,
        value: &Value<'_>,
        mut others: impl Iterator<Item = &'v Value<'v>>,
    ) {
        let cell = self.table.cell(value, TIMETABLE);
        let shared = others.any(|other| self.table.cell(other, TIMETABLE) == cell);
        if shared {
            return;
        }
        if let Some(cell) = cell.and_then(|cell| self.cells.get_mut(cell)) {
            cell.matrix = None;
        }
    }
}

/// Goes to the first of the `MCOS` cells in a structure and says where they end; `None` where there are none.
fn find_cells(body: &mut Body<'_>) -> Result<Option<u64>, Error> {
    if class(body)? != STRUCTURE {
        return Ok(None);
    }
    let _dims_name = (body.need()?, body.need()?);
    let length = body.need()?;
    let names = body.need()?;
    let length = Raw(Element {
        kind: U32,
        bytes: &length,
    });
    let length = length.whole(0).unwrap_or(0).max(1) as usize;
    for name in names.chunks(length) {
        let Some((tag, None)) = body.tag()? else {
            return Ok(None);
        };
        let end = body.place().saturating_add(tag.length);
        if name.split(|byte| *byte == 0).next() != Some(b"MCOS") {
            body.pass(tag.length)?;
            continue;
        }
        let mut class = self::class(body)?;
        if class == OPAQUE {
            let _name_kind_class_tag = (body.need()?, body.need()?, body.need()?, body.tag()?);
            class = self::class(body)?;
        }
        if class != CELL {
            return Ok(None);
        }
        let _dims_name = (body.need()?, body.need()?);
        return Ok(Some(end));
    }
    Ok(None)
}

/// The class of the matrix that begins here.
fn class(body: &mut Body<'_>) -> Result<u8, Error> {
    Ok(body.need()?.first().copied().unwrap_or(0))
}
