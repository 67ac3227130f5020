//! Programs of laboratories, vehicles, watches and terminals: names of runs, rows above the rows, clocks of other kinds.

use nalgebra::Vector3;
use stillpoint_recording::{ReadOptions, Recording};

use crate::session::{G, Session, is_it, read, read_as, says, session, table, xyz};

/// A row of seconds, the force in g or m/s² and the rate in °/s or rad/s.
fn row(s: &Session, k: usize, [force, rate]: [f64; 2]) -> String {
    let (force, rate) = (xyz(&s.force[k], force), xyz(&s.rate[k], rate));
    format!("{:.3},{force},{rate}", s.t[k])
}

const IN_SI: [f64; 2] = [1.0, 1.0];
const IN_G: [f64; 2] = [1.0 / G, 180.0 / std::f64::consts::PI];

#[test]
fn the_run_of_an_experiment_is_no_part_of_a_name() {
    let s = session();
    for header in [
        "Run 1: Time (s),Run 1: X-axis acceleration (m/s²),Run 1: Y-axis acceleration (m/s²),Run 1: Z-axis acceleration (m/s²),Run 1: X-axis gyro (rad/s),Run 1: Y-axis gyro (rad/s),Run 1: Z-axis gyro (rad/s)",
        "Time (s) Run #1,Acceleration - x (m/s²) Run #1,Acceleration - y (m/s²) Run #1,Acceleration - z (m/s²) Run #1,Angular Velocity - x (rad/s) Run #1,Angular Velocity - y (rad/s) Run #1,Angular Velocity - z (rad/s) Run #1",
        "Zeit in s,Beschleunigung_x in m/s²,Beschleunigung_y in m/s²,Beschleunigung_z in m/s²,Gyro_x in rad/s,Gyro_y in rad/s,Gyro_z in rad/s",
    ] {
        is_it(&read(&table(header, |k| row(&s, k, IN_SI))), &s, 1e-4);
    }
}

#[test]
fn rows_of_units_and_of_sources_are_no_damage() {
    let s = session();
    let header = "timestamp,x_acc,y_acc,z_acc,x_rate_of_rotation,y_rate_of_rotation,z_rate_of_rotation\nunix time,G,G,G,deg/s,deg/s,deg/s\n,101: acc,101: acc,101: acc,102: gyro,102: gyro,102: gyro";
    let text = table(header, |k| {
        let cells = row(&s, k, IN_G);
        let (_, axes) = cells.split_once(',').unwrap();
        format!("{:.3},{axes}", 1_690_000_000.0 + s.t[k])
    });
    is_it(&read(&text), &s, 1e-4);
    let header = "Shimmer_B5E1_Timestamp_FormattedUnix_CAL,Shimmer_B5E1_Accel_LN_X_CAL,Shimmer_B5E1_Accel_LN_Y_CAL,Shimmer_B5E1_Accel_LN_Z_CAL,Shimmer_B5E1_Gyro_X_CAL,Shimmer_B5E1_Gyro_Y_CAL,Shimmer_B5E1_Gyro_Z_CAL\nyyyy/mm/dd hh:mm:ss.000,m/(s^2),m/(s^2),m/(s^2),deg/s,deg/s,deg/s";
    let text = table(header, |k| {
        let cells = row(&s, k, [1.0, 180.0 / std::f64::consts::PI]);
        let (_, axes) = cells.split_once(',').unwrap();
        format!("2023/07/22 04:26:{:06.3},{axes}", s.t[k])
    });
    is_it(&read(&text), &s, 1e-4);
}

