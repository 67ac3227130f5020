//! Tables with a row per number, which says its name: `0.01,ax,0.05`.

use std::collections::HashMap;

use sensor::Sensor;

use super::gathered::{Gather, parts_of};
use super::places::may_be_row;
use super::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{compact, is_field, role_of, sensor_of, stated_unit, take_apart};
use crate::recording::options::Role;
use crate::rows::parts::Part;

/// Rows of one number each.
pub(crate) static FIELDS: TextFormat = TextFormat {
    name: "fields",
    about: "a row per number, which says its name: `0.01,ax,0.05`",
    parts,
};

/// Names of the column of the numbers.
const VALUES: [&str; 7] = [
    "value", "val", "wert", "valeur", "valor", "reading", "state",
];
/// Names of the column of the time beside those of every table: that of a change of state.
const CHANGES: [&str; 2] = ["lastchanged", "lastupdated"];

findings::tuning! {
    /// Instants that wait for their other axes, where the rows are sorted by their names.
    MOST: usize = 1 << 20;
    /// Rows of names in a run on average that are sorted by them ...
    SORTED: usize = 20;
    /// ... in so many runs at most.
    RUNS: usize = 9;
    /// Numbers in a line of a table of another kind.
    WIDEST: usize = 16;
}

/// The columns of the time and of the numbers.
#[derive(Clone, Copy, Debug)]
struct Columns {
    time: usize,
    value: usize,
}

impl Columns {
    fn of(header: &[String]) -> Option<Self> {
        let is_value = |name: &String| VALUES.contains(&compact(name).as_str());
        let is_time = |name: &String| {
            role_of(name, None) == Some(Role::Time) || CHANGES.contains(&compact(name).as_str())
        };
        let found = Self {
            time: header.iter().position(is_time)?,
            value: header.iter().position(is_value)?,
        };
        let has_axis = header.iter().any(|name| axis_of(name).is_some());
        (!has_axis && header.len() <= WIDEST.get()).then_some(found)
    }
}

/// The sensor and the axis that a name calls.
fn axis_of(name: &str) -> Option<(Sensor, usize)> {
    let role = role_of(name, None)?;
    let (sensor, axis) = match role {
        Role::Accel(axis) => (Sensor::Accelerometer, axis),
        Role::Gyro(axis) => (Sensor::Gyroscope, axis),
        Role::Field(axis) => (Sensor::Magnetometer, axis),
        _ => return None,
    };
    Some((sensor, axis))
}

/// The name of a row's number: of the cell that calls an axis, or of that of the sensor and that of the axis.
fn name_of(cells: &[String]) -> Option<(Sensor, usize)> {
    let whole = cells.iter().find_map(|cell| axis_of(cell));
    let sensor = || {
        cells.iter().find_map(|cell| {
            let word = compact(cell);
            match is_field(&word) {
                true => Some(Sensor::Magnetometer),
                false => sensor_of(&word).filter(|_| word.len() > 2),
            }
        })
    };
    let axis = || {
        let letter = |cell: &String| {
            ["x", "y", "z"]
                .iter()
                .position(|a| cell.eq_ignore_ascii_case(a))
        };
        cells.iter().find_map(letter)
    };
    whole.or_else(|| Some((sensor()?, axis()?)))
}

/// The numbers of a sensor at the instants of which an axis or two are still to come.
struct Instants {
    sensor: Sensor,
    columns: Columns,
    waiting: HashMap<String, [Option<String>; 3]>,
}

impl Gather for Instants {
    fn below(header: &[String], sensor: Sensor) -> Option<Self> {
        Some(Self {
            sensor,
            columns: Columns::of(header)?,
            waiting: HashMap::new(),
        })
    }

    fn next(&mut self, cells: &[String]) -> Option<String> {
        let (time, value) = (
            cells.get(self.columns.time)?,
            cells.get(self.columns.value)?,
        );
        let (_, axis) = name_of(cells).filter(|(own, _)| *own == self.sensor)?;
        if self.waiting.len() >= MOST.get() {
            self.waiting.clear();
        }
        let device = device_of(cells, time, value);
        let key = format!("{time};{device}");
        let axes = self.waiting.entry(key.clone()).or_default();
        axes[axis] = Some(value.clone());
        let [Some(x), Some(y), Some(z)] = axes else {
            return None;
        };
        // Another separator than commas, which may be decimal marks.
        let mut row = format!("{time};{x};{y};{z}");
        if !device.is_empty() {
            row.extend([";", &device]);
        }
        self.waiting.remove(&key);
        Some(row)
    }
}

