//! Cases 61 to 79: stamps.

use super::bench::{Bench, Run};
use super::device::{HEADER, Row, csv, good, lines, spoilt, table};

#[track_caller]
fn calibrate(content: impl AsRef<[u8]>, more: &[&str]) -> Run {
    let bench = Bench::with("r.csv", content);
    bench.run(&[&["calibrate", "r.csv"], more].concat())
}

/// The good rows with stamps as text.
fn stamped(stamp: impl Fn(&Row) -> String) -> String {
    let with = |row: &Row| {
        let line = super::device::line(row);
        let (_, values) = line.split_once(',').unwrap();
        format!("{},{values}", stamp(row))
    };
    table(HEADER, &good().iter().map(with).collect::<Vec<_>>())
}

#[test]
fn case_061_time_that_goes_back_once() {
    let mut rows = good().to_vec();
    rows.swap(5000, 5400);
    let run = calibrate(csv(&rows), &[]);
    run.ends(3).says(&["r.csv:5003", "--sort-time"]);
    calibrate(csv(&rows), &["--sort-time"]).ends(0);
}

#[test]
fn case_062_stamps_that_occur_twice() {
    let rows: Vec<Row> = good()
        .iter()
        .enumerate()
        .flat_map(|(k, row)| std::iter::repeat_n(*row, if k % 100 == 7 { 2 } else { 1 }))
        .collect();
    calibrate(csv(&rows), &[]).ends(0).says(&["r.csv", "stamp"]);
}

#[test]
fn case_063_stamps_that_stand_still() {
    let run = calibrate(stamped(|_| "1.0".into()), &[]);
    run.ends(3).says(&["--rate"]);
}

#[test]
fn case_064_no_time_column() {
    let without: Vec<String> = lines(good())
        .iter()
        .map(|line| line.split_once(',').unwrap().1.to_owned())
        .collect();
    let text = table("ax,ay,az,gx,gy,gz", &without);
    calibrate(&text, &[]).ends(2).says(&["--rate"]);
    calibrate(&text, &["--rate", "100"]).ends(0);
}

#[test]
fn case_065_the_unit_of_time_by_the_rate() {
    for (factor, unit) in [(1e3, "ms"), (1e6, "us"), (1e9, "ns")] {
        let run = calibrate(stamped(|row| format!("{:.0}", row[0] * factor)), &[]);
        run.ends(0).says(&[unit]);
    }
}

#[test]
fn case_066_epochs_in_nanoseconds() {
    let stamp = |row: &Row| format!("17{:017.0}", 1e17 + row[0] * 1e9 - 1e17);
    calibrate(stamped(stamp), &[]).ends(0);
}

#[test]
fn case_067_stamps_rounded_to_steps_of_128_seconds() {
    let run = calibrate(stamped(|row| format!("{}", 1.7e9_f32 + row[0] as f32)), &[]);
    run.ends(3).says(&["stamp"]);
}

#[test]
fn case_068_dates_by_their_pattern_only() {
    let stamp = |row: &Row| {
        let seconds = row[0] % 60.0;
        let minutes = (row[0] / 60.0) as u32;
        format!("21.11.2026 03:{minutes:02}:{seconds:06.3}")
    };
    calibrate(stamped(stamp), &[])
        .ends(3)
        .says(&["--time-format"]);
    let format = ["--time-format", "%d.%m.%Y %H:%M:%S%.f"];
    calibrate(stamped(stamp), &format).ends(0);
}

#[test]
fn case_069_a_clock_that_jumps_forward() {
    let rows = spoilt(|k, row| row[0] += if k > 7000 { 3600.0 } else { 0.0 });
    calibrate(csv(&rows), &[]).ends(0).says(&["gap"]);
}

#[test]
fn case_070_a_counter_that_wraps() {
    let stamp = |row: &Row| format!("{}", (row[0] * 1000.0).round() as u64 % 65536);
    calibrate(stamped(stamp), &[])
        .ends(0)
        .says(&["starts again", "2 times"]);
}

/// Rows of which a counter of milliseconds begins again after each of `at`.
fn rebooted(at: &[usize]) -> String {
    let mut begun = 0.0;
    let mut line = |(k, row): (usize, &Row)| {
        if at.contains(&k) {
            begun = row[0] - 0.3;
        }
        let line = super::device::line(row);
        let (_, values) = line.split_once(',').unwrap();
        format!("{:.0},{values}", (row[0] - begun) * 1000.0)
    };
    let header = HEADER.replacen('t', "millis", 1);
    let rows: Vec<String> = good().iter().enumerate().map(&mut line).collect();
    table(&header, &rows)
}

