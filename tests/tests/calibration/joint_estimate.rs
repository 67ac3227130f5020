//! The joint method on simulated sessions: a small version of the coverage study.

use stillpoint_tests::coverage::{Row, SessionResult, run, summarise};

/// Sessions run on two threads; the results do not depend on it.
fn sessions(row: Row, count: u64) -> Vec<SessionResult> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    (0..count)
        .into_par_iter()
        .map(|seed| run(row, seed).unwrap())
        .collect()
}

#[test]
fn without_noise_every_parameter_comes_back() {
    let joint = summarise(&sessions(Row::NoiseFree, 2)).joint.unwrap();
    assert!(joint.largest[0] < 1e-9, "{:e}", joint.largest[0]);
    assert!(joint.largest[1] < 1e-8, "{:e}", joint.largest[1]);
}

#[test]
fn stated_errors_hold_with_and_without_a_walk_of_the_bias() {
    for row in [Row::Consumer, Row::TacticalWalk] {
        let summary = summarise(&sessions(row, 8));
        let joint = summary.joint.unwrap();
        // 8 × 21 intervals: √(0.95 · 0.05 / 168) = 1.7 %; four of them, correlations apart.
        assert!(joint.coverage > 0.88, "{row:?}: {}", joint.coverage);
        // χ² of 168 degrees of freedom over them: √(2/168) = 0.11; four of them.
        assert!((joint.nees - 1.0).abs() < 0.44, "{row:?}: {}", joint.nees);
        assert_eq!(summary.false_alarms, 0, "{row:?}");
    }
}

#[test]
fn a_slip_a_touch_and_a_gap_are_named_where_they_are() {
    let summary = summarise(&sessions(Row::Disturbed, 4));
    assert_eq!(summary.named, [1.0; 3]);
    let joint = summary.joint.unwrap();
    // 4 × 21 intervals: 2.4 %, four of them.
    assert!(joint.coverage > 0.85, "{}", joint.coverage);
}

#[test]
fn coplanar_placements_are_refused_in_words() {
    for result in sessions(Row::Coplanar, 10) {
        let words = result.words.join(" ");
        assert!(words.contains("z up, z down"), "{}: {words}", result.seed);
    }
}

#[test]
fn the_same_session_gives_the_same_bits() {
    let figures = || serde_json::to_string(&run(Row::Consumer, 5).unwrap()).unwrap();
    assert_eq!(figures(), figures());
}
