//! Names and units of columns that people give them: read rightly or asked about, never a sensor or a factor lost.

use std::fmt::Write as _;

use calib::recording::{ReadOptions, Stream};
use calib::{Error, Recording};
use nalgebra::Vector3;
use stillpoint_tests::layouts::Samples;

const G: f64 = 9.80665;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The session with one clock below a header, times the units' sizes.
fn table(samples: &Samples, header: &str, units: [f64; 2]) -> Vec<u8> {
    let mut text = format!("{header}\n");
    let rows = samples.accel.values.iter().zip(&samples.together);
    for (t, (f, w)) in samples.accel.t.iter().zip(rows) {
        let (f, w) = (f / units[0], w / units[1]);
        let _ = writeln!(
            text,
            "{t:.3},{:.6},{:.6},{:.6},{:.8},{:.8},{:.8}",
            f.x, f.y, f.z, w.x, w.y, w.z
        );
    }
    text.into_bytes()
}

fn read(name: &str, bytes: Vec<u8>) -> Result<Recording, Error> {
    Recording::from_bytes(name, bytes, &ReadOptions::default())
}

fn is(found: &Option<Stream>, expected: &[Vector3<f64>], within: f64) -> bool {
    found.as_ref().is_some_and(|found| {
        let mut pairs = found.values.iter().zip(expected);
        found.len() == expected.len() && pairs.all(|(a, b)| (a - b).amax() < within)
    })
}

/// `None` for what is asked about with these words, else read rightly.
type Case = (&'static str, [f64; 2], Option<&'static str>);

const CASES: [Case; 21] = [
    (
        "time_s,acc_x_mps2,acc_y_mps2,acc_z_mps2,gyro_x_deg_per_sec,gyro_y_deg_per_sec,gyro_z_deg_per_sec",
        [1.0, DEGREE],
        None,
    ),
    (
        "t,acc_x_m_s2,acc_y_m_s2,acc_z_m_s2,gyro_x_rad_s,gyro_y_rad_s,gyro_z_rad_s",
        [1.0, 1.0],
        None,
    ),
    (
        "Time (s),Acc X (g),Acc Y (g),Acc Z (g),Gyro X (degrees/second),Gyro Y (degrees/second),Gyro Z (degrees/second)",
        [G, DEGREE],
        None,
    ),
    (
        "Time [sec],A_X [mg],A_Y [mg],A_Z [mg],G_X [mdps],G_Y [mdps],G_Z [mdps]",
        [G / 1e3, DEGREE / 1e3],
        None,
    ),
    (
        "t,ax (m/sÂ²),ay (m/sÂ²),az (m/sÂ²),gx (rad/sec),gy (rad/sec),gz (rad/sec)",
        [1.0, 1.0],
        None,
    ),
    // Told by the turns, whatever it is called.
    ("t,ax,ay,az,gx (d/s),gy (d/s),gz (d/s)", [1.0, DEGREE], None),
    ("t,ax,ay,az,gx (rps),gy (rps),gz (rps)", [1.0, 1.0], None),
    (
        "t,ax,ay,az,gx (rev/s),gy (rev/s),gz (rev/s)",
        [1.0, std::f64::consts::TAU],
        None,
    ),
    (
        "t,ax,ay,az,gx [deg/min],gy [deg/min],gz [deg/min]",
        [1.0, DEGREE / 60.0],
        None,
    ),
    (
        "t,ax,ay,az,gx (turn/s),gy (turn/s),gz (turn/s)",
        [1.0, std::f64::consts::TAU],
        Some("turn/s"),
    ),
    (
        "t,ax,ay,az,gx [cdps],gy [cdps],gz [cdps]",
        [1.0, DEGREE / 100.0],
        Some("cdps"),
    ),
    (
        "t,ax (mm/s^2),ay (mm/s^2),az (mm/s^2),gx (rad/s),gy (rad/s),gz (rad/s)",
        [1e-3, 1.0],
        None,
    ),
    (
        "t,accX_cmps2,accY_cmps2,accZ_cmps2,gx (rad/s),gy (rad/s),gz (rad/s)",
        [1e-2, 1.0],
        None,
    ),
    (
        "t,ax (in/s^2),ay (in/s^2),az (in/s^2),gx (rad/s),gy (rad/s),gz (rad/s)",
        [0.0254, 1.0],
        Some("in/s^2"),
    ),
    (
        "t,ax,ay,az,gyro_counts_x,gyro_counts_y,gyro_counts_z",
        [1.0, 1.0],
        Some("no gyroscope"),
    ),
    (
        "t,ax,ay,az,rotation speed x (rad/sec),rotation speed y (rad/sec),rotation speed z (rad/sec)",
        [1.0, 1.0],
        None,
    ),
    (
        "t,ax,ay,az,roll_rate,pitch_rate,yaw_rate",
        [1.0, 1.0],
        Some("no gyroscope"),
    ),
    (
        "t,ax,ay,az,rotX (deg/sec),rotY (deg/sec),rotZ (deg/sec)",
        [1.0, DEGREE],
        None,
    ),
    (
        "t,body_frame_acc_x,body_frame_acc_y,body_frame_acc_z,gx,gy,gz",
        [1.0, 1.0],
        Some("no accelerometer"),
    ),
    (
        "t,device_sensor_acc_x,device_sensor_acc_y,device_sensor_acc_z,gx,gy,gz",
        [1.0, 1.0],
        Some("no accelerometer"),
    ),
    ("t,ax,ay,az,label_p,label_q,label_rot", [1.0, 1.0], None),
];

