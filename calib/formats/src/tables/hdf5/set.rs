//! One dataset as rows of columns.

use findings::{Finding, Kind};
use hdf5_reader::Datatype;
use hdf5_reader::dataset::{Dataset, SliceInfo, SliceInfoElem};
use hdf5_reader::group::Group;

use super::super::rows::{self, Cell};
use super::bounds::{FEWEST, WIDEST};
use super::element::{Element, numbers_in, width_of};
use crate::Error;
use crate::error::unreadable;
use crate::shown::shown;

/// Rows read at a time, more where a chunk holds more.
const ROWS: u64 = 4096;
/// More numbers in a record are none of readings.
const FIELDS: u64 = 1024;

/// A dataset of rows.
pub(super) struct Set {
    dataset: Dataset,
    pub name: String,
    pub rows: u64,
    pub width: usize,
    /// Index of the dimension that counts the rows.
    axis: usize,
    /// Names of its columns, where they have some.
    pub names: Option<Vec<String>>,
}

impl Set {
    /// The dataset as rows; none of what has no rows of numbers.
    pub fn of(dataset: Dataset, group: &Group) -> Result<Option<Self>, Error> {
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
            ([], true) if numbers_in(dataset.dtype()) > FIELDS => return Ok(None),
            ([], _) => 1,
            ([width], false) if *width <= WIDEST => *width as usize,
            _ if crate::mat::quantity(&name).is_some() => {
                let found = Finding::of(Kind::DATASET_SHAPE).detail("dataset", shown(&name));
                return Err(Error::refused(found.detail("shape", format!("{shape:?}"))));
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
    pub fn stands_alone(&self) -> bool {
        let is_record = matches!(self.dataset.dtype(), Datatype::Compound { .. });
        is_record || !matches!(self.width, 1 | 3)
    }

    /// Rows that are read at a time.
    pub fn block(&self) -> u64 {
        let chunk = self.dataset.chunks();
        let chunk = chunk.and_then(|dims| dims.get(self.axis).copied());
        chunk.map_or(ROWS, u64::from).max(ROWS)
    }

    /// The cells of the rows from `start` on, row after row.
    pub fn cells(&self, start: u64, end: u64) -> Result<Vec<Cell>, Error> {
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
        let read = read.map_err(|error| unreadable(format!("dataset {}", shown(name)), &error))?;
        let cells: Vec<Cell> = read.into_iter().flat_map(|element| element.0).collect();
        let count = (end - start) as usize;
        if cells.len() != count * self.width {
            let found = Finding::of(Kind::DATASET_LENGTH).detail("dataset", shown(name));
            let found = found.count("count", cells.len());
            return Err(Error::refused(found.count("expected", count * self.width)));
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

/// Names of three axes, or numbers.
fn axes(name: &str, width: usize) -> Vec<String> {
    match width {
        1 => vec![name.to_owned()],
        3 => ["x", "y", "z"].map(|axis| format!("{name}_{axis}")).into(),
        _ => (1..=width).map(|at| format!("{name}_{at}")).collect(),
    }
}

/// True for numbers that are read.
fn is_number(datatype: &Datatype) -> bool {
    match datatype {
        Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. } => true,
        Datatype::Enum { base, .. } => is_number(base),
        _ => false,
    }
}

/// The text of the first attribute there is.
pub(super) fn attribute(dataset: &Dataset, names: &[&str]) -> Option<String> {
    let read = |name: &&str| dataset.attribute(name).ok()?.read_string().ok();
    names.iter().find_map(read)
}

/// Names of columns that stand beside a matrix: in an attribute, or as pandas keeps them, in `block0_items` of
/// `block0_values`.
fn column_names(dataset: &Dataset, group: &Group, width: usize) -> Option<Vec<String>> {
    let attributes = ["columns", "column_names", "names", "labels"];
    let given = attributes.iter().find_map(|name| {
        let given = dataset.attribute(name).ok()?;
        let is_row = given.num_elements().ok()? <= WIDEST;
        is_row.then(|| given.read_strings().ok())?
    });
    let names = given.or_else(|| {
        let stem = dataset.name().strip_suffix("_values")?;
        let items = group.dataset(&format!("{stem}_items")).ok()?;
        let is_row = items.num_elements().ok()? == width as u64;
        is_row.then(|| items.read_strings().ok())?
    });
    names.filter(|names| names.len() == width)
}
