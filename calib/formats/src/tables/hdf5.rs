//! HDF5, which MATLAB 7.3 files are too: vectors of one length in a group are the columns of a table, a matrix of three
//! columns is a triad of them, records and other matrices are tables of their own.

use std::collections::BTreeMap;
use std::fmt;
use std::io::Write;
use std::sync::Arc;

use hdf5_reader::dataset::{Dataset, SliceInfo, SliceInfoElem};
use hdf5_reader::error::{ByteOrder, Error as Hdf5Error};
use hdf5_reader::group::Group;
use hdf5_reader::storage::FileStorage;
use hdf5_reader::{Datatype, H5Type, Hdf5File, OpenOptions, dtype_element_size};

use super::rows::{self, Cell};
use super::{Listed, Reader};
use crate::container::Store;
use crate::{Error, Limits};

/// HDF5 files. Links to other files are not followed.
#[derive(Debug)]
pub(super) struct Hdf5;

/// Groups within groups that are looked into.
const DEPTH: usize = 8;
/// Fewer rows are settings, no readings.
const FEWEST: u64 = 10;
/// More columns are a picture.
const WIDEST: u64 = 64;
/// Rows read at a time, more where a chunk holds more.
const ROWS: u64 = 4096;
/// Bytes of chunks that are kept unpacked.
const CACHE: usize = 32 << 20;

impl Reader for Hdf5 {
    fn tables(&self, store: &Store, limits: Limits) -> Result<Listed, Error> {
        let mut found = Found::default();
        found.look(&open(store)?, limits)?;
        if found.tables.is_empty() {
            let words = format!(
                "no dataset of numbers with {FEWEST} rows or more; it holds {}",
                found.listed()
            );
            return Err(Error::refused(words));
        }
        Ok(Listed {
            names: found.tables.into_iter().map(|table| table.name).collect(),
            warnings: found.warnings,
        })
    }

    fn write(
        &self,
        store: &Store,
        name: &str,
        limits: Limits,
        out: &mut dyn Write,
    ) -> Result<(), Error> {
        let file = open(store)?;
        let mut found = Found::default();
        found.look(&file, limits)?;
        let table = found.tables.iter().find(|table| table.name == name);
        let table = table.ok_or_else(|| Error::refused("the file has changed"))?;
        table.write(out)
    }
}

fn damaged(error: Hdf5Error) -> Error {
    Error::refused(format!("the HDF5 file cannot be read: {error}"))
}

fn open(store: &Store) -> Result<Hdf5File, Error> {
    let options = OpenOptions::default()
        .with_chunk_cache_bytes(CACHE)
        .with_max_read_bytes(hdf5_reader::DEFAULT_MAX_CHUNK_BYTES);
    match store {
        Store::File(path) => {
            let storage = FileStorage::open(path).map_err(damaged)?;
            Hdf5File::from_storage_with_options(Arc::new(storage), options)
        }
        Store::Memory(bytes) => Hdf5File::from_shared_bytes_with_options(bytes.clone(), options),
    }
    .map_err(damaged)
}

/// A dataset of rows.
struct Set {
    dataset: Dataset,
    name: String,
    rows: u64,
    width: usize,
    /// Which of its dimensions counts the rows.
    axis: usize,
    /// Names of its columns, where they have some.
    names: Option<Vec<String>>,
}

/// Datasets of one length.
struct Table {
    name: String,
    sets: Vec<Set>,
}

/// What is in a file.
#[derive(Default)]
struct Found {
    tables: Vec<Table>,
    others: Vec<String>,
    warnings: Vec<String>,
    seen: usize,
}

impl Found {
    fn look(&mut self, file: &Hdf5File, limits: Limits) -> Result<(), Error> {
        let root = file.root_group().map_err(damaged)?;
        self.group(&root, "", 0, limits)
    }

