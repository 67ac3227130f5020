//! Units of one type, simulated.

use simulate::Spec;

use super::*;

const HIDDEN: &str = "gyro_g_sensitivity";

fn recordings(sizes: &[Option<f64>]) -> (Vec<Recording>, Request) {
    let mut gravity = 0.0;
    let all = sizes.iter().enumerate().map(|(k, size)| {
        let mut spec = Spec::hand_held(900 + k as u64);
        if let Some(size) = size {
            spec = spec.with_effect(HIDDEN, *size);
        }
        gravity = spec.gravity;
        spec.run().unwrap().recording
    });
    let all = all.collect();
    (all, Request::new(gravity))
}

#[test]
fn what_no_unit_names_alone_is_named_of_all_together() {
    // A seventieth of the typical size: too little for nine coefficients in one recording.
    let (recordings, request) = recordings(&[Some(0.014); 4]);
    let found = discover_units(&recordings, &request).unwrap();
    let alone = found.units.iter().filter(|unit| !unit.effects.is_empty());
    assert!(alone.count() < 2, "{:?}", found.units);
    assert_eq!(found.shared.len(), 1, "{found:?}");
    let shared = &found.shared[0];
    assert_eq!(shared.name, HIDDEN);
    assert_eq!(shared.sizes.len(), 4);
    assert!(shared.sizes.iter().all(|size| size.parameters.len() == 9));
    assert!(shared.adjusted_p_value < 0.005);
}

#[test]
fn what_one_unit_has_is_not_shared() {
    let (recordings, request) = recordings(&[Some(1.0), None, None]);
    let found = discover_units(&recordings, &request).unwrap();
    assert!(found.shared.is_empty(), "{found:?}");
    assert_eq!(found.own.len(), 1);
    assert_eq!(found.own[0].name, HIDDEN);
    assert_eq!(found.own[0].size.unit, recordings[0].name);
    assert!(found.own[0].others_would_show_it);
}

#[test]
fn units_that_lack_nothing_share_nothing() {
    let (recordings, request) = recordings(&[None; 4]);
    let found = discover_units(&recordings, &request).unwrap();
    assert!(found.shared.is_empty() && found.own.is_empty(), "{found:?}");
    assert!(
        found
            .units
            .iter()
            .all(|unit| unit.verdict == crate::Verdict::Nothing)
    );
}

#[test]
fn sizes_that_differ_from_unit_to_unit_are_said_to_differ() {
    // The simulator draws each unit's coefficients anew, of one size.
    let (recordings, request) = recordings(&[Some(1.0), Some(1.0)]);
    let found = discover_units(&recordings, &request).unwrap();
    let agreement = found.shared[0].agreement.as_ref().unwrap();
    assert!(agreement.p_value < 1e-3, "{agreement:?}");
    let mut same = Spec::hand_held(950).with_effect(HIDDEN, 1.0);
    let first = same.run().unwrap();
    let truth = &first.truth.gyroscope;
    let mut effects = std::collections::BTreeMap::new();
    for (name, value) in truth.names().iter().zip(truth.values()) {
        if let Some(own) = name.strip_prefix("gyro_g_sensitivity.") {
            effects.insert(own.to_owned(), *value);
        }
    }
    same = Spec::hand_held(951);
    same.effects.insert(HIDDEN.into(), effects);
    let second = same.run().unwrap();
    let found = discover_units(&[first.recording, second.recording], &request).unwrap();
    let agreement = found.shared[0].agreement.as_ref().unwrap();
    assert!(agreement.p_value > 1e-3, "{agreement:?}");
    assert_eq!(agreement.dof, 9.0);
}

/// A clock of half the rate puts the gyroscope's scale at two: its unit says so, and is not asked for the type.
#[test]
fn a_unit_that_is_not_to_be_used_says_so_and_counts_for_nothing() {
    let (mut recordings, request) = recordings(&[None, None, None]);
    let unit = &mut recordings[2];
    for stream in [&mut unit.accelerometer, &mut unit.gyroscope] {
        let stream = stream.as_mut().unwrap();
        stream.t.iter_mut().for_each(|t| *t *= 2.0);
    }
    let found = discover_units(&recordings, &request).unwrap();
    let [one, other, wrong] = found.units.as_slice() else {
        panic!("{found:?}");
    };
    assert_eq!((&one.left_out, &other.left_out), (&None, &None));
    assert_eq!(wrong.failed_gates.len(), 1);
    assert_eq!(wrong.left_out.as_ref(), wrong.failed_gates.first());
    assert_eq!(found.shared, []);
}

#[test]
fn a_unit_has_its_faults_with_interval_and_size() {
    let (mut recordings, request) = recordings(&[None, None]);
    let spec = Spec::hand_held(903).with_fault(simulate::Fault::Slip {
        interval: 9,
        angle: 4e-3,
    });
    recordings.push(spec.run().unwrap().recording);
    let found = discover_units(&recordings, &request).unwrap();
    let fault = &found.units[2].faults[0];
    assert_eq!((&*fault.name, fault.interval), ("mount_slip", Some(10)));
    assert!(fault.size.is_some());
}
