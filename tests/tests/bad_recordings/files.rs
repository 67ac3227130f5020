//! Section A: files, folders and names.

use super::*;

fn default() -> ReadOptions {
    ReadOptions::default()
}

#[test]
fn row_27_content_decides_and_a_wrong_extension_is_mentioned() {
    let place = Place::new("r.mat", file(HEADER, &rows(200)).as_bytes());
    let recording = Recording::read(&place.path(), &default()).unwrap();
    assert_eq!(recording.warnings.len(), 1);
    assert!(
        recording.warnings.texts(findings::Front::CommandLine)[0]
            .contains("in spite of its name, .mat")
    );
}

#[test]
fn row_28_a_folder_is_read_or_says_what_is_missing() {
    let accel: Vec<_> = rows(200).iter().map(|r| cut(r, [0, 1, 2, 3])).collect();
    let gyro: Vec<_> = rows(200).iter().map(|r| cut(r, [0, 4, 5, 6])).collect();
    let place = Place::new("acc.csv", file("t,ax,ay,az", &accel).as_bytes());
    let alone = Recording::read(&place.folder(), &default()).unwrap();
    assert_eq!(
        alone.warnings.texts(findings::Front::CommandLine),
        [format!(
            "{}: the recording has no gyroscope, only the accelerometer; nothing has to be done",
            alone.name
        )]
    );
    std::fs::write(place.folder().join("Gyroscope.csv"), file("t,z,y,x", &gyro)).unwrap();
    let both = Recording::read(&place.folder(), &default()).unwrap();
    assert_eq!(
        both.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
    // Row 82: by name, never by position.
    assert_eq!(both.gyroscope.unwrap().values[0].x, 2.0);

    let other = Place::new("notes.md", b"hello");
    let error = Recording::read(&other.folder(), &default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("acc.csv") && error.contains("notes.md"),
        "{error}"
    );
}

fn cut(row: &str, columns: [usize; 4]) -> String {
    let cells: Vec<_> = row.split(',').collect();
    columns.map(|i| cells[i]).join(",")
}

#[test]
fn row_29_a_missing_file_names_its_neighbour() {
    let place = Place::new("recording.csv", b"");
    let error = Recording::read(&place.folder().join("recordng.csv"), &default()).unwrap_err();
    assert!(matches!(error, Error::Io { .. }));
    assert!(
        error.to_string().contains("nearest: recording.csv"),
        "{error}"
    );
}

#[test]
fn rows_30_and_31_limits_hold() {
    let text = file(HEADER, &rows(200));
    let options = ReadOptions {
        max_rows: 100,
        ..default()
    };
    refused_with(
        &text,
        &options,
        "102",
        &["more than 100 rows", "--max-rows"],
    );
    let options = ReadOptions {
        max_bytes: 1000,
        ..default()
    };
    refused_with(&text, &options, "", &["--max-bytes"]);
    refused(text + &"1".repeat(3 << 20), "202", &["1 MiB"]);
}

#[cfg(unix)]
#[test]
fn row_30_an_endless_device_is_refused() {
    let error = Recording::read(std::path::Path::new("/dev/zero"), &default()).unwrap_err();
    assert!(
        error.to_string().contains("binary data at byte 0"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn row_32_links_to_nowhere_and_to_themselves_are_named() {
    let place = Place::new("a.csv", b"");
    for (link, target) in [("broken", "nothing"), ("circle", "circle")] {
        let link = place.folder().join(link);
        std::os::unix::fs::symlink(target, &link).unwrap();
        let error = Recording::read(&link, &default()).unwrap_err();
        assert!(matches!(error, Error::Io { .. }), "{error}");
    }
}

#[test]
fn row_33_odd_names_are_read_and_shown_escaped() {
    let text = file(HEADER, &rows(50)) + "x\n1,2\n";
    for name in ["-rf", "a b.csv", "a\nb\u{1b}[31m.csv", "ä µ.csv"] {
        let place = Place::new(name, text.as_bytes());
        let error = Recording::read(&place.path(), &default())
            .unwrap_err()
            .to_string();
        assert!(!error.contains(['\n', '\u{1b}']), "{error:?}");
    }
}

#[test]
fn a_pair_of_texts_without_headers_is_one_recording() {
    let counts = |i: usize| {
        format!(
            "{}\t{}\t{}\t{}",
            10 * i,
            30_000 + i % 7,
            32_000 + i % 5,
            33_000 - i % 3
        )
    };
    let text: Vec<_> = (0..300).map(counts).collect();
    let accel = Place::new("one.mat", text.join("\n").as_bytes());
    let gyro = Place::new("two.mat", text.join("\n").replace('\t', "  ").as_bytes());
    let options = ReadOptions {
        time_unit: Some("ms".parse().unwrap()),
        ..default()
    };
    let recording = Recording::read_pair(&accel.path(), &gyro.path(), &options).unwrap();
    let stream = recording.accelerometer.unwrap();
    assert_eq!(
        (stream.len(), stream.t[1], stream.values[0].x),
        (300, 0.01, 30_000.0)
    );
    assert_eq!(recording.gyroscope.unwrap().values[1].y, 32_001.0);
    assert!(
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("raw counts"))
    );
}
