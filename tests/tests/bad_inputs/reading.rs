//! What is read of files that are no plain CSV: sensors that are there are found or asked about, units decided by data.

use super::bench::Bench;
use super::containers::{archive, calibrate, imu, sensor, tables};
use super::device::{csv, good};

#[test]
fn a_sensor_that_is_there_and_not_understood_stops_the_run() {
    let text = csv(good());
    let renamed = text.replacen("gx,gy,gz", "foo,bar,baz", 1);
    calibrate("a.csv", &renamed, &[])
        .ends(3)
        .says(&["foo", "baz", "--columns"]);
    calibrate("a.csv", &renamed, &["--columns", "gx=foo,gy=bar,gz=baz"])
        .ends(0)
        .is_silent_on(&["only the accelerometer"]);
    calibrate("a.csv", &renamed, &["--columns", "ax=ax,ay=ay,az=az"])
        .ends(0)
        .says(&["only the accelerometer"]);
    let swapped = text.replacen("ax,ay,az,gx,gy,gz", "gx,gy,gz,ax,ay,az", 1);
    let right = "gx=ax,gy=ay,gz=az,ax=gx,ay=gy,az=gz";
    calibrate("a.csv", &swapped, &[])
        .ends(3)
        .says(&["their names are swapped", right])
        .is_silent_on(&["gravity has been removed"]);
    calibrate("a.csv", &swapped, &["--columns", right]).ends(0);
    let toolbox = text.replacen("t,ax,ay,az,gx,gy,gz", "time,gFx,gFy,gFz,foo,bar,baz", 1);
    calibrate("a.csv", toolbox, &[])
        .ends(3)
        .says(&["foo", "baz"]);
    let keyed: String = good()
        .iter()
        .map(|r| {
            format!(
                "ax:{} ay:{} az:{} p:{} q:{} r:{}\n",
                r[1], r[2], r[3], r[4], r[5], r[6]
            )
        })
        .collect();
    let run = calibrate("a.txt", keyed, &["--rate", "100"]);
    run.is_silent_on(&["only the accelerometer"]);
    let [accel, gyro] = tables();
    let bench = Bench::with("r/Accelerometer.csv", accel);
    bench.write("r/rotation.csv", gyro.replace("(rad/s)", "(1/s)"));
    bench
        .run(&["calibrate", "r"])
        .ends(3)
        .says(&["rotation.csv", "--gyro-file"]);
}

#[test]
fn a_unit_in_the_header_that_the_turns_contradict_is_refused() {
    let text = csv(good()).replacen("gx,gy,gz", "gx (deg/s),gy (deg/s),gz (deg/s)", 1);
    calibrate("a.csv", &text, &[])
        .ends(3)
        .says(&["rad/s", "--gyro-unit"]);
    calibrate("a.csv", &text, &["--gyro-unit", "rad/s"]).ends(0);
}

#[test]
fn info_says_what_is_in_a_file_and_convert_writes_it_plainly() {
    let bench = Bench::with("a.zip", archive(&[]));
    let run = bench.run(&["info", "a.zip", "--json"]);
    let file = &run.ends(0).json()["files"][0];
    assert_eq!(file["format"], "phyphox");
    assert_eq!(file["sensors"][0]["unit"], "m/s^2");
    assert_eq!(file["sensors"][1]["columns"]["gx"], "Gyroscope x (rad/s)");
    assert_eq!(file["command"], "stillpoint calibrate a.zip -o cal.json");
    assert!(
        file["static_intervals"]["count"].as_u64().unwrap() > 5,
        "{file}"
    );
    let words = bench.run(&["info", "a.zip"]);
    for part in [
        "phyphox",
        "accelerometer",
        "rad/s",
        "rate Hz",
        "static intervals: ",
        "to calibrate: ",
    ] {
        assert!(words.stdout.contains(part), "{part}: {words:#?}");
    }
    bench
        .run(&["convert", "a.zip", "-o", "plain"])
        .ends(0)
        .changes(&["acc.csv", "gyro.csv"]);
    let plain = bench.run(&["info", "plain", "--json"]).ends(0).json();
    assert_eq!(
        plain["files"][0]["sensors"][0]["samples"],
        file["sensors"][0]["samples"]
    );
    let written = bench.run(&["convert", "a.zip", "-o", "x.parquet"]);
    match cfg!(feature = "parquet") {
        true => written.ends(0).changes(&["x.parquet"]),
        false => written.ends(2).says(&["parquet"]),
    };
}