/// The other words of a row, which name the device that it is of.
fn device_of(cells: &[String], time: &str, value: &str) -> String {
    let is_word = |cell: &&String| {
        let begins = cell.starts_with(char::is_alphabetic);
        let is_other = *cell != time && *cell != value;
        let is_letter = ["x", "y", "z"].iter().any(|a| cell.eq_ignore_ascii_case(a));
        begins && is_other && !is_letter && axis_of(cell).is_none()
    };
    let is_sensor = |cell: &&String| {
        let word = compact(cell);
        is_field(&word) || sensor_of(&word).is_some()
    };
    let words: Vec<&str> = cells
        .iter()
        .filter(is_word)
        .filter(|cell| !is_sensor(cell))
        .map(String::as_str)
        .collect();
    words.join(" ")
}

/// True where all rows of one name come before those of the next, so that the beginning of a text does not show every axis.
fn are_sorted(rows: &[Vec<String>]) -> bool {
    let names = rows.iter().filter_map(|row| name_of(row));
    let names: Vec<(Sensor, usize)> = names.collect();
    let runs = names.chunk_by(|a, b| a == b).count();
    names.len() >= SORTED.get() * runs && (1..=RUNS.get()).contains(&runs)
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut lines = look.far_lines().filter(|line| may_be_row(line)).map(cells);
    let header = lines.next()?;
    let columns = Columns::of(&header)?;
    let rows: Vec<Vec<String>> = lines.collect();
    let named = rows.iter().filter(|row| name_of(row).is_some()).count();
    let has = |name: &str| header.iter().any(|own| own == name);
    let is_of_flux = has("_field") && has("_value") && has("_time");
    if 2 * named < rows.len() && !is_of_flux {
        return None;
    }
    if are_sorted(&rows) || (named == 0 && is_of_flux) {
        let is_read = |sensor: Sensor| sensor != Sensor::Magnetometer;
        let mut parts =
            parts_of::<Instants>(is_read, stated_unit(&header[columns.time]), |_| None)?;
        parts.iter_mut().for_each(|part| part.may_be_absent = true);
        return Some(parts);
    }
    let has = |sensor: Sensor| {
        let Some(mut instant) = Instants::below(&header, sensor) else {
            return false;
        };
        let whole = rows.iter().filter_map(|row| instant.next(row));
        whole.take(2).count() == 2
    };
    let unit = |sensor: Sensor| {
        let is_own = |cell: &&String| axis_of(cell).is_some_and(|(own, _)| own == sensor);
        let name = rows.iter().flatten().find(is_own)?;
        take_apart(name).1
    };
    parts_of::<Instants>(has, stated_unit(&header[columns.time]), unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn rows(text: &str) -> Option<Vec<Vec<String>>> {
        let parts = parts(&Look::at(text.as_bytes()))?;
        let rows = |part: &Part| {
            let text = changed_by(part.change.unwrap(), text);
            let rows = text.lines().filter(|line| !line.is_empty());
            rows.map(str::to_owned).collect()
        };
        Some(parts.iter().map(rows).collect())
    }

    #[test]
    fn the_numbers_of_an_instant_are_a_row_of_their_sensor() {
        let names = ["ax", "ay", "az", "gx", "gy", "gz"];
        let row = |k: usize| format!("0.0{},{},{}\n", k / 6, names[k % 6], k);
        let text = (0..12).fold("time,name,value\n".to_owned(), |text, k| text + &row(k));
        let read = rows(&text).unwrap();
        assert_eq!(read[0], ["0.00;0;1;2", "0.01;6;7;8"]);
        assert_eq!(read[1], ["0.00;3;4;5", "0.01;9;10;11"]);
        // The sensor and the axis in cells of their own, with decimal commas.
        let row = |k: usize| format!("0,0{};accel;{};{},5\n", k / 3, ["x", "y", "z"][k % 3], k);
        let text = (0..6).fold("t;sensor;axis;value\n".to_owned(), |text, k| text + &row(k));
        assert_eq!(
            rows(&text).unwrap()[0],
            ["0,00;0,5;1,5;2,5", "0,01;3,5;4,5;5,5"]
        );
    }

    #[test]
    fn rows_sorted_by_their_names_are_put_together_by_their_stamps() {
        let names = ["ax", "ay", "az", "gx", "gy", "gz"];
        let row = |at: usize, k: usize| format!("{k},{},{at}.{k}\n", names[at]);
        let rows_of = |at: usize| (0..30).map(|k| row(at, k)).collect::<String>();
        let text = "time,name,value\n".to_owned() + &(0..6).map(rows_of).collect::<String>();
        let read = rows(&text).unwrap();
        let expected: Vec<String> = (0..30).map(|k| format!("{k};3.{k};4.{k};5.{k}")).collect();
        assert_eq!((read.len(), &read[1]), (2, &expected));
    }

    #[test]
    fn axes_at_other_times_and_other_tables_are_left_alone() {
        for text in [
            "time,name,value\n1,ax,1\n2,ay,2\n3,az,3\n4,ax,4\n5,ay,5\n6,az,6\n",
            "time,ax,ay,az,value\n1,2,3,4,5\n2,2,3,4,5\n",
            "time,name,value\n1,co2,1\n2,co2,2\n",
        ] {
            assert!(rows(text).is_none(), "{text}");
        }
    }
}
