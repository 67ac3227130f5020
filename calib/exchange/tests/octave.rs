//! The MATLAB export run by GNU Octave, where that is installed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::io::Write as _;
use std::process::Command;

use nalgebra::Vector3;
use sensor::Sensor;
use stillpoint_exchange::{Settings, Source, by_name, export, import};

const ACCELEROMETER: &str = "1 -0.00283 0.00412\n0 1 0.00331\n0 0 1\n0.9951 0 0\n0 1.0043 0\n0 0 0.9987\n0.21\n-0.43\n0.31\n";
const GYROSCOPE: &str = "1 -0.0017 0.0118\n0.0096 1 -0.0113\n0.003 0.007 1\n0.9663 0 0\n0 1.0021 0\n0 0 1.02\n0.0054\n-0.0305\n-0.0126\n";

#[test]
fn octave_runs_the_matlab_script_and_corrects_as_the_calibration_does() {
    let octave = |arguments: &[&str]| {
        let mut command = Command::new("octave-cli");
        command
            .args(["--no-gui", "--norc", "--quiet"])
            .args(arguments);
        command
    };
    if !octave(&["--version"])
        .output()
        .is_ok_and(|run| run.status.success())
    {
        // Not by `eprintln!`: the output of a test that passes is captured.
        let words = "skipped: the MATLAB export is not run: no octave-cli";
        let _ = writeln!(std::io::stderr(), "{words}");
        return;
    }
    let calibration = import::imu_tk(ACCELEROMETER, GYROSCOPE).unwrap();
    let settings = Settings::default();
    let source = Source::new(&calibration);
    let files = export(by_name("matlab").unwrap(), &source, &settings)
        .unwrap()
        .files;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cal.m"), &files[0]).unwrap();
    let readings = [
        Vector3::new(0.1, -0.2, 9.8),
        Vector3::new(9.7, 0.3, 0.1),
        Vector3::new(-1.0, 2.0, 3.0),
    ];
    let rows: Vec<String> = readings
        .iter()
        .map(|r| format!("{} {} {}", r.x, r.y, r.z))
        .collect();
    let main = format!(
        "source('cal.m');\nraw = [{}];\nassert(strcmp(cal.schema, 'stillpoint.calibration/1'));\n\
         printf('%.17g\\n', cal_accelerometer(raw)', cal_gyroscope(raw)');\n",
        rows.join("; ")
    );
    std::fs::write(folder.path().join("main_script.m"), main).unwrap();
    let run = octave(&["main_script.m"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}");
    let printed = String::from_utf8_lossy(&run.stdout);
    let printed: Vec<f64> = printed
        .lines()
        .map(|line| line.trim().parse().unwrap())
        .collect();
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
    let own = sensors.iter().flat_map(|sensor| {
        let base = calibration.triad(*sensor).unwrap().base();
        readings.map(|raw| base.correct(&raw))
    });
    let own: Vec<f64> = own.flat_map(|v| [v.x, v.y, v.z]).collect();
    assert_eq!(printed.len(), own.len());
    for (own, other) in own.iter().zip(&printed) {
        assert!(
            (own - other).abs() < 1e-14 * own.abs().max(10.0),
            "{own} {other}"
        );
    }
}
