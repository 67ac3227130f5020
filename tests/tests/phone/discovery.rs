//! What is missing of a phone whose gyroscope is sampled at instants, without a filter before.

use calib::discover::{Findings, Request, discover};
use stillpoint_tests::phone;

fn findings(name: &str) -> Findings {
    let recording = phone::recording(&format!("multi_position/{name}")).unwrap();
    discover(&[recording], &Request::new(9.79))
        .unwrap()
        .findings
}

#[test]
fn the_turns_of_a_phone_miss_what_falls_between_samples() {
    if phone::folder().is_none() {
        return;
    }
    for name in ["rec_2", "rec_3"] {
        let found = findings(name);
        let faults: Vec<&str> = found.integrity.iter().map(|f| &*f.name).collect();
        assert_eq!(faults, ["undersampled_motion"], "{name}");
        assert_eq!(found.unexplained, None, "{name}");
        // No effect of the accelerometer stands for turns that scatter.
        let accelerometer = found.effects.iter().find(|e| e.name.starts_with("accel_"));
        assert_eq!(accelerometer, None, "{name}");
    }
}
