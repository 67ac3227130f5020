//! The chapter on the phone experiment: its commands run, and its figures are theirs.

use std::path::Path;

use super::{CART, blocks, cart, json, phone, stillpoint};

/// A folder with links to the recordings of the phone.
fn linked(phone: &Path) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for part in ["multi_position", "six_position", "cart", "."] {
        for entry in std::fs::read_dir(phone.join(part)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                let link = folder.path().join(path.file_name().unwrap());
                std::os::unix::fs::symlink(path.canonicalize().unwrap(), link).unwrap();
            }
        }
    }
    folder
}

/// The mean of the absolute errors of a calibration over all runs and axes of `reckon`, m.
fn mean_error(runs: &serde_json::Value, calibration: &str) -> f64 {
    let of_run = |run: &serde_json::Value| -> Vec<f64> {
        let results = run["results"].as_array().unwrap();
        let own = results.iter().find(|r| r["calibration"] == calibration);
        let errors = own.unwrap()["error"].as_array().unwrap();
        errors.iter().map(|e| e.as_f64().unwrap().abs()).collect()
    };
    let all: Vec<f64> = runs.as_array().unwrap().iter().flat_map(of_run).collect();
    all.iter().sum::<f64>() / all.len() as f64
}

#[test]
fn the_story_has_the_figures_that_its_commands_give() {
    let Some(phone) = phone() else { return };
    let dir = linked(&phone);
    blocks::run("experiment.md", dir.path());
    let missing = std::cell::RefCell::new(Vec::new());
    let say = |words: &str| {
        if !blocks::is_said("experiment.md", words) {
            missing.borrow_mut().push(words.to_owned());
        }
    };
    let read = |file: &str| -> serde_json::Value {
        serde_json::from_slice(&std::fs::read(dir.path().join(file)).unwrap()).unwrap()
    };

    let stepwise = read("stepwise.json");
    let misfit = &stepwise["misfit"][0];
    let of = |key: &str| misfit[key].as_f64().unwrap();
    say(&format!("left at rest is {:.1} mm/s²", 1e3 * of("rms")));
    say(&format!(
        "explains only {:.2} mm/s² of it",
        1e3 * of("noise")
    ));
    say(&format!("{:.0} times the noise", of("reduced_chi2").sqrt()));

    let mut call = vec!["evaluate", "rec_3", "--gravity", "9.79", "--json"];
    for file in [
        "--calibration=six=six.json",
        "--calibration=stepwise=stepwise.json",
        "--calibration=found=findings.json",
        "--calibration=today=today.json",
    ] {
        call.push(file);
    }
    let rows = json(&stillpoint(dir.path(), &call));
    let figure = |name: &str, key: &str| {
        let all = rows.as_array().unwrap();
        let own = all.iter().find(|row| row["name"] == name).unwrap();
        own["misfit"][key].as_f64().unwrap()
    };
    let norm = |name: &str| 1e3 * figure(name, "modulus_rms");
    let direction = |name: &str| figure(name, "direction_rms");
    say(&format!(
        "| raw | {:.1} | {:.3}° |",
        norm("raw"),
        direction("raw")
    ));
    say(&format!(
        "| six positions | {:.1} | {:.3}° |",
        norm("six"),
        direction("six")
    ));
    let published = (norm("stepwise"), direction("stepwise"));
    say(&format!(
        "| stepwise, as published | {:.2} | {:.3}° |",
        published.0, published.1
    ));
    say(&format!("{:.2} mm/s² calibrated", published.0));
    let found = (norm("found"), direction("found"));
    say(&format!(
        "| with the effects that were found | {:.2} | {:.3}° |",
        found.0, found.1
    ));
    say(&format!("{:.2} became {:.2} mm/s²", published.0, found.0));
    say(&format!("the norm is off by {:.2} mm/s²", norm("today")));
    let axis =
        |file: &serde_json::Value, k: usize| file["accelerometer"]["bias"][k].as_f64().unwrap();
    let today = read("today.json");
    let moved = (0..3).map(|k| (axis(&today, k) - axis(&stepwise, k)).abs());
    say(&format!(
        "moved by up to {:.1} mm/s²",
        1e3 * moved.fold(0.0, f64::max)
    ));

    // What the first chapter says of a phone.
    let first = |words: &str| assert!(blocks::is_said("first_calibration.md", words), "{words}");
    let turned = stepwise["gyroscope"]["bias"][0].as_f64().unwrap();
    let (bias, rate) = (1e3 * axis(&stepwise, 0), turned.to_degrees());
    first(&format!("{bias:.0} mm/s², {rate:.2} °/s"));
    let of_t =
        |row: usize, column: usize| stepwise["gyroscope"]["T"][row][column].as_f64().unwrap();
    first(&format!("{:.1} %", 100.0 * (1.0 - of_t(0, 0))));
    first(&format!("{:.2}°", of_t(0, 2).to_degrees()));

    let findings = read("findings.json");
    for effect in findings["effects"].as_array().unwrap() {
        say(&format!("| `{}` |", effect["name"].as_str().unwrap()));
    }
    assert_eq!(findings["effects"].as_array().unwrap().len(), 3);
    assert!(
        findings["integrity"]
            .to_string()
            .contains("undersampled_motion")
    );

    let noise = read("noise.json");
    let densities = &noise["gyroscope"]["densities"]["noise_density"];
    let [x, y, z] = [0, 1, 2].map(|k| densities[k].as_f64().unwrap());
    say(&format!("{x:.6}, {y:.6} and {z:.6} rad/s/√Hz"));

    let levels = "0.60,0.40,0.75,0.157,0.50,0.50";
    let as_published = [
        "--procedure",
        "published",
        "--level",
        levels,
        "--vertical",
        "z,z,z,z,y,y",
    ];
    let runs = cart(&phone, &as_published);
    say(&format!(
        "{:.2} m, more than half",
        mean_error(&runs, "authors-proposed")
    ));
    say(&format!(
        "raw readings give {:.2} m",
        mean_error(&runs, "raw")
    ));
    let mut call = vec![
        "reckon", "--json", "plus_x", "minus_x", "plus_y", "minus_y", "minus_z",
    ];
    for (name, displacement, _) in CART {
        if name != "plus_z" {
            call.extend(["--displacement", displacement]);
        }
    }
    let runs = json(&stillpoint(dir.path(), &call));
    say(&format!(
        "The mean error is {:.3} m",
        mean_error(&runs, "raw")
    ));

    let call = [
        "reckon",
        "walking",
        "--calibration",
        "it=stepwise.json",
        "--distance",
        "4.095",
        "--json",
    ];
    let walk = &json(&stillpoint(dir.path(), &call))[0]["results"][1];
    let walked = walk["horizontal"].as_f64().unwrap();
    say(&format!(
        "the walked distance is {walked:.2} m, off by {:.2} m",
        walked - 4.095
    ));
    let missing = missing.into_inner();
    assert!(missing.is_empty(), "not said: {missing:#?}");
}
