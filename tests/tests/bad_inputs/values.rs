//! Cases 80 to 103: values and their units.

use super::bench::{Bench, Run};
use super::device::{HEADER, Row, csv, good, lines, spoilt, table};

const G: f64 = 9.80665;

#[track_caller]
fn calibrate(content: impl AsRef<[u8]>, more: &[&str]) -> Run {
    let bench = Bench::with("r.csv", content);
    bench.run(&[&["calibrate", "r.csv"], more].concat())
}

/// The accelerometer times `accel`, the gyroscope times `gyro`.
fn scaled(accel: f64, gyro: f64) -> String {
    csv(&spoilt(|_, row| {
        row[1..4].iter_mut().for_each(|v| *v *= accel);
        row[4..7].iter_mut().for_each(|v| *v *= gyro);
    }))
}

/// The diagonal of a triad's `T`.
#[track_caller]
fn scale_of(run: &Run, sensor: &str) -> [f64; 3] {
    let t = &run.json()[sensor]["T"];
    [0, 1, 2].map(|k| t[k][k].as_f64().unwrap())
}

#[test]
fn case_080_an_accelerometer_in_other_units() {
    // g is converted on reading; a unit that is not recognised is carried by T.
    for (factor, unit) in [(1.0 / G, 1.0), (1000.0 / G, 1000.0 / G), (100.0, 100.0)] {
        let run = calibrate(scaled(factor, 1.0), &["--json"]);
        run.ends(0);
        assert!(
            run.stderr.contains("accelerometer") || run.stderr.contains("r.csv"),
            "{run:#?}"
        );
        for s in scale_of(&run, "accelerometer") {
            assert!((s * unit - 1.0).abs() < 0.05, "{factor}: {s}");
        }
    }
}

#[test]
fn case_081_degrees_per_second() {
    let degree = std::f64::consts::PI / 180.0;
    let run = calibrate(scaled(1.0, 1.0 / degree), &["--json"]);
    run.ends(0).says(&["deg/s", "--gyro-unit"]);
    for s in scale_of(&run, "gyroscope") {
        assert!((s - 1.0).abs() < 0.05, "{s}");
    }
}

#[test]
fn case_082_columns_by_name_not_by_place() {
    let swapped: Vec<String> = lines(good())
        .iter()
        .map(|line| {
            let c: Vec<&str> = line.split(',').collect();
            [c[0], c[3], c[2], c[1], c[6], c[5], c[4]].join(",")
        })
        .collect();
    let usual = calibrate(csv(good()), &["--json"]);
    let run = calibrate(table("t,az,ay,ax,gz,gy,gx", &swapped), &["--json"]);
    assert_eq!(run.ends(0).json()["covariance"], usual.json()["covariance"]);
}

#[test]
fn case_083_the_gyroscope_first() {
    let swapped: Vec<String> = lines(good())
        .iter()
        .map(|line| {
            let c: Vec<&str> = line.split(',').collect();
            [c[0], c[4], c[5], c[6], c[1], c[2], c[3]].join(",")
        })
        .collect();
    calibrate(table("t,gx,gy,gz,ax,ay,az", &swapped), &[]).ends(0);
    calibrate(swapped.join("\n"), &[]).ends(0).says(&["gx=2"]);
}

#[test]
fn case_086_axes_of_the_gyroscope_turned_by_a_right_angle() {
    let rows = spoilt(|_, row| {
        let (x, y) = (row[4], row[5]);
        row[4] = y;
        row[5] = -x;
    });
    let run = calibrate(csv(&rows), &[]);
    run.says(&["axes"]);
    assert!(matches!(run.status, Some(0 | 1)), "{run:#?}");
    let joint = calibrate(csv(&rows), &["--method", "joint"]);
    joint.ends(0).says(&["axes are turned"]);
    assert!(joint.stdout.starts_with("With care"), "{joint:#?}");
}

