//! The main job on the phone's recordings, against figures recomputed from them independently.

use calib::calibrate::{Outcome, Request, calibrate, read_static_means};
use calib::evaluate;
use calib::intervals::{Span, read_sections};
use calib::methods::{AccelerometerRequest, choose_multiplier, fit_accelerometer, step_two};
use calib::recording::Recording;
use calib::residuals::{Integrator, StaticMean};
use sensor::Base;
use stillpoint_tests::phone;

/// The gravity that the authors used, m/s².
const GRAVITY: f64 = 9.79;

fn recordings(names: &[&str]) -> Vec<Recording> {
    names
        .iter()
        .map(|n| phone::recording(&format!("multi_position/{n}")).unwrap())
        .collect()
}

fn request() -> Request {
    Request {
        gravity: GRAVITY,
        ..Request::default()
    }
}

fn golden_numbers(pointer: &str) -> Vec<f64> {
    let golden = phone::json("golden.json").unwrap();
    flatten(golden.pointer(pointer).unwrap())
}

fn flatten(value: &serde_json::Value) -> Vec<f64> {
    match value.as_array() {
        Some(items) => items.iter().flat_map(flatten).collect(),
        None => vec![value.as_f64().unwrap()],
    }
}

/// The nine parameters in the order of `golden.json`.
fn nine(outcome: &Outcome) -> Vec<f64> {
    let triad = outcome.calibration.accelerometer.as_ref().unwrap();
    let t = triad.t;
    let mut nine = vec![t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]];
    nine.extend(triad.bias);
    nine
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// The fit of the 23 published means.
fn of_the_means(folder: &std::path::Path, recordings: &[Recording], request: Request) -> Outcome {
    let means = read_static_means(&folder.join("multi_position/acc_static_average_vals.csv"));
    let request = Request {
        static_means: means.unwrap(),
        ..request
    };
    calibrate(recordings, &[], &request).unwrap()
}

#[test]
fn step_one_on_the_23_means_agrees_to_the_last_digits_printed() {
    let Some(folder) = phone::folder() else {
        return;
    };
    let outcome = of_the_means(&folder, &[], request());
    let expected = golden_numbers("/acc_9par_upper_g9.79/x");
    assert!(largest_difference(&nine(&outcome), &expected) < 1e-8);
    let rms = outcome
        .calibration
        .accelerometer
        .as_ref()
        .unwrap()
        .residual_rms;
    assert!((rms - golden_numbers("/acc_9par_upper_g9.79/rms")[0]).abs() < 1e-9);
    let fit = outcome.accelerometer.unwrap();
    let std: Vec<f64> = fit
        .fitted
        .free
        .iter()
        .map(|name| fit.fitted.standard_error(name).unwrap())
        .collect();
    let expected = golden_numbers("/acc_9par_upper_g9.79/sd");
    assert!(largest_difference(&std, &expected) < 1e-8);
}

#[test]
fn step_two_as_published_has_rank_six_and_finds_the_symmetric_factor() {
    let Some(folder) = phone::folder() else {
        return;
    };
    let means = read_static_means(&folder.join("multi_position/acc_static_average_vals.csv"));
    let request = AccelerometerRequest {
        recordings: vec![means.unwrap().into_iter().map(StaticMean::bare).collect()],
        names: vec!["means".into()],
        model: accelerometer::model(),
        gravity: GRAVITY,
    };
    let fit = fit_accelerometer(&request).unwrap();
    let second = step_two(&request, &fit).unwrap();
    assert_eq!(second.uncertainty.rank, 6);
    assert_eq!(second.uncertainty.unobservable.len(), 3);
    let expected = golden_numbers("/acc_9par_upper_g9.79/stepwise_step2_T_min_norm");
    let base = Base::from_parameters(second.parameters.values());
    let found = (base.t * fit.unit.scale).transpose();
    assert!(largest_difference(found.as_slice(), &expected) < 1e-7);
}

#[test]
fn the_symmetric_frame_is_the_symmetric_factor() {
    let Some(folder) = phone::folder() else {
        return;
    };
    let request = Request {
        frame: calib::calibrate::Frame::Symmetric,
        ..request()
    };
    let outcome = of_the_means(&folder, &[], request);
    let t = outcome.calibration.accelerometer.unwrap().t.concat();
    let expected = golden_numbers("/acc_9par_upper_g9.79/stepwise_step2_T_min_norm");
    assert!(largest_difference(&t, &expected) < 1e-7);
}

