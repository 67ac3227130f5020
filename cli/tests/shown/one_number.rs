//! One quantity has one number: on the terminal, with `-v`, on the page, in the documents, in a batch.

use std::path::Path;

use crate::common::{status, stderr, stdout, stillpoint};
use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};
use serde_json::Value;

/// What a command prints.
#[track_caller]
fn said(folder: &Path, args: &[&str]) -> String {
    let run = stillpoint(folder, args);
    assert_eq!(status(&run), 0, "{args:?}: {}", stderr(&run));
    stdout(&run)
}

/// The text of a page, its tags and pictures left out.
fn page_text(html: &str) -> String {
    let mut text = String::new();
    let mut left = html;
    while let Some((before, tag)) = left.split_once('<') {
        text.push_str(before);
        text.push(' ');
        let end = ["script", "style"]
            .iter()
            .find(|name| tag.starts_with(**name));
        left = match end {
            Some(name) => tag
                .split_once(&format!("</{name}>"))
                .map_or("", |(_, after)| after),
            None => tag.split_once('>').map_or("", |(_, after)| after),
        };
    }
    text.push_str(left);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The number that follows `before`.
#[track_caller]
fn number_after(text: &str, before: &str) -> f64 {
    let (_, after) = text
        .split_once(before)
        .unwrap_or_else(|| panic!("no `{before}` in: {text}"));
    let end = after
        .trim_start()
        .find(|c: char| !(c.is_ascii_digit() || ".e-+".contains(c)));
    let after = after.trim_start();
    let number = &after[..end.unwrap_or(after.len())];
    number
        .trim_end_matches('.')
        .parse()
        .unwrap_or_else(|_| panic!("no number after `{before}`: {after}"))
}

/// Equal to the figures that are shown.
#[track_caller]
fn same(one: f64, other: f64, figures: i32) {
    let least = 0.5 * 10f64.powi(1 - figures) * one.abs().max(other.abs());
    assert!((one - other).abs() <= 1.01 * least, "{one} and {other}");
}

/// A session with an effect that the base models lack, so that weighted and plain means differ.
fn session(folder: &Path) {
    let mut spec = Spec::hand_held(23).with_effect("gyro_g_sensitivity", 3.0);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(16),
        initial_rest: Some(40.0),
        ..HandHeld::default()
    });
    let mut simulated = spec.run().unwrap();
    let csv = to_csv(&mut simulated.recording);
    std::fs::write(folder.join("a.csv"), &csv).unwrap();
    std::fs::create_dir(folder.join("devices")).unwrap();
    std::fs::write(folder.join("devices").join("a.csv"), &csv).unwrap();
}

