//! The cells of the columns that may say which device a row is of, kept while the rows are read.

pub(crate) use super::names::Class;
use crate::header::Layout;
use crate::header::by_map::roles_by_map;
use crate::header::dialect::{Cell, Dialect};
use crate::header::preface::{Kept, cells};
use crate::recording::line_numbers::LineNumbers;
use crate::recording::options::{ReadOptions, Role};

/// The name of a device that takes the rows for those of one.
pub(crate) const ALL: &str = "all";

findings::tuning! {
    /// Columns that are looked at.
    COLUMNS: usize = 8;
    /// Nobody reads more devices into one table.
    MOST: usize = 64;
}

/// The columns that may say which device a row is of.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Labels {
    /// The columns.
    pub columns: Vec<Labelled>,
    /// The line of every row.
    lines: LineNumbers,
    rows: usize,
}

/// A column with few values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Labelled {
    /// Index of the column.
    pub at: usize,
    /// Its name; empty without one.
    pub name: String,
    /// Class of its name.
    pub class: Class,
    /// Different contents of its cells.
    pub values: Vec<Vec<u8>>,
    /// Index into `values` for each row.
    pub of_rows: Vec<u8>,
}

/// The columns of `layout` that may say which device a row is of, as far as the first `rows` show.
pub(crate) fn columns(
    layout: &Layout,
    rows: &[&Kept],
    dialect: Dialect,
    options: &ReadOptions,
) -> Vec<(usize, Class)> {
    if options.device.as_deref() == Some(ALL) {
        return Vec::new();
    }
    let numbers: Vec<String> = (1..=layout.width).map(|at| at.to_string()).collect();
    let names = match layout.names.is_empty() {
        true => &numbers,
        false => &layout.names,
    };
    let named = roles_by_map(names, &options.columns).unwrap_or_default();
    if let Some((_, at)) = named.iter().find(|(role, _)| *role == Role::Device) {
        return vec![(*at, Class::Given)];
    }
    let few = |at: &usize| has_few_values(*at, rows, dialect);
    let class = |at: usize| {
        (
            at,
            Class::of(layout.names.get(at).map_or("", String::as_str)),
        )
    };
    let mut found: Vec<(usize, Class)> = (0..layout.width)
        .filter(|at| !layout.is_read(*at))
        .filter(few)
        .map(class)
        .collect();
    found.sort_by_key(|(_, class)| *class);
    found.truncate(COLUMNS.get());
    found
}

/// True for a column of few words or whole numbers.
fn has_few_values(at: usize, rows: &[&Kept], dialect: Dialect) -> bool {
    let mut values: Vec<&[u8]> = Vec::new();
    for row in rows {
        let Some(cell) = cells(&row.bytes, dialect).get(at).cloned() else {
            continue;
        };
        let value = &row.bytes[cell];
        if is_fraction(value) {
            return false;
        }
        if !values.contains(&value) {
            values.push(value);
        }
    }
    let filled = values.iter().any(|value| !value.is_empty());
    filled && values.len() <= MOST.get()
}

/// True for a number that is not whole.
fn is_fraction(cell: &[u8]) -> bool {
    let number = fast_float2::parse::<f64, _>(cell);
    number.is_ok_and(|value| !value.is_finite() || value.fract() != 0.0)
}

impl Labels {
    /// None yet of these columns.
    pub fn of(columns: &[(usize, Class)], names: &[String]) -> Self {
        let column = |&(at, class): &(usize, Class)| Labelled {
            at,
            name: names.get(at).cloned().unwrap_or_default(),
            class,
            values: Vec::new(),
            of_rows: Vec::new(),
        };
        Self {
            columns: columns.iter().map(column).collect(),
            ..Self::default()
        }
    }

    /// Adds the row on `line`; `cell` gives what stands in the k-th column that was asked for.
    pub fn push<'a>(&mut self, line: u64, cell: impl Fn(usize) -> &'a [u8]) {
        self.lines.push(self.rows, line);
        self.rows += 1;
        for (k, column) in self.columns.iter_mut().enumerate() {
            // One that has more values than there are devices is none; its rows are not counted on.
            if column.values.len() <= MOST.get() {
                column.push(cell(k));
            }
        }
    }

    /// Leaves out the columns that have too many values.
    pub fn finish(&mut self) {
        self.columns
            .retain(|column| column.values.len() <= MOST.get());
    }

    /// The row on `line`.
    pub fn row(&self, line: u64) -> usize {
        self.lines.index_at(line)
    }
}

impl Labelled {
    fn push(&mut self, cell: &[u8]) {
        let last = self.of_rows.last().map(|last| usize::from(*last));
        let is_it = |at: &usize| self.values.get(*at).is_some_and(|value| value == cell);
        let at = last.filter(is_it).or_else(|| {
            let mut values = self.values.iter();
            values.position(|value| value == cell)
        });
        let at = at.unwrap_or_else(|| {
            self.values.push(cell.to_vec());
            self.values.len() - 1
        });
        self.of_rows.push(at as u8);
    }

    /// True where the cells of value `at` are `wanted`: the same text, or the same number.
    pub fn is(&self, at: usize, wanted: &str) -> bool {
        let Some(value) = self.values.get(at) else {
            return false;
        };
        let number = |cell: &[u8]| fast_float2::parse::<f64, _>(cell).ok();
        value == wanted.trim().as_bytes()
            || number(value).is_some_and(|v| number(wanted.trim().as_bytes()) == Some(v))
    }
}

/// Returns the content of cell `at` of a line; empty if there is no such cell.
pub(crate) fn cell_of<'a>(line: &'a [u8], cells: &[Cell], at: usize) -> &'a [u8] {
    cells
        .get(at)
        .map(|cell| &line[cell.clone()])
        .unwrap_or_default()
}
