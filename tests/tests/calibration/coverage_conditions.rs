//! The study of conditions, small: stated errors hold, and no touch is named that was none.

use calib::calibrate::Method;
use calib::recording::intervals::{Detector, segment};
use calib::recording::readings::altered_bias;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use stillpoint_tests::conditions::{
    CONDITIONS, Condition, Kind, Record, Stored, condition, read, row, run, summarise,
};

fn records(name: &str, count: u64) -> Vec<Record> {
    let condition = condition(name).unwrap();
    (0..count)
        .into_par_iter()
        .map(|seed| run(condition, seed).unwrap())
        .collect()
}

#[test]
fn stated_errors_of_clean_sessions_hold_and_nothing_is_said() {
    let (clean, records) = (condition("clean").unwrap(), records("clean", 6));
    for summary in [
        summarise(clean, &records, Method::Joint),
        summarise(clean, &records, Method::Stepwise),
    ] {
        // 6 sessions with 9 to 36 intervals in a class: 95 % less four standard errors of 18 or more.
        assert!(summary.coverage.iter().all(|c| *c > 0.74), "{summary:?}");
        // 126 degrees of freedom: √(2/126) = 0.13; four of them.
        assert!((summary.nees - 1.0).abs() < 0.5, "{summary:?}");
        assert_eq!(
            (summary.false_alarms, summary.refused),
            (0, 0),
            "{summary:?}"
        );
        // Over the bound by chance or by the stepwise method's 12 % at most.
        assert!(summary.efficiency.unwrap() < 1.5, "{summary:?}");
    }
}

#[test]
fn no_condition_but_a_dead_zone_alters_the_bias() {
    let all: Vec<&Condition> = CONDITIONS.iter().copied().flatten().collect();
    all.into_par_iter().for_each(|condition| {
        for seed in 0..2 {
            let Ok(session) = condition.spec(seed).run() else {
                continue;
            };
            let recording = session.recording;
            if let Ok(segmentation) = segment(&recording, &Detector::default()) {
                let found = altered_bias(&recording, &segmentation);
                let is_dead = condition.name == "dead-zone";
                assert_eq!(
                    found.is_some(),
                    is_dead,
                    "{} {seed}: {found:?}",
                    condition.name
                );
            }
        }
    });
}

#[test]
fn noise_of_any_kind_and_a_table_that_vibrates_are_no_touch() {
    for name in [
        "low-pass",
        "correlated",
        "laplace",
        "spikes",
        "held",
        "interpolated",
        "vibration",
        "quantised-4",
    ] {
        for record in records(name, 3) {
            let words = &record.joint.words;
            let touched = words.iter().find(|w| Kind::of(w) == Kind::Touched);
            assert_eq!(touched, None, "{name} {}", record.seed);
        }
    }
}

#[test]
fn a_study_goes_on_where_it_stopped() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("study.jsonl");
    let all = records("counts", 2);
    Stored::open(&path).unwrap().add(&all[0]).unwrap();
    let mut stored = Stored::open(&path).unwrap();
    assert!(stored.has("counts", 0) && !stored.has("counts", 1));
    stored.add(&all[1]).unwrap();
    assert_eq!(read(&path).unwrap(), all);
    let table = row(condition("counts").unwrap(), &all);
    assert!(
        table.lines().all(|line| line.chars().count() <= 80),
        "{table}"
    );
}
