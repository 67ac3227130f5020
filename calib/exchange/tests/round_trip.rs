//! Every export read back by its target's own rule, applied, and equal to `apply`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use calib::calibration::{EffectParameter, EffectValues, apply};
use calib::recording::Stream;
use calib::truth::{Corrector, Sample};
use calib::{Calibration, Recording};
use nalgebra::{Matrix3, Vector3};
use sensor::{DefinedParam, Definition, Sensor};
use stillpoint_exchange::{Error, Settings, Source, TARGETS, by_name, export, import};

const ACCELEROMETER: &str = "1 -0.00283 0.00412\n0 1 0.00331\n0 0 1\n0.9951 0 0\n0 1.0043 0\n0 0 0.9987\n0.21\n-0.43\n0.31\n";
const GYROSCOPE: &str = "1 -0.0017 0.0118\n0.0096 1 -0.0113\n0.003 0.007 1\n0.9663 0 0\n0 1.0021 0\n0 0 1.02\n0.0054\n-0.0305\n-0.0126\n";
const PLAIN: &str = "1 0 0\n0 1 0\n0 0 1\n0.9951 0 0\n0 1.0043 0\n0 0 0.9987\n0.21\n-0.43\n0.31\n";
const UNIT: &str = "1 0 0\n0 1 0\n0 0 1\n1 0 0\n0 1 0\n0 0 1\n0.0054\n-0.0305\n-0.0126\n";
const G: [f64; 9] = [
    1.1e-4, -0.9e-4, -0.7e-4, 0.5e-4, -0.9e-4, -0.5e-4, 1.1e-4, -1.4e-4, 1.2e-4,
];

/// A device with everything that a base model has.
fn device() -> Calibration {
    import::imu_tk(ACCELEROMETER, GYROSCOPE).unwrap()
}

/// One whose calibration PX4 and ArduPilot hold in full.
fn plain() -> Calibration {
    import::imu_tk(PLAIN, UNIT).unwrap()
}

fn with_g_sensitivity() -> Calibration {
    let mut calibration = device();
    let names = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];
    let parameters = names.iter().zip(G).map(|(name, value)| EffectParameter {
        name: (*name).into(),
        value,
        std: None,
        unit: "rad/s/(m/s^2)".into(),
    });
    calibration.effects.push(EffectValues {
        name: "gyro_g_sensitivity".into(),
        definition: None,
        parameters: parameters.collect(),
        outside: None,
    });
    calibration
}

/// One with effects of many kinds, one of them a user's own.
fn with_effects() -> Calibration {
    let mut calibration = with_g_sensitivity();
    let own = Definition {
        name: "accel_own".into(),
        y: "k * sign(fx) * fz^2 + step(wx) * k".into(),
        z: "-k^2 * abs(fx - 1) / (2 + fz^2) + 1e3 * sqrt(k^6) * t".into(),
        parameters: vec![DefinedParam::new("k", "m/s^2", 1e-2)],
        ..Definition::silent(Sensor::Accelerometer)
    };
    let added: [(&str, &[f64], Option<Definition>); 6] = [
        ("accel_quadratic", &[2e-4, -3e-4, 1e-4], None),
        ("accel_own", &[-1e-3], Some(own)),
        ("gyro_scale_temperature", &[3e-4, -2e-4, 5e-4], None),
        ("gyro_warmup", &[1e-3, 2e-3, -1e-3, 90.0], None),
        ("gyro_asymmetry", &[-4e-4, 3e-4, 2e-4], None),
        (
            "accel_misalignment_temperature",
            &[1e-4, -2e-4, 1e-4, 3e-4, -1e-4, 2e-4],
            None,
        ),
    ];
    for (name, values, definition) in added {
        let parameters = values.iter().enumerate();
        let parameters = parameters.map(|(k, value)| EffectParameter {
            name: format!("p{k}"),
            value: *value,
            std: None,
            unit: String::new(),
        });
        calibration.effects.push(EffectValues {
            name: name.into(),
            definition,
            parameters: parameters.collect(),
            outside: None,
        });
    }
    calibration
}

/// Temperature (°C) and time (s) of a reading.
fn surroundings(k: usize) -> (f64, f64) {
    (10.0 + k as f64, 5.0 * k as f64)
}

/// What the corrector makes of readings with surroundings.
fn corrected(calibration: &Calibration, readings: &[[Vector3<f64>; 2]]) -> Vec<[Vector3<f64>; 2]> {
    let mut corrector = Corrector::of(calibration).unwrap();
    let readings = readings.iter().enumerate();
    let corrected = readings.map(|(k, [a, w])| {
        let (celsius, t) = surroundings(k);
        let signal = corrector.correct(&Sample {
            t,
            accelerometer: Some(*a),
            gyroscope: Some(*w),
            temperature: Some(celsius),
        });
        [signal.accelerometer.unwrap(), signal.gyroscope.unwrap()]
    });
    corrected.collect()
}

