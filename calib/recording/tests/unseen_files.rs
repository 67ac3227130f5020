//! Files of programs that no format of ours is named after: both sensors are read rightly, or it is asked which is which
//! with a line that answers. Nothing ends with a sensor missing.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::fmt::Write as _;

use findings::{Front, OptionName, Remedy};
use nalgebra::{Rotation3, Unit, Vector3};
use stillpoint_recording::{Error, ReadOptions, Recording};

const G: f64 = 9.80665;

/// What a device read: eight rests and the turns between them, 100 Hz.
struct Session {
    t: Vec<f64>,
    accel: Vec<Vector3<f64>>,
    gyro: Vec<Vector3<f64>>,
}

fn session() -> Session {
    let mut session = Session {
        t: Vec::new(),
        accel: Vec::new(),
        gyro: Vec::new(),
    };
    let mut attitude = Rotation3::identity();
    for place in 0..8_i32 {
        let axis = Unit::new_normalize(Vector3::new(1.0, f64::from(place % 3) - 1.0, 0.3));
        for k in 0..400 {
            let speed = if k < 200 { 0.0 } else { 0.6 };
            let noise = Vector3::from_fn(|i, _| 1e-3 * (f64::from(k * 5) + 2.0 * i as f64).sin());
            attitude = Rotation3::from_axis_angle(&axis, -speed * 0.01) * attitude;
            session.t.push(f64::from(place * 400 + k) * 0.01);
            session.accel.push(attitude * Vector3::z() * G + noise);
            session.gyro.push(axis.into_inner() * speed + 0.1 * noise);
        }
    }
    session
}

/// The three numbers of a reading, times a factor.
fn cells(value: &Vector3<f64>, scale: f64) -> String {
    let cell = |v: &f64| format!("{:.9}", v * scale);
    value.iter().map(cell).collect::<Vec<_>>().join(",")
}

/// A table whose row `k` is what `row` says.
fn table(header: &str, row: impl Fn(usize) -> String) -> String {
    let mut text = match header {
        "" => String::new(),
        header => format!("{header}\n"),
    };
    for k in 0..3200 {
        let _ = writeln!(text, "{}", row(k));
    }
    text
}

/// The session as `t`, accelerometer and gyroscope below a header.
fn plain(header: &str, s: &Session) -> String {
    table(header, |k| {
        let (f, w) = (cells(&s.accel[k], 1.0), cells(&s.gyro[k], 1.0));
        format!("{:.2},{f},{w}", s.t[k])
    })
}

fn read(text: &str) -> Result<Recording, Error> {
    Recording::from_bytes("a.csv", text.as_bytes(), &ReadOptions::default())
}

fn read_with(text: &str, columns: &str) -> Result<Recording, Error> {
    let options = ReadOptions {
        columns: columns.parse().unwrap(),
        ..ReadOptions::default()
    };
    Recording::from_bytes("a.csv", text.as_bytes(), &options)
}

#[track_caller]
fn is_both(found: &Recording, session: &Session) {
    for (found, expected) in [
        (&found.accelerometer, &session.accel),
        (&found.gyroscope, &session.gyro),
    ] {
        let found = found.as_ref().expect("a sensor is missing");
        assert_eq!(found.len(), expected.len());
        let mut pairs = found.values.iter().zip(expected);
        assert!(pairs.all(|(a, b)| (a - b).amax() < 1e-4), "values differ");
        let rate = (found.len() - 1) as f64 / (found.t[found.len() - 1] - found.t[0]);
        assert!((rate - 100.0).abs() < 0.1, "{rate} Hz");
    }
}

/// The message, and the columns that it offers.
#[track_caller]
fn asked(read: Result<Recording, Error>) -> (String, Option<String>) {
    let found = read.expect_err("asked about").finding();
    let columns = found.remedies.iter().find_map(|remedy| match remedy {
        Remedy::Set { any_of } | Remedy::Example { any_of } => {
            let mut offered = any_of.iter();
            let columns = offered.find(|setting| setting.option == OptionName::Columns);
            columns?.value.clone()
        }
        _ => None,
    });
    (found.text(Front::CommandLine), columns)
}

