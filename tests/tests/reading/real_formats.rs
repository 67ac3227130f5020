//! Files as their programs wrote them: read sample by sample as other readers read them.

use std::path::Path;

use calib::recording::{ReadOptions, Stream};
use calib::{Error, Recording};
use stillpoint_tests::needed_data::needed;

fn read(path: &Path, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::read(path, options)
}

fn assert_same(found: &Stream, expected: &Stream, origin: f64, within: f64) {
    assert_eq!(found.len(), expected.len());
    for k in 0..found.len() {
        let stamps = (found.t[k] - origin - expected.t[k]).abs();
        assert!(stamps < 1e-6, "stamp {k} is off by {stamps:e} s");
        let values = (found.values[k] - expected.values[k]).amax();
        assert!(values <= within, "sample {k} is off by {values:e}");
    }
}

/// The CSV keeps six decimals.
#[test]
fn timetables_of_matlab_mobile_are_the_csv_of_the_same_recording() {
    for (mat, csv) in [
        (
            "formats/matlab_mobile_rec_2.mat",
            "phone/multi_position/rec_2",
        ),
        ("formats/matlab_mobile_walking.mat", "phone/walking"),
    ] {
        let (Some(mat), Some(csv)) = (needed(mat), needed(csv)) else {
            return;
        };
        let found = read(&mat, &ReadOptions::default()).unwrap();
        let expected = read(&csv, &ReadOptions::default()).unwrap();
        let (accel, gyro) = (found.accelerometer.unwrap(), found.gyroscope.unwrap());
        let (csv_accel, csv_gyro) = (expected.accelerometer.unwrap(), expected.gyroscope.unwrap());
        let origin = accel.t[0] - csv_accel.t[0];
        assert_same(&accel, &csv_accel, origin, 0.51e-6);
        assert_same(&gyro, &csv_gyro, origin, 0.51e-6);
    }
}

#[test]
fn a_px4_log_at_one_hertz_is_refused_with_what_to_set() {
    let Some(log) = needed("formats/px4_sample_log_small.ulg") else {
        return;
    };
    let words = read(&log, &ReadOptions::default())
        .unwrap_err()
        .text(findings::Front::CommandLine);
    assert!(
        words.contains("3 accelerometers") && words.contains("--instance 0"),
        "{words}"
    );
    let options = ReadOptions {
        instance: Some(0),
        ..ReadOptions::default()
    };
    let error = read(&log, &options).unwrap_err();
    assert!(matches!(error, Error::NotEnough(_)), "{error}");
    let words = error.text(findings::Front::CommandLine);
    assert!(
        words.contains("SDLOG_PROFILE") && words.contains("--topic sensor_combined"),
        "{words}"
    );
}

/// Counts and the first samples are those that pyulog 1.2 reads, the corrections that the log tells taken off by hand.
#[test]
fn the_corrected_topic_of_px4_logs_is_read_with_the_corrections_taken_off() {
    let Some(log) = needed("formats/px4_sample_log_small.ulg") else {
        return;
    };
    let options = ReadOptions {
        topics: vec!["sensor_combined".to_owned()],
        ..ReadOptions::default()
    };
    let recording = read(&log, &options).unwrap();
    let (accel, gyro) = (
        recording.accelerometer.unwrap(),
        recording.gyroscope.unwrap(),
    );
    assert_eq!((accel.len(), gyro.len()), (1298, 1298));
    assert!((gyro.t[0] - 20.326716).abs() < 1e-6);
    let told = |words: &str| {
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|warning| warning.contains(words))
    };
    assert!(told("taken off again"), "{:?}", recording.warnings);
    // SENS_BOARD_ROT is 4, half a turn about z; CAL_ACC0 and CAL_GYRO0.
    let expected = -0.00124581 / 0.9996893405914307 + 0.1580352783203125;
    assert!(
        (accel.values[0].x - expected).abs() < 1e-6,
        "{}",
        accel.values[0].x
    );
    let expected = -0.00296838 - 0.04103894159197807;
    assert!(
        (gyro.values[0].x - expected).abs() < 1e-6,
        "{}",
        gyro.values[0].x
    );
    let Some(log) = needed("formats/px4_sample.ulg") else {
        return;
    };
    let recording = read(&log, &ReadOptions::default()).unwrap();
    assert_eq!(recording.gyroscope.unwrap().len(), 17_070);
    let told = |words: &str| {
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|warning| warning.contains(words))
    };
    assert!(
        told("the log lost samples 4 times")
            && recording.warnings.has(findings::Kind::CORRECTED_BY_SYSTEM),
        "{:?}",
        recording.warnings
    );
}

#[test]
fn an_ardupilot_log_says_what_it_holds() {
    let Some(log) = needed("formats/ardupilot_test.BIN") else {
        return;
    };
    let words = read(&log, &ReadOptions::default())
        .unwrap_err()
        .text(findings::Front::CommandLine);
    assert!(
        words.contains("2 accelerometers") && words.contains("--instance 0"),
        "{words}"
    );
    let options = ReadOptions {
        instance: Some(0),
        ..ReadOptions::default()
    };
    let recording = read(&log, &options).unwrap();
    let accel = recording.accelerometer.unwrap();
    assert_eq!(accel.len(), 45);
    assert!(
        (8.0..12.0).contains(&accel.values[0].norm()),
        "{}",
        accel.values[0]
    );
    let told = recording.warnings.has(findings::Kind::CORRECTED_BY_SYSTEM);
    assert!(told, "{:?}", recording.warnings);
}