/// Readings in all directions; both sensors at the same instants.
fn readings() -> Vec<[Vector3<f64>; 2]> {
    let wave = |k: usize, c: f64| (c * (k as f64 + 0.4)).sin();
    (0..60)
        .map(|k| {
            let a = Vector3::new(wave(k, 1.1), wave(k, 2.3), wave(k, 3.1)).normalize() * 9.8;
            let w = Vector3::new(wave(k, 0.7), wave(k, 1.9), wave(k, 2.9)) * 3.0;
            [a, w]
        })
        .collect()
}

/// What `apply` makes of them.
fn applied(calibration: &Calibration, readings: &[[Vector3<f64>; 2]]) -> Vec<[Vector3<f64>; 2]> {
    let t: Vec<f64> = (0..readings.len()).map(|k| 0.01 * k as f64).collect();
    let stream = |sensor: usize| Stream {
        t: t.clone(),
        values: readings.iter().map(|r| r[sensor]).collect(),
    };
    let recording = Recording {
        name: "r".into(),
        accelerometer: Some(stream(0)),
        gyroscope: Some(stream(1)),
        ..Recording::default()
    };
    let out = apply(calibration, &recording).unwrap();
    let (a, w) = (
        out.accelerometer.unwrap().values,
        out.gyroscope.unwrap().values,
    );
    a.into_iter().zip(w).map(|(a, w)| [a, w]).collect()
}

fn written(calibration: &Calibration, target: &str, settings: &Settings) -> Vec<Vec<u8>> {
    let target = by_name(target).unwrap();
    export(target, &Source::new(calibration), settings)
        .unwrap()
        .files
}

fn text(calibration: &Calibration, target: &str) -> String {
    let files = written(calibration, target, &Settings::default());
    String::from_utf8(files.into_iter().next().unwrap()).unwrap()
}

#[track_caller]
fn same(
    calibration: &Calibration,
    digits: f64,
    rule: impl Fn(&[Vector3<f64>; 2]) -> [Vector3<f64>; 2],
) {
    let readings = readings();
    for (own, reading) in applied(calibration, &readings).iter().zip(&readings) {
        let other = rule(reading);
        for sensor in 0..2 {
            let error = (other[sensor] - own[sensor]).norm();
            assert!(
                error <= digits * own[sensor].norm().max(1.0),
                "{sensor}: {error}"
            );
        }
    }
}

fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| c.is_whitespace() || ",;[]-".contains(c) && c != '-');
    words.filter_map(|w| w.parse().ok()).collect()
}

#[test]
fn imu_tk_reads_what_apply_does() {
    let calibration = device();
    let files = written(&calibration, "imu_tk", &Settings::default());
    // CalibratedTriad_::load and unbiasNormalize.
    let load = |file: &[u8]| {
        let mat = numbers(std::str::from_utf8(file).unwrap());
        let ms = Matrix3::from_row_slice(&mat[..9]) * Matrix3::from_row_slice(&mat[9..18]);
        (ms, Vector3::from_column_slice(&mat[18..21]))
    };
    let (acc, gyro) = (load(&files[0]), load(&files[1]));
    same(&calibration, 1e-13, |[a, w]| {
        [acc.0 * (a - acc.1), gyro.0 * (w - gyro.1)]
    });
    let texts: Vec<&str> = files
        .iter()
        .map(|f| std::str::from_utf8(f).unwrap())
        .collect();
    let again = import::imu_tk(texts[0], texts[1]).unwrap();
    same(&calibration, 1e-13, |r| applied(&again, &[*r])[0]);
}

#[test]
fn kalibrs_model_makes_the_readings_of_what_apply_makes_of_them() {
    let calibration = with_g_sensitivity();
    let yaml = text(&calibration, "kalibr");
    let rows = |sensor: &str, key: &str| {
        let part = yaml.split_once(&format!("  {sensor}:\n")).unwrap().1;
        let part = part.split_once(&format!("    {key}:\n")).unwrap().1;
        let lines: Vec<&str> = part
            .lines()
            .take(3)
            .map(|l| l.trim_start_matches([' ', '-']))
            .collect();
        let trimmed = lines.iter().map(|l| l.trim_start_matches("- "));
        let all: Vec<f64> = trimmed.flat_map(numbers).collect();
        Matrix3::from_row_slice(&all)
    };
    let (m, m_g) = (rows("accelerometers", "M"), rows("gyroscopes", "M"));
    let (ma, c_gyro_i) = (rows("gyroscopes", "A"), rows("gyroscopes", "C_gyro_i"));
    for lower in [&m, &m_g] {
        assert!(lower[(0, 1)] == 0.0 && lower[(0, 2)] == 0.0 && lower[(1, 2)] == 0.0);
    }
    let source = Source::new(&calibration);
    let (acc, gyro) = (source.accelerometer.unwrap(), source.gyroscope.unwrap());
    // Kalibr's frame, by what is left of our matrix.
    let c_i_b = m.try_inverse().unwrap() * acc.t.try_inverse().unwrap();
    for rotation in [&c_i_b, &c_gyro_i] {
        assert!((rotation * rotation.transpose() - Matrix3::identity()).amax() < 1e-12);
        assert!(rotation.determinant() > 0.0);
    }
    let readings = readings();
    for ([f, w], [raw_a, raw_w]) in applied(&calibration, &readings).iter().zip(&readings) {
        // addAccelerometerErrorTerms: a = M * (C_i_b * (C_b_w * (a_w - g_w))), + b_i
        let a = m * (c_i_b * f);
        assert!((a + acc.bias - raw_a).norm() < 1e-11);
        // addGyroscopeErrorTerms: C_gyro_b = C_gyro_i * C_i_b; w = M * (C_gyro_b * w_b) + Ma * (C_gyro_b * a_b), + b_i
        let c_gyro_b = c_gyro_i * c_i_b;
        let turned = m_g * (c_gyro_b * w) + ma * (c_gyro_b * f);
        assert!((turned + gyro.bias - raw_w).norm() < 1e-11);
    }
    // Back: the same but for Kalibr's frame, the biases taken off before.
    let again = import::kalibr(&yaml).unwrap();
    let unbiased: Vec<_> = readings
        .iter()
        .map(|[a, w]| [a - acc.bias, w - gyro.bias])
        .collect();
    for (own, other) in applied(&calibration, &readings)
        .iter()
        .zip(applied(&again, &unbiased))
    {
        for (own, other) in own.iter().zip(other) {
            assert!((c_i_b * own - other).norm() < 1e-11);
        }
    }
}

