//! Tables with a time before every column, each sensor with as many rows as it has readings: `X[s],ACC.X,X[s],ACC.Y,..`.

use sensor::Sensor;

use super::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{is_like_time, role_of};
use crate::recording::options::Role;
use crate::rows::parts::Part;

/// A table whose channels have their own rates side by side, as Delsys writes it.
pub(crate) static PER_AXIS: TextFormat = TextFormat {
    name: "per_axis",
    about: "a table with a time before every channel: `X[s],ACC.X,X[s],ACC.Y,..,X[s],GYRO.X,..`",
    parts,
};

findings::tuning! {
    /// Rows that show that the three times of a sensor are one.
    FEWEST: usize = 3;
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let has_axes = |names: &[String]| {
        let axes = names.iter().filter(|name| axis_of(name).is_some());
        names.len() >= 6 && axes.count() >= 3
    };
    let names = look.header(has_axes)?;
    let parts: Vec<Part> = [Sensor::Accelerometer, Sensor::Gyroscope]
        .into_iter()
        .map(|sensor| part(look, &names, sensor))
        .collect::<Option<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect();
    (!parts.is_empty()).then_some(parts)
}

fn axis_of(name: &str) -> Option<Role> {
    role_of(name, None).filter(|role| role.sensor().is_some())
}

/// The separator of the names; of the rows it may not be the most frequent, as their decimal marks may be commas.
fn separator(look: &Look, names: &[String]) -> Option<char> {
    let header = look.far_lines().find(|line| cells(line) == names)?;
    let splits = |separator: &char| header.split(*separator).count() == names.len();
    ['\t', ';', ','].into_iter().find(splits)
}

/// The part of a sensor; no part where it has no columns, and `None` where they are not as this format's.
fn part(look: &Look, names: &[String], sensor: Sensor) -> Option<Option<Part>> {
    let of = |axis: usize| {
        let wanted = Some(Role::axis(sensor, axis));
        let mut found = (0..names.len()).filter(|&at| axis_of(&names[at]) == wanted);
        // Of two sensors of a kind the user says which.
        (found.next(), found.next())
    };
    let columns = match [0, 1, 2].map(of) {
        [(None, _), (None, _), (None, _)] => return Some(None),
        [(Some(x), None), (Some(y), None), (Some(z), None)] => [x, y, z],
        _ => return None,
    };
    let times = columns.map(|at| at.checked_sub(1));
    let [Some(x), Some(y), Some(z)] = times else {
        return None;
    };
    let is_time = |at: usize| {
        // Each may be called after its channel.
        let name = &names[at];
        role_of(name, None) == Some(Role::Time) || is_like_time(name)
    };
    if ![x, y, z].into_iter().all(is_time) {
        return None;
    }
    let separator = separator(look, names)?;
    let split = |line: &str| -> Vec<String> {
        let cells = line
            .split(separator)
            .map(|cell| cell.trim().trim_matches('"').to_owned());
        cells.collect()
    };
    let rows: Vec<Vec<String>> = look
        .far_lines()
        .map(split)
        .filter(|row| row.len() == names.len() && row[x].starts_with(|c: char| c.is_ascii_digit()))
        .collect();
    let is_one = |row: &Vec<String>| row[x] == row[y] && row[y] == row[z];
    if rows.len() < FEWEST.get() || !rows.iter().all(is_one) {
        return None;
    }
    let [ax, ay, az] = columns;
    let columns = [x, ax, ay, az].map(|at| (at + 1).to_string());
    Some(Some(Part {
        padded: true,
        ..Part::of(sensor, columns.each_ref().map(String::as_str))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(header: &str, row: &str) -> Option<Vec<Vec<String>>> {
        let text = format!("{header}\n{}", format!("{row}\n").repeat(3));
        let parts = parts(&Look::at(text.as_bytes()))?;
        let called = |part: &Part| part.columns.iter().map(|(_, at)| at.clone()).collect();
        Some(parts.iter().map(called).collect())
    }

    #[test]
    fn the_times_of_the_three_axes_are_one_where_their_stamps_are() {
        let header = "X[s],Avanti sensor 1: EMG 1,X[s],Avanti sensor 1: ACC.X 1,X[s],Avanti sensor 1: ACC.Y 1,X[s],Avanti sensor 1: ACC.Z 1";
        let expected = vec![["3", "4", "6", "8"].map(str::to_owned).to_vec()];
        assert_eq!(columns(header, "0,1,0.5,1,0.5,2,0.5,3"), Some(expected));
        assert_eq!(columns(header, "0,1,0.5,1,0.6,2,0.5,3"), None);
        let called = "ACC X Time Series (s),ACC X (G),ACC Y Time Series (s),ACC Y (G),ACC Z Time Series (s),ACC Z (G)";
        let expected = vec![["1", "2", "4", "6"].map(str::to_owned).to_vec()];
        assert_eq!(columns(called, "0,1,0,2,0,3"), Some(expected));
        let german = columns(&header.replace(',', ";"), "0;1;0,5;1,5;0,5;2,5;0,5;3,5");
        assert_eq!(german.map(|parts| parts.len()), Some(1));
        let header = "t,ax,t,ay,t,az,t,gx,t,gy,t,gz";
        let row = "0,1,0,2,0,3,0.1,4,0.1,5,0.1,6";
        let sensors = columns(header, row).unwrap();
        assert_eq!(sensors[1], ["7", "8", "10", "12"]);
        assert_eq!(columns("t,ax,ay,az,gx,gy,gz", "0,1,2,3,4,5,6"), None);
    }
}
