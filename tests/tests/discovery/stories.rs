//! What is hidden in a session is named, and nothing where nothing is: the small version of `power-study`.

use stillpoint_tests::power::{Record, Row, run};

fn records(row: Row, sessions: std::ops::Range<u64>) -> Vec<Record> {
    sessions.map(|index| run(row, index).unwrap()).collect()
}

#[test]
fn nothing_is_claimed_of_a_device_that_lacks_nothing() {
    // Two grades, without a random walk, with the usual one and with three times it.
    for record in records(Row::Clean, 0..6) {
        assert!(record.named.is_empty(), "{record:?}");
        assert!(record.integrity.is_empty(), "{record:?}");
        assert_eq!(record.unexplained, None, "{record:?}");
    }
}

#[test]
fn what_this_kind_of_data_cannot_show_is_not_named() {
    for record in records(Row::Invisible, 0..3) {
        assert!(record.named.is_empty(), "{record:?}");
    }
}

#[test]
fn hidden_effects_are_named_or_tied_to_the_name() {
    let orientation = records(Row::Orientation60, 0..6);
    let time = records(Row::Time150, 0..3);
    for record in orientation.iter().chain(&time) {
        assert_eq!(record.refused, None, "{record:?}");
        assert!(!record.named.is_empty(), "{record:?}");
    }
    // One in 140 is named wrongly where two effects look nearly the same (quadratic and asymmetry).
    let found = orientation.iter().chain(&time).filter(|r| r.is_found());
    assert!(found.count() >= 8);
}

#[test]
fn faults_of_the_recording_are_named_and_no_effect_beside_them() {
    let altered = records(Row::Altered, 2..6);
    for record in records(Row::Integrity, 0..5).iter().chain(&altered) {
        assert!(record.is_exact(), "{record:?}");
    }
}

#[test]
fn a_creep_that_may_be_a_rate_and_a_push_that_may_be_a_bad_turn_are_said_to_be_either() {
    // Creeps about the vertical, which no direction of gravity shows; a rest between two turns that lost samples.
    for index in [70_054, 75_028, 75_015] {
        let record = run(Row::Integrity, index).unwrap();
        assert!(record.named.is_empty(), "{record:?}");
        assert!(record.is_found() && !record.is_exact(), "{record:?}");
    }
}

#[test]
fn what_is_outside_the_catalogue_is_unexplained() {
    let outside = records(Row::Outside, 0..5);
    let unexplained = outside.iter().filter(|r| r.unexplained.is_some()).count();
    assert!(unexplained >= 4, "{outside:?}");
}

#[test]
fn knocks_between_samples_are_no_effect_of_the_gyroscope() {
    // Two turns of the first two sessions speak for a delay of one axis as much as all the others; of the other two a knock
    // misses by more than the one share says. The next began with a share and a scatter of its own, which no other fit had; in
    // the last what is missing is thousands of times the noise of the readings.
    for index in [35, 83, 20015, 20027, 213_023, 212_003] {
        let record = run(Row::Conditions, index).unwrap();
        assert_eq!(record.kind, "knocks-point");
        assert!(record.named.is_empty(), "{record:?}");
        let found = record
            .integrity
            .iter()
            .any(|name| name == "undersampled_motion");
        assert!(found && record.integrity.len() == 1, "{record:?}");
        assert_eq!(record.unexplained, None, "{record:?}");
    }
}
