//! Units, scales, axes and hands that gravity and the turns contradict: each is said with the option that mends it.

use calib::simulate::{HandHeld, Motion};

use super::bench::{Bench, Run};
use super::device::{HEADER, Row, csv, good, lines, rows, spec, spoilt, table};

const G: f64 = 9.80665;
const SI: &str = "t (s),ax (m/s^2),ay (m/s^2),az (m/s^2),gx (rad/s),gy (rad/s),gz (rad/s)";

#[track_caller]
fn calibrate(content: impl AsRef<[u8]>, more: &[&str]) -> Run {
    let bench = Bench::with("r.csv", content);
    bench.run(&[&["calibrate", "r.csv"], more].concat())
}

/// The good recording with a change of one column, from 1.
fn column(at: usize, change: impl Fn(f64) -> f64) -> Vec<Row> {
    spoilt(|_, row| row[at] = change(row[at]))
}

#[test]
fn an_axis_in_another_unit_or_range_fails_the_gate_by_every_method_with_what_mends_it() {
    for (at, factor, method, option) in [
        (1, 1.0 / G, "joint", "ax=ax*9.80665"),
        (3, 2.0, "stepwise", "az=az*0.5"),
        (2, 0.5, "joint", "ay=ay*2"),
        (5, 2.0, "joint", "gy=gy*0.5"),
    ] {
        let content = csv(&column(at, |v| v * factor));
        calibrate(content, &["--method", method])
            .ends(1)
            .says(&[option]);
    }
    // A factor that no unit or range explains may be the sensor's own.
    for (at, factor, option) in [(2, 1.1, "ay=ay*"), (6, 0.9, "gz=gz*")] {
        let content = csv(&column(at, |v| v * factor));
        calibrate(content, &["--method", "stepwise"])
            .ends(0)
            .says(&["that unusual", option]);
    }
    let content = csv(&column(3, |v| v * 2.0));
    calibrate(&content, &["--columns", "az=az*0.5"]).ends(0);
    let bench = Bench::with("r.csv", &content);
    bench.run(&["evaluate", "r.csv"]).says(&["az=az*0.5"]);
}

#[test]
fn all_axes_of_a_wrong_scale_and_gravity_that_was_taken_off_fail_the_gate() {
    let large = spoilt(|_, row| row[1..4].iter_mut().for_each(|v| *v *= 1.1));
    calibrate(csv(&large), &[])
        .ends(1)
        .says(&["on all axes alike", "ax=ax*"]);
    let off = csv(&column(3, |v| v - G));
    calibrate(&off, &[]).ends(1).says(&["az=az+9.80665"]);
    calibrate(&off, &["--columns", "az=az+9.80665"]).ends(0);
}

#[test]
fn a_unit_that_gravity_or_the_turns_contradict_is_refused_with_the_right_one_whoever_states_it() {
    let in_g = spoilt(|_, row| row[1..4].iter_mut().for_each(|v| *v /= G));
    calibrate(table(SI, &lines(&in_g)), &[])
        .ends(3)
        .says(&["--accel-unit g"]);
    calibrate(csv(good()), &["--accel-unit", "g"])
        .ends(3)
        .says(&["--accel-unit m/s^2"]);
    calibrate(csv(good()), &["--gyro-unit", "deg/s"])
        .ends(3)
        .says(&["--gyro-unit rad/s"]);
    let twice = spoilt(|_, row| row[1..4].iter_mut().for_each(|v| *v *= 2.0));
    calibrate(table(SI, &lines(&twice)), &[])
        .ends(3)
        .says(&["times gravity", "--accel-unit counts"]);
}

#[test]
fn a_normalised_accelerometer_is_a_direction_and_no_force() {
    for size in [1.0, G] {
        let rows = spoilt(|_, row| {
            let length = row[1].hypot(row[2]).hypot(row[3]);
            row[1..4].iter_mut().for_each(|v| *v *= size / length);
        });
        calibrate(csv(&rows), &[]).ends(3).says(&["normalised"]);
    }
}

#[test]
fn an_axis_that_repeats_another_is_named() {
    for (at, of, factor) in [(5, 4, 1.0), (6, 4, -1.0), (3, 1, 2.0)] {
        let rows = spoilt(|_, row| row[at] = factor * row[of]);
        calibrate(csv(&rows), &[]).ends(3).says(&["in every row"]);
    }
}

#[test]
fn swapped_sensors_are_told_whatever_unit_they_state() {
    let swap = |row: &Row| [row[0], row[4], row[5], row[6], row[1], row[2], row[3]];
    let swapped: Vec<Row> = good().iter().map(swap).collect();
    for header in [HEADER, SI] {
        let run = calibrate(table(header, &lines(&swapped)), &[]);
        run.ends(3)
            .says(&["names are swapped", "--columns", "gx=ax"]);
    }
}

#[test]
fn a_mirrored_accelerometer_and_a_turned_gyroscope_are_both_offered() {
    for (at, accel, gyro) in [
        (1, "--flip ax", "--flip gy,gz"),
        (3, "--flip az", "--flip gx,gy"),
    ] {
        let run = calibrate(csv(&column(at, |v| -v)), &[]);
        run.says(&[accel, gyro, "left-handed"]);
    }
    let exchanged = spoilt(|_, row| row.swap(1, 2));
    calibrate(csv(&exchanged), &[]).says(&["ax=ay,ay=ax"]);
}

#[test]
fn a_recording_in_turned_axes_is_not_merged_with_the_others() {
    // Two halves of a session of one device.
    let mut spec = spec(1);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(32),
        initial_rest: Some(20.0),
        rest: [5.0, 5.5],
        turn: [2.0, 3.0],
        ..HandHeld::default()
    });
    let whole = rows(&spec);
    let (first, second) = whole.split_at(whole.len() / 2);
    let mut second = second.to_vec();
    let bench = Bench::with("a.csv", csv(first));
    bench.write("b.csv", csv(&second));
    bench.run(&["calibrate", "a.csv", "b.csv"]).ends(0);
    for row in &mut second {
        for first in [1, 4] {
            let (x, y) = (row[first], row[first + 1]);
            (row[first], row[first + 1]) = (-y, x);
        }
    }
    bench.write("b.csv", csv(&second));
    let run = bench.run(&["calibrate", "a.csv", "b.csv"]);
    run.ends(3)
        .says(&["b.csv", "turned", "--columns ax=ay,ay=-ax,gx=gy,gy=-gx"]);
    bench
        .run(&[
            "convert",
            "b.csv",
            "--columns",
            "ax=ay,ay=-ax,gx=gy,gy=-gx",
            "-o",
            "c.csv",
        ])
        .ends(0);
    bench.run(&["calibrate", "a.csv", "c.csv"]).ends(0);
}
