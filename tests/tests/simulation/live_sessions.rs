//! Guided sessions with a simulated phone and a simulated person.

use stillpoint_tests::live::{phone, sit, sit_with};

#[test]
fn clumsy_people_with_failing_phones_end_with_a_calibration_in_at_most_1_2_times_the_plan() {
    // One seed for each kind of mishap, and one with all of them.
    for seed in 0..7 {
        let sitting = sit(seed, 12).unwrap();
        assert!(sitting.is_good(), "seed {seed}: {sitting:?}");
        assert!(
            sitting.fallback.is_none(),
            "the phone's own file is what is calibrated: {:?}",
            sitting.fallback
        );
        let far = sitting.normalised.iter().filter(|z| z.abs() > 4.0).count();
        assert!(far == 0, "seed {seed}: {:?}", sitting.normalised);
    }
}

#[test]
fn an_export_of_another_session_is_not_what_is_calibrated() {
    let sitting = sit_with(phone(0).exporting_another(), 12).unwrap();
    assert!(sitting.is_good(), "{sitting:?}");
    let reason = sitting.fallback.unwrap();
    assert!(reason.contains("another session"), "{reason}");
}
