//! One recording in every layout that apps, loggers and robots write is read as that recording.

use std::ffi::OsString;
use std::path::Path;

use calib::Recording;
use calib::recording::{ReadOptions, Stream};
use stillpoint_tests::layouts::{Layout, Samples, layouts};

/// Writes the files of a layout into `folder`.
fn write(layout: &Layout, folder: &Path) {
    for (name, content) in &layout.files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
}

fn read(layout: &Layout) -> Result<Recording, calib::Error> {
    let folder = tempfile::tempdir().unwrap();
    write(layout, folder.path());
    let path = folder.path().join(OsString::from(layout.call[0]));
    let rate = layout.call.iter().position(|word| *word == "--rate");
    let options = ReadOptions {
        rate: rate.map(|at| layout.call[at + 1].parse().unwrap()),
        ..ReadOptions::default()
    };
    Recording::read(&path, &options)
}

/// Largest difference of stamps, whose origin is free, and of samples, in the unit of `expected`.
fn differences(read: &Stream, expected: &Stream, scale: f64, origin: f64) -> [f64; 2] {
    let values = read
        .values
        .iter()
        .zip(&expected.values)
        .map(|(a, b)| (a / scale - b).amax());
    let stamps = read
        .t
        .iter()
        .zip(&expected.t)
        .map(|(a, b)| (a - origin - b).abs());
    [stamps.fold(0.0, f64::max), values.fold(0.0, f64::max)]
}

#[test]
fn every_layout_is_the_recording_that_was_written() {
    let samples = Samples::of_session();
    let mut failures = Vec::new();
    for layout in layouts(&samples) {
        if let Err(words) = check(&layout, &samples) {
            failures.push(format!("{}: {words}", layout.name));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn check(layout: &Layout, samples: &Samples) -> Result<(), String> {
    let recording = read(layout).map_err(|error| error.to_string())?;
    let torn = layout.name.contains("torn");
    let Some(accel) = &recording.accelerometer else {
        return Err("no accelerometer".to_owned());
    };
    let (mut force, mut rate) = (samples.accel.clone(), samples.gyro.clone());
    if layout.one_clock {
        rate = Stream {
            t: force.t.clone(),
            values: samples.together.clone(),
        };
    }
    if torn {
        // Cut within row 500 and within the last.
        for stream in [&mut force, &mut rate] {
            stream.t = stream.t[500..stream.t.len() - 1].to_vec();
            stream.values = stream.values[500..stream.values.len() - 1].to_vec();
        }
    }
    let origin = accel.t[0] - force.t[0];
    let mut sensors = vec![(
        "accelerometer",
        accel,
        &force,
        layout.counts[0],
        layout.within[1],
    )];
    match (&recording.gyroscope, layout.accelerometer_only) {
        (Some(gyro), false) => {
            sensors.push(("gyroscope", gyro, &rate, layout.counts[1], layout.within[2]))
        }
        (None, true) => {}
        (gyro, _) => return Err(format!("gyroscope: {}", gyro.is_some())),
    }
    for (sensor, read, expected, scale, within) in sensors {
        if read.len() != expected.len() {
            return Err(format!(
                "{sensor}: {} samples, {} expected",
                read.len(),
                expected.len()
            ));
        }
        let [stamps, values] = differences(read, expected, scale, origin);
        if stamps > layout.within[0] || values > within {
            return Err(format!(
                "{sensor}: stamps off by {stamps:e}, values by {values:e}\n{:#?}",
                recording.warnings
            ));
        }
    }
    Ok(())
}