#[test]
fn the_detector_finds_every_placement_and_no_other() {
    if phone::folder().is_none() {
        return;
    }
    for (recording, expected) in recordings(&["rec_1", "rec_2", "rec_3"])
        .iter()
        .zip([14, 10, 17])
    {
        let choice = choose_multiplier(recording, &request().detector, GRAVITY).unwrap();
        assert_eq!(
            choice.segmentation.statics.len(),
            expected,
            "{}",
            recording.name
        );
    }
}

#[test]
fn without_hand_picked_sections_the_result_stays_within_60_ppm_and_holds_on_data_not_seen() {
    let Some(folder) = phone::folder() else {
        return;
    };
    let seen = recordings(&["rec_1", "rec_2"]);
    let outcome = calibrate(&seen, &[], &request()).unwrap();
    let triad = outcome.calibration.accelerometer.as_ref().unwrap();
    assert_eq!(triad.static_intervals, Some(24));
    let reference = of_the_means(&folder, &[], request());
    let (found, expected) = (nine(&outcome), nine(&reference));
    assert!(largest_difference(&found[..3], &expected[..3]) < 60e-6);
    assert!(largest_difference(&found[6..], &expected[6..]) < 3e-4);

    let held_out = &recordings(&["rec_3"])[0];
    let cut = choose_multiplier(held_out, &request().detector, GRAVITY)
        .unwrap()
        .segmentation;
    let rms = |c| {
        evaluate(held_out, &cut, c, GRAVITY)
            .unwrap()
            .modulus_rms
            .unwrap()
    };
    assert!((rms(None) - 21.1e-3).abs() < 0.1e-3);
    assert!((rms(Some(&reference.calibration)) - 3.42e-3).abs() < 0.01e-3);
    // One placement more than the 23, the long rest at the end of rec_2, does better still.
    assert!(rms(Some(&outcome.calibration)) < 3.5e-3);
}

#[test]
fn the_three_integrators_leave_what_was_found_before() {
    let Some(folder) = phone::folder() else {
        return;
    };
    let recording = &recordings(&["rec_3"]);
    let table = folder.join("multi_position/section_limits_rec_3.csv");
    let sections: Vec<Vec<Span>> = vec![read_sections(&table, &recording[0]).unwrap()];
    let rms = |integrator, nominal_step| {
        let request = Request {
            sections: sections.clone(),
            integrator,
            nominal_step,
            ..request()
        };
        of_the_means(&folder, recording, request)
            .gyroscope
            .unwrap()
            .rms()
            .to_degrees()
    };
    assert!((rms(Integrator::Exponential, None) - 0.279).abs() < 0.002);
    // The first-order figures were made with 100 Hz for the phone's 99.75.
    assert!((rms(Integrator::FirstOrderNormalized, Some(0.01)) - 0.292).abs() < 0.002);
    assert!((rms(Integrator::FirstOrder, Some(0.01)) - 1.64).abs() < 0.005);
}

#[test]
fn the_turn_with_the_gap_is_refused_by_name_and_37_remain() {
    if phone::folder().is_none() {
        return;
    }
    let outcome = calibrate(&recordings(&["rec_1", "rec_2", "rec_3"]), &[], &request()).unwrap();
    let fit = outcome.gyroscope.unwrap();
    assert_eq!(fit.chords.len(), 37);
    assert!((fit.rms().to_degrees() - 0.36).abs() < 0.01);
    assert!((fit.rms_before().to_degrees() - 1.436).abs() < 0.01);
    let expected = [
        [0.99258, -0.00142, 0.00131],
        [0.00261, 0.99986, -0.00053],
        [0.00034, 0.00168, 0.99841],
    ];
    let t = outcome.calibration.gyroscope.unwrap().t;
    assert!(largest_difference(&t.concat(), &expected.concat()) < 1e-4);
    let texts = outcome
        .calibration
        .warnings
        .texts(findings::Front::CommandLine);
    let refused: Vec<_> = texts
        .iter()
        .filter(|w| w.contains("missing for 1.4"))
        .collect();
    assert_eq!(refused.len(), 1);
    assert!(
        refused[0].contains("rec_1: turn 6 (t = 27"),
        "{}",
        refused[0]
    );
}