#[test]
fn a_counter_that_begins_again_makes_two_recordings_of_one_device() {
    let text = rebooted(&[7000]);
    let run = calibrate(&text, &[]);
    run.ends(0)
        .says(&["the clock begins again", "r.csv#1 and r.csv#2"]);
    run.is_silent_on(&["--sort-time"]);
    let bench = Bench::with("r.csv", &text);
    let one = bench.run(&["convert", "r.csv", "-o", "plain.csv"]);
    one.ends(2)
        .says(&["r.csv:7002", "2 recordings", "--part 1"]);
    one.is_silent_on(&["--sort-time"]);
    bench
        .run(&["convert", "r.csv", "--part", "2", "-o", "plain.csv"])
        .ends(0);
    let info = bench.run(&["info", "r.csv"]);
    assert!(info.stdout.contains("r.csv#1") && info.stdout.contains("r.csv#2"));
}

#[test]
fn a_short_boot_before_the_recording_is_left_out() {
    calibrate(rebooted(&[40]), &[])
        .ends(0)
        .says(&["begins again after 40 rows: these are left out"]);
}

#[test]
fn devices_in_one_table_are_asked_for_by_every_command() {
    let rows = good().iter().flat_map(|row| {
        let line = super::device::line(row);
        let (t, values) = line.split_once(',').unwrap();
        let other = super::device::line(&row.map(|v| v + 0.2));
        let (_, others) = other.split_once(',').unwrap();
        [format!("{t},A,{values}"), format!("{t},B,{others}")]
    });
    let header = HEADER.replacen("t,", "t,unit,", 1);
    let bench = Bench::with("r.csv", table(&header, &rows.collect::<Vec<_>>()));
    bench
        .run(&["calibrate", "r.csv", "--instance", "A", "-o", "cal.json"])
        .ends(0);
    for call in [
        &["calibrate", "r.csv"][..],
        &["discover", "r.csv"],
        &["info", "r.csv"],
        &["allan", "r.csv"],
        &["convert", "r.csv", "-o", "plain.csv"],
        &["apply", "cal.json", "r.csv"],
    ] {
        let run = bench.run(call);
        run.ends(2)
            .says(&["rows of 2 devices", "`unit`", "`A`", "--instance A"]);
    }
    let line = bench.run(&["info", "r.csv", "--instance", "A"]);
    let command = "to calibrate: stillpoint calibrate r.csv --instance A";
    assert!(line.ends(0).stdout.contains(command), "{line:#?}");
}

#[test]
fn two_files_without_headers_may_share_their_column_numbers() {
    let bench = Bench::new();
    let pick = |columns: [usize; 4]| {
        let line = |row: &Row| columns.map(|k| format!("{:.6}", row[k])).join(",");
        good().iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
    };
    bench.write("a.txt", pick([1, 2, 3, 0]));
    bench.write("g.txt", pick([4, 5, 6, 0]));
    let columns = "t=4,ax=1,ay=2,az=3,gx=1,gy=2,gz=3";
    bench
        .run(&[
            "calibrate",
            "--accel-file",
            "a.txt",
            "--gyro-file",
            "g.txt",
            "--columns",
            columns,
        ])
        .ends(0);
}

#[test]
fn case_071_gaps_of_a_third_of_a_second_and_of_ten_minutes() {
    for length in [0.3, 600.0] {
        let rows = spoilt(|k, row| row[0] += if k > 7000 { length } else { 0.0 });
        calibrate(csv(&rows), &[]).ends(0).says(&["gap"]);
    }
}

#[test]
fn case_076_sensors_at_rates_of_their_own() {
    let bench = Bench::new();
    let pick = |columns: [usize; 4], every: usize| -> Vec<String> {
        let rows = good().iter().step_by(every);
        rows.map(|row| columns.map(|k| format!("{:.6}", row[k])).join(","))
            .collect()
    };
    bench.write("s/acc.csv", table("t,ax,ay,az", &pick([0, 1, 2, 3], 4)));
    bench.write("s/gyro.csv", table("t,gx,gy,gz", &pick([0, 4, 5, 6], 1)));
    bench.run(&["calibrate", "s"]).ends(0);
}

/// A folder whose gyroscope is late by `offset` and whose clock runs fast by `drift`.
fn apart(offset: f64, drift: f64) -> Bench {
    let bench = Bench::new();
    let pick = |columns: [usize; 4], own: bool| -> Vec<String> {
        let row = |row: &Row| {
            let mut row = *row;
            if own {
                row[0] = row[0] * (1.0 + drift) + offset;
            }
            columns.map(|k| format!("{:.6}", row[k])).join(",")
        };
        good().iter().map(row).collect()
    };
    bench.write("s/acc.csv", table("t,ax,ay,az", &pick([0, 1, 2, 3], false)));
    bench.write("s/gyro.csv", table("t,gx,gy,gz", &pick([0, 4, 5, 6], true)));
    bench
}

#[test]
fn case_077_sensors_that_do_not_overlap() {
    let run = apart(1000.0, 0.0).run(&["calibrate", "s"]);
    run.ends(3).says(&["1000", "overlap"]);
}

#[test]
fn case_079_values_that_a_slower_sensor_held() {
    let rows = spoilt(|k, row| {
        let held = good()[k - k % 4];
        row[1..4].copy_from_slice(&held[1..4]);
    });
    calibrate(csv(&rows), &[])
        .ends(0)
        .says(&["repeats its readings"]);
}

