//! Formats of programs met in the field.

use file_formats::make::{Rows, ulog};
use findings::Front;
use nalgebra::Vector3;
use stillpoint_recording::{FieldUnit, ReadOptions, Recording};

use crate::session::{G, is_it, read, read_as, session, table, xyz};

#[test]
fn razor_ahrs_is_read_with_its_sign_and_its_rate() {
    let s = session();
    let text = table("", |k| {
        format!(
            "#YPRAG=1.00,2.00,3.00,{},{}",
            xyz(&s.force[k], -256.0 / G),
            xyz(&s.rate[k], 1.0)
        )
    });
    let asked = read_as(&text, &ReadOptions::default())
        .unwrap_err()
        .text(Front::CommandLine);
    assert!(asked.contains("--rate 50"), "{asked}");
    let rate = ReadOptions {
        rate: Some(50.0),
        ..ReadOptions::default()
    };
    let found = read_as(&text, &rate).unwrap();
    is_it(&found, &s, 1e-4);
    assert_eq!(found.description.format, "razor_ahrs");
    let text = table("", |k| {
        let [force, field, turn] = [
            (&s.force[k], -256.0 / G),
            (&s.field[k], 5.0),
            (&s.rate[k], 800.0),
        ];
        format!(
            "#A-R={}\r\n#M-R={}\r\n#G-R={}",
            xyz(force.0, force.1),
            xyz(field.0, field.1),
            xyz(turn.0, turn.1)
        )
    });
    let found = read_as(&text, &rate).unwrap();
    let force = found.accelerometer.unwrap();
    assert!((force.values[700] * G / 256.0 - s.force[700]).amax() < 1e-4);
    assert_eq!(found.magnetometer.unwrap().stream.len(), 1600);
}

#[test]
fn rows_of_sensorstream_are_read_whatever_groups_they_have() {
    let s = session();
    let text = table("", |k| {
        let position = if k % 50 == 0 {
            " 1, 48.1,11.5,500.0,"
        } else {
            ""
        };
        format!(
            "{:.5},{position} 3, {}, 4, {}, 5, {}, 86, 31.0",
            1000.0 + s.t[k],
            xyz(&s.force[k], 1.0),
            xyz(&s.rate[k], 1.0),
            xyz(&s.field[k], 1.0)
        )
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    assert_eq!(found.description.format, "sensorstream");
    assert_eq!(
        found.magnetometer.unwrap().unit,
        Some(FieldUnit::Microtesla)
    );
}

#[test]
fn a_decoded_blackbox_is_read_in_its_units() {
    let s = session();
    let header = "loopIteration, time (us), axisP[0], axisP[1], axisP[2], gyroADC[0], gyroADC[1], gyroADC[2], accSmooth[0], accSmooth[1], accSmooth[2], flightModeFlags (flags)";
    let row = |k: usize| {
        let micros = (s.t[k] * 1e6).round();
        format!(
            "{k}, {micros}, 1, 2, 3, {}, {}, ANGLE_MODE",
            xyz(&s.rate[k], 1f64.to_degrees()),
            xyz(&s.force[k], 2048.0 / G)
        )
    };
    let settings = "\"Product\",\"Blackbox flight data recorder by Nicholas Sherlock\"\n"
        .to_owned()
        + &"\"setting\",\"1\"\n".repeat(400)
        + "\"acc_1G\",\"2048\"\n";
    let found = read(&(settings + &table(header, row)));
    is_it(&found, &s, 1e-4);
    assert_eq!(found.description.format, "betaflight");
    let found = read(&table(header, row));
    let force = found.accelerometer.unwrap();
    assert!((force.values[700] * G / 2048.0 - s.force[700]).amax() < 1e-4);
    let log =
        b"H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\n\x00\x01"
            .to_vec();
    let refused = Recording::from_bytes("LOG.BBL", log, &ReadOptions::default()).unwrap_err();
    assert!(refused.to_string().contains("blackbox_decode"), "{refused}");
}

#[test]
fn text_of_a_vmu931_is_in_milliseconds_g_and_degrees() {
    let s = session();
    let named = |name: &str, k: usize, value: &Vector3<f64>, scale: f64| {
        let [x, y, z] = [value.x, value.y, value.z].map(|v| v * scale);
        format!("[{name}] t={:.0} x={x:.6} y={y:.6} z={z:.6}", s.t[k] * 1e3)
    };
    let text = table("", |k| {
        format!(
            "{}\n{}\n{}",
            named("mag", k, &s.field[k], 1.0),
            named("accel", k, &s.force[k], 1.0 / G),
            named("gyro", k, &s.rate[k], 1f64.to_degrees())
        )
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    assert_eq!(
        found.magnetometer.unwrap().unit,
        Some(FieldUnit::Microtesla)
    );
}

#[test]
fn a_log_of_several_sensors_is_listed_with_the_options_that_choose() {
    let s = session();
    let rows = |values: &[Vector3<f64>]| -> Rows {
        let stamps = s.t.iter().map(|t| (t * 1e9) as i64);
        stamps.zip(values.iter().map(|v| [v.x, v.y, v.z])).collect()
    };
    let (force, rate) = (rows(&s.force), rows(&s.rate));
    let topics = [
        ("sensor_accel", 0, &force),
        ("sensor_accel", 1, &force),
        ("sensor_gyro", 0, &rate),
        ("sensor_gyro", 1, &rate),
    ];
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("log.ulg");
    std::fs::write(&path, ulog(&topics, &[])).unwrap();
    assert!(Recording::read(&path, &ReadOptions::default()).is_err());
    let contents = Recording::streams_in(&path, &ReadOptions::default())
        .unwrap()
        .unwrap();
    assert!(contents.has_choice());
    let first = contents.first_option(Front::CommandLine);
    assert_eq!(first.as_deref(), Some("--instance 0"));
    let options: Vec<_> = contents
        .streams
        .iter()
        .map(|s| (s.sensor, s.option(Front::CommandLine).unwrap_or_default()))
        .collect();
    assert!(
        options.contains(&("gyroscope", "--instance 1".to_owned())),
        "{options:?}"
    );
    let plain = dir.path().join("a.csv");
    std::fs::write(&plain, "t,ax,ay,az\n0,1,2,3\n").unwrap();
    assert!(
        Recording::streams_in(&plain, &ReadOptions::default())
            .unwrap()
            .is_none()
    );
}

#[test]
fn axes_behind_the_name_of_their_sensor_are_read() {
    let s = session();
    let axes = |v: &Vector3<f64>| format!("X={:.6} Y={:.6} Z={:.6}", v.x, v.y, v.z);
    let text = table("", |k| {
        let (force, rate) = (axes(&s.force[k]), axes(&s.rate[k]));
        let ms = 1e3 * s.t[k];
        format!("[{ms:.0}] Accel: {force} m/s^2  Gyro: {rate} rad/s  Temp: 25.3 C")
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    assert_eq!(found.description.format, "serial");
}