#[test]
fn ros_nodes_make_what_apply_makes() {
    let calibration = with_g_sensitivity();
    let yaml = text(&calibration, "ros");
    let sequence = |key: &str| {
        let part = yaml.split_once(&format!("{key}:\n")).unwrap().1;
        let items = part.lines().map_while(|l| l.strip_prefix("  - "));
        items.map(|v| v.parse().unwrap()).collect::<Vec<f64>>()
    };
    // loadCalib: SM_(i/3,i%3); applyCalib: SM_*raw_accel - bias_
    let (sm, bias) = (
        Matrix3::from_row_slice(&sequence("SM")),
        Vector3::from_vec(sequence("bias")),
    );
    same(&calibration, 1e-13, |r| {
        [sm * r[0] - bias, applied(&calibration, &[*r])[0][1]]
    });
    let yaml = text(&calibration, "ros2");
    let values = |sensor: &str, key: &str| {
        let part = yaml.split_once(&format!("{sensor}:\n")).unwrap().1;
        numbers(
            part.split_once(&format!("{key}: "))
                .unwrap()
                .1
                .lines()
                .next()
                .unwrap(),
        )
    };
    let matrix = |sensor: &str, key: &str| Matrix3::from_row_slice(&values(sensor, key));
    let b = |sensor: &str| Vector3::from_vec(values(sensor, "b"));
    same(&calibration, 1e-13, |[a, w]| {
        let f = matrix("accelerometer", "T") * (a - b("accelerometer"));
        let rate = matrix("gyroscope", "T") * (w - b("gyroscope")) - matrix("gyroscope", "G") * f;
        [f, rate]
    });
}

/// `name value` of lines that hold both, whatever else they hold.
fn parameters(text: &str, separator: char, name: usize) -> HashMap<String, f32> {
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(separator).collect();
            (cells[name].to_owned(), cells[name + 1].parse().unwrap())
        })
        .collect()
}

fn three(all: &HashMap<String, f32>, name: impl Fn(&str) -> String) -> Vector3<f32> {
    Vector3::from(["X", "Y", "Z"].map(|axis| all[&name(axis)]))
}

#[test]
fn px4_corrects_as_apply_does_where_it_can() {
    let calibration = plain();
    let file = text(&calibration, "px4");
    assert!(
        file.lines()
            .filter(|l| !l.starts_with('#'))
            .all(|l| l.split('\t').count() == 5)
    );
    let all = parameters(&file, '\t', 2);
    let offset = three(&all, |axis| format!("CAL_ACC0_{axis}OFF"));
    let scale = three(&all, |axis| format!("CAL_ACC0_{axis}SCALE"));
    let gyro = three(&all, |axis| format!("CAL_GYRO0_{axis}OFF"));
    // Accelerometer::Correct: _rotation * (data - _thermal_offset - _offset).emult(_scale)
    // Gyroscope::Correct: _rotation * (data - _thermal_offset - _offset)
    same(&calibration, 1e-6, |[a, w]| {
        let a = (a.map(|v| v as f32) - offset).component_mul(&scale);
        let w = w.map(|v| v as f32) - gyro;
        [a.map(f64::from), w.map(f64::from)]
    });
}