#[test]
fn names_of_many_programs_are_read() {
    let s = session();
    let degrees = 1f64.to_degrees();
    let headers = [
        // Arduino's MPU-6050 sketch, indexed columns, MAVLink's axis first.
        ("tick,AcX,AcY,AcZ,GyX,GyY,GyZ", 1.0, 1.0),
        (
            "time,accel[0],accel[1],accel[2],gyro[0],gyro[1],gyro[2]",
            1.0,
            1.0,
        ),
        (
            "time,raw.xacc,raw.yacc,raw.zacc,raw.xgyro,raw.ygyro,raw.zgyro",
            1.0,
            1.0,
        ),
        // MARS logger, VectorNav's control center, UZH-FPV.
        (
            "Unix time[sec],gx[rad/s],gy[rad/s],gz[rad/s],ax[m/s^2],ay[m/s^2],az[m/s^2]",
            1.0,
            1.0,
        ),
        (
            "Time Startup,Acceleration X,Acceleration Y,Acceleration Z,Angular Rate X,Angular Rate Y,Angular Rate Z",
            1.0,
            1.0,
        ),
        (
            "timestamp,ang_vel_x,ang_vel_y,ang_vel_z,lin_acc_x,lin_acc_y,lin_acc_z",
            1.0,
            1.0,
        ),
        // Units of other trades.
        (
            "t,ax (ft/s^2),ay (ft/s^2),az (ft/s^2),gx (deg/h),gy (deg/h),gz (deg/h)",
            1.0 / 0.3048,
            degrees * 3600.0,
        ),
        (
            "t,ax,ay,az,gx (rpm),gy (rpm),gz (rpm)",
            1.0,
            60.0 / std::f64::consts::TAU,
        ),
        (
            "t,acc_x_mps2,acc_y_mps2,acc_z_mps2,gyr_x_radps,gyr_y_radps,gyr_z_radps",
            1.0,
            1.0,
        ),
    ];
    for (header, force, rate) in headers {
        let gyro_first = header.contains("gx[") || header.contains("ang_vel");
        let text = table(header, |k| {
            let (f, w) = (cells(&s.accel[k], force), cells(&s.gyro[k], rate));
            match gyro_first {
                true => format!("{:.2},{w},{f}", s.t[k]),
                false => format!("{:.2},{f},{w}", s.t[k]),
            }
        });
        let found = read(&text).unwrap_or_else(|error| panic!("{header}: {error}"));
        is_both(&found, &s);
    }
}

#[test]
fn a_question_comes_with_the_line_that_answers_it() {
    let s = session();
    let headers = [
        "t,Acceleration X,Acceleration Y,Acceleration Z,Vinkelhastighet X,Vinkelhastighet Y,Vinkelhastighet Z",
        "time,Acc1,Acc2,Acc3,Gyr1,Gyr2,Gyr3",
        "t,left_acc_x,left_acc_y,left_acc_z,left_gyr_x,left_gyr_y,left_gyr_z",
        "GPS TOW,X Accel [x8004],Y Accel [x8004],Z Accel [x8004],p,q,r",
        "t,accSmooth[0],accSmooth[1],accSmooth[2],gyroADC[0],gyroADC[1],gyroADC[2]",
    ];
    for header in headers {
        let text = plain(header, &s);
        let (message, columns) = asked(read(&text));
        let columns = columns.unwrap_or_else(|| panic!("{header}: {message}"));
        let found = read_with(&text, &columns).unwrap_or_else(|error| panic!("{columns}: {error}"));
        is_both(&found, &s);
    }
}

#[test]
fn a_second_sensor_of_a_kind_is_asked_about() {
    let s = session();
    let with = |names: &str, scale: f64| {
        table(&format!("t,ax,ay,az,gx,gy,gz,{names}"), |k| {
            let (f, w) = (cells(&s.accel[k], 1.0), cells(&s.gyro[k], 1.0));
            format!("{:.2},{f},{w},{}", s.t[k], cells(&s.accel[k], scale))
        })
    };
    for names in [
        "ax2,ay2,az2",
        "acc_filt_x,acc_filt_y,acc_filt_z",
        "gx_lp,gy_lp,gz_lp",
    ] {
        let text = with(names, 1.1);
        let (message, columns) = asked(read(&text));
        assert!(message.contains("more than one"), "{message}");
        is_both(&read_with(&text, &columns.unwrap()).unwrap(), &s);
    }
    // What is worked out of them is none.
    is_both(&read(&with("LinAccX,LinAccY,LinAccZ", 0.1)).unwrap(), &s);
}

#[test]
fn acceleration_without_gravity_beside_a_rate_stops_the_run() {
    let s = session();
    let header = "time,rotationRate.x,rotationRate.y,rotationRate.z,userAcceleration.x,userAcceleration.y,userAcceleration.z";
    let text = table(header, |k| {
        let (w, linear) = (cells(&s.gyro[k], 1.0), cells(&s.gyro[k], 0.01));
        format!("{:.2},{w},{linear}", s.t[k])
    });
    let (message, _) = asked(read(&text));
    assert!(message.contains("without gravity"), "{message}");
    let alone = "gx=rotationRate.x,gy=rotationRate.y,gz=rotationRate.z";
    assert!(read_with(&text, alone).unwrap().gyroscope.is_some());
}

#[test]
fn a_sensor_that_lacks_an_axis_can_be_left_out() {
    let s = session();
    let text = table("t,ax,ay,gx,gy,gz", |k| {
        let (f, w) = (s.accel[k], cells(&s.gyro[k], 1.0));
        format!("{:.2},{:.6},{:.6},{w}", s.t[k], f.x, f.y)
    });
    let (message, columns) = asked(read(&text));
    assert!(message.contains("no column for az"), "{message}");
    let found = read_with(&text, &columns.unwrap()).unwrap();
    assert!(found.gyroscope.is_some() && found.accelerometer.is_none());
}

