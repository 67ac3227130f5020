//! One recording in other spellings of stamps and numbers: read as the plain table is, or refused with the line.

use calib::recording::ReadOptions;
use calib::{Error, Recording};
use nalgebra::Vector3;
use stillpoint_tests::layouts::Samples;

const HEADER: &str = "time,ax,ay,az,gx,gy,gz";
/// Decimals that are written of readings and stamps, and the error that they leave.
const WITHIN: f64 = 1e-6;

fn read(name: &str, text: String) -> Result<Recording, Error> {
    Recording::from_bytes(name, text.into_bytes(), &ReadOptions::default())
}

fn text_of(error: &Error) -> String {
    error.text(findings::Front::CommandLine)
}

/// The header and a row per reading of both sensors.
fn table(samples: &Samples, header: &str, row: impl Fn(f64, [f64; 6]) -> String) -> String {
    let all = samples.accel.t.iter().zip(&samples.accel.values);
    let rows = all.zip(&samples.together).map(|((t, f), w)| {
        let t = t - samples.accel.t[0];
        row(t, [f.x, f.y, f.z, w.x, w.y, w.z]) + "\n"
    });
    format!("{header}\n{}", rows.collect::<String>())
}

/// Six numbers, each spelt so, with this between them.
fn joined(numbers: [f64; 6], between: &str, spell: impl Fn(f64) -> String) -> String {
    numbers.map(spell).join(between)
}

fn plain(numbers: [f64; 6]) -> String {
    joined(numbers, ",", |number| format!("{number:.8}"))
}

fn is_it(name: &str, text: String, samples: &Samples) {
    let start: String = text.chars().take(200).collect();
    let found = read(name, text).unwrap_or_else(|error| panic!("{}\n{start}", text_of(&error)));
    let pairs = [
        (found.accelerometer.as_ref(), &samples.accel.values),
        (found.gyroscope.as_ref(), &samples.together),
    ];
    for (stream, expected) in pairs {
        let stream = stream.expect("both sensors");
        assert_eq!(stream.len(), expected.len(), "{start}");
        let pairs = stream.values.iter().zip(expected);
        let worst = pairs.map(|(a, b): (&Vector3<f64>, _)| (a - b).amax());
        assert!(worst.fold(0.0, f64::max) < 10.0 * WITHIN, "{start}");
        let stamps = stream.t.iter().zip(&samples.accel.t);
        let late = stamps.map(|(a, b)| (a - stream.t[0] - (b - samples.accel.t[0])).abs());
        assert!(late.fold(0.0, f64::max) < 2e-3, "{start}");
    }
}

/// Hours, minutes, and seconds with so many decimals.
fn clock(seconds: f64, decimals: usize) -> (u64, String) {
    let parts = 10f64.powi(decimals as i32);
    let count = (seconds * parts).round() as u64;
    let whole = count / parts as u64;
    let width = decimals + 3;
    let rest = format!(
        "{:02}:{:0width$.decimals$}",
        whole / 60 % 60,
        (count % (60 * parts as u64)) as f64 / parts
    );
    (whole / 3600 % 24, rest)
}

#[test]
fn a_clock_of_twelve_hours_goes_on_over_noon_and_midnight() {
    let samples = Samples::of_session();
    for (begin, separator, halves, date) in [
        (12.0 * 3600.0 + 59.0 * 60.0 + 30.0, ",", ["AM", "PM"], ""),
        (11.0 * 3600.0 + 59.0 * 60.0 + 30.0, "\t", ["am", "pm"], ""),
        (
            23.0 * 3600.0 + 59.0 * 60.0 + 30.0,
            ",",
            ["a.m.", "p.m."],
            "",
        ),
        (
            12.0 * 3600.0 + 59.0 * 60.0 + 30.0,
            ";",
            ["AM", "PM"],
            "2026-11-21 ",
        ),
        // Without a half the hour goes back by eleven.
        (12.0 * 3600.0 + 59.0 * 60.0 + 30.0, ",", ["", ""], ""),
    ] {
        let row = |t: f64, numbers| {
            let (hour, rest) = clock(begin + t, 3);
            let half = halves[usize::from(hour >= 12)];
            let stamp = format!("{date}{:02}:{rest} {half}", (hour + 11) % 12 + 1);
            format!("{},{}", stamp.trim_end(), plain(numbers)).replace(',', separator)
        };
        let text = table(&samples, &HEADER.replace(',', separator), row);
        is_it("r.csv", text, &samples);
    }
}