#[test]
fn columns_take_signs_factors_and_offsets_in_two_files() {
    let rows = imu();
    let table = |gyro: bool, names: &str| {
        let rows = sensor(&rows, gyro, 1);
        let rows = rows.iter().map(|(t, v)| {
            format!(
                "{},{},{},{},700\n",
                *t as f64 * 1e-9,
                -v[0],
                v[1],
                v[2] * 2.0
            )
        });
        format!("{names}\n{}", rows.collect::<String>())
    };
    let bench = Bench::with("acc.csv", table(false, "s,p,q,r,raw"));
    bench.write("gyro.csv", table(true, "s,u,v,w,raw"));
    let columns = "t=s,ax=-p,ay=q,az=r*0.5,gx=-u,gy=v,gz=w/2,temp=raw*0.01+20";
    let run = bench.run(&[
        "calibrate",
        "--accel-file",
        "acc.csv",
        "--gyro-file",
        "gyro.csv",
        "--columns",
        columns,
        "-o",
        "cal.json",
        "--json",
    ]);
    let found = run.ends(0).json();
    let expected = calibrate("r.csv", csv(good()), &["--json"]).ends(0).json();
    for sensor in ["accelerometer", "gyroscope"] {
        for axis in 0..3 {
            let scale = |cal: &serde_json::Value| cal[sensor]["T"][axis][axis].as_f64().unwrap();
            assert!(
                (scale(&found) - scale(&expected)).abs() < 1e-6,
                "{sensor} {axis}"
            );
        }
    }
}

#[test]
fn a_magnetometer_that_never_changes_is_kept_and_not_calibrated() {
    let rows = good().iter().zip(0..).map(|(r, k)| {
        let field = match k {
            0..10 => "0,0,0".to_owned(),
            k => format!("{},-0.2,0.4", 0.3 + 1e-4 * f64::from(k % 7)),
        };
        format!("{},{field}\n", super::device::line(r))
    });
    let text = format!(
        "t,ax,ay,az,gx,gy,gz,mx (gauss),my (gauss),mz (gauss)\n{}",
        rows.collect::<String>()
    );
    let bench = Bench::with("r.csv", text);
    let run = bench.run(&["calibrate", "r.csv", "--json"]);
    run.ends(0)
        .says(&["the magnetometer is not calibrated"])
        .is_silent_on(&["not used", "only"]);
    let plain = calibrate("r.csv", csv(good()), &["--json"]).json();
    assert_eq!(
        run.json()["accelerometer"]["T"],
        plain["accelerometer"]["T"]
    );
    let info = bench.run(&["info", "r.csv", "--json"]).ends(0).json();
    let field = &info["files"][0]["magnetometer"];
    assert_eq!(field["unit"], "gauss");
    assert_eq!(field["columns"]["my"], "my (gauss)");
    // Readings before the sensor began are none.
    assert_eq!(field["samples"], good().len() as u64 - 10);
    bench
        .run(&["convert", "r.csv", "-o", "plain"])
        .ends(0)
        .changes(&["acc.csv", "gyro.csv", "mag.csv"]);
    bench
        .run(&["convert", "r.csv", "-o", "plain.csv"])
        .ends(0)
        .changes(&["plain.csv"]);
    for converted in ["plain", "plain.csv"] {
        let again = bench.run(&["info", converted, "--json"]).ends(0).json();
        let again = &again["files"][0]["magnetometer"];
        assert_eq!(again["samples"], field["samples"], "{converted}");
        assert_eq!(again["unit"], "gauss", "{converted}");
    }
}

