//! Tables in which a row has the number of one axis, and its other cells are blank: `1700000000001,0.1,,` and `1700000000002,,0.2,`.

use sensor::Sensor;

use super::gathered::{Gather, parts_of};
use super::places::may_be_row;
use super::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{role_of, stated_unit, take_apart};
use crate::recording::options::Role;
use crate::rows::parts::Part;

/// Rows of one axis each.
pub(crate) static AXIS_ROWS: TextFormat = TextFormat {
    name: "axis_rows",
    about: "a table with a row for each axis, whose other cells are blank, as Science Journal exports it",
    parts,
};

findings::tuning! {
    /// Rows that show it.
    FEWEST: usize = 12;
}

/// The columns of the time and of a sensor's axes.
#[derive(Clone, Copy, Debug)]
struct Columns {
    time: usize,
    axes: [usize; 3],
}

impl Columns {
    fn of(header: &[String], sensor: Sensor) -> Option<Self> {
        let at = |role: Role| {
            header
                .iter()
                .position(|name| role_of(name, None) == Some(role))
        };
        let axis = |axis| at(Role::axis(sensor, axis));
        Some(Self {
            time: at(Role::Time)?,
            axes: [axis(0)?, axis(1)?, axis(2)?],
        })
    }

    /// The axis that a row has the number of.
    fn axis(&self, cells: &[String]) -> Option<usize> {
        let has = |axis: &usize| {
            cells
                .get(self.axes[*axis])
                .is_some_and(|cell| !cell.is_empty())
        };
        let mut found = (0..3).filter(has);
        found.next().filter(|_| found.next().is_none())
    }
}

/// The numbers since the last row of all axes, and the time of the first.
struct Gathered {
    columns: Columns,
    time: String,
    axes: [Option<String>; 3],
}

impl Gather for Gathered {
    fn below(header: &[String], sensor: Sensor) -> Option<Self> {
        Some(Self {
            columns: Columns::of(header, sensor)?,
            time: String::new(),
            axes: Default::default(),
        })
    }

    fn next(&mut self, cells: &[String]) -> Option<String> {
        let axis = self.columns.axis(cells)?;
        // An axis that comes again before the others: one of them was lost.
        if self.axes.iter().all(Option::is_none) || self.axes[axis].is_some() {
            self.time.clone_from(cells.get(self.columns.time)?);
            self.axes = Default::default();
        }
        self.axes[axis] = cells.get(self.columns.axes[axis]).cloned();
        let [Some(x), Some(y), Some(z)] = &self.axes else {
            return None;
        };
        // Another separator than commas, which may be decimal marks.
        let row = format!("{};{x};{y};{z}", self.time);
        self.axes = Default::default();
        Some(row)
    }
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut lines = look.far_lines().filter(|line| may_be_row(line)).map(cells);
    let header = lines.next()?;
    let rows: Vec<Vec<String>> = lines.collect();
    let whole = &rows[..rows.len().saturating_sub(1)];
    let of = |sensor: Sensor| Columns::of(&header, sensor);
    let known: Vec<Columns> = Sensor::ALL.into_iter().filter_map(of).collect();
    // Every row is of one axis of one sensor.
    let is_of_one = |row: &Vec<String>| {
        let has = |columns: &&Columns| {
            let cell = |at: &usize| row.get(*at).is_some_and(|cell| !cell.is_empty());
            columns.axes.iter().any(cell)
        };
        let mut found = known.iter().filter(has);
        let one = found
            .next()
            .is_some_and(|columns| columns.axis(row).is_some());
        row.len() == header.len() && one && found.next().is_none()
    };
    if whole.len() < FEWEST.get() || !whole.iter().all(is_of_one) {
        return None;
    }
    let has = |sensor: Sensor| {
        let columns = of(sensor);
        columns.is_some_and(|columns| whole.iter().any(|row| columns.axis(row).is_some()))
    };
    let unit = |sensor: Sensor| take_apart(&header[of(sensor)?.axes[0]]).1;
    parts_of::<Gathered>(has, stated_unit(&header[known.first()?.time]), unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn rows_of_one_axis_each_are_put_together() {
        let rows = |k: usize| format!("{k}0,1,,\n{k}1,,2,\n{k}2,,,3\n");
        let text = (1..9).fold("timestamp,AccX,AccY,AccZ\n".to_owned(), |text, k| {
            text + &rows(k)
        });
        let parts = parts(&Look::at(text.as_bytes())).unwrap();
        assert_eq!(parts.len(), 1);
        let read = |text: &str| -> Vec<String> {
            let text = changed_by(parts[0].change.unwrap(), text);
            let rows = text.lines().filter(|line| !line.is_empty());
            rows.map(str::to_owned).collect()
        };
        assert_eq!(read(&text)[..2], ["10;1;2;3", "20;1;2;3"]);
        assert_eq!(read(&text).len(), 8);
        // A row that was lost.
        assert_eq!(read(&text.replace("21,,2,\n", "")).len(), 7);
    }

    #[test]
    fn tables_with_whole_rows_are_left_alone() {
        for rows in ["1,2,3,4\n", "1,2,,\n1,2,3,4\n", "1,,,\n"] {
            let text = "t,ax,ay,az\n".to_owned() + &rows.repeat(20);
            assert!(parts(&Look::at(text.as_bytes())).is_none(), "{rows}");
        }
    }
}
