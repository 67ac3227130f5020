//! Corruptions of a good recording that leave a file which looks well: by either method each is refused, or a warning
//! names its kind and its place; and so does `evaluate` on what was written nevertheless.

use super::bench::{Bench, Run};
use super::device::{Row, csv, good, spoilt};

/// Where the recording changes.
fn half() -> usize {
    good().len() / 2
}

/// How the place of a corruption is said.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// `(t = A to B s)` with the time of this row of the good recording between.
    Around(usize),
    /// These words: an axis, a row, a number of rows.
    Words(&'static str),
}

impl Place {
    fn is_in(self, line: &str) -> bool {
        match self {
            Self::Words(words) => line.contains(words),
            Self::Around(row) => {
                let span = line.split_once("(t = ").and_then(|(_, rest)| {
                    let (from, rest) = rest.split_once(" to ")?;
                    let (to, _) = rest.split_once(" s)")?;
                    Some((from.parse::<f64>().ok()?, to.parse::<f64>().ok()?))
                });
                let t = good()[row][0];
                span.is_some_and(|(from, to)| from <= t && t <= to && to - from < 20.0)
            }
        }
    }
}

#[track_caller]
fn names(run: &Run, kind: &str, place: Place) {
    let named = |line: &str| line.contains(kind) && place.is_in(line);
    assert!(
        run.stderr.lines().any(named),
        "no line with `{kind}` and {place:?}: {run:#?}"
    );
}

/// Calibrates by both methods and evaluates what was written; whether each method refused.
#[track_caller]
fn runs(rows: &[Row], mut look: impl FnMut(&Run, &str)) -> [bool; 2] {
    let bench = Bench::with("r.csv", csv(rows));
    ["stepwise", "joint"].map(|method| {
        let cal = format!("{method}.json");
        let gravity = ["--gravity", "9.80665"];
        let run = bench.run(
            &[
                &["calibrate", "r.csv", "-o", &cal, "--method", method],
                &gravity[..],
            ]
            .concat(),
        );
        let refused = matches!(run.status, Some(3..=5));
        if !refused {
            assert!(matches!(run.status, Some(0 | 1)), "{run:#?}");
            let named = format!("it={cal}");
            let evaluated = bench.run(
                &[
                    &["evaluate", "r.csv", "--calibration", &named],
                    &gravity[..],
                ]
                .concat(),
            );
            look(&run, "calibrate");
            look(&evaluated, "evaluate");
        }
        refused
    })
}

/// Both methods write a result and name what is wrong, and `evaluate` does.
#[track_caller]
fn named(rows: &[Row], kind: &str, place: Place) {
    let refused = runs(rows, |run, _| names(run, kind, place));
    assert_eq!(refused, [false, false], "refused: say so in the test");
}

/// Neither method writes a result; the message holds these words.
#[track_caller]
fn refused(rows: &[Row], status: i32, words: &[&str]) {
    let bench = Bench::with("r.csv", csv(rows));
    for method in ["stepwise", "joint"] {
        let args = ["calibrate", "r.csv", "-o", "cal.json", "--method", method];
        bench.run(&args).ends(status).says(words).changes(&[]);
    }
}

/// Rows from half on changed.
fn from_half(change: impl Fn(&mut Row)) -> Vec<Row> {
    spoilt(|k, row| {
        if k >= half() {
            change(row);
        }
    })
}

/// Rows stamped anew, 10 ms apart.
fn stamped(rows: impl IntoIterator<Item = Row>) -> Vec<Row> {
    let with = |(k, mut row): (usize, Row)| {
        row[0] = 0.01 * k as f64;
        row
    };
    rows.into_iter().enumerate().map(with).collect()
}

/// Stamps from half on by a clock that runs at another rate.
fn clock(rate: f64) -> Vec<Row> {
    let start = good()[half()][0];
    from_half(|row| row[0] = start + (row[0] - start) * rate)
}

/// One row in ten, without a pattern.
fn is_chosen(k: usize) -> bool {
    let mixed = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    mixed % 10 == 3
}

fn quantised(columns: std::ops::Range<usize>, step: f64) -> Vec<Row> {
    spoilt(|_, row| {
        for v in &mut row[columns.clone()] {
            *v = (*v / step).round() * step;
        }
    })
}

/// The axes of both sensors turned about z by this angle.
fn turned(row: &mut Row, angle: f64) {
    let (s, c) = angle.sin_cos();
    for first in [1, 4] {
        let (x, y) = (row[first], row[first + 1]);
        row[first] = c * x - s * y;
        row[first + 1] = s * x + c * y;
    }
}

