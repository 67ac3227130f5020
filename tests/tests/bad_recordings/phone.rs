//! Real recordings, where they are found.

use std::path::Path;

use super::*;

/// A recording below the folder of data, or `None` with a note.
fn recorded(name: &str) -> Option<Recording> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let data = std::env::var_os("STILLPOINT_DATA").map_or(beside, PathBuf::from);
    let path = data.join(name);
    if !path.exists() {
        println!("skipped: no {name} under STILLPOINT_DATA or beside the workspace");
        return None;
    }
    Some(Recording::read(&path, &ReadOptions::default()).unwrap())
}

#[test]
fn a_phone_recording_keeps_both_clocks_and_reports_its_gap() {
    let Some(recording) = recorded("phone/multi_position/rec_1") else {
        return;
    };
    let (accel, gyro) = (
        recording.accelerometer.unwrap(),
        recording.gyroscope.unwrap(),
    );
    assert_eq!((accel.len(), gyro.len()), (62_674, 62_673));
    assert_eq!((accel.t[0], gyro.t[0]), (0.0, 0.007));
    assert_eq!(
        accel.gaps().iter().map(|g| g.t0).collect::<Vec<_>>(),
        [279.055]
    );
    assert_eq!(
        gyro.gaps().iter().map(|g| g.t0).collect::<Vec<_>>(),
        [279.061]
    );
    assert_eq!(recording.warnings.len(), 2, "{:?}", recording.warnings);
}

#[test]
fn the_repeated_rows_of_a_cart_run_are_left_out_by_name() {
    let Some(recording) = recorded("phone/cart/plus_z") else {
        return;
    };
    assert_eq!(recording.gyroscope.unwrap().len(), 2600);
    assert_eq!(recording.warnings.len(), 1);
    assert!(
        recording.warnings.texts(findings::Front::CommandLine)[0]
            .contains("20 rows between lines 2594 and 2621 repeat")
    );
}

#[test]
fn well_kept_recordings_are_read_without_a_word() {
    for name in [
        "phone/multi_position/rec_2",
        "phone/multi_position/rec_3",
        "phone/walking",
        "mpu9150/imu0.csv",
        "phone/six_position/plus_y_up",
    ] {
        let Some(recording) = recorded(name) else {
            continue;
        };
        assert_eq!(
            recording.warnings.texts(findings::Front::CommandLine),
            Vec::<String>::new(),
            "{name}"
        );
    }
}
