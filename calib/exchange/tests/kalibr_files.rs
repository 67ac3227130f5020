//! Files in Kalibr's form as Kalibr, imu-calib and people write them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use calib::Calibration;
use stillpoint_exchange::import::kalibr;

/// What `ImuIntrinsics::to_kalibr_yaml_string` of imu-calib 0.3.1 writes, `model` replaced.
fn imu_calib(model: &str) -> String {
    format!(
        "imu0:\n  model: {model}\n  rostopic: /imu0\n  update_rate: 200.0\n  accelerometer_noise_density: 0.00186\n  \
         accelerometer_random_walk: 0.000433\n  gyroscope_noise_density: 0.000187\n  gyroscope_random_walk: 0.0000266\n  \
         accelerometers:\n    M:\n    - [1.01, 0.0, 0.0]\n    - [0.001, 1.02, 0.0]\n    - [0.002, 0.003, 1.03]\n    \
         b: [0.1, 0.2, 0.3]\n  gyroscopes:\n    M:\n    - [0.99, 0.0, 0.0]\n    - [-0.001, 0.98, 0.0]\n    \
         - [-0.002, 0.001, 0.97]\n    A:\n    - [0.001, 0.0, 0.0]\n    - [0.0, 0.002, 0.0]\n    - [0.0, 0.0, 0.003]\n    \
         C_gyro_i:\n    - [0.99999949, 0.00071135, 0.00071417]\n    - [-0.00071004, 0.99999806, -0.00183835]\n    \
         - [-0.00071547, 0.00183784, 0.99999806]\n    b: [0.01, 0.02, 0.03]\n  time_offset: 0.0\n"
    )
}

fn biases(calibration: &Calibration) -> [Option<[f64; 3]>; 2] {
    [&calibration.accelerometer, &calibration.gyroscope]
        .map(|triad| triad.as_ref().map(|triad| triad.bias))
}

#[test]
fn biases_and_models_that_imu_calib_writes_are_read() {
    for model in [
        "calibrated",
        "scale-misalignment",
        "scale-misalignment-size-effect",
    ] {
        let read = kalibr(&imu_calib(model)).unwrap();
        assert_eq!(
            biases(&read),
            [Some([0.1, 0.2, 0.3]), Some([0.01, 0.02, 0.03])],
            "{model}"
        );
        assert!(
            !read
                .warnings
                .texts(findings::Front::CommandLine)
                .iter()
                .any(|w| w.contains("bias")),
            "{:?}",
            read.warnings
        );
        // `a = M⁻¹ (raw − b)`: 1.01 a_x + b_x is what it reads along x.
        let t = read.accelerometer.unwrap().t;
        assert!((t[0][0] - 1.0 / 1.01).abs() < 1e-12);
        assert_eq!(read.effects.len(), 1);
    }
}

#[test]
fn without_biases_it_is_said_of_the_sensors_that_have_none() {
    let without = |line: &str| imu_calib("scale-misalignment").replace(line, "");
    let said = |text: &str| {
        kalibr(text)
            .unwrap()
            .warnings
            .texts(findings::Front::CommandLine)
            .join("\n")
    };
    assert!(said(&without("    b: [0.01, 0.02, 0.03]\n")).contains("its gyroscopes have no bias"));
    let neither = without("    b: [0.01, 0.02, 0.03]\n").replace("    b: [0.1, 0.2, 0.3]\n", "");
    assert!(said(&neither).contains("its accelerometers and gyroscopes have no bias"));
    let other = imu_calib("scale-misalignment").replace("    b: [0.1", "    offset: [0.1");
    assert!(said(&other).contains("accelerometers.offset is not read"));
}

