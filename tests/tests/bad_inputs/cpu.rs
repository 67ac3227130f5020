//! Any command on 100,000 rows ends within 5 s of CPU, whatever they hold; within 15 s in a debug build.
//!
//! The limit is the kernel's on the CPU time of the process, all its threads together, so that a busy machine fails
//! nothing. What each command took is printed. As a release build:
//!
//! ```text
//! cargo test --release --config 'profile.release.lto="off"' --config profile.release.codegen-units=16 \
//!   --workspace --test cli cpu -- --nocapture --test-threads 1
//! ```

use std::f64::consts::PI;
use std::fmt::Write as _;

use super::bench::Bench;
use super::device::HEADER;

const ROWS: usize = 100_000;
/// What a call may take of the processor, s, in whatever profile the tests are built; the released program takes up to 5 of them.
const LIMIT: u32 = 15;

/// Noise between -1 and 1 without a pattern.
fn noise(k: usize, column: usize) -> f64 {
    let mixed = (k as u64 * 8 + column as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn with_noise(k: usize, a: [f64; 3], g: [f64; 3]) -> [f64; 6] {
    let column = |c: usize| match c {
        0..3 => a[c] + 0.02 * noise(k, c),
        _ => g[c - 3] + 2e-3 * noise(k, c),
    };
    std::array::from_fn(column)
}

/// A device that is turned about axis `k % axes` in every second half of `period` rows, by an angle that differs.
fn turned(period: usize, axes: usize) -> Vec<[f64; 6]> {
    let mut up = [0.0, 0.0, 9.80665];
    let half = period / 2;
    let turn = |k: usize| {
        let (number, phase) = (k / period, (k % period) as f64 - half as f64);
        let axis = number % axes;
        let angle = 0.7 + 0.5 * (1.7 * number as f64).sin();
        let share = 1.0 - (2.0 * PI * (phase + 0.5) / half as f64).cos();
        (
            axis,
            if phase >= 0.0 {
                angle * share / (0.01 * half as f64)
            } else {
                0.0
            },
        )
    };
    let row = |k: usize| {
        let (axis, rate) = turn(k);
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        // Gravity turns against the device: by half of the step before the sample and half after.
        let mut half_step = || {
            let (sin, cos) = (0.005 * rate).sin_cos();
            (up[b], up[c]) = (cos * up[b] + sin * up[c], cos * up[c] - sin * up[b]);
        };
        half_step();
        half_step();
        let mut gyro = [0.0; 3];
        gyro[axis] = rate;
        with_noise(k, up, gyro)
    };
    (0..ROWS).map(row).collect()
}

fn csv(rows: &[[f64; 6]], stamp: impl Fn(usize) -> f64) -> String {
    let mut text = format!("{HEADER}\n");
    for (k, row) in rows.iter().enumerate() {
        write!(text, "{:.4}", stamp(k)).unwrap();
        row.iter().for_each(|v| write!(text, ",{v:.5}").unwrap());
        text.push('\n');
    }
    text
}

fn evenly(k: usize) -> f64 {
    0.01 * k as f64
}

/// Every command, or those that fit, within the limit; whatever they find is fine.
#[track_caller]
fn ends(text: String) {
    let bench = Bench::with("r.csv", text);
    let calls: [&[&str]; 8] = [
        &["segment", "r.csv"],
        &["calibrate", "r.csv", "-o", "cal.json"],
        &["calibrate", "r.csv", "--method", "joint"],
        &["calibrate", "r.csv", "--method", "six-position"],
        &["discover", "r.csv"],
        &["allan", "r.csv"],
        &["evaluate", "r.csv", "--calibration", "c=cal.json"],
        &["apply", "cal.json", "r.csv", "-o", "corrected.csv"],
    ];
    for call in calls {
        // The last line that it says is what its children took: user and system time.
        let script = format!("(ulimit -t {LIMIT}; exec \"$0\" \"$@\"); s=$?; times >&2; exit $s");
        let mut command = std::process::Command::new("sh");
        command
            .current_dir(bench.path(""))
            .args(["-c", &script, env!("CARGO_BIN_EXE_stillpoint")])
            .args(call);
        let run = command.output().unwrap();
        // A process over its limit is ended by a signal and has no status.
        let said = String::from_utf8_lossy(&run.stderr);
        let status = run.status.code();
        let took = said.lines().last().unwrap_or_default();
        println!("{took:>20} {status:?} {}", call.join(" "));
        assert!(matches!(status, Some(0..=5)), "{call:?}: {status:?} {said}");
    }
}

#[test]
fn noise_alone() {
    let row = |k: usize| std::array::from_fn(|c| if c < 3 { 9.0 } else { 1.0 } * noise(k, c));
    ends(csv(&(0..ROWS).map(row).collect::<Vec<_>>(), evenly));
}

#[test]
fn constants_and_a_device_that_never_moves() {
    ends(csv(&[[0.0, 0.0, 9.80665, 0.0, 0.0, 0.0]; ROWS], evenly));
    let still = |k| with_noise(k, [0.0, 0.0, 9.80665], [0.0; 3]);
    ends(csv(&(0..ROWS).map(still).collect::<Vec<_>>(), evenly));
}

#[test]
fn static_intervals_that_alternate_every_second() {
    ends(csv(&turned(200, 3), evenly));
}

#[test]
fn more_static_intervals_than_a_hand_makes() {
    ends(csv(&turned(700, 3), evenly));
}

#[test]
fn stamps_that_scatter() {
    ends(csv(&turned(700, 3), |k| evenly(k) + 4e-3 * noise(k, 7)));
}

#[test]
fn stamps_with_a_jitter_of_3_ms() {
    ends(csv(&turned(800, 3), |k| evenly(k) + 3e-3 * noise(k, 7)));
}

#[test]
fn three_hundred_placements() {
    ends(csv(&turned(333, 3), evenly));
}

#[test]
fn coplanar_placements() {
    ends(csv(&turned(800, 1), evenly));
}

#[test]
fn coplanar_placements_to_a_hundredth_of_the_noise() {
    let mut rows = turned(800, 1);
    rows.iter_mut().for_each(|row| row[0] *= 0.01);
    ends(csv(&rows, evenly));
}

#[test]
fn spikes() {
    let mut rows = turned(800, 3);
    for k in (17..ROWS).step_by(67) {
        rows[k][k % 6] = 327.67;
    }
    ends(csv(&rows, evenly));
}

#[test]
fn a_device_that_is_pushed() {
    let mut rows = turned(800, 3);
    rows.iter_mut().for_each(|row| row[0] += 200.0);
    ends(csv(&rows, evenly));
    let mut rows = turned(800, 3);
    rows[30_000..30_400]
        .iter_mut()
        .for_each(|row| row[1] += 200.0);
    ends(csv(&rows, evenly));
}

#[test]
fn a_device_that_is_pushed_in_every_fifth_placement() {
    let mut rows = turned(800, 3);
    let pushed = (0..ROWS).filter(|k| k % 4000 < 400);
    pushed.for_each(|k| rows[k][1] += 200.0);
    ends(csv(&rows, evenly));
}

#[test]
fn readings_that_are_saturated_and_slow() {
    let mut rows = turned(800, 3);
    for row in &mut rows {
        row[..3].iter_mut().for_each(|v| *v = v.clamp(-6.0, 6.0));
        row[3..].iter_mut().for_each(|v| *v = v.clamp(-0.5, 0.5));
    }
    ends(csv(&rows, |k| 0.05 * k as f64));
}

#[test]
fn one_axis_that_is_stuck() {
    for column in [1, 4] {
        let mut rows = turned(800, 3);
        rows.iter_mut().for_each(|row| row[column] = 0.5);
        ends(csv(&rows, evenly));
    }
}

#[test]
fn readings_that_walk() {
    let mut at = [0.0; 6];
    let row = |k: usize| {
        for (c, v) in at.iter_mut().enumerate() {
            let (step, limit) = if c < 3 { (0.05, 12.0) } else { (5e-3, 3.0) };
            *v = (*v + step * noise(k, c)).clamp(-limit, limit);
        }
        at
    };
    ends(csv(&(0..ROWS).map(row).collect::<Vec<_>>(), evenly));
}

#[test]
fn raw_counts() {
    let mut rows = turned(800, 3);
    for row in &mut rows {
        row[..3].iter_mut().for_each(|v| *v = (*v * 1670.7).round());
        row[3..].iter_mut().for_each(|v| *v = (*v * 939.7).round());
    }
    ends(csv(&rows, evenly));
}
