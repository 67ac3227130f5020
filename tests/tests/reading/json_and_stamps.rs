//! One recording as JSON and as texts with stamps in brackets, in two columns and in days: read as the plain table is.

use std::fmt::Write as _;

use calib::recording::{ReadOptions, TimeUnit};
use calib::{Error, Recording};
use nalgebra::Vector3;
use stillpoint_tests::layouts::Samples;

fn read(name: &str, text: &str, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::from_bytes(name, text.as_bytes().to_vec(), options)
}

/// A row per reading of both sensors, `end` behind each but the last.
fn rows(
    samples: &Samples,
    end: &str,
    row: impl Fn(f64, Vector3<f64>, Vector3<f64>) -> String,
) -> String {
    let all = samples.accel.t.iter().zip(&samples.accel.values);
    let all = all.zip(&samples.together);
    let all: Vec<String> = all.map(|((t, f), w)| row(*t, *f, *w)).collect();
    all.join(end)
}

fn same(found: &Recording, samples: &Samples) {
    let pairs = [
        (found.accelerometer.as_ref(), &samples.accel.values),
        (found.gyroscope.as_ref(), &samples.together),
    ];
    for (found, expected) in pairs {
        let found = found.expect("both sensors");
        assert_eq!(found.len(), expected.len());
        let worst = found
            .values
            .iter()
            .zip(expected)
            .map(|(a, b)| (a - b).amax());
        assert!(worst.fold(0.0, f64::max) < 1e-9);
        let (from, to) = (samples.accel.t[0], samples.accel.t.last().unwrap());
        let duration = found.t.last().unwrap() - found.t[0];
        assert!((duration - (to - from)).abs() < 2e-3, "{duration}");
    }
}

fn triad(v: Vector3<f64>) -> String {
    format!("{},{},{}", v.x, v.y, v.z)
}

#[test]
fn json_of_records_and_of_columns_is_the_table_that_it_is() {
    let samples = Samples::of_session();
    let named = |v: Vector3<f64>| format!("{{\"x\":{},\"y\":{},\"z\":{}}}", v.x, v.y, v.z);
    let lists = |t: f64, f, w| {
        format!(
            "{{\"t\": {t}, \"acc\": [{}], \"gyro\": [{}]}}",
            triad(f),
            triad(w)
        )
    };
    let within = |t: f64, f, w| {
        format!(
            "{{\"time_ms\": {}, \"imu\": {{\"accelerometer\": {}, \"gyroscope\": {}}}}}",
            1e3 * t,
            named(f),
            named(w)
        )
    };
    let lines = rows(&samples, "\n", lists);
    let array = format!("[{}]", rows(&samples, ",\n", within));
    let document = format!(
        "{{\"rate\": 100, \"data\": [{}]}}",
        rows(&samples, ",", lists)
    );
    let list = |of: &dyn Fn(f64, Vector3<f64>, Vector3<f64>) -> String| rows(&samples, ",", of);
    let columns = format!(
        "{{\"time\": [{}], \"accel\": [{}], \"gyro\": [{}]}}",
        list(&|t, _, _| t.to_string()),
        list(&|_, f, _| format!("[{}]", triad(f))),
        list(&|_, _, w| format!("[{}]", triad(w)))
    );
    for text in [lines, array, document, columns] {
        let found = read("r.json", &text, &ReadOptions::default()).unwrap();
        same(&found, &samples);
        assert_eq!(found.description.format, "json");
    }
}

#[test]
fn json_that_lacks_a_sensor_by_name_is_asked_about() {
    let samples = Samples::of_session();
    let text = rows(&samples, "\n", |t, f, w| {
        format!(
            "{{\"t\": {t}, \"acc\": [{}], \"foo\": [{}]}}",
            triad(f),
            triad(w)
        )
    });
    let words = read("r.json", &text, &ReadOptions::default()).unwrap_err();
    assert!(words.to_string().contains("gx=foo.x"), "{words}");
}

#[test]
fn stamps_in_brackets_and_in_two_columns_are_read() {
    let samples = Samples::of_session();
    let clock = |t: f64| {
        let (whole, rest) = (t as u64, t.fract());
        let seconds = (whole % 60) as f64 + rest;
        format!("12:{:02}:{seconds:07.4}", whole / 60)
    };
    let bracketed =
        |t: f64, f, w| format!("[{t:10.4}] {},{}", triad(f), triad(w)).replace(',', " ");
    let dated = |t: f64, f, w| format!("[2026-05-01 {}] {},{}", clock(t), triad(f), triad(w));
    let timed =
        |t: f64, f, w| format!("[{}]\t{},{}", clock(t), triad(f), triad(w)).replace(',', "\t");
    let apart = |t: f64, f, w| {
        format!("01.05.2026;{};{},{}", clock(t), triad(f), triad(w)).replace(',', ";")
    };
    let header = "ax\tay\taz\tgx\tgy\tgz\n";
    let split = "Datum;Uhrzeit;ax;ay;az;gx;gy;gz\n";
    let usual = ReadOptions::default();
    let apart = format!("{split}{}", rows(&samples, "\n", apart));
    // Day or month first is not guessed.
    let words = read("r.log", &apart, &usual)
        .unwrap_err()
        .text(findings::Front::CommandLine);
    assert!(words.contains("--time-format"), "{words}");
    let day_first = ReadOptions {
        time_format: Some("%d.%m.%Y %H:%M:%S%.f".to_owned()),
        ..ReadOptions::default()
    };
    for (text, how) in [
        (rows(&samples, "\n", bracketed), &usual),
        (rows(&samples, "\n", dated), &usual),
        (format!("{header}{}", rows(&samples, "\n", timed)), &usual),
        (apart, &day_first),
    ] {
        let found = read("r.log", &text, how);
        same(
            &found.unwrap_or_else(|error| panic!("{error}\n{}", &text[..200])),
            &samples,
        );
    }
}