#[test]
fn the_good_recording_draws_no_warning() {
    let none = |run: &Run, command: &str| assert_eq!(run.stderr, "", "{command}");
    assert_eq!(runs(good(), none), [false, false]);
}

#[test]
fn units_that_change_half_way() {
    let g = from_half(|row| row[1..4].iter_mut().for_each(|v| *v /= 9.80665));
    refused(&g, 3, &["r.csv:8485", "from m/s² to g"]);
    let degrees = from_half(|row| row[4..7].iter_mut().for_each(|v| *v = v.to_degrees()));
    let words = ["in rad/s up to t = ", "in deg/s from t = "];
    refused(&degrees, 3, &words);
    let start = good()[half()][0];
    let milliseconds = from_half(|row| row[0] = start + (row[0] - start) * 1e3);
    refused(&milliseconds, 4, &["stamps"]);
}

#[test]
fn signs_that_change_half_way() {
    let at = Place::Around(half());
    for (column, kind) in [
        (1, "x axis of the accelerometer changes its sign"),
        (3, "z axis of the accelerometer changes its sign"),
        (4, "x axis of the gyroscope changes its sign"),
        (6, "z axis of the gyroscope changes its sign"),
    ] {
        named(&from_half(|row| row[column] = -row[column]), kind, at);
    }
}

#[test]
fn columns_that_are_swapped_half_way() {
    let at = Place::Around(half());
    let accel = from_half(|row| row.swap(1, 2));
    named(
        &accel,
        "columns x and y of the accelerometer change places",
        at,
    );
    let gyro = from_half(|row| row.swap(4, 5));
    named(&gyro, "columns x and y of the gyroscope change places", at);
    let sensors = from_half(|row| (1..4).for_each(|k| row.swap(k, k + 3)));
    refused(&sensors, 3, &["r.csv:8", "other columns"]);
}

#[test]
fn a_clock_two_percent_fast_or_slow_from_half_on() {
    for (rate, share) in [(1.02, "2.0"), (0.98, "-2.0")] {
        let kind = format!("scale factor of the gyroscope on all axes changes by {share}");
        let kind = if rate < 1.0 {
            "scale factor of the gyroscope on all axes changes by -"
        } else {
            &kind
        };
        named(&clock(rate), kind, Place::Around(half()));
    }
}

#[test]
fn one_row_in_ten_twice_or_not_at_all() {
    let twice = || {
        let rows = good().iter().enumerate();
        rows.flat_map(|(k, row)| std::iter::repeat_n(*row, 1 + usize::from(is_chosen(k))))
    };
    let with_stamps: Vec<Row> = twice().collect();
    named(
        &with_stamps,
        "repeated earlier rows",
        Place::Words("rows between lines"),
    );
    let kind = "its unit or its sampling rate is wrong";
    let all = Place::Words("on all axes");
    named(&stamped(twice()), kind, all);
    let rows = good().iter().enumerate().filter(|(k, _)| !is_chosen(*k));
    named(&stamped(rows.map(|(_, row)| *row)), kind, all);
}

#[test]
fn scale_factors_that_change_by_one_percent_half_way() {
    let at = Place::Around(half());
    let scaled = |columns: &'static [usize]| {
        from_half(move |row| columns.iter().for_each(|&k| row[k] *= 1.01))
    };
    let by = "changes by ";
    named(
        &scaled(&[1]),
        &format!("scale factor of the accelerometer on x {by}"),
        at,
    );
    named(
        &scaled(&[1, 2, 3]),
        &format!("scale factor of the accelerometer on all axes {by}"),
        at,
    );
    named(
        &scaled(&[4]),
        &format!("scale factor of the gyroscope on x {by}"),
        at,
    );
    named(
        &scaled(&[6]),
        &format!("scale factor of the gyroscope on z {by}"),
        at,
    );
    named(
        &scaled(&[4, 5, 6]),
        &format!("scale factor of the gyroscope on all axes {by}"),
        at,
    );
}

#[test]
fn an_axis_that_is_stuck_from_half_on() {
    for (column, name) in [(2, "ay"), (5, "gy")] {
        let value = good()[half()][column];
        let rows = from_half(|row| row[column] = value);
        refused(&rows, 3, &["r.csv:8485", name, "is stuck at"]);
    }
}

