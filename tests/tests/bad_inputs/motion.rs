//! Cases 104 to 119: motion, and what it tells.

use calib::simulate::{Fault, HandHeld, Motion, Spec};

use super::bench::{Bench, Run};
use super::device::{Row, at_rest, csv, good, rows, spec, spoilt};

#[track_caller]
fn calibrate(rows: &[Row], more: &[&str]) -> Run {
    let bench = Bench::with("r.csv", csv(rows));
    bench.run(&[&["calibrate", "r.csv"], more].concat())
}

/// A session with the hand's motion changed.
fn session(seed: u64, change: impl Fn(&mut HandHeld)) -> Vec<Row> {
    let mut spec = spec(seed);
    if let Motion::HandHeld(motion) = &mut spec.motion {
        change(motion);
    }
    rows(&spec)
}

#[test]
fn case_104_nothing_but_rest() {
    calibrate(&at_rest(19.0), &[])
        .ends(4)
        .says(&["all static", "stillpoint plan"]);
}

#[test]
fn case_106_three_orientations() {
    let rows = session(2, |motion| motion.placements = Some(4));
    calibrate(&rows, &[]).ends(4).says(&["placement"]);
}

#[test]
fn case_108_one_placement_thirty_times() {
    let still = at_rest(19.0);
    let step = still.len() as f64 * 0.01;
    let rows: Vec<Row> = (0..10)
        .flat_map(|k| {
            still.iter().enumerate().map(move |(i, row)| {
                let mut row = *row;
                row[0] += step * f64::from(k);
                if i < 100 {
                    let t = 0.1 * i as f64;
                    row[1] += 4.0 * t.sin();
                    row[4] += 2.0 * (3.0 * t).sin();
                }
                row
            })
        })
        .collect();
    calibrate(&rows, &[]).ends(4).says(&["placement"]);
}

#[test]
fn case_109_a_device_that_slipped_in_its_case() {
    // Two placements read what no orientation gives.
    let mut spec = spec(4);
    spec.faults = [5, 11]
        .map(|interval| Fault::Disturbed {
            interval,
            size: 0.4,
        })
        .to_vec();
    let run = calibrate(&rows(&spec), &[]);
    run.ends(1).says(&["static interval"]);
}

#[test]
fn case_112_turns_faster_than_the_rate_can_follow() {
    let mut spec = spec(6);
    spec.rate = 12.5;
    if let Motion::HandHeld(motion) = &mut spec.motion {
        motion.turn = [0.5, 0.55];
    }
    let run = calibrate(&rows(&spec), &[]);
    run.ends(0).says(&[
        "turns are too fast for 12.5 Hz",
        "(coning) makes an error of about",
        "(t = ",
    ]);
    run.is_silent_on(&["single readings"]);
    calibrate(good(), &[]).is_silent_on(&["coning"]);
}

#[test]
fn case_113_a_lever_arm_does_not_spoil_the_turns() {
    let mut spec = spec(7);
    spec.lever_arm = [0.3, 0.2, -0.1];
    calibrate(&rows(&spec), &[]).ends(0);
}

#[test]
fn case_114_a_bias_that_follows_the_temperature_is_named() {
    let spec = spec(8).with_effect("accel_temperature", 4.0);
    let recording = spec.run().unwrap().recording;
    let bench = Bench::new();
    let mut with = recording.clone();
    bench.write("r.csv", calib::recording::to_csv(&mut with));
    let run = bench.run(&["discover", "r.csv", "--json"]);
    let names = run.ends(0).json()["effects"].to_string();
    assert!(names.contains("accel_temperature"), "{names}");
}

#[test]
fn case_115_recordings_of_two_devices() {
    let bench = Bench::with("a.csv", csv(good()));
    bench.write("b.csv", csv(&rows(&spec(99))));
    let run = bench.run(&["calibrate", "a.csv", "b.csv"]);
    run.ends(3).says(&["--force-device"]);
}

#[test]
fn case_116_a_file_given_twice() {
    let bench = Bench::with("a.csv", csv(good()));
    bench.write("b.csv", csv(good()));
    let twice = bench.run(&["calibrate", "a.csv", "b.csv", "--json"]);
    let once = bench.run(&["calibrate", "a.csv", "--json"]);
    twice.ends(0).says(&["a.csv", "b.csv"]);
    assert_eq!(twice.json()["covariance"], once.json()["covariance"]);
}

#[test]
fn case_117_a_recording_without_noise() {
    let rows = rows(&spec(9).noise_free());
    let run = calibrate(&rows, &["--json"]);
    let covariance = run.ends(0).json()["covariance"].clone();
    let first = covariance[0][0].as_f64().unwrap();
    assert!(first.is_finite() && first >= 0.0, "{first}");
}

#[test]
fn case_118_numbers_that_lie_on_no_sphere() {
    let rows = spoilt(|_, row| {
        let t = row[0];
        row[1] = 3.0 * (0.0001 * t).sin() + 1e-3 * (t * 1e5).sin();
        row[2] = 1e-3 * (t * 2e5).sin();
        row[3] = 1e-3 * (t * 3e5).sin();
    });
    let run = calibrate(&rows, &["-o", "cal.json"]);
    run.ends(3).says(&["gravity has been removed"]).changes(&[]);
}

#[test]
fn case_119_discovery_on_too_little() {
    let rows = rows(&{
        let mut spec = Spec::hand_held(10);
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(6),
            initial_rest: Some(20.0),
            ..HandHeld::default()
        });
        spec
    });
    let bench = Bench::with("r.csv", csv(&rows));
    bench.run(&["discover", "r.csv"]).ends(4).says(&[
        "static intervals",
        "too few to tell",
        "placements",
    ]);
}

#[test]
fn case_105_nothing_but_motion() {
    let rows = spoilt(|_, row| {
        let t = row[0];
        row[1] += 3.0 * (17.0 * t).sin() * (1.0 + (3.0 * t).sin());
        row[2] += 3.0 * (13.0 * t).cos();
        row[4] += (9.0 * t).sin() + 0.5 * (7.3 * t).sin();
        row[5] += (8.0 * t).cos();
    });
    let run = calibrate(&rows, &[]);
    run.ends(4).says(&["quiet", "--multiplier"]);
}

#[test]
fn case_107_placements_in_one_plane() {
    let rows = session(3, |motion| {
        motion.coplanar = true;
        motion.scatter = 0.0;
    });
    let run = calibrate(&rows, &[]);
    run.ends(4).says(&["z", "placement"]);
}

#[test]
fn case_110_a_fan_from_half_way_on() {
    let rows = spoilt(|k, row| {
        if k > 7000 {
            row[1] += 0.08 * (1.9 * k as f64).sin();
            row[2] += 0.08 * (2.3 * k as f64).cos();
        }
    });
    let run = calibrate(&rows, &[]);
    run.ends(0)
        .says(&["times noisier in static intervals", "a fan or a motor"]);
}

#[test]
fn case_111_a_placement_that_tilts_slowly() {
    // One placement creeps through 3 degrees over 5 s.
    let mut spec = spec(5);
    spec.faults = vec![Fault::Slip {
        interval: 6,
        angle: 0.05,
    }];
    let run = calibrate(&rows(&spec), &[]);
    run.ends(0)
        .says(&["static interval 7", "drift while the device should rest"]);
}
