//! `make_formats.py` beside the recordings writes a phone's recording in the layouts of programs; every one of them is
//! read as that recording.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use calib::Recording;
use calib::calibrate::{Request, calibrate};
use calib::recording::{ReadOptions, Stream};
use nalgebra::{Matrix3, Vector3};
use sensor::Sensor;
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
    calibrations_are_the_recordings_own(folder.path(), &expected);
    let refused: [(&str, &[&str]); 1] = [("phone/phyphox_linear", &["gravity", "with g"])];
    for (path, words) in refused {
        let error = Recording::read(&folder.path().join(path), &ReadOptions::default())
            .unwrap_err()
            .to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
}

/// What of a calibration does not depend on how the axes are named: `TᵀT` of both sensors in the recording's axes.
struct Invariants([Matrix3<f64>; 2]);

impl Invariants {
    /// Of readings in axes turned by `turn` and in units of which `counts` make the SI unit.
    fn of(recording: Recording, turn: &Matrix3<f64>, counts: [f64; 2]) -> Self {
        let outcome = calibrate(&[recording], &[], &Request::default()).unwrap();
        let of = |sensor: Sensor, counts: f64| {
            let t = outcome.calibration.triad(sensor).unwrap().base().t * turn * counts;
            t.transpose() * t
        };
        Self([
            of(Sensor::Accelerometer, counts[0]),
            of(Sensor::Gyroscope, counts[1]),
        ])
    }

    /// The largest difference of scales and misalignments, of either sensor.
    fn off(&self, other: &Self) -> [f64; 2] {
        // TᵀT changes by twice as much as T.
        [0, 1].map(|k| (self.0[k] - other.0[k]).amax() / 2.0)
    }
}

/// Layouts in other axes or without stamps are calibrated as the recording with one clock is, the latter at its rate.
fn calibrations_are_the_recordings_own(folder: &Path, expected: &Recording) {
    let (accel, gyro) = (
        expected.accelerometer.as_ref().unwrap(),
        expected.gyroscope.as_ref().unwrap(),
    );
    let one_clock = |t: Vec<f64>| Recording {
        name: "one clock".to_owned(),
        gyroscope: Some(Stream {
            values: accel.t.iter().filter_map(|t| gyro.at(*t)).collect(),
            t: t.clone(),
        }),
        accelerometer: Some(Stream {
            values: accel.values.clone(),
            t,
        }),
        ..Recording::default()
    };
    let same = Matrix3::identity();
    let stamped = Invariants::of(one_clock(accel.t.clone()), &same, [1.0; 2]);
    let turn = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0);
    for case in cases().iter().filter(|case| case.frd) {
        let found = Recording::read(&folder.join(case.path), &ReadOptions::default()).unwrap();
        let off = Invariants::of(found, &turn, [1.0; 2]).off(&stamped);
        println!("{}: scales off by {off:?}", case.path);
        assert!(off.iter().all(|off| *off < 2e-4), "{}: {off:?}", case.path);
    }
    // The usual step: where samples are missing their number says nothing of the time.
    let rate = 1.0 / accel.median_step().unwrap();
    let counted = (0..accel.len()).map(|k| k as f64 / rate).collect();
    let counted = Invariants::of(one_clock(counted), &same, [1.0; 2]);
    let off = counted.off(&stamped);
    println!("the recording itself at {rate:.3} Hz: scales off by {off:?}");
    for case in cases().iter().filter(|case| case.rate.is_some()) {
        let options = ReadOptions {
            rate: Some(rate),
            ..ReadOptions::default()
        };
        let found = Recording::read(&folder.join(case.path), &options).unwrap();
        let off = Invariants::of(found, &same, case.counts).off(&counted);
        println!("{}: scales off by {off:?} at {rate:.3} Hz", case.path);
        // Two decimals are kept by one of them.
        let within = if case.counts == [1.0; 2] { 1e-2 } else { 1e-3 };
        assert!(
            off.iter().all(|off| *off < within),
            "{}: {off:?}",
            case.path
        );
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
            value = Vector3::new(value.y, value.x, -value.z);
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