#[test]
fn biases_that_step_half_way() {
    let at = Place::Around(half());
    for (column, size, kind) in [
        (1, 0.02, "bias of the accelerometer on x jumps by 1.8"),
        (1, 0.2, "bias of the accelerometer on x jumps by 19"),
        (4, 1e-3, "bias of the gyroscope on x jumps by +9.8"),
        (4, 1e-2, "bias of the gyroscope on x jumps by +1.0"),
    ] {
        let rows = from_half(|row| row[column] += size);
        named(&rows, kind.split(" by ").next().unwrap(), at);
    }
}

#[test]
fn steps_of_four_times_the_noise() {
    let axes = Place::Words("on x, y, z");
    named(
        &quantised(4..7, 3.9e-3),
        "the gyroscope reads in steps of",
        axes,
    );
    named(
        &quantised(4..7, 9.75e-3),
        "the gyroscope reads in steps of",
        axes,
    );
    named(
        &quantised(1..4, 0.081),
        "the accelerometer reads in steps of",
        axes,
    );
}

#[test]
fn ranges_that_are_too_small() {
    let clipped = |columns: std::ops::Range<usize>, limit: f64| {
        spoilt(|_, row| {
            row[columns.clone()]
                .iter_mut()
                .for_each(|v| *v = v.clamp(-limit, limit))
        })
    };
    // Of 19 turns two are left: the gyroscope is not calibrated, and its bias is written beside the accelerometer.
    let words = [
        "gyroscope x is saturated at -",
        "the gyroscope is not calibrated",
        "17 faster than the gyroscope can read",
        "larger range",
    ];
    let bench = Bench::with("r.csv", csv(&clipped(4..7, 1.2)));
    for method in ["stepwise", "joint"] {
        let cal = format!("{method}.json");
        let run = bench.run(&["calibrate", "r.csv", "-o", &cal, "--method", method]);
        run.ends(4).says(&words).changes(&[&cal]);
    }
    named(
        &clipped(1..2, 8.0),
        "is saturated at 8",
        Place::Words("accelerometer x"),
    );
}

#[test]
fn readings_that_a_filter_or_a_bus_has_touched() {
    let spikes = spoilt(|k, row| {
        if [3000, 6000, 9000, 12000].contains(&k) {
            row[1] = 327.67;
        }
    });
    named(
        &spikes,
        "single readings",
        Place::Words("rows 3002, 6002, 9002, 12002"),
    );
    let dead = spoilt(|_, row| {
        row[4..7]
            .iter_mut()
            .filter(|v| v.abs() < 0.05)
            .for_each(|v| *v = 0.0);
    });
    named(&dead, "a dead zone", Place::Words("zero on x, y, z"));
    let held = spoilt(|k, row| row[1..4].copy_from_slice(&good()[k - k % 4][1..4]));
    named(
        &held,
        "the file repeats its readings",
        Place::Words("accelerometer"),
    );
    let noise = |k: usize, column: usize| {
        let phase = (k * 7 + column * 131) as f64;
        (phase * 12.9898).sin() + (phase * 78.233).sin() + (phase * 37.719).sin()
    };
    let fan = spoilt(|k, row| {
        if k >= half() {
            (1..4).for_each(|c| row[c] += 0.16 * noise(k, c));
            (4..7).for_each(|c| row[c] += 0.008 * noise(k, c));
        }
    });
    named(
        &fan,
        "noisier in static intervals 10, 11, 12",
        Place::Words("the gyroscope"),
    );
}

#[test]
fn rows_that_are_pasted_cut_out_or_moved() {
    let kind = "misses gravity by";
    let all = good();
    let pasted = stamped(all[..8000].iter().chain(&all[7500..]).copied());
    named(&pasted, kind, Place::Around(8000));
    let cut = stamped(all[..8000].iter().chain(&all[8500..]).copied());
    named(&cut, kind, Place::Around(8000));
    let parts = [
        &all[..6000],
        &all[9000..12000],
        &all[6000..9000],
        &all[12000..],
    ];
    let moved = stamped(parts.concat());
    for row in [6000, 9000, 12000] {
        named(&moved, kind, Place::Around(row));
    }
}

#[test]
fn a_gyroscope_that_is_late_from_half_on() {
    let late = spoilt(|k, row| {
        if k >= half() {
            row[4..7].copy_from_slice(&good()[k - 5][4..7]);
        }
    });
    named(&late, "misses gravity by", Place::Around(half()));
}

#[test]
fn a_device_that_is_mounted_otherwise_from_half_on() {
    let rows = from_half(|row| turned(row, 0.05));
    named(
        &rows,
        "axes of the accelerometer turn by",
        Place::Around(half()),
    );
}
