//! Files of programs met in the field: what they hold is read as it was meant, or what is missing is said with the option
//! that helps.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::fmt::Write as _;

use file_formats::make::{Rows, ulog};
use nalgebra::{Rotation3, Unit, Vector3};
use stillpoint_recording::{Error, FieldUnit, ReadOptions, Recording};

const G: f64 = 9.80665;

/// What a device read: eight rests and the turns between them, 50 Hz.
struct Session {
    t: Vec<f64>,
    force: Vec<Vector3<f64>>,
    rate: Vec<Vector3<f64>>,
    field: Vec<Vector3<f64>>,
}

fn session() -> Session {
    let mut session = Session {
        t: Vec::new(),
        force: Vec::new(),
        rate: Vec::new(),
        field: Vec::new(),
    };
    let mut attitude = Rotation3::identity();
    for place in 0..8_i32 {
        let axis = Unit::new_normalize(Vector3::new(1.0, f64::from(place % 3) - 1.0, 0.3));
        for k in 0..200 {
            let speed = if k < 100 { 0.0 } else { 0.6 };
            let noise = Vector3::from_fn(|i, _| 1e-3 * (f64::from(k * 5) + 2.0 * i as f64).sin());
            attitude = Rotation3::from_axis_angle(&axis, -speed * 0.02) * attitude;
            session.t.push(f64::from(place * 200 + k) * 0.02);
            session.force.push(attitude * Vector3::z() * G + noise);
            session.rate.push(axis.into_inner() * speed + 0.1 * noise);
            let field = attitude * Vector3::new(20.0, 0.0, -40.0);
            session.field.push(field + 100.0 * noise);
        }
    }
    session
}

/// Three numbers with so many digits, times a factor.
fn xyz(value: &Vector3<f64>, scale: f64) -> String {
    let cell = |v: &f64| format!("{:.6}", v * scale);
    value.iter().map(cell).collect::<Vec<_>>().join(",")
}

fn table(header: &str, row: impl Fn(usize) -> String) -> String {
    let mut text = match header {
        "" => String::new(),
        header => format!("{header}\n"),
    };
    for k in 0..1600 {
        let _ = writeln!(text, "{}", row(k));
    }
    text
}

fn read_as(text: &str, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::from_bytes("a.csv", text.as_bytes(), options)
}

fn read(text: &str) -> Recording {
    read_as(text, &ReadOptions::default()).unwrap()
}

/// The recording is the session, to what its digits leave.
#[track_caller]
fn is_it(found: &Recording, s: &Session, tolerance: f64) {
    let (force, rate) = (
        found.accelerometer.as_ref().unwrap(),
        found.gyroscope.as_ref().unwrap(),
    );
    assert_eq!((force.len(), rate.len()), (1600, 1600));
    for k in [0, 150, 799, 1501] {
        assert!(
            (force.values[k] - s.force[k]).amax() < tolerance,
            "{k}: {} {}",
            force.values[k],
            s.force[k]
        );
        assert!(
            (rate.values[k] - s.rate[k]).amax() < tolerance,
            "{k}: {} {}",
            rate.values[k],
            s.rate[k]
        );
        assert!((force.t[k] - force.t[0] - s.t[k]).abs() < 2e-3, "{k}");
    }
}

#[track_caller]
fn says(warnings: &[String], words: &str) {
    assert!(
        warnings.iter().any(|w| w.contains(words)),
        "{words}: {warnings:?}"
    );
}

/// What moves beside gravity, in the unit of the file.
fn shaken(k: usize) -> Vector3<f64> {
    Vector3::new(0.01, -0.02, 0.03) * (k as f64 * 0.3).sin()
}

