//! Tables with a row per reading, of which one cell says the sensor: `17000,gyroscope,0.01,0.02,0.03`.

use std::io::Read;

use sensor::Sensor;

use super::places::may_be_row;
use super::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::{compact, is_like_time, role_of, stated_unit, take_apart};
use crate::header::triads::{Triad, triads};
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::Stated;

/// Rows of both sensors by turns.
pub(crate) static LONG: TextFormat = TextFormat {
    name: "long",
    about: "a row per reading, which says its sensor: `17000,gyroscope,0.01,0.02,0.03`",
    parts,
};

/// The name of the rows of a sensor.
struct Label {
    /// Words in small letters without punctuation, or numbers in a column that is called after a type.
    words: &'static [&'static str],
    /// The rewriting to these rows.
    change: Change,
}

/// Labels of each sensor, those of what no system has corrected first; numbers are those of Android
/// (`android.hardware.Sensor`, constants `TYPE_..`).
static ACCEL: [Label; 5] = [
    Label {
        words: &[
            "accelerometeruncalibrated",
            "typeaccelerometeruncalibrated",
            "androidsensoraccelerometeruncalibrated",
        ],
        change: |text| only(text, &ACCEL[0]),
    },
    Label {
        words: &[
            "acc",
            "acce",
            "accel",
            "accelerometer",
            "acceleration",
            "imuacc",
            "imuaccel",
            "typeaccelerometer",
            "androidsensoraccelerometer",
        ],
        change: |text| only(text, &ACCEL[1]),
    },
    Label {
        words: &["35"],
        change: |text| only(text, &ACCEL[2]),
    },
    Label {
        words: &["1"],
        change: |text| only(text, &ACCEL[3]),
    },
    Label {
        words: &["a"],
        change: |text| only(text, &ACCEL[LETTER]),
    },
];
static GYRO: [Label; 5] = [
    Label {
        words: &[
            "gyroscopeuncalibrated",
            "typegyroscopeuncalibrated",
            "androidsensorgyroscopeuncalibrated",
        ],
        change: |text| only(text, &GYRO[0]),
    },
    Label {
        words: &[
            "gyr",
            "gyro",
            "gyroscope",
            "angularvelocity",
            "imugyr",
            "imugyro",
            "typegyroscope",
            "androidsensorgyroscope",
        ],
        change: |text| only(text, &GYRO[1]),
    },
    Label {
        words: &["16"],
        change: |text| only(text, &GYRO[2]),
    },
    Label {
        words: &["4"],
        change: |text| only(text, &GYRO[3]),
    },
    Label {
        words: &["g"],
        change: |text| only(text, &GYRO[LETTER]),
    },
];
static FIELD: [Label; 5] = [
    Label {
        words: &[
            "magnetometeruncalibrated",
            "magneticfielduncalibrated",
            "typemagneticfielduncalibrated",
            "androidsensormagneticfielduncalibrated",
        ],
        change: |text| only(text, &FIELD[0]),
    },
    Label {
        words: &[
            "mag",
            "magn",
            "magnetometer",
            "imumag",
            "magneticfield",
            "typemagneticfield",
            "androidsensormagneticfield",
        ],
        change: |text| only(text, &FIELD[1]),
    },
    Label {
        words: &["14"],
        change: |text| only(text, &FIELD[2]),
    },
    Label {
        words: &["2"],
        change: |text| only(text, &FIELD[3]),
    },
    Label {
        words: &["m"],
        change: |text| only(text, &FIELD[LETTER]),
    },
];

/// The index of the letter among the labels of a sensor: it may be a unit where the rows are not called by letters.
const LETTER: usize = 4;

/// Names of columns whose numbers are Android's.
const TYPES: [&str; 3] = ["type", "sensortype", "sensortypeid"];

impl Label {
    fn is_letter(&self) -> bool {
        self.words
            .iter()
            .all(|word| word.starts_with(char::is_alphabetic) && word.len() == 1)
    }

    /// The column with the label in the rows below `header`; `None` where any may have it.
    fn column(&self, header: &[String]) -> Option<usize> {
        let is_number = self.words.iter().all(|word| word.parse::<u8>().is_ok());
        let is_type = |name: &String| TYPES.contains(&compact(name).as_str());
        // Without such a column there are no rows.
        is_number.then(|| header.iter().position(is_type).unwrap_or(usize::MAX))
    }

    /// The index of the first cell of a row that is the label.
    fn at(&self, line: &str, column: Option<usize>) -> Option<usize> {
        let is_it = |(at, cell): (usize, &String)| {
            let is_there = column.is_none_or(|column| at == column);
            is_there && self.words.contains(&take_apart(cell).0.as_str())
        };
        let cells = cells(line);
        cells.iter().enumerate().position(is_it)
    }

