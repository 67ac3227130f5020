//! Tables whose names are in two rows: `,acc,acc,acc,gyro,..` above `time,x,y,z,x,..`, as pandas and spreadsheets with merged
//! cells write them.

use std::io::Read;

use super::places::{may_be_row, words};
use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::role_of;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units;

/// A table with the sensors in one row and their axes in the next.
pub(crate) static TWO_HEADERS: TextFormat = TextFormat {
    name: "two_headers",
    about: "a table whose names are in two rows: sensors above, axes below",
    parts,
};

findings::tuning! {
    /// Rows of names: sensors, axes, and the name of the index below them.
    MOST: usize = 3;
}

/// True for a line with a number in more than half of its cells.
fn is_row(line: &str) -> bool {
    let cells = words(line);
    let is_number = |cell: &&&str| cell.parse::<f64>().is_ok();
    2 * cells.iter().filter(is_number).count() > cells.len()
}

fn has_time(names: &[String]) -> bool {
    let mut roles = names.iter().map(|name| role_of(name, None));
    roles.any(|role| role == Some(Role::Time))
}

/// The names of columns of a sensor and an axis, each in a row; an empty cell above goes on with the one before it.
fn joined<'a>(above: &'a str, below: &'a str) -> Vec<String> {
    let mut last: &'a str = "";
    let pairs = words(above).into_iter().zip(words(below));
    let join = |(over, under): (&'a str, &'a str)| {
        let merged = if over.is_empty() { last } else { over };
        last = merged;
        let is_axis = matches!(under, "x" | "y" | "z" | "X" | "Y" | "Z");
        match merged.find(['(', '[']) {
            _ if under.is_empty() => over.to_owned(),
            _ if !is_axis && units::is_unit(under) => format!("{over} ({under})"),
            _ if !is_axis => under.to_owned(),
            // The unit of a sensor stands behind its axis.
            Some(at) => format!("{} {under} {}", merged[..at].trim(), &merged[at..]),
            None => format!("{merged} {under}"),
        }
    };
    let mut names: Vec<String> = pairs.map(join).collect();
    // An index without a name of its own is the time, where nothing else is.
    let has_time = has_time(&names);
    if let Some(first) = names
        .first_mut()
        .filter(|first| first.is_empty() || *first == "axis")
    {
        *first = if has_time { "index" } else { "time" }.to_owned();
    }
    names
}

/// The names of two rows that name a sensor together and none alone.
fn names(above: &str, below: &str) -> Option<Vec<String>> {
    let names_a_sensor = |names: &[String]| {
        let role = |name: &String| role_of(name, None);
        let roles: Vec<Option<Role>> = names.iter().map(role).collect();
        let has =
            |sensor: fn(usize) -> Role| (0..3).all(|axis| roles.contains(&Some(sensor(axis))));
        has(Role::Accel) || has(Role::Gyro)
    };
    let own = |line: &str| {
        words(line)
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let joined = joined(above, below);
    let as_wide = words(above).len() == words(below).len();
    // Names below a time that stands above are not whole.
    let is_whole = names_a_sensor(&own(below)) && (has_time(&own(below)) || !has_time(&joined));
    let alone = names_a_sensor(&own(above)) || is_whole;
    (as_wide && !alone && names_a_sensor(&joined)).then_some(joined)
}

/// True for the row below the names that names the index alone: `time,,,`.
fn is_of_index(line: &str) -> bool {
    let cells = words(line);
    cells.len() > 1 && !cells[0].is_empty() && cells[1..].iter().all(|cell| cell.is_empty())
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let lines: Vec<&str> = look
        .lines()
        .filter(|line| may_be_row(line))
        .take(MOST.get())
        .collect();
    let [above, below, ..] = lines[..] else {
        return None;
    };
    names(above, below)?;
    let part = Part {
        change: Some(change),
        ..Part::default()
    };
    (!is_row(above) && !is_row(below)).then(|| vec![part])
}

/// The text with its names in the second row.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut above: Option<String> = None;
    let mut lines = 0;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if lines == MOST.get() || !may_be_row(text) {
            return out.extend_from_slice(line);
        }
        lines += 1;
        let Some(first) = &above else {
            above = Some(text.to_owned());
            return;
        };
        if lines == MOST.get() {
            if !is_of_index(text) {
                out.extend_from_slice(line);
            }
            return;
        }
        let separator = [',', ';', '\t']
            .into_iter()
            .max_by_key(|c| text.matches(*c).count());
        let names = names(first, text).unwrap_or_default();
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        out.extend_from_slice(
            quoted
                .join(&separator.unwrap_or(',').to_string())
                .as_bytes(),
        );
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn names_in_two_rows_are_one() {
        for (text, expected) in [
            (
                ",acc,acc,acc\n,x,y,z\n0,1,2,3\n",
                "\n\"time\",\"acc x\",\"acc y\",\"acc z\"\n0,1,2,3\n",
            ),
            (
                "sensor,acc,,\naxis,x,y,z\ntime,,,\n0,1,2,3\n",
                "\n\"time\",\"acc x\",\"acc y\",\"acc z\"\n\n0,1,2,3\n",
            ),
            (
                "Zeit;Gyro (deg/s);;\nms;X;Y;Z\n0;1,5;2;3\n",
                "\n\"Zeit (ms)\";\"Gyro X (deg/s)\";\"Gyro Y (deg/s)\";\"Gyro Z (deg/s)\"\n0;1,5;2;3\n",
            ),
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_some(), "{text}");
            assert_eq!(changed_by(change, text), expected);
        }
    }

    #[test]
    fn a_row_that_names_a_sensor_alone_is_left_alone() {
        for text in [
            "t,ax,ay,az\ns,g,g,g\n0,1,2,3\n",
            "Sensor,x,y,z\nt,ax,ay,az\n0,1,2,3\n",
            "a,b\nc,d\n1,2\n",
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_none(), "{text}");
        }
    }
}
