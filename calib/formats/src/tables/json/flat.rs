//! A record as cells: names of what is within each other joined by points, three numbers called x, y and z.

use std::collections::HashMap;
use std::io::Write;

use findings::{Finding, Kind};
use serde_json::{Map, Value};

use super::rows::{self, Cell};
use crate::Error;
use crate::shown::shown;

/// Cells by name.
pub(super) type Row = Vec<(String, Cell)>;

/// More columns are no readings.
const WIDEST: usize = 256;
/// No name is longer, bytes.
const LONGEST: usize = 200;
/// Numbers in a list that is a cell of a record.
const MOST: usize = 64;

/// Adds the cells of `value`, which is called `name`.
///
/// # Errors
/// Lists within lists: which of their numbers belong to one moment is not known.
pub(super) fn flatten(name: &str, value: &Value, row: &mut Row) -> Result<(), Error> {
    let within = |inner: &str| match name.is_empty() {
        true => inner.to_owned(),
        false => format!("{name}.{inner}"),
    };
    match value {
        Value::Object(members) if let Some(stamp) = seconds(members) => {
            row.push((name.to_owned(), Cell::Text(stamp)));
            Ok(())
        }
        Value::Object(members) => {
            for (inner, value) in members {
                flatten(&within(inner), value, row)?;
            }
            Ok(())
        }
        Value::Array(values) => {
            let is_nested = |value: &Value| value.is_array() || value.is_object();
            if values.len() > MOST || values.iter().any(is_nested) {
                let found = Finding::of(Kind::LISTS_IN_RECORDS);
                return Err(Error::refused(found.detail("name", shown(name))));
            }
            for (at, value) in values.iter().enumerate() {
                match (name.is_empty(), values.len()) {
                    // Rows without names.
                    (true, _) => row.push((String::new(), scalar(value))),
                    (false, 3) => row.push((within(["x", "y", "z"][at]), scalar(value))),
                    _ => row.push((format!("{name}[{at}]"), scalar(value))),
                }
            }
            Ok(())
        }
        scalar_ => {
            row.push((name.to_owned(), scalar(scalar_)));
            Ok(())
        }
    }
}

/// The stamp of ROS, seconds with nanoseconds apart, as one number.
fn seconds(members: &Map<String, Value>) -> Option<String> {
    let whole = |names: &[&str]| names.iter().find_map(|name| members.get(*name)?.as_u64());
    let (seconds, rest) = (
        whole(&["sec", "secs"])?,
        whole(&["nanosec", "nsec", "nsecs"])?,
    );
    (members.len() == 2 && rest < 1_000_000_000).then(|| format!("{seconds}.{rest:09}"))
}

fn scalar(value: &Value) -> Cell {
    match value {
        Value::Bool(yes) => Cell::Whole(i64::from(*yes)),
        Value::Number(number) => match (number.as_i64(), number.as_u64(), number.as_f64()) {
            (Some(number), ..) => Cell::Whole(number),
            (_, Some(number), _) => Cell::Unsigned(number),
            (.., Some(number)) => Cell::Double(number),
            _ => Cell::Empty,
        },
        Value::String(words) => Cell::Text(words.clone()),
        Value::Null | Value::Array(_) | Value::Object(_) => Cell::Empty,
    }
}

/// The columns of all records, in the order in which they first occur.
#[derive(Debug, Default)]
pub(super) struct Columns {
    names: Vec<String>,
    places: HashMap<String, usize>,
    /// The most cells of a row without names.
    unnamed: usize,
}

impl Columns {
    /// Adds those of a record.
    ///
    /// # Errors
    /// More than any recording has, or longer names.
    pub fn add(&mut self, row: &Row) -> Result<(), Error> {
        let unnamed = row.iter().filter(|(name, _)| name.is_empty()).count();
        self.unnamed = self.unnamed.max(unnamed);
        for (name, _) in row.iter().filter(|(name, _)| !name.is_empty()) {
            if !self.places.contains_key(name) {
                self.places.insert(name.clone(), self.names.len());
                self.names.push(name.clone());
            }
            if name.len() > LONGEST {
                let found = Finding::of(Kind::NAME_TOO_LONG);
                return Err(Error::refused(found.count("bytes", name.len())));
            }
        }
        if self.names.len() + self.unnamed > WIDEST {
            let found = Finding::of(Kind::NAMES_TOO_MANY);
            return Err(Error::refused(found.count("limit", WIDEST)));
        }
        if self.unnamed > 0 && !self.names.is_empty() {
            return Err(Error::refused(Finding::of(Kind::NAMES_MIXED)));
        }
        Ok(())
    }

    /// Writes the line of names; none where there are none.
    pub fn write_names(&self, out: &mut dyn Write) -> Result<(), Error> {
        if self.unnamed == 0 {
            out.write_all(rows::header(&self.names).as_bytes())?;
        }
        Ok(())
    }

    /// Writes a record; `line` is scratch space.
    pub fn write(&self, row: Row, out: &mut dyn Write, line: &mut String) -> Result<(), Error> {
        if self.unnamed > 0 {
            return rows::write(out, line, row.iter().map(|(_, cell)| cell));
        }
        let mut cells = vec![Cell::Empty; self.names.len()];
        for (name, cell) in row {
            if let Some(at) = self.places.get(&name) {
                cells[*at] = cell;
            }
        }
        rows::write(out, line, cells.iter())
    }
}