#[test]
fn names_and_units_are_understood_or_asked_about() {
    let samples = Samples::of_session();
    let mut failures = Vec::new();
    for (header, units, asked) in CASES {
        let found = read("r.csv", table(&samples, header, units));
        let judged = match (found, asked) {
            (Err(Error::Input(found)), Some(asked))
                if found.text(findings::Front::CommandLine).contains(asked) =>
            {
                Ok(())
            }
            (Err(error), _) => Err(error.to_string()),
            (Ok(_), Some(_)) => Err("read".to_owned()),
            (Ok(found), None) => {
                let force = is(&found.accelerometer, &samples.accel.values, 1e-4);
                let labels = header.contains("label");
                let rate = labels || is(&found.gyroscope, &samples.together, 1e-6);
                (force && rate)
                    .then_some(())
                    .ok_or_else(|| format!("{:#?}", found.warnings))
            }
        };
        failures.extend(judged.err().map(|words| format!("{header}: {words}")));
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn a_proposal_takes_three_columns_of_one_name() {
    let samples = Samples::of_session();
    let header = "t,acc1_x,acc1_y,acc1_z,gyr1_x,gyr1_y,gyr1_z";
    let words = read("r.csv", table(&samples, header, [1.0, 1.0]))
        .unwrap_err()
        .to_string();
    let proposed = "ax=acc1_x,ay=acc1_y,az=acc1_z,gx=gyr1_x,gy=gyr1_y,gz=gyr1_z";
    assert!(words.contains(proposed), "{words}");
}

/// Both sensors row by row, each reading with its sensor's label; every `often`-th of the gyroscope.
fn long(samples: &Samples, header: &str, labels: [&str; 2], often: usize) -> Vec<u8> {
    let mut rows: Vec<(f64, &str, Vector3<f64>)> = Vec::new();
    for (stream, label, often) in [
        (&samples.accel, labels[0], 1),
        (&samples.gyro, labels[1], often),
    ] {
        let all = stream.t.iter().zip(&stream.values).step_by(often);
        rows.extend(all.map(|(t, v)| (*t, label, *v)));
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = header.to_owned();
    for (t, label, v) in rows {
        let _ = writeln!(text, "{t:.3},{label},{:.8},{:.8},{:.8}", v.x, v.y, v.z);
    }
    text.into_bytes()
}

#[test]
fn rows_of_both_sensors_by_turns_are_told_apart_by_their_labels() {
    let samples = Samples::of_session();
    for (header, labels) in [
        ("timestamp,sensor,x,y,z\n", ["accelerometer", "gyroscope"]),
        ("time (s),type,X,Y,Z\n", ["ACC", "GYR"]),
        ("", ["Accel", "Gyro"]),
        (
            "seconds,name,v0,v1,v2\n",
            ["android.sensor.accelerometer", "android.sensor.gyroscope"],
        ),
    ] {
        for often in [1, 7] {
            let found = read("r.csv", long(&samples, header, labels, often)).unwrap();
            let gyro: Vec<_> = samples.gyro.values.iter().step_by(often).copied().collect();
            assert!(
                is(&found.accelerometer, &samples.accel.values, 1e-6),
                "{header} {labels:?}"
            );
            assert!(is(&found.gyroscope, &gyro, 1e-6), "{header} {labels:?}");
        }
    }
    // Labels that nobody knows are no reason to mix them.
    for often in [1, 10] {
        let found = read("r.csv", long(&samples, "", ["one", "two"], often));
        assert!(matches!(found, Err(Error::Input(_))), "{often}: {found:?}");
    }
}

#[test]
fn a_matlab_file_of_version_4_is_named() {
    let mut file = [0u32, 100, 4, 0, 4].map(u32::to_le_bytes).concat();
    file.extend(b"acc\0");
    file.extend([0; 3200]);
    let words = read("r.mat", file).unwrap_err().to_string();
    assert!(
        words.contains("version 4") && words.contains("save -v7"),
        "{words}"
    );
}

#[test]
fn a_unit_of_time_in_which_no_device_records_is_asked_about() {
    let samples = Samples::of_session();
    for (header, is_read) in [
        ("time (s),ax,ay,az,gx,gy,gz", true),
        ("time (ms),ax,ay,az,gx,gy,gz", false),
        ("time (us),ax,ay,az,gx,gy,gz", false),
    ] {
        match read("r.csv", table(&samples, header, [1.0, 1.0])) {
            Ok(_) => assert!(is_read, "{header}"),
            Err(error) => assert!(
                !is_read
                    && error
                        .text(findings::Front::CommandLine)
                        .contains("--time-unit"),
                "{error}"
            ),
        }
    }
}

#[test]
fn what_is_proposed_for_a_missing_sensor_keeps_the_one_that_is_there() {
    let samples = Samples::of_session();
    let header = "t,ax,ay,az,roll_rate,pitch_rate,yaw_rate";
    let words = read("r.csv", table(&samples, header, [1.0, 1.0]))
        .unwrap_err()
        .to_string();
    let proposed = "t=t,ax=ax,ay=ay,az=az,gx=roll_rate,gy=pitch_rate,gz=yaw_rate";
    assert!(words.contains(proposed), "{words}");
}

#[test]
fn a_row_of_units_that_looks_like_names_is_none() {
    let samples = Samples::of_session();
    let header = "t,ax,ay,az,gx,gy,gz\ns,m/(s^2),m/(s^2),m/(s^2),deg/s,deg/s,deg/s";
    let mut text = table(&samples, header, [1.0, DEGREE]);
    // The first static interval alone: nothing tells the unit but the row.
    let rows = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
    let end = rows.map(|(at, _)| at).nth(200).unwrap();
    text.truncate(end + 1);
    let found = read("r.csv", text).unwrap();
    let expected = &samples.together[..199];
    assert!(is(&found.gyroscope, expected, 1e-6), "{:?}", found.warnings);
}

#[test]
fn the_stamp_of_a_message_goes_before_the_time_of_its_arrival() {
    let samples = Samples::of_session();
    let rows = String::from_utf8(table(&samples, "", [1.0, 1.0])).unwrap();
    let late = |header: &str, stamp: fn(f64) -> String| {
        let mut text = format!("{header}\n");
        for line in rows.lines().skip(1) {
            let (t, readings) = line.split_once(',').unwrap();
            let t: f64 = t.parse().unwrap();
            let _ = writeln!(
                text,
                "{:.6},{},{readings}",
                t + 0.03 + 1e-4 * (50.0 * t).sin(),
                stamp(t)
            );
        }
        read("r.csv", text.into_bytes()).unwrap()
    };
    let in_one = late("__time,header/stamp,ax,ay,az,gx,gy,gz", |t| {
        format!("{t:.6}")
    });
    let in_two = late(
        "Time,header.stamp.secs,header.stamp.nsecs,ax,ay,az,gx,gy,gz",
        |t| format!("{},{}", t.floor(), ((t - t.floor()) * 1e9).round()),
    );
    let nanoseconds = |t: f64| format!("{:.0}", t * 1e9);
    let of_sensor = late("time,sensor_time_ns,ax,ay,az,gx,gy,gz", nanoseconds);
    // A header that nobody fills leaves the time of arrival.
    let unfilled = late("__time,header/stamp,ax,ay,az,gx,gy,gz", |_| "0".into());
    let arrived = unfilled.accelerometer.unwrap().t[0] - samples.accel.t[0];
    assert!((arrived - 0.03).abs() < 2e-3, "{arrived}");
    for found in [in_one, in_two, of_sensor] {
        for stream in [found.accelerometer, found.gyroscope].into_iter().flatten() {
            let off = stream.t.iter().zip(&samples.accel.t);
            let off = off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3, "{off}");
        }
    }
}

#[test]
fn the_stamp_of_another_topic_is_no_clock_of_the_sensors() {
    let samples = Samples::of_session();
    let rows = String::from_utf8(table(&samples, "", [1.0, 1.0])).unwrap();
    let mut text =
        "__time,/camera/header/stamp,/imu/ax,/imu/ay,/imu/az,/imu/gx,/imu/gy,/imu/gz\n".to_owned();
    for line in rows.lines().skip(1) {
        let (t, readings) = line.split_once(',').unwrap();
        let at: f64 = t.parse().unwrap();
        let _ = writeln!(text, "{t},{:.3},{readings}", at + 5.0);
    }
    let found = read("r.csv", text.into_bytes()).unwrap();
    let first = found.accelerometer.unwrap().t[0];
    assert!((first - samples.accel.t[0]).abs() < 1e-3, "{first}");
}