    /// Its rows at the beginning of a text, each with the index of its label.
    fn rows<'a>(&self, look: &'a Look) -> Vec<(&'a str, usize)> {
        let column = self.column(&look.first());
        let rows = look
            .lines()
            .filter_map(|line| Some((line, self.at(line, column)?)));
        rows.collect()
    }
}

/// The first label that has rows, and those.
fn first<'a>(
    labels: &'static [Label],
    look: &'a Look,
) -> Option<(&'static Label, Vec<(&'a str, usize)>)> {
    let with_rows = labels.iter().map(|label| (label, label.rows(look)));
    let mut found = with_rows.filter(|(_, rows)| rows.len() >= 2);
    found.next()
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
            // Of more columns nobody knows which, but that a system states its biases behind what it has not corrected.
            let has_biases = take_apart(&numbers[label]).0.ends_with("uncalibrated");
            let [x, y, z] = match free[..] {
                [x, y, z] => [x, y, z],
                [x, y, z, _, _, _] if has_biases => [x, y, z],
                _ => return None,
            };
            [t, x, y, z]
        }
    };
    Some(found.map(|at| (at + 1).to_string()))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let ((force, forces), (rate, rates)) = (first(&ACCEL, look)?, first(&GYRO, look)?);
    // Of one label alone the table is that sensor's.
    if 4 * (forces.len() + rates.len()) < look.lines().count() {
        return None;
    }
    let (row, label) = forces[0];
    let at = columns(look, row, label)?;
    // A letter beside words is a unit, and one label in several columns is none.
    let mut labels = forces.iter().chain(&rates);
    let are_in_one = labels.all(|(_, at)| *at == label);
    let are_alike = force.is_letter() == rate.is_letter();
    if !are_in_one || !are_alike || columns(look, rates[0].0, label)? != at {
        return None;
    }
    let names = look.first();
    let stamps = at[0].parse::<usize>().ok();
    let time_unit = stamps.and_then(|at| stated_unit(names.get(at - 1)?));
    let field = first(&FIELD, look).filter(|(field, rows)| {
        let is_in_one = rows.iter().all(|(_, at)| *at == label);
        is_in_one && field.is_letter() == force.is_letter()
    });
    let field = field.map(|(label, _)| label.change);
    let changes = [Some(force.change), Some(rate.change), field];
    let stated = Stated {
        time: time_unit,
        ..Stated::default()
    };
    let columns = at.each_ref().map(String::as_str);
    Some(Part::of_each(changes, columns, stated).collect())
}

/// The rows that have the label; the others are blank.
fn only(text: Box<dyn Read + Send>, label: &'static Label) -> Box<dyn Read + Send> {
    let mut column: Option<Option<usize>> = None;
    rewritten(text, move |line, out| {
        let text = String::from_utf8_lossy(line);
        if column.is_none() && may_be_row(&text) {
            column = Some(label.column(&cells(&text)));
        }
        if column.is_some_and(|column| label.at(&text, column).is_some()) {
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
        let uncalibrated =
            "ACCELEROMETER_UNCALIBRATED,7,1,2,3,0,0,0\nGYROSCOPE_UNCALIBRATED,8,4,5,6,0,0,0\n";
        let expected: Vec<String> = ["2", "3", "4", "5"].map(str::to_owned).into();
        assert_eq!(columns_of(&uncalibrated.repeat(2)), Some(expected.clone()));
        let blanks = "ACC 7 1 2 3\nGYR 8 4 5 6\n";
        assert_eq!(columns_of(&blanks.repeat(2)), Some(expected));
        let letters = "7,a,1,2,3\n8,g,4,5,6\n9,a,1,2,3\n9,g,4,5,6\n";
        let expected: Vec<String> = ["1", "3", "4", "5"].map(str::to_owned).into();
        assert_eq!(columns_of(letters), Some(expected));
        // Where they stand for units they are none.
        let units = "7,acc,1,2,3,g\n7,acc,1,2,3,g\n8,acc,1,2,3,g\n";
        assert_eq!(columns_of(units), None);
        let units = "7,a,1,2,3,g\n7,g,1,2,3,s\n8,a,1,2,3,g\n8,g,1,2,3,s\n";
        assert_eq!(columns_of(units), None);
        // Numbers are labels in a column of types alone.
        let rows = "7,1,1,2,3\n8,4,4,5,6\n9,1,1,2,3\n9,4,4,5,6\n";
        assert!(columns_of(&format!("t,sensor_type,x,y,z\n{rows}")).is_some());
        assert_eq!(columns_of(&format!("t,id,x,y,z\n{rows}")), None);
    }
}