#[test]
fn ardupilot_corrects_as_apply_does_where_it_can() {
    let calibration = plain();
    // _rotate_and_correct_accel: accel -= offset; accel.x *= scale.x …; _rotate_and_correct_gyro: gyro -= offset
    let rule = |file: &str| {
        let all = parameters(file, ',', 0);
        let offset = three(&all, |axis| format!("INS_ACCOFFS_{axis}"));
        let scale = three(&all, |axis| format!("INS_ACCSCAL_{axis}"));
        let gyro = three(&all, |axis| format!("INS_GYROFFS_{axis}"));
        move |[a, w]: &[Vector3<f64>; 2]| {
            let mut accel = a.map(|v| v as f32);
            accel -= offset;
            accel = accel.component_mul(&scale);
            [
                accel.map(f64::from),
                (w.map(|v| v as f32) - gyro).map(f64::from),
            ]
        }
    };
    same(&calibration, 1e-6, rule(&text(&calibration, "ardupilot")));
    // From a log: the readings that the calibration is of were corrected by these already.
    let before = "INS_ACCOFFS_X,0.5\nINS_ACCOFFS_Y,-0.2\nINS_ACCOFFS_Z 0.1\nINS_ACCSCAL_X,1.01\nINS_ACCSCAL_Y,0.99\n\
                  INS_ACCSCAL_Z,1.02\nINS_GYROFFS_X,0.01\nINS_GYROFFS_Y,0.02\nINS_GYROFFS_Z,-0.03\n";
    let settings = Settings {
        logged_with: Some(before.into()),
        ..Settings::default()
    };
    let files = written(&calibration, "ardupilot", &settings);
    let (first, second) = (
        rule(&before.replace(' ', ",")),
        rule(std::str::from_utf8(&files[0]).unwrap()),
    );
    let readings = readings();
    let logged: Vec<_> = readings.iter().map(first).collect();
    for (own, raw) in applied(&calibration, &logged).iter().zip(&readings) {
        let other = second(raw);
        assert!((own[0] - other[0]).norm() < 2e-5 && (own[1] - other[1]).norm() < 2e-6);
    }
}

/// Runs a command in a folder and gives what it printed.
fn ran(folder: &Path, program: &str, args: &[&str]) -> String {
    let run = Command::new(program)
        .current_dir(folder)
        .args(args)
        .output();
    let run = run.unwrap_or_else(|e| panic!("{program}: {e}"));
    assert!(
        run.status.success(),
        "{program} {args:?}: {}",
        String::from_utf8_lossy(&run.stderr)
    );
    String::from_utf8(run.stdout).unwrap()
}

fn lines_of_six(printed: &str) -> Vec<[Vector3<f64>; 2]> {
    let pair = |line: &str| {
        let v = numbers(line);
        [
            Vector3::new(v[0], v[1], v[2]),
            Vector3::new(v[3], v[4], v[5]),
        ]
    };
    printed.lines().map(pair).collect()
}

#[test]
fn compiled_c_makes_what_apply_makes_in_floats() {
    for calibration in [device(), with_g_sensitivity()] {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("cal.h"), text(&calibration, "c")).unwrap();
        let force = if calibration.effects.is_empty() {
            ""
        } else {
            ", f"
        };
        let readings = readings();
        let mut main = String::from(
            "#include <stdio.h>\n#include \"cal.h\"\nint main(void) {\n    float f[3], w[3];\n",
        );
        for [a, g] in &readings {
            let list = |v: &Vector3<f64>| format!("{{{:e}f, {:e}f, {:e}f}}", v.x, v.y, v.z);
            let _ = writeln!(
                main,
                "    {{\n        const float a[3] = {}, g[3] = {};\n        stillpoint_correct_accelerometer(a, f);\n        \
                 stillpoint_correct_gyroscope(g{force}, w);\n        printf(\"%.9g %.9g %.9g %.9g %.9g %.9g\\n\", (double)f[0], \
                 (double)f[1], (double)f[2], (double)w[0], (double)w[1], (double)w[2]);\n    }}",
                list(a),
                list(g)
            );
        }
        main.push_str("    return 0;\n}\n");
        let printed = compiled_and_run(dir.path(), &main);
        for (own, other) in applied(&calibration, &readings).iter().zip(printed) {
            assert!(
                (own[0] - other[0]).norm() < 4e-6,
                "{}",
                (own[0] - other[0]).norm()
            );
            assert!(
                (own[1] - other[1]).norm() < 2e-6,
                "{}",
                (own[1] - other[1]).norm()
            );
        }
    }
}

#[test]
fn an_effect_of_nine_parameters_beside_a_g_sensitivity_is_no_g_sensitivity() {
    let names: Vec<String> = (0..9).map(|k| format!("k{k}")).collect();
    let own = Definition {
        name: "gyro_own".into(),
        x: names.join(" * wx + ") + " * wx",
        parameters: names
            .iter()
            .map(|name| DefinedParam::new(name, "1", 1e-3))
            .collect(),
        ..Definition::silent(Sensor::Gyroscope)
    };
    let mut calibration = with_g_sensitivity();
    let parameters = names.into_iter().map(|name| EffectParameter {
        name,
        value: 1e-3,
        std: None,
        unit: "1".into(),
    });
    calibration.effects.push(EffectValues {
        name: own.name.clone(),
        definition: Some(own),
        parameters: parameters.collect(),
        outside: None,
    });
    assert!(text(&calibration, "c").contains("stillpoint_correct("));
    assert!(text(&calibration, "rust").contains("pub fn correct("));
    assert!(!text(&with_g_sensitivity(), "c").contains("stillpoint_correct("));
}