/// A page without its line breaks.
fn one_line(page: &str) -> String {
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_magnetometer_alone_is_described_rightly_and_what_is_missing_is_said() {
    let rows = good()
        .iter()
        .map(|r| format!("{},{},{},{}\n", r[0], 4.0 * r[1], 4.0 * r[2], 4.0 * r[3]));
    let text = format!("t,mx (uT),my (uT),mz (uT)\n{}", rows.collect::<String>());
    let bench = Bench::with("r.csv", text);
    let info = one_line(&bench.run(&["info", "r.csv"]).ends(0).stdout);
    for part in [
        "magnetometer",
        "µT",
        "only the magnetometer",
        "record the accelerometer",
    ] {
        assert!(info.contains(part), "{part}: {info}");
    }
    for part in [
        "only the gyroscope",
        "accelerometer only",
        " inf",
        "static intervals",
    ] {
        assert!(!info.contains(part), "{part}: {info}");
    }
    bench
        .run(&["calibrate", "r.csv"])
        .ends(4)
        .says(&["a magnetometer alone", "record the accelerometer"])
        .is_silent_on(&["gyroscope only", "accelerometer only", "inf s"]);
}

#[test]
fn a_log_of_several_sensors_is_listed_and_not_refused() {
    let stamps = || good().iter().map(|r| (r[0] * 1e9) as i64);
    let rows = |first: usize| -> file_formats::make::Rows {
        let values = good()
            .iter()
            .map(|r| [r[first], r[first + 1], r[first + 2]]);
        stamps().zip(values).collect()
    };
    let (force, rate) = (rows(1), rows(4));
    let topics = [
        ("sensor_accel", 0, &force),
        ("sensor_gyro", 0, &rate),
        ("sensor_accel", 2, &force),
        ("sensor_gyro", 2, &rate),
    ];
    let bench = Bench::with("a.ulg", file_formats::make::ulog(&topics, &[]));
    bench
        .run(&["calibrate", "a.ulg"])
        .ends(3)
        .says(&["--instance 0"]);
    let info = one_line(&bench.run(&["info", "a.ulg"]).ends(0).stdout);
    for part in [
        "sensor_gyro 2",
        "--instance 2",
        "calibrate a.ulg --instance 0",
    ] {
        assert!(info.contains(part), "{part}: {info}");
    }
    let listed = bench.run(&["info", "a.ulg", "--json"]).ends(0).json();
    let streams = listed["files"][0]["streams"].as_array().unwrap();
    // An accelerometer has its thermometer beside it.
    for sensor in ["accelerometer", "gyroscope", "thermometer"] {
        let of = streams.iter().filter(|stream| stream["sensor"] == sensor);
        assert_eq!(of.count(), 2, "{sensor}: {streams:?}");
    }
    bench.run(&["info", "a.ulg", "--instance", "2"]).ends(0);
}

#[test]
fn a_table_of_static_means_may_have_tabs_and_no_names() {
    let means: String = (0..14)
        .map(|k| {
            let (a, b) = (f64::from(k) * 0.9, f64::from(k % 5) - 2.0);
            let up = nalgebra::Vector3::new(a.cos(), a.sin(), b).normalize() * 9.8;
            format!("{:.4}\t{:.4}\t{:.4}\n", up.x, up.y, up.z)
        })
        .collect();
    let bench = Bench::with("means.txt", means);
    bench.write("a.csv", csv(good()));
    let call = [
        "calibrate",
        "a.csv",
        "--static-means",
        "means.txt",
        "--json",
    ];
    let found = bench.run(&call).json();
    assert!(
        found["accelerometer"]["T"][0][0].as_f64().is_some(),
        "{found}"
    );
}