#[test]
fn digits_of_the_day_go_on_over_the_minute() {
    let s = session();
    let text = table("utc_time,ax,ay,az,gx,gy,gz", |k| {
        let since = 26.0 * 60.0 + 40.0 + s.t[k];
        let (minutes, seconds) = ((since / 60.0).floor(), since % 60.0);
        let cells = row(&s, k, IN_SI);
        let (_, axes) = cells.split_once(',').unwrap();
        format!("04{minutes:02.0}{seconds:06.3},{axes}")
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    let t = &found.gyroscope.unwrap().t;
    assert!((t[1599] - t[0] - s.t[1599]).abs() < 2e-3);
}

#[test]
fn tenths_of_microseconds_are_known_by_their_epoch() {
    let s = session();
    for start in [133_344_736_000_000_000_u64, 638_255_968_000_000_000] {
        let text = table("time,ax,ay,az,gx,gy,gz", |k| {
            let cells = row(&s, k, IN_SI);
            let (_, axes) = cells.split_once(',').unwrap();
            format!("{},{axes}", start + 200_000 * k as u64)
        });
        is_it(&read(&text), &s, 1e-4);
    }
}

#[test]
fn rows_below_their_start_and_rate_have_stamps() {
    let s = session();
    let counts = |k: usize| {
        let cell = |v: &f64| format!("{:.0}", v / G * 64.0);
        s.force[k].iter().map(cell).collect::<Vec<_>>().join(",")
    };
    let header =
        "1690000000.000000, 1690000000.000000, 1690000000.000000\n50.000000, 50.000000, 50.000000";
    let found = read(&table(header, counts));
    let force = found.accelerometer.unwrap();
    assert_eq!(force.len(), 1600);
    assert!((force.usual_step().unwrap() - 0.02).abs() < 1e-9);
}

#[test]
fn what_a_terminal_writes_before_a_line_is_its_stamp() {
    let s = session();
    let clock = |k: usize| format!("04:26:{:06.3}", s.t[k]);
    let words = |value: &Vector3<f64>, names: [&str; 3]| {
        let pairs = names.iter().zip(value.iter());
        let pairs: Vec<String> = pairs.map(|(name, v)| format!("{name}:{v:.6}")).collect();
        pairs.join(" ")
    };
    let bracketed = table("", |k| {
        let force = words(&s.force[k], ["ax", "ay", "az"]);
        let rate = words(&s.rate[k], ["gx", "gy", "gz"]);
        format!("[2023-07-22 {}] {force} {rate}", clock(k))
    });
    is_it(&read(&bracketed), &s, 1e-4);
    let blocks = table("", |k| {
        let ([x, y, z], [p, q, r]) = (s.force[k].into(), s.rate[k].into());
        let (x, y, z, p, q, r): (f64, f64, f64, f64, f64, f64) = (x, y, z, p, q, r);
        format!(
            "{0} -> Accel X: {x:.6}\tY: {y:.6}\tZ: {z:.6} m/s^2\n{0} -> Gyro X: {p:.6}\tY: {q:.6}\tZ: {r:.6} radians/s",
            clock(k)
        )
    });
    is_it(&read(&blocks), &s, 1e-4);
    let objects = table("", |k| {
        let (force, rate) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
        format!("{} -> {{\"acc\": [{force}], \"gyr\": [{rate}]}}", clock(k))
    });
    is_it(&read(&objects), &s, 1e-4);
}

#[test]
fn a_magnetometer_beside_is_used_or_named() {
    let s = session();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, header: &str, of: &[Vector3<f64>]| {
        let text = table(header, |k| format!("{:.3},{}", s.t[k], xyz(&of[k], 1.0)));
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    write("rec_ACC.csv", "timestamp,acc_x,acc_y,acc_z", &s.force);
    write("rec_GYRO.csv", "timestamp,gyr_x,gyr_y,gyr_z", &s.rate);
    let read = || Recording::read(folder.path(), &ReadOptions::default()).unwrap();
    write("rec_MAG.csv", "timestamp,mag_x,mag_y,mag_z", &s.field);
    assert!(read().magnetometer.is_some());
    write("rec_MAG.csv", "", &s.field);
    assert!(read().magnetometer.is_some());
    write("rec_MAG.csv", "timestamp,p,q,r", &s.field);
    let found = read();
    assert!(found.magnetometer.is_none());
    says(
        &found.warnings.texts(findings::Front::CommandLine),
        "rec_MAG.csv",
    );
}

#[test]
fn of_two_times_the_one_that_tells_the_rows_apart_is_taken() {
    let s = session();
    for fine in ["millis", "elapsed_ms", "Time since start in ms"] {
        let header = format!("timestamp,{fine},ax,ay,az,gx,gy,gz");
        // A card is written to by fits and starts.
        let late = |k: usize| 4 * (k % 7 == 3) as u64;
        let text = table(&header, |k| {
            let cells = row(&s, k, IN_SI);
            let (_, axes) = cells.split_once(',').unwrap();
            let ms = (1e3 * s.t[k]).round() as u64 + late(k);
            format!("2023-07-22 04:26:{:02},{ms},{axes}", s.t[k] as u64)
        });
        let found = read(&text);
        let t = &found.gyroscope.unwrap().t;
        assert!(
            (t[3] - t[0] - 0.064).abs() < 1e-9,
            "{fine}: {}",
            t[3] - t[0]
        );
    }
}

#[test]
fn each_file_of_a_folder_has_stamps_in_its_own_unit() {
    let s = session();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, header: &str, of: &[Vector3<f64>], unit: f64| {
        let text = table(header, |k| {
            format!("{:.3},{}", unit * s.t[k], xyz(&of[k], 1.0))
        });
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    write("acc.csv", "t,ax,ay,az", &s.force, 1e3);
    write("gyro.csv", "t,gx,gy,gz", &s.rate, 1.0);
    let found = Recording::read(folder.path(), &ReadOptions::default()).unwrap();
    is_it(&found, &s, 1e-4);
}

#[test]
fn the_name_of_a_section_is_no_row() {
    let s = session();
    let header = "File created by a logger\n\n[column names]\ntime ax ay az gx gy gz\n\n[data]";
    let text = table(header, |k| row(&s, k, IN_SI).replace(',', " "));
    is_it(&read(&text), &s, 1e-4);
}

#[test]
fn acceleration_in_the_frame_of_the_earth_is_named_as_lacking_gravity() {
    let s = session();
    let text = table("t,FreeAcc_E,FreeAcc_N,FreeAcc_U,Gyr_X,Gyr_Y,Gyr_Z", |k| {
        row(&s, k, [1e-3, 1.0])
    });
    let error = read_as(&text, &ReadOptions::default()).unwrap_err();
    let words = error.text(findings::Front::CommandLine);
    assert!(words.contains("without gravity"), "{words}");
}

#[test]
fn the_text_of_an_ardupilot_log_is_read_as_corrected() {
    let s = session();
    let header = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\nFMT, 131, 43, IMU, Qffffff, TimeUS,GyrX,GyrY,GyrZ,AccX,AccY,AccZ\nPARM, 1000, INS_GYROFFS_X, 0.01";
    let text = table(header, |k| {
        let (force, rate) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
        format!(
            "IMU, {:.0}, {rate}, {force}\nATT, 1000, 0.1, 0.2",
            s.t[k] * 1e6
        )
    });
    let found = read(&text);
    is_it(&found, &s, 1e-4);
    let corrected = findings::Kind::CORRECTED_BY_SYSTEM;
    assert!(found.warnings.iter().any(|own| own.kind == corrected));
}

#[test]
fn the_samples_of_a_cameras_streams_are_read() {
    let s = session();
    let stream = |values: &[Vector3<f64>], unit: &str| {
        let sample = |k: usize| {
            // The order is that of the stream's name.
            let value = xyz(&Vector3::new(values[k].z, values[k].x, values[k].y), 1.0);
            format!(
                "{{\"value\":[{value}],\"cts\":{:.1},\"date\":\"2026-05-01T12:00:00.000Z\"}}",
                s.t[k] * 1e3
            )
        };
        let samples: Vec<String> = (0..1600).map(sample).collect();
        format!(
            "{{\"samples\":[{}],\"name\":\"Sensor (z,x,y)\",\"units\":\"{unit}\"}}",
            samples.join(",")
        )
    };
    let text = format!(
        "{{\"1\":{{\"streams\":{{\"ACCL\":{},\"GYRO\":{}}},\"device name\":\"HERO9\"}},\"frames/second\":29.97}}",
        stream(&s.force, "m/s2"),
        stream(&s.rate, "rad/s"),
    );
    let found = Recording::from_bytes("a.json", text.as_bytes(), &ReadOptions::default());
    is_it(&found.unwrap(), &s, 1e-4);
}

#[test]
fn a_rate_above_rows_without_stamps_is_the_one_that_is_asked_for() {
    let s = session();
    let header = "# range 4 g\n# Sample rate: 50.0Hz\nax,ay,az,gx,gy,gz";
    let text = table(header, |k| {
        let cells = row(&s, k, IN_SI);
        cells.split_once(',').unwrap().1.to_owned()
    });
    let refused = read_as(&text, &ReadOptions::default()).unwrap_err();
    let words = refused.text(findings::Front::CommandLine);
    assert!(words.contains("--rate 50"), "{words}");
}