#[test]
fn compiled_c_corrects_with_effects() {
    let calibration = with_effects();
    let lost = export(
        by_name("c").unwrap(),
        &Source::new(&calibration),
        &Settings::default(),
    );
    assert!(
        !lost
            .unwrap()
            .lost
            .iter()
            .any(|loss| loss.what.contains("effect"))
    );
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("cal.h"), text(&calibration, "c")).unwrap();
    let readings = readings();
    let mut main = String::from(
        "#include <stdio.h>\n#include \"cal.h\"\nint main(void) {\n    float f[3], w[3];\n",
    );
    for (k, [a, g]) in readings.iter().enumerate() {
        let list = |v: &Vector3<f64>| format!("{{{:e}f, {:e}f, {:e}f}}", v.x, v.y, v.z);
        let (celsius, t) = surroundings(k);
        let _ = writeln!(
            main,
            "    {{\n        const float a[3] = {}, g[3] = {};\n        stillpoint_correct(a, g, {celsius:e}f, {t:e}f, f, w);\n        \
             printf(\"%.9g %.9g %.9g %.9g %.9g %.9g\\n\", (double)f[0], (double)f[1], (double)f[2], (double)w[0], (double)w[1], \
             (double)w[2]);\n    }}",
            list(a),
            list(g)
        );
    }
    main.push_str("    return 0;\n}\n");
    let printed = compiled_and_run(dir.path(), &main);
    for (own, other) in corrected(&calibration, &readings).iter().zip(printed) {
        let off = [(own[0] - other[0]).norm(), (own[1] - other[1]).norm()];
        assert!(off[0] < 6e-6 && off[1] < 3e-6, "{off:?}");
    }
}

#[test]
fn compiled_rust_corrects_with_effects() {
    let calibration = with_effects();
    let dir = tempfile::tempdir().unwrap();
    let readings = readings();
    let list: Vec<String> = readings
        .iter()
        .enumerate()
        .map(|(k, [a, w])| {
            let (celsius, t) = surroundings(k);
            format!(
                "({:?}, {:?}, {celsius:?}, {t:?})",
                a.as_slice(),
                w.as_slice()
            )
        })
        .collect();
    let main = format!(
        "#![deny(warnings)]\n#[allow(dead_code)]\nmod cal;\nfn main() {{\n    for (a, w, celsius, t) in [{}] {{\n        \
         let (f, w) = cal::correct(a, w, celsius, t);\n        \
         println!(\"{{:e}} {{:e}} {{:e}} {{:e}} {{:e}} {{:e}}\", f[0], f[1], f[2], w[0], w[1], w[2]);\n    }}\n}}\n",
        list.join(", ")
    );
    std::fs::write(dir.path().join("cal.rs"), text(&calibration, "rust")).unwrap();
    std::fs::write(dir.path().join("main.rs"), main).unwrap();
    ran(
        dir.path(),
        "rustc",
        &["--edition", "2021", "main.rs", "-o", "main"],
    );
    let printed = lines_of_six(&ran(dir.path(), "./main", &[]));
    for (own, other) in corrected(&calibration, &readings).iter().zip(printed) {
        let off = [(own[0] - other[0]).norm(), (own[1] - other[1]).norm()];
        assert!(off[0] < 1e-9 && off[1] < 1e-9, "{off:?}");
    }
}

/// What a C program prints, six numbers a line.
fn compiled_and_run(dir: &Path, main: &str) -> Vec<[Vector3<f64>; 2]> {
    std::fs::write(dir.join("main.c"), main).unwrap();
    let flags = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-pedantic",
        "-Werror",
        "main.c",
        "-o",
        "main",
        "-lm",
    ];
    ran(dir, "cc", &flags);
    lines_of_six(&ran(dir, "./main", &[]))
}

#[test]
fn compiled_c_corrects_counts_in_integers() {
    let counts = |text: &str, scale: f64| {
        let mut v = numbers(text);
        v[9..18].iter_mut().for_each(|v| *v *= scale);
        v[18..].iter_mut().for_each(|v| *v /= scale);
        v.iter().map(|v| format!("{v:e} ")).collect::<String>()
    };
    let (force, rate) = (9.80665 / 2048.0, 2000f64.to_radians() / 32768.0);
    let calibration =
        import::imu_tk(&counts(ACCELEROMETER, force), &counts(GYROSCOPE, rate)).unwrap();
    let readings: Vec<[Vector3<f64>; 2]> = readings()
        .iter()
        .map(|[a, w]| {
            [
                (a * 1.5 / force).map(f64::round),
                (w * 5.0 / rate).map(f64::round),
            ]
        })
        .collect();
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("cal.h"), text(&calibration, "c")).unwrap();
    let mut main = String::from(
        "#include <stdio.h>\n#include \"cal.h\"\nint main(void) {\n    int32_t f[3], w[3];\n",
    );
    for [a, g] in &readings {
        let list = |v: &Vector3<f64>| format!("{{{}, {}, {}}}", v.x, v.y, v.z);
        let _ = writeln!(
            main,
            "    {{\n        const int16_t a[3] = {}, g[3] = {};\n        stillpoint_correct_accelerometer_counts(a, f);\n        \
             stillpoint_correct_gyroscope_counts(g, w);\n        printf(\"%ld %ld %ld %ld %ld %ld\\n\", (long)f[0], (long)f[1], \
             (long)f[2], (long)w[0], (long)w[1], (long)w[2]);\n    }}",
            list(a),
            list(g)
        );
    }
    main.push_str("    return 0;\n}\n");
    let printed = compiled_and_run(dir.path(), &main);
    for (own, other) in applied(&calibration, &readings).iter().zip(printed) {
        // Half a unit of rounding, and what 16 binary places leave of the matrix.
        assert!(
            (own[0] * 1e3 - other[0]).amax() < 0.7,
            "{}",
            (own[0] * 1e3 - other[0]).amax()
        );
        assert!(
            (own[1] * 1e6 - other[1]).amax() < 0.9,
            "{}",
            (own[1] * 1e6 - other[1]).amax()
        );
    }
}