#[test]
fn gravity_and_the_rest_of_the_acceleration_are_added_with_the_sign_of_their_system() {
    let s = session();
    // Apple counts -1 g on the axis that points up.
    let header = "timestamp,gravity.x,gravity.y,gravity.z,rotationRate.x,rotationRate.y,rotationRate.z,userAcceleration.x,userAcceleration.y,userAcceleration.z";
    let apple = table(header, |k| {
        let user = shaken(k);
        let gravity = -s.force[k] / G - user;
        format!(
            "{:.3},{},{},{}",
            s.t[k],
            xyz(&gravity, 1.0),
            xyz(&s.rate[k], 1.0),
            xyz(&user, 1.0)
        )
    });
    let found = read(&apple);
    is_it(&found, &s, 1e-4);
    says(&found.warnings, "is the sum of `userAcceleration.x`");
    assert!(found.description.sensors[0].turned);
    let header = "t,linearAccelerationX,linearAccelerationY,linearAccelerationZ,gyroX,gyroY,gyroZ,gravityX,gravityY,gravityZ";
    let android = table(header, |k| {
        let linear = shaken(k) * G;
        let gravity = s.force[k] - linear;
        format!(
            "{:.3},{},{},{}",
            s.t[k],
            xyz(&linear, 1.0),
            xyz(&s.rate[k], 1.0),
            xyz(&gravity, 1.0)
        )
    });
    let found = read(&android);
    is_it(&found, &s, 1e-4);
    assert!(!found.description.sensors[0].turned);
    // ROS calls what the accelerometer reads its linear acceleration.
    let ros = android.lines().enumerate().map(|(k, line)| match k {
        0 => format!("{line}\n"),
        k => {
            let cells: Vec<&str> = line.split(',').collect();
            format!(
                "{},{},{},{}\n",
                cells[0],
                xyz(&s.force[k - 1], 1.0),
                cells[4..7].join(","),
                cells[7..].join(",")
            )
        }
    });
    let found = read(&ros.collect::<String>());
    is_it(&found, &s, 1e-4);
    says(&found.warnings, "holds gravity already");
}

#[test]
fn what_a_user_names_as_the_accelerometer_is_not_added_to() {
    let s = session();
    let header = "t,gravityX,gravityY,gravityZ,userAccelerationX,userAccelerationY,userAccelerationZ,p,q,r,gx,gy,gz";
    let text = table(header, |k| {
        let zero = Vector3::zeros();
        format!(
            "{:.3},{},{},{},{}",
            s.t[k],
            xyz(&zero, 1.0),
            xyz(&zero, 1.0),
            xyz(&s.force[k], 1.0),
            xyz(&s.rate[k], 1.0)
        )
    });
    let options = ReadOptions {
        columns: "ax=p,ay=q,az=r".parse().unwrap(),
        ..ReadOptions::default()
    };
    is_it(&read_as(&text, &options).unwrap(), &s, 1e-4);
}

#[test]
fn temperatures_in_counts_are_never_degrees_and_the_offered_line_makes_them_so() {
    let s = session();
    for (name, counts, celsius) in [
        ("temp", -2220, 30.0),
        ("temperature", 1000, 39.5),
        ("temp (raw)", 20, 36.6),
        ("Temp", -8000, 13.0),
    ] {
        let text = table(&format!("t,ax,ay,az,gx,gy,gz,{name}"), |k| {
            format!(
                "{:.3},{},{},{}",
                s.t[k],
                xyz(&s.force[k], 1.0),
                xyz(&s.rate[k], 1.0),
                counts + k as i32 / 50
            )
        });
        let found = read(&text);
        assert!(found.temperature.is_none(), "{name}");
        let said = found
            .warnings
            .iter()
            .find(|w| w.contains("left out"))
            .unwrap();
        assert!(said.contains("MPU-6050"), "{said}");
        let (_, line) = said.split_once("--columns '").unwrap();
        let (line, _) = line.split_once('\'').unwrap();
        let options = ReadOptions {
            columns: line.parse().unwrap(),
            ..ReadOptions::default()
        };
        let found = read_as(&text, &options).unwrap();
        is_it(&found, &s, 1e-4);
        assert!(
            (found.temperature.unwrap().celsius[0] - celsius).abs() < 0.1,
            "{name}"
        );
    }
}

