//! No sensor is lost silently: in every layout one sensor's columns are renamed, removed or put elsewhere, and the file is
//! read rightly or asked about.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::path::Path;

use calib::recording::{Described, ReadOptions};
use calib::{Error, Recording};
use sensor::Sensor;
use stillpoint_tests::layouts::{Layout, Samples, layouts};

/// What is done to the three columns of a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    Renamed,
    Removed,
    OneRemoved,
    Reversed,
    MovedToTheEnd,
}

const CHANGES: [Change; 5] = [
    Change::Renamed,
    Change::Removed,
    Change::OneRemoved,
    Change::Reversed,
    Change::MovedToTheEnd,
];

/// Layouts whose rows are no cells between separators: what names one sensor in them, and what does not.
const WORDS: [(&str, &str, &str); 14] = [
    ("serial plotter", "gx:", "p:"),
    ("serial plotter", "ax:", "p:"),
    ("Adafruit MPU6050", "Rotation", "Foo"),
    ("Adafruit MPU6050", "Acceleration", "Foo"),
    ("GetSensorData", "GYRO;", "FOO;"),
    ("GetSensorData", "ACCE;", "FOO;"),
    ("GnssLogger", "UncalGyro,", "Foo,"),
    ("GnssLogger", "UncalAccel,", "Foo,"),
    ("VectorNav", "$VNIMU", "$VNFOO"),
    ("Sensor Logger, JSON", "Gyroscope", "Foo"),
    ("Sensor Logger, JSON", "TotalAcceleration", "Foo"),
    ("PX4 log", "sensor_gyro", "sensor_fooo"),
    ("ArduPilot log", "GyrX", "FooX"),
    ("MATLAB matrices", "gyro", "fooo"),
];

fn write(files: &[(String, Vec<u8>)], folder: &Path) {
    for (name, content) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
}

fn read(layout: &Layout, files: &[(String, Vec<u8>)]) -> Result<Recording, Error> {
    let rate = layout.call.iter().position(|word| *word == "--rate");
    let options = ReadOptions {
        rate: rate.map(|at| layout.call[at + 1].parse().unwrap()),
        ..ReadOptions::default()
    };
    let folder = tempfile::tempdir().unwrap();
    write(files, folder.path());
    Recording::read(&folder.path().join(layout.call[0]), &options)
}

/// A text as cells.
struct Table {
    before: String,
    separator: char,
    header: Option<Vec<String>>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// `None` for anything but rows of equally many cells below names or without them.
    fn of(bytes: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(bytes).ok()?;
        let lines: Vec<&str> = text.lines().collect();
        let last = lines.get(lines.len().checked_sub(2)?)?;
        let count = |separator: &char| last.matches(*separator).count();
        let separator = [',', '\t', ';'].into_iter().max_by_key(count)?;
        let split = |line: &&str| line.split(separator).map(str::to_owned).collect::<Vec<_>>();
        let width = split(last).len();
        let first = lines.iter().position(|line| split(line).len() == width)?;
        let mut rows: Vec<Vec<String>> = lines[first..].iter().map(split).collect();
        let whole = width >= 4 && rows.iter().all(|row| row.len() == width);
        let is_number = |cell: &String| cell.replace(',', ".").parse::<f64>().is_ok();
        let numbers = rows[0].iter().all(is_number);
        // Names or nothing: labels in cells are no table.
        let named = !numbers && rows.get(2)?.iter().filter(|cell| is_number(cell)).count() >= 3;
        (whole && (numbers || named)).then(|| Self {
            before: lines[..first]
                .iter()
                .map(|line| format!("{line}\n"))
                .collect(),
            separator,
            header: named.then(|| rows.remove(0)),
            rows,
        })
    }

    /// Where the columns called so are, or numbered from 1.
    fn columns(&self, sensor: &Described) -> Option<Vec<usize>> {
        let axes = sensor
            .columns
            .iter()
            .filter(|(role, _)| *role != "t" && *role != "temp");
        let bare = |cell: &String| cell.trim_matches(['"', '#', ' ']).to_owned();
        let at = |name: &String| match &self.header {
            Some(header) => header.iter().position(|cell| bare(cell) == *name),
            None => Some(name.parse::<usize>().ok()? - 1),
        };
        let found: Option<Vec<usize>> = axes.map(|(_, name)| at(name)).collect();
        found.filter(|found| found.len() == 3)
    }

    fn changed(&self, columns: &[usize], change: Change) -> Vec<u8> {
        let width = self.rows[0].len();
        let mut order: Vec<usize> = (0..width).collect();
        match change {
            Change::Renamed => {}
            Change::Removed => order.retain(|at| !columns.contains(at)),
            Change::OneRemoved => order.retain(|at| *at != columns[1]),
            Change::Reversed => order.swap(columns[0], columns[2]),
            Change::MovedToTheEnd => {
                order.retain(|at| !columns.contains(at));
                order.extend(columns);
            }
        }
        let line = |cells: &Vec<String>| {
            let cells: Vec<&str> = order.iter().map(|at| cells[*at].as_str()).collect();
            cells.join(&self.separator.to_string()) + "\n"
        };
        let mut text = self.before.clone();
        if let Some(mut header) = self.header.clone() {
            if change == Change::Renamed {
                for (at, name) in columns.iter().zip(["p", "q", "r"]) {
                    header[*at] = name.to_owned();
                }
            }
            text.push_str(&line(&header));
        }
        text.extend(self.rows.iter().map(line));
        text.into_bytes()
    }
}