#[test]
fn columns_without_names_are_told_by_what_they_do() {
    let s = session();
    let last = table("", |k| {
        let (f, w) = (cells(&s.accel[k], 1.0), cells(&s.gyro[k], 1.0));
        format!("{f},{w},{:.2}", s.t[k])
    });
    is_both(&read(&last).unwrap(), &s);
    // The registers of an MPU-6050: the temperature lies between the sensors.
    let between = table("", |k| {
        let (f, w) = (cells(&s.accel[k], 1.0), cells(&s.gyro[k], 1.0));
        format!("{:.2},{f},{:.2},{w}", s.t[k], 28.0 + 1e-3 * s.t[k])
    });
    let (_, columns) = asked(read(&between));
    let columns = columns.unwrap();
    assert!(columns.contains("temp=5"), "{columns}");
    is_both(&read_with(&between, &columns).unwrap(), &s);
}

#[test]
fn a_table_with_a_time_before_each_sensor_has_two_clocks() {
    let s = session();
    let header = "Time (s),Acceleration x (m/s^2),Acceleration y (m/s^2),Acceleration z (m/s^2),Time (s),Gyroscope x (rad/s),Gyroscope y (rad/s),Gyroscope z (rad/s)";
    let text = table(header, |k| {
        let f = cells(&s.accel[k], 1.0);
        match s.t.get(2 * k) {
            Some(t) => format!("{:.2},{f},{t:.2},{}", s.t[k], cells(&s.gyro[2 * k], 1.0)),
            None => format!("{:.2},{f},NaN,NaN,NaN,NaN", s.t[k]),
        }
    });
    let found = read(&text).unwrap();
    let (accel, gyro) = (found.accelerometer.unwrap(), found.gyroscope.unwrap());
    assert_eq!((accel.len(), gyro.len()), (3200, 1600));
    assert!((gyro.t[1599] - accel.t[3199]).abs() < 0.02);
}

#[test]
fn a_date_beside_decimal_commas_does_not_hide_them() {
    let s = session();
    let text = table("date;time;ax;ay;az;gx;gy;gz", |k| {
        let (f, w) = (cells(&s.accel[k], 1.0), cells(&s.gyro[k], 1.0));
        let row = format!("{:.2},{f},{w}", s.t[k]);
        format!(
            "2026-09-21 10:00:00.000 +0200;{}",
            row.replace(',', ";").replace('.', ",")
        )
    });
    is_both(&read(&text).unwrap(), &s);
}

#[test]
fn what_a_program_says_before_its_rows_is_no_header() {
    let s = session();
    for said in [
        "=~=~=~= PuTTY log 2026.09.21 10:00:00 =~=~=~=",
        "MPU6050 found",
        "--- Miniterm on COM3 ---",
    ] {
        let found = read(&plain(said, &s)).unwrap_or_else(|error| panic!("{said}: {error}"));
        is_both(&found, &s);
    }
}

#[test]
fn counts_without_their_sign_are_told() {
    let s = session();
    let text = table("t,ax,ay,az,gx,gy,gz", |k| {
        let count = |v: f64| (v.round() as i64).rem_euclid(65_536).to_string();
        let force = s.accel[k].map(|v| v / G * 16_384.0);
        let rate = s.gyro[k].map(|v| v.to_degrees() * 131.0);
        let all: Vec<String> = force.iter().chain(rate.iter()).map(|v| count(*v)).collect();
        format!("{:.2},{}", s.t[k], all.join(","))
    });
    let (message, _) = asked(read(&text));
    assert!(message.contains("int16_t"), "{message}");
}

#[test]
fn a_file_per_sensor_is_known_by_its_content() {
    let s = session();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let remove = |name: &str| std::fs::remove_file(folder.path().join(name)).unwrap();
    let read = || Recording::read(folder.path(), &ReadOptions::default());
    let triad = |header: &str, values: &[Vector3<f64>], scale: f64| {
        table(header, |k| {
            format!("{:.2},{}", s.t[k], cells(&values[k], scale))
        })
    };
    // Physics Toolbox, a file per sensor: g, and `gFx` is no gyroscope.
    write("g-force.csv", triad("time,gFx,gFy,gFz", &s.accel, 1.0 / G));
    write("rotation.csv", triad("time,wx,wy,wz", &s.gyro, 1.0));
    is_both(&read().unwrap(), &s);
    // Without names one of two may be the other sensor.
    write("g-force.csv", triad("", &s.accel, 1.0));
    write("rotation.csv", triad("", &s.gyro, 1.0));
    let (message, _) = asked(read());
    assert!(message.contains("--gyro-file"), "{message}");
    remove("rotation.csv");
    remove("g-force.csv");
    // What is worked out lies beside the table of both.
    write(
        "earth.csv",
        triad("Time (s),X (g),Y (g),Z (g)", &s.gyro, 1.0),
    );
    write("sensors.csv", plain("t,ax,ay,az,gx,gy,gz", &s));
    is_both(&read().unwrap(), &s);
}
