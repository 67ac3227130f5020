//! Rows, names and stamps in other layouts: read as the plain table is, or refused where they may be another.

use findings::Front;
use stillpoint_recording::ReadOptions;

use crate::session::{G, Session, is_it, read, read_as, session, table, xyz};

const NAMES: [&str; 7] = ["t", "ax", "ay", "az", "gx", "gy", "gz"];

/// The cells of a row: time, force, rate.
fn cells(s: &Session, k: usize) -> Vec<String> {
    let (f, w) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
    let row = format!("{:.2},{f},{w}", s.t[k]);
    row.split(',').map(str::to_owned).collect()
}

/// Milliseconds of a sample, from half a minute past noon on.
fn after_noon(s: &Session, k: usize) -> [u64; 3] {
    let ms = 30_000 + (1e3 * s.t[k]).round() as u64;
    [ms / 60_000, ms / 1000 % 60, ms % 1000]
}

/// A table whose rows begin with these cells.
fn stamped(header: &str, s: &Session, stamp: impl Fn([u64; 3]) -> String) -> String {
    table(&format!("{header},ax,ay,az,gx,gy,gz"), |k| {
        format!("{},{}", stamp(after_noon(s, k)), cells(s, k)[1..].join(","))
    })
}

#[track_caller]
fn is_read_as(format: &str, text: &str, s: &Session) {
    let options = ReadOptions::default();
    let found = read_as(text, &options).unwrap_or_else(|error| {
        let start: String = text.chars().take(200).collect();
        panic!("{}\n{start}", error.text(Front::CommandLine))
    });
    is_it(&found, s, 1e-4);
    assert_eq!(found.description.format, format);
}

#[track_caller]
fn refused(text: &str) -> String {
    let error = read_as(text, &ReadOptions::default()).expect_err("refused");
    error.text(Front::CommandLine)
}

#[test]
fn dates_without_marks_or_with_other_marks_are_stamps() {
    let s = session();
    type Stamp<'a> = &'a dyn Fn([u64; 3]) -> String;
    let packed: [Stamp<'_>; 6] = [
        &|[m, s, ms]| format!("20260501T12{m:02}{s:02}.{ms:03}"),
        &|[m, s, ms]| format!("2026050112{m:02}{s:02}.{ms:03}"),
        &|[m, s, ms]| format!("2026050112{m:02}{s:02}{ms:03}"),
        &|[m, s, ms]| format!("26050112{m:02}{s:02}{ms:03}"),
        &|[m, s, ms]| format!("2026-05-01_12-{m:02}-{s:02}-{ms:03}"),
        &|[m, s, ms]| format!("2026.05.01 12:{m:02}:{s:02}.{ms:03}"),
    ];
    for stamp in packed {
        is_read_as("csv", &stamped("time", &s, stamp), &s);
    }
    // Of a day and a month that may be each other the time of day is known, over midnight too.
    let days = |after: u64, ms: u64| {
        let (day, seconds) = ((ms / 1000 + after) / 86_400, (ms / 1000 + after) % 86_400);
        let (minutes, seconds) = (seconds / 60, seconds % 60);
        format!(
            "{:02}05{:02}{:02}{seconds:02}{:03}",
            day + 1,
            minutes / 60,
            minutes % 60,
            ms % 1000
        )
    };
    for year in ["26", "2026"] {
        let stamp = |[m, s, ms]: [u64; 3]| {
            let all = days(86_380, (60 * m + s) * 1000 + ms);
            format!("{}{year}{}", &all[..4], &all[4..])
        };
        is_it(&read(&stamped("time", &s, stamp)), &s, 1e-4);
    }
    let of_the_hour = |[m, s, ms]: [u64; 3]| format!("{m:02}:{s:02}:{ms:03}");
    is_read_as("time_of_day", &stamped("time", &s, of_the_hour), &s);
    // Who says the format reads the digits themselves.
    let options = ReadOptions {
        time_format: Some("%Y%m%d%H%M%S%.f".to_owned()),
        ..ReadOptions::default()
    };
    let said = stamped("time", &s, packed[1]);
    is_it(&read_as(&said, &options).unwrap(), &s, 1e-4);
    // Days and months that may be each other, and parts that may be of anything.
    let refusals: [Stamp<'_>; 2] = [
        &|[m, s, ms]| format!("01.05.2026 12:{m:02}:{s:02}.{ms:03}"),
        &|[m, s, ms]| format!("2026-05-01_12-{m:02}-{s:02}-{ms}"),
    ];
    for stamp in refusals {
        refused(&stamped("time", &s, stamp));
    }
}

#[test]
fn a_column_per_field_of_the_clock_is_one_stamp() {
    let s = session();
    let of_day = |[m, s, ms]: [u64; 3]| format!("12,{m},{s}.{ms:03}");
    is_read_as(
        "clock_columns",
        &stamped("hour,minute,second", &s, of_day),
        &s,
    );
    let counted = |[m, s, ms]: [u64; 3]| format!("{m},{s},{ms}");
    is_read_as("clock_columns", &stamped("min,sec,ms", &s, counted), &s);
    let goes_on = |[m, s, ms]: [u64; 3]| format!("{m},{}.{ms:03}", 60 * m + s);
    is_read_as("clock_columns", &stamped("min,sec", &s, goes_on), &s);
    // Hundredths that are called milliseconds.
    let hundredths = |[m, s, ms]: [u64; 3]| format!("{m},{s},{}", ms / 10);
    refused(&stamped("min,sec,ms", &s, hundredths));
}

