//! Search for the datasets of a file that make tables.

use findings::{Finding, Findings, Kind};
use std::collections::BTreeMap;
use std::io::Write;

use hdf5_reader::Hdf5File;
use hdf5_reader::dataset::Dataset;
use hdf5_reader::group::Group;

use super::super::rows;
use super::bounds::damaged;
use super::set::{Set, attribute};
use crate::shown::shown;
use crate::{Error, Limits};

/// Groups within groups that are looked into.
const DEPTH: usize = 8;
/// Cells read at a time, however large the chunks are: a cell takes a hundred bytes.
const CELLS: u64 = 1 << 20;

/// Datasets of one length.
pub(super) struct Table {
    pub name: String,
    sets: Vec<Set>,
}

impl Table {
    /// Rows times columns.
    fn cells(&self) -> u64 {
        let cells = |set: &Set| set.rows.saturating_mul(set.width as u64);
        self.sets.iter().map(cells).fold(0, u64::saturating_add)
    }

    /// Writes it as comma-separated text.
    pub fn write(&self, out: &mut dyn Write) -> Result<(), Error> {
        let names: Option<Vec<&Vec<String>>> =
            self.sets.iter().map(|set| set.names.as_ref()).collect();
        if let Some(names) = names {
            let names: Vec<String> = names.into_iter().flatten().cloned().collect();
            out.write_all(rows::header(&names).as_bytes())?;
        }
        let rows = self.sets.first().map_or(0, |set| set.rows);
        let width = self.sets.iter().map(|set| set.width as u64).sum::<u64>();
        let block = self.sets.iter().map(Set::block).max().unwrap_or(1);
        let block = block.min(CELLS / width.max(1)).max(1);
        let mut line = String::new();
        let mut start = 0;
        while start < rows {
            let end = rows.min(start.saturating_add(block));
            let mut cells = Vec::new();
            for set in &self.sets {
                cells.push((set.width, set.cells(start, end)?));
            }
            for row in 0..(end - start) as usize {
                let of_row = cells.iter();
                let of_row =
                    of_row.flat_map(|(width, cells)| cells.iter().skip(row * width).take(*width));
                rows::write(out, &mut line, of_row)?;
            }
            start = end;
        }
        Ok(())
    }
}

/// Tables and other datasets found in a file.
#[derive(Default)]
pub(super) struct Found {
    pub tables: Vec<Table>,
    others: Vec<String>,
    pub warnings: Findings,
    seen: usize,
}

impl Found {
    /// Looks into a file of `length` bytes.
    pub fn look(&mut self, file: &Hdf5File, length: u64, limits: Limits) -> Result<(), Error> {
        let root = file.root_group().map_err(damaged)?;
        self.group(&root, "", 0, limits)?;
        let tables = self.tables.iter();
        let cells = tables.map(|table| table.cells());
        let cells = cells.fold(0, u64::saturating_add);
        rows::check_cells(cells, 1, length, limits)
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
            let found = Finding::of(Kind::ENTRIES_TOO_MANY).count("limit", limits.entries);
            return Err(Error::refused(
                found.detail("things", "groups and datasets"),
            ));
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
    pub fn listed(&self) -> String {
        let names: Vec<String> = self
            .others
            .iter()
            .take(12)
            .map(|name| shown(name))
            .collect();
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
fn is_object(dataset: &Dataset, name: &str, warnings: &mut Findings) -> Result<bool, Error> {
    const PLAIN: [&str; 6] = ["double", "single", "logical", "char", "cell", "struct"];
    let Some(class) = attribute(dataset, &["MATLAB_class"]) else {
        return Ok(false);
    };
    if PLAIN.contains(&class.as_str()) || class.contains("int") {
        return Ok(class == "char" || class == "cell");
    }
    match crate::mat::quantity(name) {
        Some(_) => {
            let found = Finding::of(Kind::OBJECT_NOT_READ).detail("variable", shown(name));
            Err(Error::refused(found.detail("class", shown(&class))))
        }
        None => {
            warnings.push(
                Finding::of(Kind::VARIABLE_NOT_READ)
                    .detail("variable", shown(name))
                    .detail("class", shown(&class)),
            );
            Ok(true)
        }
    }
}
