//! Calibrations of readings that a system had corrected before: put together with that, or said.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use calib::calibration::Input;
use calib::recording::AppliedBefore;
use calib::{Calibration, Recording};
use findings::{Finding, Front};
use nalgebra::Vector3;
use sensor::Sensor;
use stillpoint_exchange::{Export, Settings, Source, TARGETS, by_name, export, import};

/// `diag(1.01, 0.99, 1.02)` and a bias of 0.1, 0.2, −0.1 m/s²; the gyroscope's bias is 0.01, −0.02, 0.03 rad/s.
const ACCELEROMETER: &str = "1 0 0 0 1 0 0 0 1\n1.01 0 0 0 0.99 0 0 0 1.02\n0.1 0.2 -0.1\n";
const GYROSCOPE: &str = "1 0 0 0 1 0 0 0 1\n1 0 0 0 1 0 0 0 1\n0.01 -0.02 0.03\n";

/// A calibration of a recording of both sensors with this claim.
fn calibration(by: &str, undone: bool) -> Calibration {
    let mut calibration = import::imu_tk(ACCELEROMETER, GYROSCOPE).unwrap();
    let stream = || {
        Some(calib::recording::Stream {
            t: vec![0.0, 0.01],
            values: vec![Vector3::z(); 2],
        })
    };
    let mut recording = Recording {
        name: "log".into(),
        accelerometer: stream(),
        gyroscope: stream(),
        ..Recording::default()
    };
    let claim = |sensor| AppliedBefore {
        undone,
        ..AppliedBefore::by(by, sensor)
    };
    if !by.is_empty() {
        recording.description.applied_before = [Sensor::Accelerometer, Sensor::Gyroscope]
            .map(claim)
            .to_vec();
    }
    calibration.provenance.inputs = vec![Input::of(&recording, None, [Some(1.0); 2])];
    calibration.seal();
    calibration
}

/// A remark as the command line says it.
fn said(note: &Finding) -> String {
    note.text(Front::CommandLine)
}

fn exported(
    calibration: &Calibration,
    target: &str,
    in_force: Option<&str>,
) -> Result<Export, String> {
    let settings = Settings {
        logged_with: in_force.map(str::to_owned),
        ..Settings::default()
    };
    export(
        by_name(target).unwrap(),
        &Source::new(calibration),
        &settings,
    )
    .map_err(|e| e.finding().text(Front::CommandLine))
}

fn parameter(export: &Export, name: &str) -> f64 {
    let text = String::from_utf8_lossy(&export.files[0]).into_owned();
    let line = text
        .lines()
        .find(|line| line.split([',', '\t']).any(|word| word == name));
    let line = line.unwrap_or_else(|| panic!("no {name} in {text}"));
    let words: Vec<&str> = line.split([',', '\t']).collect();
    let at = words.iter().position(|word| *word == name).unwrap();
    words[at + 1].parse().unwrap()
}

const PX4: &str = "# QGroundControl\n1\t1\tCAL_ACC0_XOFF\t0.5\t9\n1\t1\tCAL_ACC0_YOFF\t-0.2\t9\n1\t1\tCAL_ACC0_ZOFF\t0\t9\n\
                   1\t1\tCAL_ACC0_XSCALE\t1.01\t9\n1\t1\tCAL_ACC0_YSCALE\t0.98\t9\n1\t1\tCAL_ACC0_ZSCALE\t1\t9\n\
                   1\t1\tCAL_GYRO0_XOFF\t0.001\t9\n1\t1\tCAL_GYRO0_YOFF\t0.002\t9\n1\t1\tCAL_GYRO0_ZOFF\t0.003\t9\n\
                   1\t1\tCAL_ACC0_ROT\t-1\t6\n1\t1\tSENS_BOARD_ROT\t0\t6\n";

const ARDUPILOT: &str = "INS_ACCOFFS_X,0.5\nINS_ACCOFFS_Y,-0.2\nINS_ACCOFFS_Z,0\nINS_ACCSCAL_X,1.01\nINS_ACCSCAL_Y,0.98\n\
                         INS_ACCSCAL_Z,0\nINS_GYROFFS_X,0.001\nINS_GYROFFS_Y,0.002\nINS_GYROFFS_Z,0.003\nAHRS_ORIENTATION,0\n";