#[test]
fn names_in_two_rows_are_those_of_sensors_and_axes() {
    let s = session();
    let row = |k| cells(&s, k).join(",");
    for header in [
        ",acc,acc,acc,gyro,gyro,gyro\ntime,x,y,z,x,y,z",
        "sensor,acc,,,gyro,,\naxis,x,y,z,x,y,z\ntime,,,,,,",
    ] {
        is_read_as("two_headers", &table(header, row), &s);
    }
    // Numbers of rows are no stamps.
    let numbered = table(",acc,acc,acc,gyro,gyro,gyro\n,x,y,z,x,y,z", |k| {
        format!("{k},{}", cells(&s, k)[1..].join(","))
    });
    refused(&numbered);
}

#[test]
fn frames_around_rows_are_taken_off() {
    let s = session();
    let strokes = |cells: &[String]| format!("| {} |", cells.join(" | "));
    let names = NAMES.map(str::to_owned);
    let rule = format!("|{}", "---|".repeat(NAMES.len()));
    let header = format!("{}\n{rule}", strokes(&names));
    is_read_as("csv", &table(&header, |k| strokes(&cells(&s, k))), &s);
    let tuples = table(&NAMES.join(","), |k| {
        format!("({})", cells(&s, k).join(", "))
    });
    is_read_as("csv", &tuples, &s);
}

#[test]
fn letters_that_say_the_sensor_are_no_units() {
    let s = session();
    let long = |accel: &str, gyro: &str, units: [&str; 2]| {
        table("t,sensor,x,y,z,unit", |k| {
            let (f, w) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0));
            let [of_accel, of_gyro] = units;
            let t = s.t[k];
            format!("{t:.2},{accel},{f},{of_accel}\n{t:.2},{gyro},{w},{of_gyro}")
        })
    };
    is_read_as("long", &long("a", "g", ["x", "x"]), &s);
    is_read_as("long", &long("ACCE", "GYRO", ["x", "x"]), &s);
    // Gravity is no rate.
    let gravity = table("t,sensor,x,y,z", |k| {
        let (t, f) = (s.t[k], xyz(&s.force[k], 1.0));
        format!("{t:.2},a,{f}\n{t:.2},g,{}", xyz(&s.force[k], 0.999))
    });
    assert!(refused(&gravity).contains("they hold no rates"));
    // Rows of the accelerometer have `g` in them too.
    refused(&long("a", "g", ["g", "s"]));
}

#[test]
fn numbers_of_gyroflow_have_the_scales_of_its_log() {
    let s = session();
    let log = |settings: &str| {
        let header = format!("GYROFLOW IMU LOG\nversion,1.3\n{settings}t,gx,gy,gz,ax,ay,az");
        table(&header, |k| {
            let count = |value: f64, scale: f64| format!("{}", (value / scale).round());
            let rates = s.rate[k].iter().map(|rate| count(*rate, 2e-5));
            let forces = s.force[k].iter().map(|force| count(force / G, 2e-6));
            let time = std::iter::once(count(s.t[k], 1e-3));
            time.chain(rates)
                .chain(forces)
                .collect::<Vec<_>>()
                .join(",")
        })
    };
    let text = log("tscale,0.001\ngscale,0.00002\nascale,0.000002\n");
    is_read_as("gyroflow", &text, &s);
}

#[test]
fn messages_of_a_log_have_the_stamp_before_them() {
    let s = session();
    let of = |between: &str, before: &dyn Fn([u64; 3]) -> String| {
        table("", |k| {
            let pairs = NAMES.iter().zip(cells(&s, k)).skip(1);
            let pairs: Vec<String> = pairs
                .map(|(name, value)| format!("{name}{between}{value}"))
                .collect();
            format!("{}{}", before(after_noon(&s, k)), pairs.join(" "))
        })
    };
    let android = of(":", &|[m, s, ms]| {
        format!("05-01 12:{m:02}:{s:02}.{ms:03}  1234  5678 D IMU     : ")
    });
    is_read_as("serial", &android, &s);
    let python = of("=", &|[m, s, ms]| {
        format!("2026-05-01 12:{m:02}:{s:02},{ms:03} - INFO - ")
    });
    is_read_as("serial", &python, &s);
    let topic = table("", |k| {
        let pairs: Vec<String> = NAMES
            .iter()
            .zip(cells(&s, k))
            .map(|(name, value)| format!("\"{name}\": {value}"))
            .collect();
        format!("imu/data {{{}}}", pairs.join(", "))
    });
    is_it(&read(&topic), &s, 1e-4);
}

#[test]
fn a_unit_that_changes_within_the_file_is_refused() {
    let s = session();
    let text = table("t,ax,ay,az,gx,gy,gz", |k| {
        let scale = if k > 800 { 1f64.to_degrees() } else { 1.0 };
        let (f, w) = (xyz(&s.force[k], 1.0), xyz(&s.rate[k], scale));
        format!("{:.2},{f},{w}", s.t[k])
    });
    let said = refused(&text);
    assert!(said.contains("rad/s") && said.contains("deg/s"), "{said}");
}
