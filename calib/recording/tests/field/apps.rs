//! Events of Android, logs of firmware, and packets of Movesense.

use findings::Front;
use nalgebra::Vector3;
use stillpoint_recording::{ReadOptions, Recording};

use crate::session::{G, Session, is_it, read, read_as, session, table, xyz};

/// A row per event: the sensors by turns, and a type that each has.
fn events(header: &str, s: &Session, types: [&str; 3]) -> String {
    let [accel, gyro, field] = types;
    table(header, |k| {
        let at = (1e9 * s.t[k]).round() as u64 + 123_456_000_000;
        let event = |kind: &str, value: &Vector3<f64>| format!("{at},{kind},{}", xyz(value, 1.0));
        let rows = [
            event(accel, &s.force[k]),
            event(field, &s.field[k]),
            event(gyro, &s.rate[k]),
        ];
        rows.join("\n")
    })
}

#[test]
fn events_of_android_are_told_apart_by_the_number_of_their_type() {
    let s = session();
    for (header, types) in [
        ("timestamp_ns,type,x,y,z", ["1", "4", "2"]),
        ("timestamp_ns,sensorType,x,y,z", ["35", "16", "14"]),
        ("timestamp_ns,sensor_type,x,y,z", ["1", "16", "2"]),
        (
            "timestamp_ns,sensor,x,y,z",
            [
                "TYPE_ACCELEROMETER",
                "TYPE_GYROSCOPE",
                "TYPE_MAGNETIC_FIELD",
            ],
        ),
        (
            "timestamp_ns,sensor,x,y,z",
            ["Accelerometer", "Gyroscope_Uncalibrated", "MagneticField"],
        ),
    ] {
        let found = read(&events(header, &s, types));
        is_it(&found, &s, 1e-4);
        assert!(found.magnetometer.is_some(), "{header} {types:?}");
    }
    // Numbers of anything else say nothing.
    for header in ["timestamp_ns,id,x,y,z", "timestamp_ns,type,x,y,z"] {
        let text = events(header, &s, ["0", "1", "2"]);
        let words = read_as(&text, &ReadOptions::default()).unwrap_err();
        assert!(
            words.text(Front::CommandLine).contains("--columns"),
            "{header}"
        );
    }
}

#[test]
fn the_unit_of_the_stamps_of_events_is_that_of_their_name() {
    let s = session();
    let text = table("time (min),type,x,y,z", |k| {
        let t = s.t[k] / 60.0;
        let (force, rate) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
        format!("{t:.9},accelerometer,{force}\n{t:.9},gyroscope,{rate}")
    });
    is_it(&read(&text), &s, 1e-4);
}

/// The readings of a row as a program prints them, in g and deg/s.
fn printed(s: &Session, k: usize) -> String {
    let (f, w) = (s.force[k] / G, s.rate[k].map(f64::to_degrees));
    format!(
        "ax:{:.6} ay:{:.6} az:{:.6} gx:{:.5} gy:{:.5} gz:{:.5}",
        f.x, f.y, f.z, w.x, w.y, w.z
    )
}

#[test]
fn logs_of_firmware_have_their_stamps_before_their_messages() {
    let s = session();
    let ms = |k: usize| (1e3 * s.t[k]).round() as u64 + 12_345;
    let clock = |ms: u64| format!("00:00:{:02}.{:03}", ms / 1000, ms % 1000);
    let boot = "ESP-ROM:esp32c3-api1-20210207\nI (24) boot: ESP-IDF v5.1 2nd stage bootloader\n\
        I (60) boot:  0 nvs WiFi data 01 02 00009000 00006000\nI (310) app_start: Starting scheduler.\n";
    let triads = |k: usize| {
        let (f, w) = (s.force[k] / G, s.rate[k].map(f64::to_degrees));
        format!(
            "acc: {} gyro: {}",
            xyz(&f, 1.0).replace(',', ", "),
            xyz(&w, 1.0).replace(',', ", ")
        )
    };
    for text in [
        table("", |k| format!("I ({}) imu: {}", ms(k), printed(&s, k))),
        boot.to_owned() + &table("", |k| format!("I ({}) imu: {}", ms(k), printed(&s, k))),
        table("", |k| {
            format!("\u{1b}[0;32mI ({}) imu: {}\u{1b}[0m", ms(k), printed(&s, k))
        }),
        table("", |k| {
            format!("[{:6}][I][main.cpp:42] loop(): {}", ms(k), printed(&s, k))
        }),
        table("", |k| {
            format!("[{},000] <inf> imu: {}", clock(ms(k)), printed(&s, k))
        }),
        table("", |k| format!("I ({}) MPU6050: {}", ms(k), triads(k))),
        // Other parts of the program say something now and then.
        table("", |k| match k % 50 {
            7 => format!(
                "I ({}) imu: {}\nW (1) wifi: beacon 1 2 3",
                ms(k),
                printed(&s, k)
            ),
            9 => format!(
                "I ({}) imu: {}\nI (1) imu: still alive",
                ms(k),
                printed(&s, k)
            ),
            _ => format!("I ({}) imu: {}", ms(k), printed(&s, k)),
        }),
    ] {
        let found = read(&text);
        is_it(&found, &s, 1e-4);
        assert_eq!(found.description.format, "serial");
    }
}