#[test]
fn a_comma_before_the_milliseconds_is_no_separator() {
    let samples = Samples::of_session();
    for (header, count, date) in [
        (HEADER, false, ""),
        ("n,time,ax,ay,az,gx,gy,gz", true, ""),
        (HEADER, false, "2026-11-21 "),
    ] {
        let row = |t: f64, numbers| {
            let (hour, rest) = clock(47_110.0 + t, 3);
            let count = if count { "7," } else { "" };
            let stamp = format!("{count}{date}{hour:02}:{rest}").replace('.', ",");
            format!("{stamp},{}", plain(numbers))
        };
        is_it("r.csv", table(&samples, header, row), &samples);
    }
    let seconds =
        |t: f64, numbers| format!("{},{}", format!("{t:.3}").replace('.', ","), plain(numbers));
    is_it("r.csv", table(&samples, HEADER, seconds), &samples);
}

/// A number with a mark between its thousands and another before its decimals.
fn grouped(number: f64, group: &str, mark: &str, decimals: usize) -> String {
    let text = format!("{:.decimals$}", number.abs());
    let (whole, rest) = text.split_once('.').unwrap_or((&text, ""));
    let mut digits = String::new();
    for (at, digit) in whole.chars().enumerate() {
        if at > 0 && (whole.len() - at).is_multiple_of(3) {
            digits += group;
        }
        digits.push(digit);
    }
    let sign = if number < 0.0 { "-" } else { "" };
    let mark = if rest.is_empty() { "" } else { mark };
    format!("{sign}{digits}{mark}{rest}")
}

#[test]
fn thousands_that_nothing_else_can_be_are_read() {
    let samples = Samples::of_session();
    let header = "t [ms];ax [mm/s²];ay [mm/s²];az [mm/s²];gx [mrad/s];gy [mrad/s];gz [mrad/s]";
    for (group, mark) in [("'", "."), ("’", "."), ("\u{202f}", ",")] {
        let row = |t: f64, numbers: [f64; 6]| {
            let numbers = joined(numbers, ";", |n| grouped(1e3 * n, group, mark, 5));
            format!("{};{numbers}", grouped(1e3 * t, group, mark, 0))
        };
        is_it("r.csv", table(&samples, header, row), &samples);
    }
}

#[test]
fn numbers_that_lost_their_points_are_refused_with_their_line() {
    let samples = Samples::of_session();
    let lose = |number: f64| {
        let text = format!("{number:.3}").trim_end_matches('0').to_owned();
        match text.rsplit_once('.').map(|(_, decimals)| decimals.len()) {
            Some(3) => text.replace('.', "").parse::<i64>().unwrap().to_string(),
            _ => text.trim_end_matches('.').to_owned(),
        }
    };
    let row = |t: f64, numbers: [f64; 6]| {
        let [x, y, z, rates @ ..] = numbers;
        let rates = rates.map(|rate| format!("{rate:.6}")).join(";");
        format!("{t:.3};{};{};{};{rates}", lose(x), lose(y), lose(z))
    };
    let text = table(&samples, &HEADER.replace(',', ";"), row);
    let words = text_of(&read("r.csv", text).unwrap_err());
    assert!(
        words.contains("r.csv:") && words.contains("lost their decimal points"),
        "{words}"
    );
}

#[test]
fn units_in_the_cells_are_those_of_the_columns() {
    let samples = Samples::of_session();
    let cells = |t: f64, numbers: [f64; 6]| {
        let [x, y, z, rates @ ..] = numbers;
        let force = [x, y, z].map(|n| format!("{:.7} g", n / 9.80665)).join(",");
        let rates = rates.map(|n| format!("{:.7}°/s", n.to_degrees())).join(",");
        format!("{t:.3} s,{force},{rates}")
    };
    is_it("r.csv", table(&samples, HEADER, cells), &samples);
    // Of two units in a column one is another's.
    let text = table(&samples, HEADER, cells);
    let mixed: String = text
        .lines()
        .enumerate()
        .map(|(at, line)| match at {
            1500.. => line.replace(" g", " mg") + "\n",
            _ => line.to_owned() + "\n",
        })
        .collect();
    let words = text_of(&read("r.csv", mixed).unwrap_err());
    assert!(
        words.contains("r.csv:1501:")
            && words.contains("mg` in column 2")
            && words.contains("one unit"),
        "{words}"
    );
    let stated = text.replacen("ax,ay,az", "ax (m/s²),ay (m/s²),az (m/s²)", 1);
    assert!(read("r.csv", stated).is_err());
}

#[test]
fn stamps_in_minutes_that_nothing_states_are_asked_about() {
    let samples = Samples::of_session();
    for (size, unit) in [(60.0, "min"), (3600.0, "h")] {
        let row = |t: f64, numbers| format!("{:.12},{}", t / size, plain(numbers));
        let text = table(&samples, HEADER, row);
        match read("r.csv", text) {
            Err(error) => {
                let words = text_of(&error);
                assert!(words.contains(&format!("--time-unit {unit}")), "{words}");
            }
            Ok(_) => panic!("{unit}"),
        }
    }
}