#[test]
fn case_086b_an_accelerometer_with_one_wrong_sign_is_not_good() {
    let rows = spoilt(|_, row| row[3] = -row[3]);
    let run = calibrate(csv(&rows), &["--method", "joint"]);
    run.ends(0)
        .says(&["the accelerometer is mirrored", "data sheet", "--flip az"]);
    assert!(run.stdout.starts_with("With care"), "{run:#?}");
}

#[test]
fn case_087_a_negative_scale_is_not_exported_where_no_sign_can_be_kept() {
    let rows = spoilt(|_, row| row[4..6].iter_mut().for_each(|v| *v = -*v));
    let bench = Bench::with("r.csv", csv(&rows));
    bench
        .run(&["calibrate", "r.csv", "-o", "cal.json"])
        .ends(0)
        .says(&["x and y are flipped"]);
    for target in ["px4", "ardupilot"] {
        let run = bench.run(&["export", "cal.json", "--to", target, "-o", "out"]);
        run.ends(1).says(&["--flip gx,gy"]).changes(&[]);
    }
    let run = bench.run(&["export", "cal.json", "--to", "c", "-o", "out.h"]);
    run.ends(0);
}

#[test]
fn case_088_a_bias_of_half_a_g() {
    let rows = spoilt(|_, row| row[1] += 0.5 * G);
    calibrate(csv(&rows), &[]).ends(0);
}

#[test]
fn case_089_absurd_sizes() {
    for size in ["1e300", "-1e300"] {
        let mut rows = lines(good());
        rows[48] = format!("0.48,{size},2,3,4,5,6");
        calibrate(table(HEADER, &rows), &[])
            .ends(3)
            .says(&["r.csv", "ax"]);
    }
}

#[test]
fn case_091_an_axis_of_zeros() {
    let rows = spoilt(|_, row| row[5] = 0.0);
    calibrate(csv(&rows), &[]).ends(3).says(&["gy"]);
}

#[test]
fn case_095_an_accelerometer_without_gravity() {
    let rows = spoilt(|k, row| {
        let mean = good()[k - k % 50];
        for axis in 1..4 {
            row[axis] -= mean[axis];
        }
    });
    calibrate(csv(&rows), &[]).ends(3).says(&["gravity"]);
}

#[test]
fn case_096_readings_that_the_system_has_corrected() {
    // Corrected readings show at a gyroscope whose static mean is zero to within its error.
    let bias: [f64; 3] = {
        let still: Vec<&Row> = good().iter().take_while(|row| row[0] < 19.0).collect();
        [4, 5, 6].map(|k| still.iter().map(|row| row[k]).sum::<f64>() / still.len() as f64)
    };
    let rows = spoilt(|_, row| (0..3).for_each(|k| row[4 + k] -= bias[k]));
    let run = calibrate(csv(&rows), &[]);
    run.ends(0)
        .says(&["reads zero at rest", "while that software subtracts"]);
    calibrate(csv(good()), &[]).is_silent_on(&["that software subtracts"]);
}

#[test]
fn case_098_temperatures_that_cannot_be() {
    let with = |celsius: &dyn Fn(f64) -> f64| -> String {
        let line = |row: &Row| format!("{},{:.3}", super::device::line(row), celsius(row[0]));
        let rows: Vec<String> = good().iter().map(line).collect();
        table("t,ax,ay,az,gx,gy,gz,temp", &rows)
    };
    calibrate(with(&|t| 298.0 + 0.01 * t), &[]).ends(0).says(&[
        "are beyond -60 to 150. The program",
        "--columns temp=temp-273.15",
        "makes 24.9 to",
    ]);
    calibrate(with(&|t| 521.0 + t), &[])
        .ends(0)
        .says(&["are beyond -60 to 150. The program", "temp [K]"]);
    calibrate(with(&|t| 98.0 + 0.01 * t), &[]).ends(0).says(&[
        "are taken as °C",
        "in °F they would be 36.7 °C to",
        "temp [F]",
    ]);
    // Boards that heat their sensor keep it below.
    calibrate(with(&|t| 55.0 + 0.01 * t), &[])
        .ends(0)
        .is_silent_on(&["°F"]);
    let bench = Bench::with("r.csv", with(&|_| 25.0));
    let run = bench.run(&["calibrate", "r.csv", "--effects", "accel_temperature"]);
    run.ends(4).says(&[
        "cannot be found",
        "accel_temperature.x, accel_temperature.y",
    ]);
}