    fn group(
        &mut self,
        group: &Group,
        path: &str,
        depth: usize,
        limits: Limits,
    ) -> Result<(), Error> {
        let (groups, datasets) = group.members().map_err(damaged)?;
        self.seen += groups.len() + datasets.len();
        if self.seen > limits.entries {
            let words = format!("more than {} groups and datasets", limits.entries);
            return Err(Error::refused(words));
        }
        // By their number of rows.
        let mut together: BTreeMap<u64, Vec<Set>> = BTreeMap::new();
        for dataset in datasets {
            let called = inside(path, dataset.name());
            if is_object(&dataset, &called, &mut self.warnings)? {
                continue;
            }
            let Some(set) = Set::of(dataset, group)? else {
                self.others.push(called);
                continue;
            };
            rows::check(set.rows, limits.rows)?;
            match set.stands_alone() {
                true => self.tables.push(Table {
                    name: called,
                    sets: vec![set],
                }),
                false => together.entry(set.rows).or_default().push(set),
            }
        }
        together.retain(|_, sets| {
            let enough = sets.iter().map(|set| set.width).sum::<usize>() >= 3;
            let names = sets.iter().map(|set| inside(path, &set.name));
            self.others
                .extend(names.filter(|_| !enough).collect::<Vec<_>>());
            enough
        });
        let only = together.len() == 1;
        for (rows, sets) in together {
            let mut triads = sets.iter().filter(|set| set.width > 1);
            let name = match (only, triads.next(), triads.next()) {
                (true, ..) if !path.is_empty() => path.to_owned(),
                // Stamps and one sensor's triad.
                (_, Some(triad), None) => inside(path, &triad.name),
                (true, ..) => String::new(),
                _ => inside(path, &format!("{rows} rows")),
            };
            self.tables.push(Table {
                name,
                sets: without_the_sensor(sets),
            });
        }
        for inner in groups.iter().filter(|_| depth < DEPTH) {
            // Where MATLAB keeps what its objects and cells consist of.
            if !inner.name().starts_with('#') {
                self.group(inner, &inside(path, inner.name()), depth + 1, limits)?;
            }
        }
        Ok(())
    }

    /// Names of what is no table.
    fn listed(&self) -> String {
        let names: Vec<String> = self.others.iter().take(12).cloned().collect();
        match names.is_empty() {
            true => "nothing".to_owned(),
            false => names.join(", "),
        }
    }
}

/// Stamps beside one triad may be called after it, as `t_acc` beside `acc`: `t` is what a table calls them.
fn without_the_sensor(mut sets: Vec<Set>) -> Vec<Set> {
    let mut triads = sets.iter().filter(|set| set.width > 1);
    let (Some(sensor), None) = (triads.next().map(|set| set.name.clone()), triads.next()) else {
        return sets;
    };
    let vectors = sets.iter_mut().filter(|set| set.width == 1);
    for name in vectors.filter_map(|set| set.names.as_mut()?.first_mut()) {
        let rest = name.replacen(&sensor, "", 1);
        let rest = rest.trim_matches('_');
        if !rest.is_empty() {
            *name = rest.to_owned();
        }
    }
    sets
}

fn inside(path: &str, name: &str) -> String {
    match path.is_empty() {
        true => name.to_owned(),
        false => format!("{path}/{name}"),
    }
}

/// True for an object of MATLAB, which is no numbers: one called after a sensor is refused, others are told of.
fn is_object(dataset: &Dataset, name: &str, warnings: &mut Vec<String>) -> Result<bool, Error> {
    const PLAIN: [&str; 6] = ["double", "single", "logical", "char", "cell", "struct"];
    let Some(class) = attribute(dataset, &["MATLAB_class"]) else {
        return Ok(false);
    };
    if PLAIN.contains(&class.as_str()) || class.contains("int") {
        return Ok(class == "char" || class == "cell");
    }
    let words = format!(
        "the variable {} is an object of class {}, which is not read from MATLAB 7.3; save it with `save -v7`",
        name.escape_default(),
        class.escape_default()
    );
    match crate::mat::quantity(name) {
        Some(_) => Err(Error::refused(words)),
        None => {
            warnings.push(words);
            Ok(true)
        }
    }
}

/// The text of the first attribute there is.
fn attribute(dataset: &Dataset, names: &[&str]) -> Option<String> {
    let read = |name: &&str| dataset.attribute(name).ok()?.read_string().ok();
    names.iter().find_map(read)
}

/// True for numbers that are read.
fn is_number(datatype: &Datatype) -> bool {
    match datatype {
        Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. } => true,
        Datatype::Enum { base, .. } => is_number(base),
        _ => false,
    }
}

/// Names of three axes, or numbers.
fn axes(name: &str, width: usize) -> Vec<String> {
    match width {
        1 => vec![name.to_owned()],
        3 => ["x", "y", "z"].map(|axis| format!("{name}_{axis}")).into(),
        _ => (1..=width).map(|at| format!("{name}_{at}")).collect(),
    }
}