#[test]
fn every_figure_that_appears_twice_is_the_same() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    session(folder);
    let first = said(
        folder,
        &[
            "calibrate",
            "a.csv",
            "-o",
            "cal.json",
            "--report",
            "page.html",
        ],
    );
    let all = said(folder, &["calibrate", "a.csv", "-v"]);
    let json: Value =
        serde_json::from_str(&said(folder, &["calibrate", "a.csv", "--json"])).unwrap();
    let file = std::fs::read_to_string(folder.join("cal.json")).unwrap();
    let file: Value = serde_json::from_str(&file).unwrap();
    let page = page_text(&std::fs::read_to_string(folder.join("page.html")).unwrap());

    // The residuals.
    let (_, residual) = first.split_once("residual").unwrap();
    let residual = residual.lines().next().unwrap();
    let at_rest = number_after(residual, "→");
    let after_turn = number_after(residual.split_once("at rest").unwrap().1, "→");
    let [force, rate] =
        ["accelerometer", "gyroscope"].map(|s| file[s]["residual_rms"].as_f64().unwrap());
    let evaluate = ["evaluate", "a.csv", "--calibration", "cal.json", "--json"];
    let evaluated: Value = serde_json::from_str(&said(folder, &evaluate)).unwrap();
    let plain = |name: &str| evaluated[1]["misfit"][name].as_f64().unwrap();
    same(at_rest, 1e3 * plain("modulus_rms"), 3);
    same(after_turn, plain("direction_rms"), 3);
    // By the weights of the fit.
    let by_weights = number_after(&all, "static intervals, residual");
    same(by_weights, 1e3 * force, 3);
    same(number_after(&all, "gravity predicted to"), rate, 3);
    let (_, head) = page.split_once("Residual, raw → calibrated").unwrap();
    same(at_rest, number_after(head, "→"), 3);
    same(
        after_turn,
        number_after(head.split_once("direction through").unwrap().1, "→"),
        3,
    );

    // The documents are one.
    for key in ["accelerometer", "gyroscope", "verdict", "findings"] {
        assert_eq!(json[key], file[key], "{key}");
    }

    // The weakest parameter has the error of its place in the table and in the document.
    let weakest = first.split_once("weakest parameter").unwrap().1;
    let weakest = weakest.lines().next().unwrap().trim();
    let (name, error) = weakest.split_once(" ± ").unwrap();
    assert!(page.contains(&format!("± {error}")), "{weakest}");
    let std = file_error(&file, name);
    same(error.split(' ').next().unwrap().parse().unwrap(), std, 2);

    // The error of a corrected reading, in the terminal and with -v.
    let force_error = number_after(&first, "corrected reading  ±");
    assert!(force_error > 0.0);

    // The rate of a recording.
    let info: Value = serde_json::from_str(&said(folder, &["info", "a.csv", "--json"])).unwrap();
    let of_info = rates(&info);
    let table = said(folder, &["info", "a.csv"]);
    for rate in &of_info {
        same(*rate, number_after(&table, " at "), 4);
    }

    // A batch.
    said(folder, &["batch", "devices", "-o", "batch"]);
    said(folder, &["batch", "merge", "batch", "-o", "all", "--csv"]);
    let csv = std::fs::read_to_string(folder.join("all.csv")).unwrap();
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row: Vec<&str> = lines.next().unwrap().split(',').collect();
    let cell = |name: &str| row[header.iter().position(|h| *h == name).unwrap()];
    same(cell("residual_mm_s2").parse().unwrap(), 1e3 * force, 6);
    same(cell("residual_deg").parse().unwrap(), rate, 6);
}

/// The standard error of a parameter of the table in its unit there.
fn file_error(file: &Value, name: &str) -> f64 {
    let words: Vec<&str> = name.split(' ').collect();
    let sensor = &file[words[0]];
    let axis = |letter: &str| "xyz".find(letter).unwrap();
    match words[1..] {
        [letter, "scale"] => {
            1e6 * sensor["T_std"][axis(letter)][axis(letter)]
                .as_f64()
                .unwrap()
        }
        ["misalignment", angle] => {
            let (column, other) = (axis(&angle[..1]), axis(&angle[1..]));
            1e3 * sensor["T_std"][3 - column - other][column]
                .as_f64()
                .unwrap()
        }
        [letter, "bias"] if words[0] == "accelerometer" => {
            1e3 * sensor["bias_std"][axis(letter)].as_f64().unwrap()
        }
        [letter, "bias"] => {
            3600.0
                * sensor["bias_std"][axis(letter)]
                    .as_f64()
                    .unwrap()
                    .to_degrees()
        }
        _ => panic!("{name}"),
    }
}

/// The rates of the sensors in a document of `info`.
fn rates(info: &Value) -> Vec<f64> {
    let mut found = Vec::new();
    let mut open = vec![info];
    while let Some(value) = open.pop() {
        match value {
            Value::Object(object) => {
                found.extend(object.get("rate").and_then(Value::as_f64));
                open.extend(object.values());
            }
            Value::Array(values) => open.extend(values),
            _ => {}
        }
    }
    assert!(!found.is_empty(), "{info}");
    found
}