#[test]
fn case_099_a_temperature_with_stamps_of_its_own() {
    let columns = |from: usize| {
        let line = |row: &Row| {
            let [x, y, z] = [0, 1, 2].map(|axis| row[from + axis]);
            format!("{:.4},{x:.6},{y:.6},{z:.6}", row[0])
        };
        good().iter().map(line).collect::<Vec<_>>()
    };
    let end = good().last().unwrap()[0];
    let with = |shift: f64| {
        let bench = Bench::with("r/acc.csv", table("t,ax,ay,az", &columns(1)));
        bench.write("r/gyro.csv", table("t,gx,gy,gz", &columns(4)));
        let line = |k: u32| {
            let t = 1.7 * f64::from(k);
            format!("{:.2},{:.2}", t + shift, 20.0 + 0.05 * t)
        };
        let lines: Vec<String> = (0..=(end / 1.7) as u32).map(line).collect();
        bench.write("r/temp.csv", table("t,temp", &lines));
        bench.run(&["calibrate", "r", "--effects", "accel_temperature", "--json"])
    };
    // Read between its own stamps.
    let run = with(0.0);
    run.ends(0).is_silent_on(&["the temperature is known from"]);
    assert_eq!(run.json()["effects"][0]["name"], "accel_temperature");
    with(-0.2 * end)
        .ends(0)
        .says(&["the temperature is known from", "taken as constant"]);
    with(1.7e9)
        .ends(4)
        .says(&["the temperature is known from", "leaves", "one clock"]);
}

#[test]
fn case_099_the_temperature_of_a_magnetometer_is_not_the_sensors() {
    let lines = |names: &str, from: usize, temperature: Option<f64>| {
        let line = |row: &Row| {
            let [x, y, z] = [0, 1, 2].map(|axis| row[from + axis]);
            let warmer = temperature.map(|start| format!(",{:.3}", start + 0.05 * row[0]));
            let warmer = warmer.unwrap_or_default();
            format!("{:.4},{x:.6},{y:.6},{z:.6}{warmer}", row[0])
        };
        table(names, &good().iter().map(line).collect::<Vec<_>>())
    };
    let bench = Bench::with("r/acc.csv", lines("t,ax,ay,az,temp", 1, Some(20.0)));
    bench.write("r/gyro.csv", lines("t,gx,gy,gz", 4, None));
    bench.write("r/mag.csv", lines("t,mx,my,mz,temp", 1, Some(50.0)));
    bench.run(&["convert", "r", "-o", "out.csv"]).ends(0);
    let text = std::fs::read_to_string(bench.path("out.csv")).unwrap();
    let (names, first) = text.split_once('\n').unwrap();
    let at = names.split(',').position(|name| name == "temp").unwrap();
    let first = first.lines().next().unwrap().split(',').nth(at).unwrap();
    assert!(
        (first.parse::<f64>().unwrap() - 20.0).abs() < 0.1,
        "{first}"
    );
}

#[test]
fn case_099_a_column_of_temperature_is_no_sensor() {
    let rows: Vec<String> = good()
        .iter()
        .map(|row| format!("{:.4},20,21,22", row[0]))
        .collect();
    calibrate(table("t,temp,p,q", &rows), &["--columns", "temp=2"])
        .ends(3)
        .says(&[
            "no columns of an accelerometer or a gyroscope among",
            "--columns",
        ]);
}