impl Set {
    /// The dataset as rows; none of what has no rows of numbers.
    fn of(dataset: Dataset, group: &Group) -> Result<Option<Self>, Error> {
        let shape = dataset.shape().to_vec();
        let longest = (0..shape.len()).max_by_key(|axis| (shape[*axis], usize::MAX - axis));
        let Some(axis) = longest.filter(|axis| shape[*axis] >= FEWEST) else {
            return Ok(None);
        };
        let name = dataset.name().to_owned();
        let others = (0..shape.len()).filter(|other| *other != axis && shape[*other] != 1);
        let widths: Vec<u64> = others.map(|other| shape[other]).collect();
        let is_record = matches!(dataset.dtype(), Datatype::Compound { .. });
        if !is_record && !is_number(dataset.dtype()) {
            return Ok(None);
        }
        let width = match (&widths[..], is_record) {
            ([], _) => 1,
            ([width], false) if *width <= WIDEST => *width as usize,
            _ if crate::mat::quantity(&name).is_some() => {
                return Err(Error::refused(format!(
                    "the dataset {} has {shape:?} numbers, and only rows of columns are read",
                    name.escape_default()
                )));
            }
            _ => return Ok(None),
        };
        let unit = attribute(&dataset, &["units", "unit", "Units", "Unit"]);
        let given = column_names(&dataset, group, width);
        let names = match dataset.dtype() {
            Datatype::Compound { fields, .. } => Some(
                fields
                    .iter()
                    .flat_map(|field| axes(&field.name, width_of(&field.datatype)))
                    .collect(),
            ),
            _ => given.or_else(|| matches!(width, 1 | 3).then(|| axes(&name, width))),
        };
        let names: Option<Vec<String>> = names.map(|names: Vec<String>| {
            let with = |name: &String| rows::with_unit(name, unit.as_deref());
            names.iter().map(with).collect()
        });
        Ok(Some(Self {
            rows: shape[axis],
            width: names.as_ref().map_or(width, Vec::len),
            axis,
            names,
            name,
            dataset,
        }))
    }

    /// True for records and for matrices whose columns are not one sensor's.
    fn stands_alone(&self) -> bool {
        let is_record = matches!(self.dataset.dtype(), Datatype::Compound { .. });
        is_record || !matches!(self.width, 1 | 3)
    }

    /// Rows that are read at a time.
    fn block(&self) -> u64 {
        let chunk = self.dataset.chunks();
        let chunk = chunk.and_then(|dims| dims.get(self.axis).copied());
        chunk.map_or(ROWS, u64::from).max(ROWS)
    }

    /// The cells of the rows from `start` on, row after row.
    fn cells(&self, start: u64, end: u64) -> Result<Vec<Cell>, Error> {
        let shape = self.dataset.shape();
        let selections = (0..shape.len()).map(|axis| match axis == self.axis {
            true => SliceInfoElem::Slice {
                start,
                end,
                step: 1,
            },
            false => SliceInfoElem::Slice {
                start: 0,
                end: shape[axis],
                step: 1,
            },
        });
        let selection = SliceInfo {
            selections: selections.collect(),
        };
        let read = self.dataset.read_slice::<Element>(&selection);
        let name = &self.name;
        let read = read.map_err(|error| {
            Error::refused(format!(
                "the dataset {} cannot be read: {error}",
                name.escape_default()
            ))
        })?;
        let cells: Vec<Cell> = read.into_iter().flat_map(|element| element.0).collect();
        let count = (end - start) as usize;
        if cells.len() != count * self.width {
            return Err(Error::refused(format!(
                "the dataset {} has {} numbers where {} were expected",
                name.escape_default(),
                cells.len(),
                count * self.width
            )));
        }
        // Of MATLAB, which writes column after column.
        let is_turned = (0..self.axis).any(|axis| shape[axis] != 1);
        Ok(match is_turned {
            true => (0..cells.len())
                .map(|at| cells[at % self.width * count + at / self.width].clone())
                .collect(),
            false => cells,
        })
    }
}

/// Names of columns that stand beside a matrix: in an attribute, or as pandas keeps them, in `block0_items` of
/// `block0_values`.
fn column_names(dataset: &Dataset, group: &Group, width: usize) -> Option<Vec<String>> {
    let attributes = ["columns", "column_names", "names", "labels"];
    let given = attributes
        .iter()
        .find_map(|name| dataset.attribute(name).ok()?.read_strings().ok());
    let names = given.or_else(|| {
        let stem = dataset.name().strip_suffix("_values")?;
        let items = group.dataset(&format!("{stem}_items")).ok()?;
        items.read_strings().ok()
    });
    names.filter(|names| names.len() == width)
}

/// Numbers in a field of a record.
fn width_of(datatype: &Datatype) -> usize {
    match datatype {
        Datatype::Array { dims, .. } => dims
            .iter()
            .product::<u64>()
            .try_into()
            .unwrap_or(usize::MAX)
            .min(WIDEST as usize),
        _ => 1,
    }
}

