//! The six-position method on the phone's six recordings of five minutes.

use calib::intervals::{Detector, Moments};
use calib::methods::six_position::{EarthRotation, Face, Placement, Six, SixPosition, placements};
use calib::recording::Stream;
use nalgebra::{Matrix3, Matrix3x6, Vector3};
use stillpoint_tests::phone;

const GRAVITY: f64 = 9.79;

/// `golden.json`, `six_turns`: the means over the sample ranges that the authors used.
#[test]
fn the_authors_sample_ranges_give_their_matrix_bias_and_gyroscope_part_to_1e_9() {
    let (Some(golden), Some(ranges)) = (
        phone::json("golden.json"),
        phone::json("six_position/recovered_index_ranges.json"),
    ) else {
        return;
    };
    let all = Face::ALL
        .iter()
        .enumerate()
        .map(|(k, face)| {
            let recording = phone::recording(folder_of(*face)).unwrap();
            let mean = |stream: Option<Stream>, sensor: &str| {
                let at = |what: &str| {
                    phone::number(&ranges, &format!("/{k}/{sensor}_{what}")).unwrap() as usize
                };
                let range = at("start_1based") - 1..at("stop_1based_incl");
                Moments::of(&stream.unwrap().values[range]).unwrap().mean
            };
            Placement {
                label: face.name().into(),
                accelerometer: mean(recording.accelerometer, "acc"),
                gyroscope: Some(mean(recording.gyroscope, "gyro")),
            }
        })
        .rev()
        .collect();
    let found = SixPosition::solve(&Six::sort(all, GRAVITY).unwrap(), GRAVITY);
    let golden = |what: &str, i: usize, j: usize| {
        phone::number(&golden, &format!("/six_turns/{what}/{i}/{j}")).unwrap()
    };
    let m = Matrix3::from_fn(|i, j| golden("M_code", i, j));
    let b = Vector3::from_fn(|i, _| golden("M_code", i, 3));
    let f = Matrix3x6::from_fn(|i, j| golden("F", i, j));
    assert!((found.means - f).abs().max() < 1e-9);
    assert!((found.m - m).abs().max() < 1e-9 && (found.bias - b).abs().max() < 1e-9);
    let authors = phone::json("six_position/author_six_turns.json").unwrap();
    let gyroscope = found.gyroscope.unwrap();
    for (k, axis) in ["x", "y", "z"].iter().enumerate() {
        let author = |what: &str| {
            phone::number(
                &authors,
                &format!("/Gyro_params_result/{what}_omega_{axis}"),
            )
            .unwrap()
        };
        assert!((gyroscope.scale_error[k] - author("S")).abs() < 1e-9);
        assert!((gyroscope.bias[k] - author("b")).abs() < 1e-9);
    }
    // The scale factor errors of -0.25 to -0.73 are within three standard errors of zero.
    assert_eq!(gyroscope.earth_rotation(), EarthRotation::Hidden);
    for (error, std) in gyroscope
        .scale_error
        .iter()
        .zip(gyroscope.scale_error_std.iter())
    {
        assert!(error.abs() < 3.0 * std);
    }
}

#[test]
fn the_faces_are_found_by_direction_and_the_tilt_of_the_placements_is_warned_about() {
    if phone::folder().is_none() {
        return;
    }
    let recordings: Vec<_> = Face::ALL
        .iter()
        .rev()
        .map(|face| phone::recording(folder_of(*face)).unwrap())
        .collect();
    let six = placements(&recordings, &Detector::default(), GRAVITY).unwrap();
    for (face, placement) in Face::ALL.iter().zip(six.placements()) {
        assert_eq!(placement.label, folder_of(*face));
    }
    let found = SixPosition::solve(&six, GRAVITY);
    // METHODS.md section 6: 0.4 to 0.9 degrees.
    let degrees = found.tilt().to_degrees();
    assert!((0.4..0.9).contains(&degrees), "{degrees}");
    assert!(
        found
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("tilted"))
    );
}

#[test]
fn one_recording_that_holds_the_six_faces_and_eight_edges_is_enough() {
    if phone::folder().is_none() {
        return;
    }
    let recording = phone::recording("multi_position/rec_1").unwrap();
    let six = placements(&[recording], &Detector::default(), GRAVITY).unwrap();
    assert_eq!(
        six.warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .filter(|w| w.contains("on no face"))
            .count(),
        8
    );
    let found = SixPosition::solve(&six, GRAVITY);
    // Scale factor errors are second order in the tilt: as in METHODS.md section 2 to 1e-3.
    for (k, scale) in [0.99968, 0.99984, 0.99827].iter().enumerate() {
        assert!((found.base().unwrap().t[(k, k)] - scale).abs() < 1e-3);
    }
}

#[test]
fn five_recordings_name_the_face_that_is_missing() {
    if phone::folder().is_none() {
        return;
    }
    let recordings: Vec<_> = Face::ALL[..5]
        .iter()
        .map(|face| phone::recording(folder_of(*face)).unwrap())
        .collect();
    let message = placements(&recordings, &Detector::default(), GRAVITY)
        .unwrap_err()
        .to_string();
    assert!(message.contains("no rest with z up"), "{message}");
}

fn folder_of(face: Face) -> &'static str {
    match face {
        Face::XDown => "six_position/minus_x_up",
        Face::XUp => "six_position/plus_x_up",
        Face::YDown => "six_position/minus_y_up",
        Face::YUp => "six_position/plus_y_up",
        Face::ZDown => "six_position/minus_z_up",
        Face::ZUp => "six_position/plus_z_up",
    }
}