#[test]
fn a_flight_controller_that_had_corrected_is_put_together_with_its_parameters_or_refused() {
    for (system, in_force, names) in [
        (
            "px4",
            PX4,
            [
                "CAL_ACC0_XOFF",
                "CAL_ACC0_XSCALE",
                "CAL_GYRO0_YOFF",
                "CAL_ACC0_ZSCALE",
            ],
        ),
        (
            "ardupilot",
            ARDUPILOT,
            [
                "INS_ACCOFFS_X",
                "INS_ACCSCAL_X",
                "INS_GYROFFS_Y",
                "INS_ACCSCAL_Z",
            ],
        ),
    ] {
        let corrected = calibration(system, false);
        let refused = exported(&corrected, system, None).unwrap_err();
        assert!(
            refused.contains("--logged-with") && refused.contains("would replace"),
            "{refused}"
        );
        let made = exported(&corrected, system, Some(in_force)).unwrap();
        // d (s (raw − o) − b) = s d (raw − (o + b / s)) with o = 0.5, s = 1.01, d = 1.01, b = 0.1.
        let expected = [0.5 + 0.1 / 1.01, 1.01 * 1.01, 0.002 - 0.02, 1.02];
        for (name, expected) in names.into_iter().zip(expected) {
            let found = parameter(&made, name);
            assert!(
                (found - expected).abs() < 1e-6,
                "{name}: {found}, {expected}"
            );
        }
        assert!(
            made.notes
                .iter()
                .all(|note| !said(note).contains("had corrected")),
            "{:?}",
            made.notes
        );
        let text = String::from_utf8_lossy(&made.files[0]).into_owned();
        assert!(text.contains("put together with the parameters that were in force"));
        // The reader took them off: they must not go in twice.
        let restored = calibration(system, true);
        let refused = exported(&restored, system, Some(in_force)).unwrap_err();
        assert!(
            refused.contains("run it again without --logged-with"),
            "{refused}"
        );
        let made = exported(&restored, system, None).unwrap();
        assert!((parameter(&made, names[0]) - 0.1).abs() < 1e-6);
        assert!(
            made.notes
                .iter()
                .all(|note| !said(note).contains("--logged-with")),
            "{:?}",
            made.notes
        );
        // Nothing is stated: it is for the user to know.
        let made = exported(&calibration("", false), system, None).unwrap();
        assert!(
            made.notes
                .iter()
                .any(|note| said(note).contains("--logged-with"))
        );
    }
}

#[test]
fn parameters_that_are_not_those_of_the_sensor_are_refused() {
    let corrected = calibration("px4", false);
    for (in_force, says) in [
        ("", "lacks CAL_ACC0_XOFF"),
        (ARDUPILOT, "lacks CAL_ACC0_XOFF"),
        (
            PX4.replace("ACC0_ZOFF", "ACC1_ZOFF").as_str(),
            "lacks CAL_ACC0_ZOFF",
        ),
        (
            PX4.replace("SENS_BOARD_ROT\t0", "SENS_BOARD_ROT\t6")
                .as_str(),
            "SENS_BOARD_ROT",
        ),
        (
            PX4.replace("CAL_ACC0_ROT\t-1", "CAL_ACC0_ROT\t4").as_str(),
            "CAL_ACC0_ROT",
        ),
        (
            PX4.replace("CAL_ACC0_XOFF\t0.5", "CAL_ACC0_XOFF\tabc")
                .as_str(),
            "line 2",
        ),
        ("CAL_ACC0_XOFF", "line 1"),
    ] {
        let said = exported(&corrected, "px4", Some(in_force)).unwrap_err();
        assert!(said.contains(says), "{says}: {said}");
    }
    // Lines of ulog_params, and of a shell.
    let lines = |separator: &str| {
        let line = |line: &str| {
            let words: Vec<&str> = line.split('\t').collect();
            format!("{}{separator}{}\r\n", words[2], words[3])
        };
        PX4.lines().skip(1).map(line).collect::<String>()
    };
    for separator in [",", " ", "=", ", "] {
        let made = exported(&corrected, "px4", Some(&lines(separator))).unwrap();
        assert!((parameter(&made, "CAL_ACC0_XSCALE") - 1.01 * 1.01).abs() < 1e-6);
    }
}

#[test]
fn every_other_target_says_what_the_calibration_is_on_top_of() {
    for (by, name) in [
        ("px4", "PX4"),
        ("ardupilot", "ArduPilot"),
        ("ios", "iOS"),
        ("unknown", "the recording software"),
    ] {
        let corrected = calibration(by, false);
        for target in TARGETS.iter().filter(|target| target.name != by) {
            let made = exported(&corrected, target.name, None).unwrap();
            let says = |note: &str| note.contains(name) && note.contains("on top of");
            assert_eq!(
                made.notes.iter().filter(|note| says(&said(note))).count(),
                1,
                "{}: {:?}",
                target.name,
                made.notes
            );
            let text = String::from_utf8_lossy(&made.files[0]).into_owned();
            let in_file = text.contains("on top of what") || text.contains("applied_before");
            assert!(
                in_file || target.name == "imu_tk" || target.name == "npz",
                "{}: {text}",
                target.name
            );
        }
    }
    for stated in [calibration("", false), calibration("px4", true)] {
        for target in TARGETS {
            let made = exported(&stated, target.name, None).unwrap();
            assert!(
                made.notes
                    .iter()
                    .all(|note| !said(note).contains("on top of")),
                "{}: {:?}",
                target.name,
                made.notes
            );
        }
    }
}

#[test]
fn every_target_says_that_the_calibration_was_edited() {
    let mut edited = calibration("", false);
    edited.accelerometer.as_mut().unwrap().bias[0] = 0.2;
    for target in TARGETS {
        let all_of = |calibration| {
            let made = exported(calibration, target.name, None).unwrap();
            made.notes.iter().map(said).collect::<Vec<_>>().join("\n")
        };
        assert!(
            all_of(&edited).contains("was edited since"),
            "{}",
            target.name
        );
        assert!(
            !all_of(&calibration("", false)).contains("was edited"),
            "{}",
            target.name
        );
    }
}
