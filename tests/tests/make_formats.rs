//! `make_formats.py` beside the recordings writes a phone's recording in the layouts of programs; every one of them is
//! read as that recording.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use calib::Recording;
use calib::recording::{ReadOptions, Stream};
use stillpoint_tests::needed_data::needed;

/// A Python with numpy, pandas and rosbags: `$STILLPOINT_PYTHON`, else `python3`.
fn python() -> Option<String> {
    let python = std::env::var("STILLPOINT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let check = Command::new(&python)
        .args(["-c", "import numpy, pandas, rosbags"])
        .output();
    if check.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    // Not by `eprintln!`: the output of a test that passes is captured.
    let _ = writeln!(
        std::io::stderr(),
        "skipped: make_formats: no Python with numpy, pandas and rosbags; name one in STILLPOINT_PYTHON"
    );
    None
}

/// A layout: path, its options, counts per SI unit, largest error of values, and whether axes are turned to
/// forward-right-down.
struct Case {
    path: &'static str,
    rate: Option<f64>,
    counts: [f64; 2],
    within: [f64; 2],
    frd: bool,
}

const COUNTS: [f64; 2] = [16384.0 / 9.80665, 65.5 * 180.0 / std::f64::consts::PI];

fn si(path: &'static str, within: [f64; 2]) -> Case {
    Case {
        path,
        rate: None,
        counts: [1.0; 2],
        within,
        frd: false,
    }
}

fn counted(path: &'static str, rate: Option<f64>) -> Case {
    Case {
        rate,
        counts: COUNTS,
        ..si(path, [0.51 / COUNTS[0], 0.51 / COUNTS[1]])
    }
}

fn turned(path: &'static str) -> Case {
    Case {
        frd: true,
        ..si(path, [1e-6, 1e-6])
    }
}

fn cases() -> Vec<Case> {
    let exact = [1e-9, 1e-9];
    let mut cases: Vec<Case> = [
        "phone/phyphox_rec_1",
        "phone/phyphox_rec_1.zip",
        "phone/phyphox_de",
        "phone/sensorlogger_android",
        "phone/sensorlogger_android.zip",
        "phone/sensorlogger_android_uncal.zip",
        "phone/sensorlogger_ios.zip",
        "phone/sensorlogger_ios_std.zip",
        "phone/sensorlogger.json",
        "ros/imu.bag",
        "ros/bag_mcap",
        "ros/bag_db3",
    ]
    .map(|path| si(path, exact))
    .into();
    cases.extend([
        si("phone/ptb_multi.csv", [0.5e-3, 0.51e-4]),
        si("phone/ptb_multi_clock.csv", [0.5e-3, 0.51e-4]),
        si("phone/sensorlog_ios.csv", [0.5e-5, 0.51e-6]),
        si("phone/androsensor.csv", [0.51e-4, 0.51e-4]),
        counted("firmware/plain.csv", None),
        counted("firmware/nohdr7.csv", None),
        counted("firmware/arduino_ts.txt", None),
        counted("firmware/micros_wrap.csv", None),
        counted("firmware/jeff.txt", Some(100.0)),
        counted("firmware/plotter.txt", Some(100.0)),
        counted("firmware/nohdr6.csv", Some(100.0)),
        Case {
            rate: Some(100.0),
            ..si("firmware/adafruit.txt", [0.51e-2, 0.51e-2])
        },
        turned("px4/log_0_sensor_combined_0.csv"),
        turned("apm/imu_csv.csv"),
        turned("ros/rostopic.csv"),
        turned("ros/ros2topic.csv"),
    ]);
    cases
}

#[test]
fn every_layout_of_make_formats_is_the_recording_that_it_was_made_of() {
    let (Some(script), Some(phone)) = (
        needed("../tools/make_formats.py"),
        needed("phone/multi_position/rec_1"),
    ) else {
        return;
    };
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let made = Command::new(python)
        .arg(script)
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(
        made.status.success(),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let expected = Recording::read(&phone, &ReadOptions::default()).unwrap();
    let failures: Vec<String> = cases()
        .iter()
        .filter_map(|case| {
            let words = check(case, folder.path(), &expected).err()?;
            Some(format!("{}: {words}", case.path))
        })
        .collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    let refused: [(&str, &[&str]); 1] = [("phone/phyphox_linear", &["gravity", "with g"])];
    for (path, words) in refused {
        let error = Recording::read(&folder.path().join(path), &ReadOptions::default())
            .unwrap_err()
            .to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
}

fn check(case: &Case, folder: &Path, expected: &Recording) -> Result<(), String> {
    let path: PathBuf = folder.join(case.path);
    let options = ReadOptions {
        rate: case.rate,
        ..ReadOptions::default()
    };
    let found = Recording::read(&path, &options).map_err(|error| error.to_string())?;
    let (accel, gyro) = expected
        .accelerometer
        .as_ref()
        .zip(expected.gyroscope.as_ref())
        .ok_or("no CSV")?;
    let sensors = [
        (&found.accelerometer, accel, 0),
        (&found.gyroscope, gyro, 1),
    ];
    for (stream, expected, k) in sensors {
        let stream = stream.as_ref().ok_or("a sensor is missing")?;
        let one_clock = stream.len() != expected.len()
            || found.gyroscope.as_ref().map(|s| &s.t) == found.accelerometer.as_ref().map(|s| &s.t);
        let off = largest_error(stream, expected, case, k, one_clock.then_some(accel))?;
        if off > case.within[k] {
            return Err(format!("sensor {k} is off by {off:e}"));
        }
    }
    Ok(())
}

/// The largest error of the values; the gyroscope of one clock is interpolated to the accelerometer's stamps.
fn largest_error(
    found: &Stream,
    expected: &Stream,
    case: &Case,
    sensor: usize,
    clock: Option<&Stream>,
) -> Result<f64, String> {
    let times = clock.map_or(&expected.t, |accel| &accel.t);
    if found.len() != times.len() {
        return Err(format!("{} samples, {} expected", found.len(), times.len()));
    }
    let mut largest: f64 = 0.0;
    for (k, t) in times.iter().enumerate() {
        let Some(mut value) = expected.at(*t) else {
            continue;
        };
        if case.frd {
            value = nalgebra::Vector3::new(value.y, value.x, -value.z);
        }
        // The range of the sensor in counts ends at 2 g.
        let value = (value * case.counts[sensor]).map(|v| {
            if case.counts[sensor] == 1.0 {
                v
            } else {
                v.clamp(-32768.0, 32767.0)
            }
        });
        largest = largest.max((found.values[k] - value).amax() / case.counts[sensor]);
    }
    Ok(largest)
}
