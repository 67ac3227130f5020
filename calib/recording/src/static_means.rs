//! Tables of static means: `ax,ay,az` of every placement, with or without these names above them.

use std::path::Path;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::Error;
use crate::header::dialect::Dialect;
use crate::header::names::role_of;
use crate::header::preface::{cells, is_comment, is_row, words};
use crate::recording::Role;
use crate::rows::number::{self, Dialects};
use crate::shown::{shown_cell, shown_list, shown_path};
use crate::source::place::{at_column, at_line};
use crate::text_file::read_text;

/// Reads the accelerometer's columns of a table of static means: separated by commas, semicolons, tabs or blanks; by
/// their names, or three columns without any.
///
/// # Errors
/// An unreadable table or a cell that is no number; the message names file, line and column.
pub fn read_static_means(path: &Path) -> Result<Vec<Vector3<f64>>, Error> {
    means(&shown_path(path), &read_text(path)?)
}

fn means(name: &str, text: &str) -> Result<Vec<Vector3<f64>>, Error> {
    let text = text.trim_start_matches('\u{feff}');
    let lines = (1..).zip(text.split('\n').map(|line| line.trim_end_matches('\r')));
    let is_blank = |line: &str| line.trim().is_empty();
    let lines = lines.filter(|(_, line)| !is_blank(line) && !is_comment(line.as_bytes()));
    let lines: Vec<(u64, &str)> = lines.collect();
    let bytes: Vec<&[u8]> = lines.iter().map(|(_, line)| line.as_bytes()).collect();
    let dialect = Dialect::of(&bytes);
    let Some(&(first, header)) = lines.first() else {
        return Err(at_line(name, 1, Finding::of(Kind::NO_STATIC_MEANS)));
    };
    let named = !is_row(header.as_bytes(), dialect);
    let columns = match named {
        true => by_names(&words(header.as_bytes(), dialect)),
        false => by_order(cells(header.as_bytes(), dialect).len()),
    };
    let columns = columns.map_err(|found| at_line(name, first, *found))?;
    let rows = &lines[usize::from(named)..];
    if rows.is_empty() {
        return Err(at_line(
            name,
            first,
            Finding::of(Kind::NO_STATIC_MEANS).detail("found", "header"),
        ));
    }
    let mean = |(line, text): &(u64, &str)| mean(name, *line, text, dialect, columns);
    rows.iter().map(mean).collect()
}

fn by_names(names: &[String]) -> Result<[usize; 3], Box<Finding>> {
    let find = |axis: usize| {
        let is_it =
            |name: &String| role_of(name, Some(Sensor::Accelerometer)) == Some(Role::Accel(axis));
        names.iter().position(is_it)
    };
    match [find(0), find(1), find(2)] {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(Finding::of(Kind::STATIC_MEANS_COLUMNS)
            .detail("columns", shown_list(names.iter()))
            .into()),
    }
}

fn by_order(width: usize) -> Result<[usize; 3], Box<Finding>> {
    match width {
        3 => Ok([0, 1, 2]),
        _ => Err(Finding::of(Kind::STATIC_MEANS_WIDTH)
            .count("width", width)
            .into()),
    }
}

fn mean(
    name: &str,
    line: u64,
    text: &str,
    dialect: Dialect,
    columns: [usize; 3],
) -> Result<Vector3<f64>, Error> {
    let cells = cells(text.as_bytes(), dialect);
    let mut mean = Vector3::zeros();
    for (axis, column) in columns.into_iter().enumerate() {
        let Some(cell) = cells.get(column).cloned() else {
            let short = Finding::of(Kind::ROW_SHORT)
                .count("found", cells.len())
                .count("column", column + 1);
            return Err(at_line(name, line, short));
        };
        let content = &text.as_bytes()[cell.clone()];
        let read = number::parse(content, dialect.decimal_comma, &mut Dialects::default());
        mean[axis] = read.map_err(|_| {
            let found = Finding::of(Kind::NUMBER_EXPECTED)
                .detail("cell", shown_cell(content))
                .count("column", column + 1);
            at_column(name, line, cell.start + 1, found)
        })?;
    }
    Ok(mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_separator_with_or_without_names_gives_the_same_means() {
        let expected = [Vector3::new(0.5, -0.25, 9.5), Vector3::new(9.75, 0.0, 1.0)];
        for text in [
            "ax,ay,az\n0.5,-0.25,9.5\n9.75,0,1\n",
            "# by hand\n0.5,-0.25,9.5\r\n9.75,0,1\r\n",
            "ax\tay\taz\n0.5\t-0.25\t9.5\n9.75\t0\t1\n",
            "0.5\t-0.25\t9.5\n9.75\t0\t1\n",
            "ax;ay;az\n0.5;-0.25;9.5\n9.75;0;1\n",
            "ax;ay;az\n0,5;-0,25;9,5\n9,75;0;1\n",
            "\u{feff}0.5 -0.25 9.5\n9.75 0 1",
            "  0.5   -0.25   9.5\n  9.75  0  1\n",
            "place,acc_x (m/s^2),acc_y (m/s^2),acc_z (m/s^2)\n1,0.5,-0.25,9.5\n2,9.75,0,1\n",
            "\"x\",\"y\",\"z\"\n\"0.5\",\"-0.25\",\"9.5\"\n9.75,0,1\n",
            "z, y, x\n9.5, -0.25, 0.5\n1, 0, 9.75\n",
        ] {
            assert_eq!(means("m.csv", text).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn what_is_no_table_of_means_is_refused_with_its_place() {
        for (text, words) in [
            ("", "no rows of means"),
            ("ax,ay,az\n", "only a header"),
            ("t,gx,gy,gz\n1,2,3,4\n", "the columns `t`, `gx`"),
            ("1,2,3,4\n", "4 columns without a header"),
            ("ax,ay,az\n1,2,3\n1,two,3\n", "m.csv:3:3: `two` in column 2"),
            ("ax,ay,az\n1,2,3\n1,nan,3\n", "m.csv:3:3: `nan` in column 2"),
            ("ax,ay,az\n1,2,3\n1,2\n", "m.csv:3: this row has 2 cells"),
        ] {
            let refused = means("m.csv", text).unwrap_err().to_string();
            assert!(refused.contains(words), "{text:?}: {refused}");
        }
    }
}