#[test]
fn compiled_rust_makes_what_apply_makes() {
    for calibration in [device(), with_g_sensitivity()] {
        let dir = tempfile::tempdir().unwrap();
        let force = if calibration.effects.is_empty() {
            ""
        } else {
            ", f"
        };
        let readings = readings();
        let list: Vec<String> = readings
            .iter()
            .map(|[a, w]| {
                format!(
                    "([{:?}, {:?}, {:?}], [{:?}, {:?}, {:?}])",
                    a.x, a.y, a.z, w.x, w.y, w.z
                )
            })
            .collect();
        let main = format!(
            "#![deny(warnings)]\nmod cal;\nfn main() {{\n    let _ = (cal::ACCELEROMETER_T, cal::GYROSCOPE_T);\n    for (a, w) in [{}] {{\n        \
             let f = cal::correct_accelerometer(a);\n        let w = cal::correct_gyroscope(w{force});\n        \
             println!(\"{{:e}} {{:e}} {{:e}} {{:e}} {{:e}} {{:e}}\", f[0], f[1], f[2], w[0], w[1], w[2]);\n    }}\n}}\n",
            list.join(", ")
        );
        std::fs::write(dir.path().join("cal.rs"), text(&calibration, "rust")).unwrap();
        std::fs::write(dir.path().join("main.rs"), main).unwrap();
        ran(
            dir.path(),
            "rustc",
            &["--edition", "2021", "main.rs", "-o", "main"],
        );
        let printed = lines_of_six(&ran(dir.path(), "./main", &[]));
        for (own, other) in applied(&calibration, &readings).iter().zip(printed) {
            assert!((own[0] - other[0]).norm() < 1e-13 && (own[1] - other[1]).norm() < 1e-13);
        }
    }
}

/// The numbers behind a key in a text of a language, up to where the value ends.
fn behind(text: &str, section: &str, key: &str, end: &str) -> Vec<f64> {
    let part = text.split_once(section).unwrap().1;
    let part = part.split_once(key).unwrap().1;
    numbers(&part.split_once(end).unwrap().0.replace("np.array(", ""))
}

