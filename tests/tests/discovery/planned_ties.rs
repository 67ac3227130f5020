//! Effects that one recording cannot tell apart, and the recording that is planned for them.

use stillpoint_tests::tie_study::{Outcome, TIES};

#[test]
fn the_planned_recording_tells_tied_effects_apart() {
    // The study of all ten is `plan-study -- --ties`.
    let tie = &TIES[2];
    let found: Vec<Outcome> = tie.outcomes(10, 1, 1).unwrap();
    assert_eq!(found.len(), 1, "session 10 of the power study has the tie");
    assert!(
        found[0].before < 21.0 && found[0].after >= 21.0,
        "{found:?}"
    );
    assert!(found[0].is_separated(tie), "{found:?}");
}
