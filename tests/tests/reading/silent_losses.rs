//! No sensor is lost silently: in every layout one sensor's columns are renamed, removed or put elsewhere, and the file is
//! read rightly or asked about.

use std::path::Path;

use calib::recording::{Described, ReadOptions, Stream};
use calib::{Error, Recording};
use file_formats::make::Packing;
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
const WORDS: [(&str, &str, &str); 23] = [
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
    ("PX4 log", "sensor_accel", "sensor_fooos"),
    ("PX4 log", "float x;", "float q;"),
    ("ArduPilot log", "GyrX", "FooX"),
    ("ArduPilot log", "AccX", "FooX"),
    ("ArduPilot log", "IMU", "FOO"),
    ("ROS 1 bag", "sensor_msgs/Imu", "sensor_msgs/Foo"),
    ("MCAP", "sensor_msgs/msg/Imu", "sensor_msgs/msg/Foo"),
    (
        "ROS 2 bag, folder",
        "sensor_msgs/msg/Imu",
        "sensor_msgs/msg/Foo",
    ),
    (
        "ROS 2 bag, db3",
        "sensor_msgs/msg/Imu",
        "sensor_msgs/msg/Foo",
    ),
    ("MATLAB matrices", "gyro", "fooo"),
    ("MATLAB matrices", "acc", "foo"),
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
        Sensor::Magnetometer => (true, found.magnetometer.is_none()),
    };
    let said = found
        .warnings
        .texts(findings::Front::CommandLine)
        .iter()
        .any(|words| words.contains(" only"));
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
            renamed_matrix(&samples, from, to)
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

/// The MATLAB file with another name for the matrix called `from`.
fn renamed_matrix(samples: &Samples, from: &str, to: &str) -> Vec<u8> {
    let rows = |stream: &Stream| {
        let row = |(t, v): (&f64, &nalgebra::Vector3<f64>)| ((t * 1e9).round() as i64, (*v).into());
        stream.t.iter().zip(&stream.values).map(row).collect()
    };
    let (accel, gyro) = (rows(&samples.accel), rows(&samples.gyro));
    let name = |name| if name == from { to } else { name };
    file_formats::make::mat(&[(name("acc"), &accel), (name("gyro"), &gyro)])
}

#[test]
fn a_topic_of_an_unknown_type_that_may_be_the_missing_sensor_is_asked_about() {
    let samples = Samples::of_session();
    let all = layouts(&samples);
    let name = "ROS 1 bag, a topic for each sensor";
    let layout = all.iter().find(|layout| layout.name == name).unwrap();
    let whole = read(layout, &layout.files).unwrap();
    let content = &layout.files[0].1;
    for topic in ["/camera/gyro/sample", "/camera/accel/sample"] {
        let (kind, other) = (b"sensor_msgs/Imu", b"foo_drivers/Imu");
        let mut changed = content.clone();
        let places = |bytes: &[u8], what: &[u8]| -> Vec<usize> {
            let windows = bytes.windows(what.len()).enumerate();
            windows
                .filter(|(_, w)| *w == what)
                .map(|(at, _)| at)
                .collect()
        };
        let topics = places(content, b"/sample");
        for at in places(content, kind) {
            // The type stands behind its topic.
            let before = topics.iter().rfind(|before| **before < at).unwrap() + b"/sample".len();
            if content[..before].ends_with(topic.as_bytes()) {
                changed[at..at + kind.len()].copy_from_slice(other);
            }
        }
        assert_ne!(&changed, content);
        let files = vec![(layout.files[0].0.clone(), changed)];
        let judged = judge(read(layout, &files), &whole, Sensor::Gyroscope, None);
        assert_eq!(judged, Ok(()), "{topic}");
    }
}

#[test]
fn fields_of_logs_are_taken_by_name_wherever_they_stand() {
    let samples = Samples::of_session();
    let all = layouts(&samples);
    let swapped = |stream: &Option<Stream>| {
        let mut stream = stream.clone().unwrap();
        let values = stream.values.iter_mut();
        values.for_each(|v| *v = nalgebra::Vector3::new(v.z, v.y, v.x));
        Some(stream)
    };
    for (name, from, to, is_force) in [
        (
            "PX4 log",
            "float x;float y;float z",
            "float z;float y;float x",
            true,
        ),
        ("ArduPilot log", "GyrX,GyrY,GyrZ", "GyrZ,GyrY,GyrX", false),
    ] {
        let layout = all.iter().find(|layout| layout.name == name).unwrap();
        let whole = read(layout, &layout.files).unwrap();
        let content = replaced(&layout.files[0].1, from.as_bytes(), to.as_bytes());
        let found = read(layout, &[(layout.files[0].0.clone(), content)]).unwrap();
        assert_eq!(
            found.gyroscope.unwrap().len(),
            whole.gyroscope.as_ref().unwrap().len()
        );
        if is_force {
            assert_eq!(found.accelerometer, swapped(&whole.accelerometer), "{name}");
        } else {
            assert_eq!(found.accelerometer, whole.accelerometer, "{name}");
        }
    }
}

fn is_near(found: &Option<Stream>, whole: &Option<Stream>) -> bool {
    let (Some(found), Some(whole)) = (found, whole) else {
        return found.is_none() && whole.is_none();
    };
    let mut pairs = found.values.iter().zip(&whole.values);
    found.len() == whole.len() && pairs.all(|(a, b)| (a - b).amax() < 1e-4)
}

#[test]
fn a_file_of_a_folder_or_archive_that_is_called_otherwise_is_read_or_asked_about() {
    let samples = Samples::of_session();
    let (mut failures, mut tried) = (Vec::new(), 0);
    for layout in layouts(&samples) {
        let whole = read(&layout, &layout.files).unwrap();
        for sensor in &whole.description.sensors {
            let of_sensor = |(name, _): &&(String, Vec<u8>)| sensor.source.ends_with(name.as_str());
            let Some(k) = layout.files.iter().position(|file| of_sensor(&file)) else {
                continue;
            };
            if layout.files.len() < 2 || layout.call[0] != "." {
                continue;
            }
            let mut files = layout.files.clone();
            files[k].0 = files[k]
                .0
                .rsplit_once('/')
                .map_or("", |(folder, _)| folder)
                .to_owned()
                + "Foo.csv";
            let entries: Vec<_> = files
                .iter()
                .map(|(name, content)| (name.as_str(), content.as_slice(), Packing::Deflated))
                .collect();
            let archive = vec![("a.zip".to_owned(), file_formats::make::zip(&entries))];
            let packed = Layout {
                call: vec!["a.zip"],
                ..layout.clone()
            };
            for (of, layout, files) in [("folder", &layout, &files), ("archive", &packed, &archive)]
            {
                tried += 1;
                let found = read(layout, files);
                // Of an iPhone the sum of two others is the same to rounding.
                let is_same = found.as_ref().is_ok_and(|found| {
                    is_near(&found.accelerometer, &whole.accelerometer)
                        && is_near(&found.gyroscope, &whole.gyroscope)
                });
                if is_same {
                    continue;
                }
                let judged = judge(found, &whole, sensor.sensor, None);
                if let Err(words) = judged {
                    let sensor = sensor.sensor.name();
                    failures.push(format!("{} ({of}), {sensor}: {words}", layout.name));
                }
            }
        }
    }
    println!("{tried} renamed files, {} wrong", failures.len());
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    assert!(tried >= 8, "{tried}");
}