#[test]
fn case_073_a_time_base_that_is_wrong_by_two() {
    let rows = spoilt(|_, row| row[0] *= 0.5);
    calibrate(csv(&rows), &[])
        .ends(1)
        .says(&["its unit or its sampling rate is wrong"]);
}

#[test]
fn case_074_one_sample_a_second() {
    let rows: Vec<Row> = slow(100);
    let run = calibrate(csv(&rows), &[]);
    run.ends(4).says(&["1 Hz", "turn"]);
}

/// Placements of a minute, one sample in `every`.
fn slow(every: usize) -> Vec<Row> {
    use calib::simulate::{HandHeld, Motion, Spec};
    let mut spec = Spec::hand_held(5);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(14),
        initial_rest: Some(40.0),
        rest: [30.0, 31.0],
        turn: [2.0, 3.0],
        ..HandHeld::default()
    });
    let rows = super::device::rows(&spec);
    rows.into_iter().step_by(every).collect()
}

#[test]
fn case_072_stamps_of_arrival_in_bursts() {
    // Ten rows arrive together, 0.2 ms apart; the fit is that of the even clock.
    let arrived =
        |k: usize| good()[(k - k % 10 + 9).min(good().len() - 1)][0] + 2e-4 * (k % 10) as f64;
    let rows = spoilt(|k, row| row[0] = arrived(k));
    let run = calibrate(csv(&rows), &["--json"]);
    run.ends(0)
        .says(&["come in bursts of 10 samples", "equal time steps"]);
    let usual = calibrate(csv(good()), &["--json"]);
    for k in 0..3 {
        let scale = |run: &Run| run.json()["gyroscope"]["T"][k][k].as_f64().unwrap();
        let (found, expected) = (scale(&run), scale(&usual));
        // Several standard errors of 6e-5; the median step would be off by a factor of 50.
        assert!(
            (found / expected - 1.0).abs() < 5e-4,
            "{found} and {expected}"
        );
    }
}

#[test]
fn case_072_stamps_that_are_coarser_than_the_rate() {
    let usual = calibrate(csv(good()), &["--json"]);
    // Read every 16 ms and stamped then, alike or a little apart: one or two rows of 100 Hz at a time.
    for apart in [0.0, 2e-3] {
        let read = |k: usize| {
            let polls = good()[k][0] / 0.016;
            0.016 * (polls.ceil() + apart * (1.0 + polls - polls.ceil()))
        };
        let run = calibrate(csv(&spoilt(|k, row| row[0] = read(k))), &["--json"]);
        run.ends(0).says(&["even clock", "Hz"]);
        for k in 0..3 {
            let scale = |run: &Run| run.json()["gyroscope"]["T"][k][k].as_f64().unwrap();
            let (found, expected) = (scale(&run), scale(&usual));
            assert!(
                (found / expected - 1.0).abs() < 1e-3,
                "{found} and {expected}"
            );
        }
    }
}

#[test]
fn a_rate_that_the_stamps_contradict_is_noticed() {
    let wrong = calibrate(csv(good()), &["--rate", "101"]);
    wrong.says(&["tell a rate of 100 Hz, but 101 Hz was given", "--rate 100"]);
    let right = calibrate(csv(good()), &["--rate", "100"]);
    right.is_silent_on(&["tell a rate of"]);
}

#[test]
fn case_075_thirty_kilohertz() {
    use calib::simulate::{HandHeld, Motion, Spec};
    let mut spec = Spec::hand_held(1);
    spec.rate = 30_000.0;
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(12),
        initial_rest: Some(2.0),
        rest: [1.2, 1.3],
        turn: [0.8, 1.0],
        ..HandHeld::default()
    });
    let session = spec.run().unwrap().recording;
    let mut session = session;
    let bench = Bench::with("r.csv", calib::recording::to_csv(&mut session));
    let run = bench.run(&["calibrate", "r.csv"]);
    run.ends(0).says(&[
        "sampled at 30 kHz",
        "means of 30 samples",
        "which leaves 1000 Hz",
    ]);
}

#[test]
fn case_078_clocks_that_are_apart_or_drift_apart() {
    let late = apart(0.5, 0.0).run(&["calibrate", "s"]);
    late.ends(0).says(&["the gyroscope is 0.5 s late"]);
    let early = apart(-3.0, 0.0).run(&["calibrate", "s"]);
    early.says(&["the accelerometer is 3 s late"]);
    // More than a turn and a static interval, so that other turns nearly fall together.
    let far = apart(15.0, 0.0).run(&["calibrate", "s"]);
    far.says(&["the gyroscope is 15 s late"])
        .is_silent_on(&["runs"]);
    let fast = apart(0.0, 1e-3).run(&["calibrate", "s"]);
    fast.ends(0)
        .says(&["the clock of the gyroscope runs", "ppm faster"]);
    let together = apart(0.0, 0.0).run(&["calibrate", "s"]);
    together.ends(0).is_silent_on(&["clock"]);
}
