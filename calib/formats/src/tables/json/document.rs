//! One JSON object, and the lists in it that are tables.

use serde_json::{Deserializer, Map, Value};

use super::axis_order::in_order;
use super::flat::{Row, flatten};
use super::packets;
use super::records::{Budgeted, first_byte};
use crate::Error;
use crate::error::no_json;
use crate::shown::shown;
use crate::store::Store;
use crate::tables::rows::{Cell, with_unit};

/// Fewer are settings, no readings.
const FEWEST: usize = 10;
/// Objects within objects that are looked into.
const DEPTH: usize = 6;
/// Numbers in an element of a column: a quaternion has four.
const WIDEST: usize = 4;
/// Keys of a list that names the columns of rows without names.
const NAMES: [&str; 6] = [
    "sensors", "columns", "names", "fields", "header", "channels",
];
/// Key of the step between rows, ms.
const STEP: &str = "interval_ms";

/// One object.
pub(super) struct Document {
    root: Value,
}

/// A table of a document.
pub(super) struct Table<'a> {
    /// Path in the document, names joined by `/`.
    pub name: String,
    content: Content<'a>,
}

enum Content<'a> {
    /// Objects.
    Records(&'a [Value]),
    /// Objects by keys that are in the order of time.
    Members(Vec<(&'a str, &'a Value)>),
    /// Lists of numbers, the names of their columns, and the step between them, ms.
    Rows(&'a [Value], Vec<String>, Option<f64>),
    /// Columns by name, all of one length.
    Columns(Columns<'a>),
}

/// Lists by name.
type Columns<'a> = Vec<(&'a str, &'a [Value])>;

impl Document {
    /// The object in `store`; none where there is another beginning, or more than one.
    ///
    /// # Errors
    /// Damage of a file that holds one object.
    pub fn open(store: &Store) -> Result<Option<Self>, Error> {
        if first_byte(store)? != b'{' {
            return Ok(None);
        }
        let (reader, left) = Budgeted::open(store)?;
        let mut values = Deserializer::from_reader(reader).into_iter::<Value>();
        let Some(root) = values.next() else {
            return Ok(None);
        };
        let mut root = root.map_err(|error| no_json(&error))?;
        // What follows is looked at to its end at most.
        left.set(u64::MAX);
        match values.next() {
            None => {
                in_order(&mut root);
                Ok(Some(Self { root }))
            }
            Some(_) => Ok(None),
        }
    }

    /// The tables in it.
    pub fn tables(&self) -> impl Iterator<Item = Table<'_>> {
        let mut tables = Vec::new();
        if let Value::Object(members) = &self.root {
            look("", members, DEPTH, &mut tables);
        }
        tables.into_iter()
    }

    /// Lists up to ten keys of the document, for a message.
    pub fn listed(&self) -> String {
        let names = self.root.as_object().into_iter().flat_map(Map::keys);
        let names: Vec<String> = names.take(10).map(|name| shown(name)).collect();
        match names.is_empty() {
            true => "nothing".to_owned(),
            false => names.join(", "),
        }
    }
}

fn look<'a>(at: &str, members: &'a Map<String, Value>, depth: usize, tables: &mut Vec<Table<'a>>) {
    let within = |name: &str| match at.is_empty() {
        true => name.to_owned(),
        false => format!("{at}/{name}"),
    };
    if let Some(members) = members_alike(members) {
        tables.push(Table {
            name: at.to_owned(),
            content: Content::Members(members),
        });
        return;
    }
    // By length: sensors may have columns of their own.
    let mut columns: Vec<(usize, Columns<'_>)> = Vec::new();
    for (name, value) in members {
        match value {
            Value::Object(inner) if depth > 0 => look(&within(name), inner, depth - 1, tables),
            Value::Array(values) if values.len() >= FEWEST => {
                if values.iter().all(Value::is_object) {
                    tables.push(Table {
                        name: within(name),
                        content: Content::Records(values),
                    });
                } else if let Some(names) = names_of(members, values) {
                    let step = members.get(STEP).and_then(Value::as_f64);
                    tables.push(Table {
                        name: within(name),
                        content: Content::Rows(values, names, step),
                    });
                } else if values.iter().all(is_narrow) {
                    match columns
                        .iter_mut()
                        .find(|(length, _)| *length == values.len())
                    {
                        Some((_, same)) => same.push((name, values)),
                        None => columns.push((values.len(), vec![(name, values)])),
                    }
                }
            }
            _ => {}
        }
    }
    let several = columns.len() > 1;
    for (length, columns) in columns {
        let name = match several {
            true => within(&format!("{length} rows")),
            false => at.to_owned(),
        };
        tables.push(Table {
            name,
            content: Content::Columns(columns),
        });
    }
}

/// The members of an object of records that are alike, as databases keep them by keys that they make: in the order of the keys, of
/// numbers by their size.
fn members_alike(members: &Map<String, Value>) -> Option<Vec<(&str, &Value)>> {
    let is_record = |record: &Map<String, Value>| {
        let is_long = |value: &Value| value.as_array().is_some_and(|list| list.len() > WIDEST);
        !record.is_empty() && !record.values().any(is_long)
    };
    let first = members
        .values()
        .next()?
        .as_object()
        .filter(|own| is_record(own))?;
    let is_alike = |value: &Value| {
        value
            .as_object()
            .is_some_and(|own| is_record(own) && own.keys().eq(first.keys()))
    };
    if members.len() < FEWEST || !members.values().all(is_alike) {
        return None;
    }
    let mut members: Vec<(&str, &Value)> = members
        .iter()
        .map(|(key, value)| (key.as_str(), value))
        .collect();
    let number = |key: &str| key.parse::<u64>().ok();
    if members.iter().all(|(key, _)| number(key).is_some()) {
        members.sort_by_key(|(key, _)| number(key));
    }
    Some(members)
}

/// True for a number or what may stand for one, and for as few as a vector has.
fn is_narrow(value: &Value) -> bool {
    match value {
        Value::Object(_) => false,
        Value::Array(numbers) => {
            numbers.len() <= WIDEST
                && numbers
                    .iter()
                    .all(|one| !one.is_array() && !one.is_object())
        }
        _ => true,
    }
}

/// The names of the columns of `rows`, where another member lists as many.
fn names_of(members: &Map<String, Value>, rows: &[Value]) -> Option<Vec<String>> {
    let width = rows.first()?.as_array()?.len();
    let is_row = |row: &Value| row.as_array().is_some_and(|row| row.len() == width);
    if !rows.iter().all(is_row) {
        return None;
    }
    let lists = NAMES.iter().filter_map(|name| members.get(*name));
    let mut lists = lists.filter_map(Value::as_array);
    let names = lists.find(|names| names.len() == width)?;
    names.iter().map(named).collect()
}

/// A name, or a record with a name and, if any, a unit.
fn named(value: &Value) -> Option<String> {
    let text = |name: &str| value.get(name).and_then(Value::as_str);
    match value {
        Value::String(name) => Some(name.clone()),
        _ => Some(with_unit(
            text("name")?,
            text("units").or_else(|| text("unit")),
        )),
    }
}

impl Table<'_> {
    /// Number of its records, of which packets are several rows each.
    pub fn length(&self) -> usize {
        match &self.content {
            Content::Records(rows) | Content::Rows(rows, ..) => rows.len(),
            Content::Members(members) => members.len(),
            Content::Columns(columns) => columns.first().map_or(0, |(_, column)| column.len()),
        }
    }

    /// The rows of the record `at`.
    ///
    /// # Errors
    /// Lists within lists.
    pub fn rows(&self, at: usize) -> Result<Vec<Row>, Error> {
        let mut row = Row::new();
        match &self.content {
            Content::Records(records) => return packets::rows(&records[at]),
            Content::Members(members) => {
                let (key, record) = members[at];
                // Keys that count are stamps, be it of the rows.
                let stamp = key
                    .parse()
                    .ok()
                    .map(|key| ("key".to_owned(), Cell::Unsigned(key)));
                let mut rows = packets::rows(record)?;
                for row in &mut rows {
                    row.extend(stamp.clone());
                }
                return Ok(rows);
            }
            Content::Rows(rows, names, step) => {
                if let Some(step) = step {
                    row.push(("time (ms)".to_owned(), Cell::Double(step * at as f64)));
                }
                let cells = rows[at].as_array().into_iter().flatten();
                for (name, value) in names.iter().zip(cells) {
                    flatten(name, value, &mut row)?;
                }
            }
            Content::Columns(columns) => {
                for (name, column) in columns {
                    flatten(name, &column[at], &mut row)?;
                }
            }
        }
        Ok(vec![row])
    }
}