/// Whether what was read of a changed file is right.
fn judge(
    read: Result<Recording, Error>,
    whole: &Recording,
    sensor: Sensor,
    change: Option<Change>,
) -> Result<(), String> {
    let found = match read {
        Err(Error::Input(_) | Error::Usage(_)) => return Ok(()),
        Err(other) => return Err(other.to_string()),
        Ok(found) => found,
    };
    let (is_force, is_rate) = (
        found.accelerometer == whole.accelerometer,
        found.gyroscope == whole.gyroscope,
    );
    if is_force && is_rate {
        return Ok(());
    }
    let (other_is_right, missing) = match sensor {
        Sensor::Accelerometer => (is_rate, found.accelerometer.is_none()),
        Sensor::Gyroscope => (is_force, found.gyroscope.is_none()),
    };
    let said = found.warnings.iter().any(|words| words.contains(" only"));
    // What is not in the file any more cannot be read; it is said.
    if change == Some(Change::Removed) && other_is_right && missing && said {
        return Ok(());
    }
    Err(format!(
        "accelerometer {}, gyroscope {}; {:?}",
        found.accelerometer.is_some(),
        found.gyroscope.is_some(),
        found.warnings
    ))
}

#[test]
fn a_sensor_whose_columns_are_renamed_removed_or_elsewhere_is_read_or_asked_about() {
    let samples = Samples::of_session();
    let (mut failures, mut tried, mut tables) = (Vec::new(), 0, 0);
    for layout in layouts(&samples) {
        let whole = read(&layout, &layout.files).unwrap();
        for (k, (name, content)) in layout.files.iter().enumerate() {
            let Some(table) = Table::of(content) else {
                continue;
            };
            let of_file = |sensor: &&Described| sensor.source.ends_with(name.as_str());
            for sensor in whole.description.sensors.iter().filter(of_file) {
                let Some(columns) = table.columns(sensor) else {
                    continue;
                };
                tables += 1;
                for change in CHANGES {
                    // Columns without names are what they are by their place.
                    let by_place = !matches!(change, Change::Removed | Change::OneRemoved);
                    if table.header.is_none() && by_place {
                        continue;
                    }
                    let mut files = layout.files.clone();
                    files[k].1 = table.changed(&columns, change);
                    let judged = judge(read(&layout, &files), &whole, sensor.sensor, Some(change));
                    tried += 1;
                    if let Err(words) = judged {
                        let of = sensor.sensor.name();
                        failures.push(format!("{}: {of} {change:?}: {words}", layout.name));
                    }
                }
            }
        }
    }
    println!(
        "{tried} changes of {tables} triads, {} wrong",
        failures.len()
    );
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    assert!(tables >= 45 && tried > 200, "{tables} {tried}");
}

#[test]
fn a_sensor_that_is_called_otherwise_in_lines_and_logs_is_asked_about() {
    let samples = Samples::of_session();
    let all = layouts(&samples);
    let mut failures = Vec::new();
    for (name, from, to) in WORDS {
        let layout = all.iter().find(|layout| layout.name == name).unwrap();
        let whole = read(layout, &layout.files).unwrap();
        let mut files = layout.files.clone();
        let content = if name == "MATLAB matrices" {
            renamed_matrix(&samples, to)
        } else {
            replaced(&files[0].1, from.as_bytes(), to.as_bytes())
        };
        assert_ne!(content, files[0].1, "{name}");
        files[0].1 = content;
        if let Err(words) = judge(read(layout, &files), &whole, Sensor::Gyroscope, None) {
            failures.push(format!("{name}, {from} as {to}: {words}"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        match rest.strip_prefix(from) {
            Some(behind) => {
                out.extend_from_slice(to);
                rest = behind;
            }
            None => {
                out.push(rest[0]);
                rest = &rest[1..];
            }
        }
    }
    out
}

/// The MATLAB file with another name for the gyroscope's matrix.
fn renamed_matrix(samples: &Samples, name: &str) -> Vec<u8> {
    let rows = |stream: &calib::recording::Stream| {
        let row = |(t, v): (&f64, &nalgebra::Vector3<f64>)| ((t * 1e9).round() as i64, (*v).into());
        stream.t.iter().zip(&stream.values).map(row).collect()
    };
    let (accel, gyro) = (rows(&samples.accel), rows(&samples.gyro));
    file_formats::make::mat(&[("acc", &accel), (name, &gyro)])
}