#[test]
fn documents_hold_all_of_it() {
    let calibration = with_g_sensitivity();
    let source = Source::new(&calibration);
    for name in ["toml", "matlab", "numpy", "npz"] {
        let export = export(by_name(name).unwrap(), &source, &Settings::default()).unwrap();
        assert_eq!(export.lost, [], "{name}");
    }
    let toml: toml::Table = text(&calibration, "toml").parse().unwrap();
    let of_toml = |sensor: &str, key: &str| numbers(&toml[sensor][key].to_string());
    let matlab = text(&calibration, "matlab");
    let of_matlab = |sensor: &str, key: &str| {
        behind(
            &matlab,
            &format!("'{sensor}'"),
            &format!("'{key}', {{["),
            "]}",
        )
    };
    let numpy = text(&calibration, "numpy");
    let of_numpy = |sensor: &str, key: &str| {
        behind(
            &numpy,
            &format!("\"{sensor}\": {{"),
            &format!("\"{key}\": np.array("),
            ")",
        )
    };
    let archive = arrays(&written(&calibration, "npz", &Settings::default())[0]);
    let of_npz = |sensor: &str, key: &str| archive[&format!("{sensor}_{key}")].1.clone();
    type Read<'a> = &'a dyn Fn(&str, &str) -> Vec<f64>;
    let ways: [Read<'_>; 4] = [&of_toml, &of_matlab, &of_numpy, &of_npz];
    for read in ways {
        let base = |sensor: &str| {
            (
                Matrix3::from_row_slice(&read(sensor, "T")),
                Vector3::from_vec(read(sensor, "bias")),
            )
        };
        let (acc, gyro) = (base("accelerometer"), base("gyroscope"));
        let g = Matrix3::from_row_slice(&G);
        same(&calibration, 1e-15, |[a, w]| {
            let f = acc.0 * (a - acc.1);
            [f, gyro.0 * (w - gyro.1) - g * f]
        });
    }
    assert_eq!(archive["g_sensitivity"], (vec![3, 3], G.to_vec()));
}

#[test]
fn python_runs_the_module_and_numpy_loads_the_archive() {
    let dir = tempfile::tempdir().unwrap();
    let numpy = Command::new("python3")
        .args(["-c", "import numpy"])
        .output();
    if !numpy.is_ok_and(|run| run.status.success()) {
        println!("skipped: no python3 with NumPy");
        return;
    }
    let calibration = with_g_sensitivity();
    for (target, file) in [("numpy", "cal.py"), ("npz", "cal.npz")] {
        let files = written(&calibration, target, &Settings::default());
        std::fs::write(dir.path().join(file), &files[0]).unwrap();
    }
    let readings = readings();
    let list: Vec<String> = readings
        .iter()
        .map(|[a, w]| format!("{:?}", [a.x, a.y, a.z, w.x, w.y, w.z]))
        .collect();
    let script = format!(
        "import numpy as np, json, cal\nr = np.array([{}])\nz = np.load('cal.npz')\nassert json.loads(str(z['cal_json']))['schema']\n\
         assert np.array_equal(z['accelerometer_T'], cal.calibration['accelerometer']['T'])\n\
         f = cal.accelerometer(r[:, :3])\n\
         for a, w in zip(f, cal.gyroscope(r[:, 3:], f)): print(*map(repr, map(float, [*a, *w])))\n",
        list.join(", ")
    );
    std::fs::write(dir.path().join("main.py"), script).unwrap();
    let printed = lines_of_six(&ran(dir.path(), "python3", &["main.py"]));
    for (own, other) in applied(&calibration, &readings).iter().zip(printed) {
        assert!((own[0] - other[0]).norm() < 1e-13 && (own[1] - other[1]).norm() < 1e-13);
    }
}

#[test]
fn octave_runs_the_script() {
    let dir = tempfile::tempdir().unwrap();
    if Command::new("octave").arg("--version").output().is_err() {
        println!("skipped: no octave");
        return;
    }
    let calibration = with_g_sensitivity();
    let files = written(&calibration, "matlab", &Settings::default());
    std::fs::write(dir.path().join("imu.m"), &files[0]).unwrap();
    let readings = readings();
    let rows: Vec<String> = readings
        .iter()
        .map(|[a, w]| {
            format!(
                "{:?} {:?} {:?} {:?} {:?} {:?}",
                a.x, a.y, a.z, w.x, w.y, w.z
            )
        })
        .collect();
    let script = format!(
        "imu\nr = [{}];\nf = cal_accelerometer(r(:, 1:3));\nprintf('%.17g %.17g %.17g %.17g %.17g %.17g\\n', [f cal_gyroscope(r(:, 4:6), f)]');\n",
        rows.join("; ")
    );
    std::fs::write(dir.path().join("main.m"), script).unwrap();
    let arguments = ["--no-gui", "--quiet", "--norc", "main.m"];
    let printed = lines_of_six(&ran(dir.path(), "octave", &arguments));
    for (own, other) in applied(&calibration, &readings).iter().zip(printed) {
        assert!((own[0] - other[0]).norm() < 1e-13 && (own[1] - other[1]).norm() < 1e-13);
    }
}

/// The arrays of numbers of an npz: local headers one after the other, then `.npy` version 1.0.
fn arrays(bytes: &[u8]) -> HashMap<String, (Vec<usize>, Vec<f64>)> {
    let u16_at = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
    let u32_at = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let mut all = HashMap::new();
    let mut at = 0;
    while &bytes[at..at + 4] == b"PK\x03\x04" {
        let (size, name) = (u32_at(at + 18), u16_at(at + 26));
        let entry = std::str::from_utf8(&bytes[at + 30..at + 30 + name]).unwrap();
        let file = &bytes[at + 30 + name..at + 30 + name + size];
        assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&file[10..10 + length]).unwrap();
        if header.contains("'<f8'") {
            let shape = header
                .split_once("'shape': (")
                .unwrap()
                .1
                .split_once(')')
                .unwrap()
                .0;
            let shape = shape
                .split(',')
                .filter_map(|n| n.trim().parse().ok())
                .collect();
            let numbers = file[10 + length..].chunks_exact(8);
            let numbers = numbers
                .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
                .collect();
            all.insert(entry.trim_end_matches(".npy").to_owned(), (shape, numbers));
        }
        at += 30 + name + size;
    }
    all
}