#[test]
fn a_magnetometer_is_read_by_many_names_and_what_is_not_read_is_said() {
    let s = session();
    let text = |names: &str| {
        table(&format!("t,ax,ay,az,gx,gy,gz,{names}"), |k| {
            format!(
                "{:.3},{},{},{}",
                s.t[k],
                xyz(&s.force[k], 1.0),
                xyz(&s.rate[k], 1.0),
                xyz(&s.field[k], 1.0)
            )
        })
    };
    for (names, unit) in [
        ("mx_uT,my_uT,mz_uT", Some(FieldUnit::Microtesla)),
        ("mx (nT),my (nT),mz (nT)", Some(FieldUnit::Nanotesla)),
        (
            "mag_x_gauss,mag_y_gauss,mag_z_gauss",
            Some(FieldUnit::Gauss),
        ),
        ("mag_uT_x,mag_uT_y,mag_uT_z", Some(FieldUnit::Microtesla)),
        ("mag_x_T,mag_y_T,mag_z_T", Some(FieldUnit::Tesla)),
        ("magX,magY,magZ", None),
        ("mag[0],mag[1],mag[2]", None),
        (
            "magnetic_x [mG],magnetic_y [mG],magnetic_z [mG]",
            Some(FieldUnit::Milligauss),
        ),
        (
            "MagneticField X (mT),MagneticField Y (mT),MagneticField Z (mT)",
            Some(FieldUnit::Millitesla),
        ),
        ("compass_x (raw),compass_y (raw),compass_z (raw)", None),
        ("x_mag,y_mag,z_mag", None),
    ] {
        let found = read(&text(names));
        is_it(&found, &s, 1e-4);
        let field = found.magnetometer.unwrap_or_else(|| panic!("{names}"));
        assert_eq!(field.unit, unit, "{names}");
        assert!(
            (field.stream.values[0] - s.field[0]).amax() < 1e-4,
            "{names}"
        );
    }
    let odd = text("hmc_mag_a_x,hmc_mag_a_y,hmc_mag_a_z");
    let found = read(&odd);
    assert!(found.magnetometer.is_none());
    says(
        &found.warnings,
        "--columns 'mx=hmc_mag_a_x,my=hmc_mag_a_y,mz=hmc_mag_a_z' reads them",
    );
    let options = ReadOptions {
        columns: "mx=hmc_mag_a_x,my=hmc_mag_a_y,mz=hmc_mag_a_z"
            .parse()
            .unwrap(),
        mag_unit: Some(FieldUnit::Gauss),
        ..ReadOptions::default()
    };
    let found = read_as(&odd, &options).unwrap();
    is_it(&found, &s, 1e-4);
    assert_eq!(found.magnetometer.unwrap().unit, Some(FieldUnit::Gauss));
    let counts = ReadOptions {
        mag_unit: Some(FieldUnit::Counts),
        ..ReadOptions::default()
    };
    let found = read_as(&text("mx (uT),my (uT),mz (uT)"), &counts).unwrap();
    assert_eq!(found.magnetometer.unwrap().unit, None);
    says(
        &found.warnings,
        "--mag-unit counts is used, though the file says µT",
    );
}

#[test]
fn a_magnetometer_alone_is_called_so() {
    let s = session();
    let found = read(&table("t,mx (uT),my (uT),mz (uT)", |k| {
        format!("{:.3},{}", s.t[k], xyz(&s.field[k], 1.0))
    }));
    assert!(found.is_magnetometer_only());
    assert_eq!(found.start(), 0.0);
    assert_eq!(
        found.warnings,
        ["no accelerometer and no gyroscope: magnetometer only"]
    );
    let warm = read(&table("t,mx,my,mz,temp", |k| {
        format!("{:.3},{},25.0", s.t[k], xyz(&s.field[k], 1.0))
    }));
    assert!(warm.is_magnetometer_only());
}

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
        .to_string();
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
    assert_eq!(contents.first_option(), Some("--instance 0"));
    let options: Vec<_> = contents
        .streams
        .iter()
        .map(|s| (s.sensor, s.option.clone().unwrap_or_default()))
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