impl Table {
    fn write(&self, out: &mut dyn Write) -> Result<(), Error> {
        let names: Option<Vec<&Vec<String>>> =
            self.sets.iter().map(|set| set.names.as_ref()).collect();
        if let Some(names) = names {
            let names: Vec<String> = names.into_iter().flatten().cloned().collect();
            out.write_all(rows::header(&names).as_bytes())?;
        }
        let rows = self.sets.first().map_or(0, |set| set.rows);
        let block = self.sets.iter().map(Set::block).max().unwrap_or(ROWS);
        let mut line = String::new();
        let mut start = 0;
        while start < rows {
            let end = rows.min(start.saturating_add(block));
            let mut cells = Vec::new();
            for set in &self.sets {
                cells.push((set.width, set.cells(start, end)?));
            }
            for row in 0..(end - start) as usize {
                line.clear();
                for (width, cells) in &cells {
                    for cell in cells.iter().skip(row * width).take(*width) {
                        line.push_str(if line.is_empty() { "" } else { "," });
                        cell.write(&mut line);
                    }
                }
                line.push('\n');
                out.write_all(line.as_bytes())?;
            }
            start = end;
        }
        Ok(())
    }
}

/// What an element of a dataset holds: a number, or those of a record.
#[derive(Clone, Debug)]
struct Element(Vec<Cell>);

impl H5Type for Element {
    fn hdf5_type() -> Datatype {
        f64::hdf5_type()
    }

    fn from_bytes(bytes: &[u8], datatype: &Datatype) -> Result<Self, Hdf5Error> {
        let mut cells = Vec::with_capacity(1);
        add_cells(bytes, datatype, &mut cells)?;
        Ok(Self(cells))
    }

    fn element_size(datatype: &Datatype) -> usize {
        dtype_element_size(datatype).unwrap_or(1)
    }
}

/// Adds what `bytes` hold.
fn add_cells(bytes: &[u8], datatype: &Datatype, cells: &mut Vec<Cell>) -> Result<(), Hdf5Error> {
    let unread = |what: &dyn fmt::Debug| {
        Hdf5Error::InvalidData(format!("numbers of a type that is not read: {what:?}"))
    };
    match datatype {
        Datatype::Compound { fields, .. } => {
            for field in fields {
                let at = field.byte_offset as usize;
                let rest = bytes.get(at..).unwrap_or_default();
                add_cells(rest, &field.datatype, cells)?;
            }
        }
        Datatype::Array { base, .. } => {
            let size = dtype_element_size(base)?;
            for at in 0..width_of(datatype) {
                let rest = bytes.get(at * size..).unwrap_or_default();
                add_cells(rest, base, cells)?;
            }
        }
        Datatype::Enum { base, .. } => add_cells(bytes, base, cells)?,
        Datatype::FixedPoint {
            size,
            signed,
            byte_order,
        } => {
            let mut wide = [0; 8];
            let size = usize::from(*size);
            let digits = bytes.get(..size).filter(|_| size <= 8);
            let digits = digits.ok_or_else(|| unread(datatype))?;
            for (to, from) in wide.iter_mut().zip(ordered(digits, *byte_order)) {
                *to = from;
            }
            // The sign of the shorter number goes on to the left.
            let unused = 8 * (8 - size.max(1)) as u32;
            let number = u64::from_le_bytes(wide);
            cells.push(match (signed, i64::try_from(number)) {
                (true, _) => Cell::Whole((number << unused) as i64 >> unused),
                (false, Ok(number)) => Cell::Whole(number),
                (false, Err(_)) => Cell::Unsigned(number),
            });
        }
        Datatype::FloatingPoint { size, byte_order } => {
            let digits = bytes.get(..usize::from(*size));
            let digits: Vec<u8> =
                ordered(digits.ok_or_else(|| unread(datatype))?, *byte_order).collect();
            cells.push(match (digits.first_chunk(), digits.first_chunk(), size) {
                (Some(digits), _, 4) => Cell::Single(f32::from_le_bytes(*digits)),
                (_, Some(digits), 8) => Cell::Double(f64::from_le_bytes(*digits)),
                _ => return Err(unread(datatype)),
            });
        }
        // Words beside numbers in a record.
        _ => cells.push(Cell::Text("text".to_owned())),
    }
    Ok(())
}

/// Bytes of a number, least first.
fn ordered(bytes: &[u8], order: ByteOrder) -> impl Iterator<Item = u8> + '_ {
    let last = bytes.len().saturating_sub(1);
    (0..bytes.len()).map(move |at| match order {
        ByteOrder::LittleEndian => bytes[at],
        ByteOrder::BigEndian => bytes[last - at],
    })
}