#[test]
fn what_is_lost_is_named_with_its_size() {
    let calibration = with_g_sensitivity();
    let source = Source::new(&calibration);
    let lost = |target: &str| {
        export(by_name(target).unwrap(), &source, &Settings::default())
            .unwrap()
            .lost
    };
    let what = |target: &str| {
        lost(target)
            .iter()
            .map(|l| l.what.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(what("imu_tk"), ["the effect gyro_g_sensitivity"]);
    assert_eq!(
        what("kalibr"),
        ["bias of the accelerometer", "bias of the gyroscope"]
    );
    assert_eq!(
        what("ros"),
        [
            "the whole calibration of the gyroscope",
            "the effect gyro_g_sensitivity"
        ]
    );
    assert_eq!(what("ros2"), [""; 0]);
    let all = [
        "misalignments of the accelerometer",
        "misalignments of the gyroscope",
        "scale factors of the gyroscope",
        "the effect gyro_g_sensitivity",
    ];
    assert_eq!(what("px4"), all);
    assert_eq!(what("ardupilot"), all);
    // Off-diagonal elements of T times a reading of g: at most 9.8 * (.0041 + .0033 + .0028), at least the largest of them.
    let sizes: Vec<f64> = lost("px4").iter().map(|l| l.size.unwrap()).collect();
    assert!((0.04..0.1).contains(&sizes[0]), "{sizes:?}");
    // 3.4 % of the x axis and more.
    assert!((0.033..0.037).contains(&sizes[2]), "{sizes:?}");
    // The largest singular value of G, or nearly, times g.
    let g = Matrix3::from_row_slice(&G).singular_values().max() * 9.80665;
    assert!(
        sizes[3] <= g * (1.0 + 1e-12) && sizes[3] > 0.8 * g,
        "{sizes:?} {g}"
    );
    assert!(lost("px4")[0].to_string().contains("mm/s² at 1 g"));
}

#[test]
fn what_a_target_cannot_hold_is_refused_by_name() {
    let mut lame = device();
    lame.gyroscope = None;
    let result = |c: &Calibration, name: &str, s: &Settings| {
        export(by_name(name).unwrap(), &Source::new(c), s)
    };
    let none = Settings::default();
    for name in ["imu_tk", "kalibr"] {
        let said = result(&lame, name, &none).unwrap_err().to_string();
        assert!(
            said.contains("no gyroscope") && said.contains(name),
            "{said}"
        );
    }
    for target in TARGETS
        .iter()
        .filter(|t| !["imu_tk", "kalibr"].contains(&t.name))
    {
        assert!(result(&lame, target.name, &none).is_ok(), "{target:?}");
    }
    let counts = import::imu_tk(
        &PLAIN
            .replace("0.9951", "0.0048")
            .replace("1.0043", "0.0048")
            .replace("0.9987", "0.0048"),
        UNIT,
    )
    .unwrap();
    for name in ["kalibr", "ros", "ros2", "px4", "ardupilot"] {
        let said = result(&counts, name, &none).unwrap_err().to_string();
        assert!(
            said.contains("in count") && said.contains("m/s^2"),
            "{said}"
        );
    }
    let large = import::imu_tk(&PLAIN.replace("0.9951", "1.31"), UNIT).unwrap();
    let said = result(&large, "ardupilot", &none).unwrap_err().to_string();
    assert!(
        said.contains("INS_ACCSCAL_X would be 1.31") && said.contains("0.8 to 1.2"),
        "{said}"
    );
    let mirrored = import::imu_tk(&ACCELEROMETER.replace("0.9951", "-0.9951"), GYROSCOPE).unwrap();
    assert!(matches!(
        result(&mirrored, "kalibr", &none),
        Err(Error::LeftHanded {
            sensor: "accelerometer",
            ..
        })
    ));
    for target in ["px4", "ardupilot"] {
        assert!(matches!(
            result(&mirrored, target, &none),
            Err(Error::Flipped {
                sensor: "accelerometer",
                ..
            })
        ));
    }
    let fifth = Settings {
        instance: 5,
        ..Settings::default()
    };
    for name in ["px4", "ardupilot"] {
        assert!(
            result(&device(), name, &fifth)
                .unwrap_err()
                .to_string()
                .contains("sensor 5")
        );
    }
    let broken = Settings {
        logged_with: Some("INS_ACCOFFS_X,abc\n".into()),
        ..Settings::default()
    };
    assert!(
        result(&device(), "ardupilot", &broken)
            .unwrap_err()
            .to_string()
            .contains("line 1")
    );
}

#[test]
fn what_cannot_be_imported_is_refused_with_its_place() {
    let said = |text: &str| import::kalibr(text).unwrap_err().to_string();
    assert!(said("").contains("empty"));
    let open = import::kalibr("a: [1, 2").unwrap_err().finding();
    assert_eq!(open.place.line, Some(2), "{open}");
    assert!(said("rostopic: /imu0\n").contains("no accelerometers and no gyroscopes"));
    assert!(said("accelerometers: {}\n").contains("accelerometers.M: missing"));
    let yaml = text(&device(), "kalibr");
    let singular = yaml.replacen("    - [", "    - [0.0, 0.0, 0.0]\n    - [", 1);
    assert!(
        said(&singular).contains("three rows"),
        "{}",
        said(&singular)
    );
    let said = |a: &str, b: &str| import::imu_tk(a, b).unwrap_err().to_string();
    assert!(
        said(&ACCELEROMETER.replace("0.21", "nan"), GYROSCOPE).contains("accelerometer, line 7")
    );
    assert!(said(ACCELEROMETER, "1 2 3").contains("gyroscope: 3 numbers found, 21"));
    assert!(said(&ACCELEROMETER.replace("0.9951", "0"), GYROSCOPE).contains("no inverse"));
}

#[test]
fn names_from_outside_end_no_comment() {
    let mut calibration = device();
    calibration.created_by = "x */ int main; /* \n # evil \u{1b}[0m".into();
    for target in ["c", "rust", "ros", "ros2", "kalibr", "px4", "ardupilot"] {
        let text = text(&calibration, target);
        assert!(
            !text.contains("x */") && !text.contains("\n # evil") && !text.contains('\u{1b}'),
            "{target}"
        );
    }
}