#[test]
fn the_same_numbers_in_other_legal_forms_are_the_same_calibration() {
    let whole = imu_calib("scale-misalignment");
    let read = kalibr(&whole).unwrap();
    let rows = "    - [1.01, 0.0, 0.0]\n    - [0.001, 1.02, 0.0]\n    - [0.002, 0.003, 1.03]\n";
    let json = r#"{"imu0": {"model": "scale-misalignment",
        "accelerometers": {"M": [[1.01, 0, 0], [1e-3, 1.02, 0], [2.0E-3, 0.003, 1.03]], "b": [0.1, 0.2, 0.3]},
        "gyroscopes": {"M": [[0.99, 0, 0], [-0.001, 0.98, 0], [-0.002, 0.001, 0.97]],
            "A": [[0.001, 0, 0], [0, 0.002, 0], [0, 0, 0.003]],
            "C_gyro_i": [[0.99999949, 0.00071135, 0.00071417], [-0.00071004, 0.99999806, -0.00183835],
                         [-0.00071547, 0.00183784, 0.99999806]],
            "b": [0.01, 0.02, 0.03]}}}"#;
    let forms = [
        json.to_owned(),
        json.replace('\n', "\r\n"),
        format!("\u{feff}{whole}"),
        format!("%YAML 1.2\n---\n{whole}..."),
        format!("# written by hand\n{}", whole.replace("imu0:", "imu0: # the first")),
        whole.replace("imu0:", "imu1:"),
        whole.lines().skip(1).map(|line| format!("{}\n", &line[2..])).collect(),
        whole.replace("0.001, 1.02", "1e-03, 1.02").replace("0.002, 0.003", "2e-3, .003"),
        whole.replace("model: scale-misalignment", "model: \"scale-misalignment\""),
        whole.replace(rows, "    - - 1.01\n      - 0\n      - 0.\n    - - +0.001\n      - 1.02\n      - 0\n    - - 0.002\n      - 0.003\n      - 1.03\n"),
        whole.replace(&format!("M:\n{rows}"), "M: [1.01, 0, 0, 0.001, 1.02, 0, 0.002, 0.003, 1.03]\n"),
        whole.replace(&format!("M:\n{rows}"), "M: {rows: 3, cols: 3, dt: d, data: [1.01, 0, 0, 0.001, 1.02, 0, 0.002, 0.003, 1.03]}\n"),
        whole.replace("b: [0.1, 0.2, 0.3]", "b: [[0.1], [0.2], [0.3]]"),
        whole.replace("b: [0.1, 0.2, 0.3]", "b:\n    - 0.1\n    - 0.2\n    - 0.3"),
        whole.replace("b: [0.1, 0.2, 0.3]", "b: [\"0.1\", '0.2', 0.3]"),
        whole.replace("  model: scale-misalignment\n", ""),
        format!("{whole}imu1:\n  model: calibrated\n"),
    ];
    for (k, form) in forms.iter().enumerate() {
        let other = kalibr(form).unwrap_or_else(|e| panic!("form {k}: {e}\n{form}"));
        assert_eq!(other.accelerometer, read.accelerometer, "form {k}");
        assert_eq!(other.gyroscope, read.gyroscope, "form {k}");
        assert_eq!(other.effects, read.effects, "form {k}");
    }
}

#[test]
fn a_sensor_that_the_file_does_not_have_is_not_calibrated() {
    let whole = imu_calib("calibrated");
    let (before, gyroscopes) = whole.split_once("  gyroscopes:").unwrap();
    let accelerometer = kalibr(before).unwrap();
    assert!(accelerometer.gyroscope.is_none() && accelerometer.accelerometer.is_some());
    let head = "imu0:\n  model: calibrated\n  gyroscopes:";
    let gyroscope = kalibr(&format!("{head}{gyroscopes}")).unwrap();
    assert!(gyroscope.accelerometer.is_none() && gyroscope.gyroscope.is_some());
}

#[test]
fn what_is_no_calibration_is_refused_with_its_place() {
    let whole = imu_calib("scale-misalignment");
    let noise = "rostopic: /imu0\nupdate_rate: 200.0\naccelerometer_noise_density: 1.86e-03\n";
    let cases = [
        (noise.to_owned(), "corrects nothing"),
        (
            "imu0:\n  model: calibrated\n  update_rate: 200.0\n".to_owned(),
            "corrects nothing",
        ),
        (imu_calib("kalibr"), "IMU model \"kalibr\""),
        (imu_calib("[1]"), "model"),
        (
            whole.replace("b: [0.1, 0.2, 0.3]", "b: [0.1, 0.2]"),
            "accelerometers.b: three numbers",
        ),
        (
            whole.replace("b: [0.1, 0.2, 0.3]", "b: [0.1, .nan, 0.3]"),
            "accelerometers.b: three numbers",
        ),
        (
            whole.replace("b: [0.1, 0.2, 0.3]", "b: 0.1"),
            "accelerometers.b: three numbers",
        ),
        (
            whole.replace("[0.001, 1.02, 0.0]", "[0.001, 1.02]"),
            "accelerometers.M: three rows",
        ),
        (
            whole.replace("[1.01, 0.0, 0.0]", "[0.0, 0.0, 0.0]"),
            "accelerometers.M: the three axes",
        ),
        (
            whole.replace("[0.99999949, 0.00071135", "[0.5, 0.00071135"),
            "gyroscopes.C_gyro_i is no rotation",
        ),
        (
            whole.replace("    A:\n", "    a:\n"),
            "gyroscopes.A: missing",
        ),
        ("[1, 2, 3]".to_owned(), "keys and values"),
        ("just words".to_owned(), "keys and values"),
    ];
    for (text, says) in cases {
        let said = kalibr(&text).unwrap_err().to_string();
        assert!(said.contains(says), "{says}: {said}");
    }
}
