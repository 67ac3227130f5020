//! Tables with a row per reading, of which one cell says the sensor: `17000,gyroscope,0.01,0.02,0.03`.

use std::io::Read;

use sensor::Sensor;

use super::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{is_like_time, role_of, take_apart};
use crate::header::triads::{Triad, triads};
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;

/// Rows of both sensors by turns.
pub(crate) static LONG: TextFormat = TextFormat {
    name: "long",
    about: "a row per reading, which says its sensor: `17000,gyroscope,0.01,0.02,0.03`",
    parts,
};

/// Labels of each sensor's rows, in small letters and without punctuation.
const ACCEL: [&str; 5] = [
    "acc",
    "accel",
    "accelerometer",
    "acceleration",
    "androidsensoraccelerometer",
];
const GYRO: [&str; 5] = [
    "gyr",
    "gyro",
    "gyroscope",
    "angularvelocity",
    "androidsensorgyroscope",
];
const FIELD: [&str; 5] = [
    "mag",
    "magn",
    "magnetometer",
    "magneticfield",
    "androidsensormagneticfield",
];

/// The index of the first cell that is one of `labels`.
fn labelled(line: &str, labels: &[&str]) -> Option<usize> {
    let word = |cell: &String| take_apart(cell).0;
    cells(line)
        .iter()
        .position(|cell| labels.contains(&word(cell).as_str()))
}

/// Time and axes by their names, else by their order: the first four columns that are numbers.
fn columns(look: &Look, row: &str, label: usize) -> Option<[String; 4]> {
    let numbers = cells(row);
    let is_number = |at: &usize| *at != label && numbers[*at].parse::<f64>().is_ok();
    let mut free: Vec<usize> = (0..numbers.len()).filter(is_number).collect();
    let names = look.first();
    let named = |wanted: &dyn Fn(&str) -> bool| {
        let mut found = (0..names.len()).filter(|at| wanted(&names[*at]));
        found.find(|at| free.contains(at))
    };
    let time = named(&|name| role_of(name, None) == Some(Role::Time));
    let axis =
        |axis| named(&|name| role_of(name, Some(Sensor::Gyroscope)) == Some(Role::Gyro(axis)));
    let by_names = axis(0).zip(axis(1)).zip(axis(2));
    // Three columns that differ by their axis alone, as `3DOF_x`.
    let triads: Vec<Triad> = triads(&names)
        .into_iter()
        .filter(|triad| triad.columns.iter().all(|at| free.contains(at)))
        .collect();
    let only = || match &triads[..] {
        [triad] => Some(triad.columns),
        _ => None,
    };
    let axes = by_names.map(|((x, y), z)| [x, y, z]).or_else(only);
    let time = time.or_else(|| named(&|name| axes.is_some() && is_like_time(name)));
    let found = match (axes, time) {
        (Some([x, y, z]), Some(t)) => [t, x, y, z],
        _ => {
            let t = time.or_else(|| free.first().copied())?;
            free.retain(|at| *at != t);
            // Of more columns nobody knows which.
            let [x, y, z] = free[..] else { return None };
            [t, x, y, z]
        }
    };
    Some(found.map(|at| (at + 1).to_string()))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let row = |labels: &'static [&'static str]| {
        look.lines()
            .find_map(|line| Some((line, labelled(line, labels)?)))
    };
    let rows_of = |labels: &[&str]| {
        look.lines()
            .filter(|line| labelled(line, labels).is_some())
            .count()
    };
    let (accel, gyro) = (rows_of(&ACCEL), rows_of(&GYRO));
    // Of one label alone the table is that sensor's.
    if accel.min(gyro) < 2 || 4 * (accel + gyro) < look.lines().count() {
        return None;
    }
    let ((force, label), (rate, other)) = (row(&ACCEL)?, row(&GYRO)?);
    let at = columns(look, force, label)?;
    if label != other || columns(look, rate, other)? != at {
        return None;
    }
    let part = |sensor, change: Change| Part {
        change: Some(change),
        ..Part::of(sensor, at.each_ref().map(String::as_str))
    };
    let mut parts = vec![
        part(Sensor::Accelerometer, |text| only(text, &ACCEL)),
        part(Sensor::Gyroscope, |text| only(text, &GYRO)),
    ];
    if row(&FIELD).is_some() {
        parts.push(Part {
            change: Some(|text| only(text, &FIELD)),
            ..Part::of_field(at.each_ref().map(String::as_str), None)
        });
    }
    Some(parts)
}

/// The rows that have one of `labels`; the others are blank.
fn only(text: Box<dyn Read + Send>, labels: &'static [&'static str]) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        if labelled(&String::from_utf8_lossy(line), labels).is_some() {
            out.extend_from_slice(line);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns_of(text: &str) -> Option<Vec<String>> {
        let parts = parts(&Look::at(text.as_bytes()))?;
        Some(parts[1].columns.iter().map(|(_, at)| at.clone()).collect())
    }

    #[test]
    fn columns_are_found_by_name_or_by_order() {
        let rows = "7,ACC,1,2,3\n8,GYR,4,5,6\n9,ACC,1,2,3\n9,GYR,4,5,6\n";
        let expected: Vec<String> = ["1", "3", "4", "5"].map(str::to_owned).into();
        assert_eq!(columns_of(rows), Some(expected));
        let named = "sensor,z,y,x,accuracy,time\naccel,1,2,3,0,4\ngyro,4,5,6,0,4\naccel,1,2,3,0,5\ngyro,4,5,6,0,5\n";
        let expected: Vec<String> = ["6", "4", "3", "2"].map(str::to_owned).into();
        assert_eq!(columns_of(named), Some(expected));
        let unnamed =
            "a,1,2,3,0,4\naccel,1,2,3,0,4\ngyro,4,5,6,0,4\naccel,1,2,3,0,4\ngyro,4,5,6,0,4\n";
        assert_eq!(columns_of(unnamed), None);
        assert_eq!(columns_of("1,acc,1,2,3\n2,acc,1,2,3\n"), None);
    }
}