#[test]
fn case_100_a_wrong_gravity() {
    calibrate(csv(good()), &["--gravity", "48.1"])
        .ends(2)
        .says(&["--gravity"]);
    let run = calibrate(csv(good()), &["--gravity", "9.70"]);
    run.ends(2).says(&["9.76", "9.84"]);
}

#[test]
fn case_101_no_gyroscope() {
    let rows: Vec<String> = lines(good())
        .iter()
        .map(|line| line.split(',').take(4).collect::<Vec<_>>().join(","))
        .collect();
    calibrate(table("t,ax,ay,az", &rows), &[])
        .ends(0)
        .says(&["gyroscope"]);
}

#[test]
fn case_102_no_accelerometer() {
    let rows: Vec<String> = lines(good())
        .iter()
        .map(|line| {
            let c: Vec<&str> = line.split(',').collect();
            [c[0], c[4], c[5], c[6]].join(",")
        })
        .collect();
    let run = calibrate(table("t,gx,gy,gz", &rows), &[]);
    run.ends(0).says(&["accelerometer"]);
}

#[test]
fn case_103_sixteen_bits_that_overflow() {
    let rows = spoilt(|_, row| {
        for v in &mut row[1..4] {
            let counts = (*v / 0.00025).round() as i64;
            *v = f64::from(((counts + 32768).rem_euclid(65536) - 32768) as i32);
        }
        for v in &mut row[4..7] {
            *v = (*v / 0.001).round();
        }
    });
    calibrate(csv(&rows), &[])
        .ends(3)
        .says(&["beyond what 16 bits hold"]);
}

#[test]
fn case_085_one_axis_flipped() {
    let rows = spoilt(|_, row| row[4] = -row[4]);
    let run = calibrate(csv(&rows), &[]);
    run.ends(1).says(&["--flip gx"]);
    let joint = calibrate(csv(&rows), &["--method", "joint"]);
    joint.ends(1).says(&["x is flipped", "--flip gx"]);
    calibrate(csv(&rows), &["--flip", "gx"]).ends(0);
}

#[test]
fn case_090_a_sensor_that_is_stuck_from_a_row_on() {
    let stuck = good()[4000][1];
    let rows = spoilt(|k, row| {
        if k >= 4000 {
            row[1] = stuck;
        }
    });
    let run = calibrate(csv(&rows), &[]);
    run.ends(3).says(&["ax", "4002"]);
}

#[test]
fn case_092_a_saturated_axis() {
    let rows = spoilt(|_, row| {
        row[4..7].iter_mut().for_each(|v| *v = v.clamp(-1.2, 1.2));
    });
    let run = calibrate(csv(&rows), &[]);
    run.says(&["satura", "68.8 °/s"]);
    assert!(matches!(run.status, Some(0 | 4)), "{run:#?}");
}

#[test]
fn case_093_steps_wider_than_the_noise() {
    let rows = spoilt(|_, row| {
        row[1..4]
            .iter_mut()
            .for_each(|v| *v = (*v / 0.05).round() * 0.05);
    });
    let run = calibrate(csv(&rows), &[]);
    run.ends(0).says(&["step", "accelerometer"]);
}

#[test]
fn case_094_spikes_of_a_bus() {
    let rows = spoilt(|k, row| {
        if [3000, 6000, 9000].contains(&k) {
            row[1] = 327.67;
        }
    });
    let run = calibrate(csv(&rows), &[]);
    run.ends(0).says(&["3002", "6002", "9002"]);
}

#[test]
fn case_097_a_gyroscope_with_a_dead_zone() {
    let rows = spoilt(|_, row| {
        for v in &mut row[4..7] {
            if v.abs() < 0.05 {
                *v = 0.0;
            }
        }
    });
    let run = calibrate(csv(&rows), &[]);
    run.ends(0).says(&["zero", "gyroscope"]);
}