#[test]
fn sensors_that_are_logged_by_turns_are_two_tables() {
    let s = session();
    let text = table("", |k| {
        let ms = (1e3 * s.t[k]).round() as u64 + 12_345;
        let (f, w) = (&s.force[k], &s.rate[k]);
        format!(
            "I ({ms}) imu: acc_x={:.6} acc_y={:.6} acc_z={:.6}\nI ({ms}) imu: gyro_x={:.6} gyro_y={:.6} gyro_z={:.6}",
            f.x, f.y, f.z, w.x, w.y, w.z
        )
    });
    is_it(&read(&text), &s, 1e-4);
}

#[test]
fn a_row_of_a_log_that_is_broken_is_refused_at_its_line() {
    let s = session();
    let text = table("", |k| match k {
        700 => "I (26345) imu: ax:0.1 ay:0.2 az:0.9.1 gx:0 gy:0 gz:0".to_owned(),
        _ => format!("I ({}) imu: {}", 12_345 + 20 * k, printed(&s, k)),
    });
    let words = read_as(&text, &ReadOptions::default()).unwrap_err();
    assert!(
        words.text(Front::CommandLine).contains("a.csv:701"),
        "{words}"
    );
}

/// Samples of a packet as objects.
fn array(values: &[Vector3<f64>], scale: f64) -> String {
    let object = |v: &Vector3<f64>| {
        let v = v * scale;
        format!("{{\"x\":{:.6},\"y\":{:.6},\"z\":{:.6}}}", v.x, v.y, v.z)
    };
    format!(
        "[{}]",
        values.iter().map(object).collect::<Vec<_>>().join(",")
    )
}

/// A packet from its stamp, ms, and the samples of both sensors.
type Packet<'a> = dyn Fn(u64, &[Vector3<f64>], &[Vector3<f64>]) -> String + 'a;

fn read_json(json: &str) -> Recording {
    Recording::from_bytes("a.json", json.as_bytes(), &ReadOptions::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn packets_of_movesense_are_samples_on_an_even_clock() {
    let s = session();
    let degrees = 1f64.to_degrees();
    let packets = |size: usize, row: &Packet<'_>| {
        let begins = (0..1600).step_by(size);
        let packet = |k: usize| {
            let ms = (1e3 * s.t[k]).round() as u64 + 5000;
            row(ms, &s.force[k..k + size], &s.rate[k..k + size])
        };
        begins.map(packet).collect::<Vec<_>>().join(",")
    };
    let together = |ms: u64, f: &[Vector3<f64>], w: &[Vector3<f64>]| {
        let (f, w) = (array(f, 1.0), array(w, degrees));
        format!("{{\"imu6\":{{\"Timestamp\":{ms},\"ArrayAcc\":{f},\"ArrayGyro\":{w}}}}}")
    };
    let by_turns = |ms: u64, f: &[Vector3<f64>], w: &[Vector3<f64>]| {
        let (f, w) = (array(f, 1.0), array(w, degrees));
        format!(
            "{{\"acc\":{{\"Timestamp\":{ms},\"ArrayAcc\":{f}}}}},{{\"gyro\":{{\"Timestamp\":{ms},\"ArrayGyro\":{w}}}}}"
        )
    };
    for size in [4, 8, 32] {
        is_it(
            &read_json(&format!("[{}]", packets(size, &together))),
            &s,
            1e-4,
        );
        is_it(
            &read_json(&format!("{{\"data\":[{}]}}", packets(size, &together))),
            &s,
            1e-4,
        );
        is_it(
            &read_json(&format!("{{\"data\":[{}]}}", packets(size, &by_turns))),
            &s,
            1e-4,
        );
    }
    // A file per sensor.
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let of_force = |ms: u64, f: &[Vector3<f64>], _: &[Vector3<f64>]| {
        format!(
            "{{\"acc\":{{\"Timestamp\":{ms},\"ArrayAcc\":{}}}}}",
            array(f, 1.0)
        )
    };
    let of_rate = |ms: u64, _: &[Vector3<f64>], w: &[Vector3<f64>]| {
        format!(
            "{{\"gyro\":{{\"Timestamp\":{ms},\"ArrayGyro\":{}}}}}",
            array(w, degrees)
        )
    };
    write(
        "acc.json",
        format!("{{\"data\":[{}]}}", packets(8, &of_force)),
    );
    write(
        "gyro.json",
        format!("{{\"data\":[{}]}}", packets(8, &of_rate)),
    );
    is_it(
        &Recording::read(folder.path(), &ReadOptions::default()).unwrap(),
        &s,
        1e-4,
    );
}

#[test]
fn packets_of_two_lengths_are_refused() {
    let s = session();
    let packet = |k: usize| {
        let (f, w) = (
            array(&s.force[k..k + 8], 1.0),
            array(&s.rate[k..k + 4], 1.0),
        );
        format!(
            "{{\"Timestamp\":{},\"ArrayAcc\":{f},\"ArrayGyro\":{w}}}",
            20 * k
        )
    };
    let json: Vec<String> = (0..1600).step_by(8).map(packet).collect();
    let json = format!("[{}]", json.join(","));
    let found = Recording::from_bytes("a.json", json.as_bytes(), &ReadOptions::default());
    let words = found.unwrap_err().text(Front::CommandLine);
    assert!(words.contains("ArrayGyro"), "{words}");
}