#[test]
fn minutes_and_days_are_units_of_time() {
    let samples = Samples::of_session();
    let minutes = |t: f64, f, w| format!("{:.9},{},{}", t / 60.0, triad(f), triad(w));
    let text = format!(
        "time (min),ax,ay,az,gx,gy,gz\n{}",
        rows(&samples, "\n", minutes)
    );
    same(
        &read("r.csv", &text, &ReadOptions::default()).unwrap(),
        &samples,
    );
    let days = |t: f64, f, w| format!("{:.9},{},{}", 45_000.5 + t / 86_400.0, triad(f), triad(w));
    let text = format!("Time,ax,ay,az,gx,gy,gz\n{}", rows(&samples, "\n", days));
    let asked = read("r.csv", &text, &ReadOptions::default()).unwrap_err();
    let asked = asked.text(findings::Front::CommandLine);
    assert!(asked.contains("--time-unit d"), "{asked}");
    let options = ReadOptions {
        time_unit: Some(TimeUnit::Days),
        ..ReadOptions::default()
    };
    same(&read("r.csv", &text, &options).unwrap(), &samples);
    // A minimum is no time in minutes.
    let mut text = "t,ax,ay,az,gx,gy,gz,ax_min\n".to_owned();
    let _ = write!(
        text,
        "{}",
        rows(&samples, "\n", |t, f, w| format!(
            "{t},{},{},0",
            triad(f),
            triad(w)
        ))
    );
    same(
        &read("r.csv", &text, &ReadOptions::default()).unwrap(),
        &samples,
    );
}

#[test]
fn quoted_decimal_commas_and_rows_named_by_r_are_read() {
    let samples = Samples::of_session();
    let quoted = |t: f64, f, w| {
        let row = format!("{t},{},{}", triad(f), triad(w));
        format!("\"{}\"", row.replace(',', "\";\"").replace(['.', ';'], ","))
    };
    let header = "\"t\",\"ax\",\"ay\",\"az\",\"gx\",\"gy\",\"gz\"\n";
    let text = format!("{header}{}", rows(&samples, "\n", quoted));
    same(
        &read("r.csv", &text, &ReadOptions::default()).unwrap(),
        &samples,
    );
    let text = rows(&samples, "\n", |t, f, w| {
        format!("{t},{},{}", triad(f), triad(w)).replace(',', " ")
    });
    let numbered = text
        .lines()
        .zip(1..)
        .map(|(row, at)| format!("\"{at}\" {row}\n"));
    let text = format!(
        "{}{}",
        header.replace(',', " "),
        numbered.collect::<String>()
    );
    same(
        &read("r.txt", &text, &ReadOptions::default()).unwrap(),
        &samples,
    );
}

#[test]
fn the_columns_that_are_proposed_are_those_of_both_sensors() {
    let samples = Samples::of_session();
    let twice = |t: f64, f, w| format!("{t},{},{},{},{}", triad(f), triad(w), triad(f), triad(w));
    let names = ["ax", "ay", "az", "gx", "gy", "gz"];
    let of = |imu: &str| names.map(|name| format!("{imu}_{name}")).join(",");
    let text = format!(
        "t,{},{}\n{}",
        of("IMU1"),
        of("IMU2"),
        rows(&samples, "\n", twice)
    );
    let words = read("r.csv", &text, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(words.contains("az=IMU1_az,gx=IMU1_gx"), "{words}");
}

#[test]
fn stamps_of_1024_ticks_in_a_second_are_a_doubt_of_the_calibration() {
    use calib::calibrate::{Request, calibrate};
    let samples = Samples::of_session();
    let rows = samples.accel.t.iter().zip(&samples.accel.values);
    let of = |per_second: f64| {
        let mut text = "stamp,ax,ay,az,gx,gy,gz\n".to_owned();
        for ((t, f), w) in rows.clone().zip(&samples.together) {
            let stamp = (t * per_second).round();
            text += &format!(
                "{stamp},{:.6},{:.6},{:.6},{:.8},{:.8},{:.8}\n",
                f.x, f.y, f.z, w.x, w.y, w.z
            );
        }
        let read = Recording::from_bytes("a.csv", text.into_bytes(), &ReadOptions::default());
        let outcome = calibrate(&[read.unwrap()], &[], &Request::default()).unwrap();
        outcome.calibration.findings()
    };
    let kind = findings::Kind::CLOCK_OF_TICKS;
    let found = of(1024.0);
    let doubt = found.iter().find(|own| own.kind == kind).unwrap();
    let words = doubt.text(findings::Front::CommandLine);
    assert!(words.contains("--columns t=stamp/1024"), "{words}");
    assert!(!of(1000.0).has(kind));
}
