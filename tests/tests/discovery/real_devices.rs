//! What real devices do that a simulator does not think of: discovery names what a person would.

use calib::Recording;
use calib::discover::{Discovery, Request, Verdict, discover};
use calib::recording::ReadOptions;
use calib::simulate::{
    Fault, HandHeld, Hidden, Motion, Pattern, Relaxation, Rezeroing, Session, Spec, Telegraph,
    Temperature,
};
use findings::Grade;
use nalgebra::Vector3;
use sensor::{Axis, Sensor};
use stillpoint_tests::needed_data::needed;

const DEGREE_PER_HOUR: f64 = std::f64::consts::PI / 180.0 / 3600.0;

fn of(recordings: &[Recording], spec: &Spec) -> Discovery {
    discover(recordings, &Request::new(spec.gravity)).unwrap()
}

/// Names of effects, then of faults with their intervals.
fn claims(discovery: &Discovery) -> Vec<String> {
    let findings = &discovery.findings;
    let effects = findings.effects.iter().map(|e| e.name.clone());
    let faults = findings.integrity.iter();
    effects
        .chain(faults.map(|f| format!("{} {}", f.name, f.interval.unwrap_or(0))))
        .collect()
}

/// The same recording with `error` added to the rate while `true_interval` (from 0) lasts.
fn with_excursion(session: &Session, interval: usize, error: Vector3<f64>) -> Recording {
    let span = &session.truth.static_intervals[interval];
    let mut recording = session.recording.clone();
    let stream = recording.gyroscope.as_mut().unwrap();
    for (t, value) in stream.t.iter().zip(&mut stream.values) {
        if (span.start..span.end).contains(t) {
            *value += error;
        }
    }
    recording
}

#[test]
fn flicker_is_noise_and_is_measured() {
    let (mut found, seeds) = ([0.0; 2], 4);
    for seed in 0..seeds {
        let mut spec = Spec::hand_held(seed);
        spec.accelerometer.instability = 1e-3;
        spec.gyroscope.instability = 15.0 * DEGREE_PER_HOUR;
        let request = Request {
            flicker: true,
            ..Request::new(spec.gravity)
        };
        let discovery = discover(&[spec.run().unwrap().recording], &request).unwrap();
        assert_eq!(
            discovery.findings.verdict,
            Verdict::Nothing,
            "{:?}",
            claims(&discovery)
        );
        for (sum, axes) in found.iter_mut().zip(discovery.findings.bias_instability) {
            *sum += axes.iter().map(|b| b * b).sum::<f64>() / (3.0 * seeds as f64);
        }
    }
    // A single axis of a session knows its variance to a half; twelve of them to a sixth.
    for (found, truth) in found.into_iter().zip([1e-3, 15.0 * DEGREE_PER_HOUR]) {
        let ratio = found.sqrt() / truth;
        assert!((0.6..1.4).contains(&ratio), "{ratio}");
    }
}

#[test]
fn one_interval_whose_rate_is_off_is_no_step_of_the_bias() {
    let spec = Spec::hand_held(3);
    let session = spec.run().unwrap();
    let recording = with_excursion(&session, 12, Vector3::new(1.5e-3, -1e-3, 0.8e-3));
    assert_eq!(claims(&of(&[recording], &spec)), ["disturbed_interval 13"]);
}

#[test]
fn a_zero_that_is_set_anew_at_rest_is_a_fault_of_the_recording() {
    let rezeroing = Hidden::Rezeroing(Rezeroing {
        sensor: Sensor::Gyroscope,
        amplitude: 2e-4,
        after: 3.0,
    });
    let spec = Spec::hand_held(31).with_hidden(rezeroing);
    let discovery = of(&[spec.run().unwrap().recording], &spec);
    assert_eq!(claims(&discovery), ["rezeroing 0"]);
    let detail = &discovery.findings.integrity[0].finding.what();
    // The detector needs up to half a second to see that the turn is over.
    let jumps = [" 2.5 s", " 2.75 s", " 2.8 s", " 3 s"].iter();
    assert!(
        jumps.filter(|at| detail.contains(*at)).count() == 1,
        "{detail}"
    );
    // √(3 · 2) times the standard deviation of a component, some placements.
    assert!(detail.contains(" °/h (rms over"), "{detail}");
}

#[test]
fn a_bias_that_relaxes_drifts_or_flips_is_not_set_anew() {
    let (sensor, axis) = (Sensor::Gyroscope, Axis::Y);
    let relaxes = |tau| {
        Hidden::Relaxation(Relaxation {
            sensor,
            axis,
            amplitude: 1e-3,
            tau,
        })
    };
    let flips = Hidden::Telegraph(Telegraph {
        sensor,
        axis,
        amplitude: 1e-3,
        dwell: 10.0,
    });
    let plain = Spec::hand_held(32);
    let mut walks = plain.clone();
    walks.gyroscope.random_walk = 2e-4;
    let hidden =
        [relaxes(1.0), relaxes(3.0), flips].map(|hidden| plain.clone().with_hidden(hidden));
    for spec in hidden
        .into_iter()
        .chain([plain.with_effect("gyro_drift", 100.0), walks])
    {
        let discovery = of(&[spec.run().unwrap().recording], &spec);
        let named = claims(&discovery);
        assert!(!named.contains(&"rezeroing 0".to_owned()), "{named:?}");
    }
}

#[test]
fn a_bias_that_flips_between_two_levels_is_said_to() {
    for (seed, sensor, amplitude) in [
        (39, Sensor::Accelerometer, 3e-3),
        (37, Sensor::Gyroscope, 1e-4),
        (40, Sensor::Accelerometer, 3e-3),
    ] {
        let spec = Spec::hand_held(seed).with_hidden(Hidden::Telegraph(Telegraph {
            sensor,
            axis: Axis::Z,
            amplitude,
            dwell: 60.0,
        }));
        let findings = of(&[spec.run().unwrap().recording], &spec).findings;
        assert!(findings.effects.is_empty(), "{seed}");
        let shape = findings.unexplained.unwrap().shape();
        let said = format!("{}: the bias of axis z jumps to and fro", sensor.name());
        assert!(shape.starts_with(&said), "{seed}: {shape}");
    }
}

/// A pattern over orientation has two levels about as well: of 40 three were said to jump to and fro.
#[test]
fn a_bias_that_goes_with_the_placement_does_not_jump_to_and_fro() {
    let said = (33..39).filter_map(|seed| {
        let spec = Spec::hand_held(seed).with_hidden(Hidden::Pattern(Pattern {
            sensor: Sensor::Accelerometer,
            axis: Axis::X,
            amplitude: 8e-3,
            wavenumber: 7.0,
        }));
        let findings = of(&[spec.run().unwrap().recording], &spec).findings;
        findings.unexplained.map(|rest| rest.shape())
    });
    let said: Vec<String> = said.collect();
    assert!(said.len() > 3, "{said:?}");
    let jumps = said.iter().filter(|shape| shape.contains("to and fro"));
    assert_eq!(jumps.count(), 0, "{said:?}");
}

/// What a gyroscope does to the turns, with no walk anywhere: taken for a walk of the accelerometer, from whose directions the
/// turns begin, it was `accel_misalignment_temperature`.
#[test]
fn what_the_gyroscope_does_to_turns_is_no_walk_of_the_accelerometer() {
    for seed in [2, 4] {
        let mut spec = Spec::hand_held(seed).with_effect("gyro_misalignment_temperature", 1.6);
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(40),
            rest: [3.5, 8.0],
            turn: [1.0, 4.0],
            ..HandHeld::default()
        });
        spec.temperature = Some(Temperature {
            self_heating: 8.0,
            swing: 3.0,
            period: 250.0,
            ..Temperature::default()
        });
        let discovery = of(&[spec.run().unwrap().recording], &spec);
        assert_eq!(claims(&discovery), ["gyro_misalignment_temperature"]);
        assert!(discovery.findings.unexplained.is_none(), "{seed}");
    }
}

#[test]
fn a_dead_zone_is_a_fault_of_the_recording_where_only_turns_show_it_too() {
    for half_width in [0.004, 0.02] {
        let mut spec = Spec::hand_held(4);
        spec.gyroscope.dead_zone = half_width;
        let discovery = of(&[spec.run().unwrap().recording], &spec);
        assert_eq!(claims(&discovery), ["dead_zone 0"]);
        assert!(discovery.findings.unexplained.is_none());
        // What calibrate asks care for, a search does too.
        let verdict = discovery.findings.calibration.verdict();
        assert_eq!(verdict.level, Grade::Care, "{half_width}");
    }
}

#[test]
fn samples_lost_in_neighbouring_turns_do_not_hide_each_other() {
    let spec = Spec::hand_held(4)
        .with_fault(Fault::Lost {
            turn: 8,
            length: 0.05,
        })
        .with_fault(Fault::Lost {
            turn: 9,
            length: 0.05,
        });
    let recording = spec.run().unwrap().recording;
    // Their stamps are closed up: they are outliers, and nothing says that samples are lost.
    assert_eq!(
        claims(&of(&[recording], &spec)),
        ["outlying_turn 9", "outlying_turn 10"]
    );
}

#[test]
fn two_recordings_make_no_step_between_them() {
    let spec = Spec::hand_held(5);
    let truth = spec.run().unwrap();
    let mut later = spec.clone();
    later.seed += 1000;
    // The same device, its gyroscope switched on again with another bias.
    for own in [&truth.truth.accelerometer, &truth.truth.gyroscope] {
        for (name, value) in own.names().iter().zip(own.values()) {
            let moved = if name.starts_with("gyro.b_") {
                1e-3
            } else {
                0.0
            };
            later.parameters.insert(name.clone(), value + moved);
        }
    }
    let recordings = [truth.recording, later.run().unwrap().recording];
    let discovery = of(&recordings, &spec);
    assert_eq!(
        discovery.findings.verdict,
        Verdict::Nothing,
        "{:?}",
        claims(&discovery)
    );
}

#[test]
fn a_drift_that_was_evident_beside_a_withdrawn_step_only_is_withdrawn_too() {
    let Some(path) = needed("real/snu_2.csv.gz") else {
        return;
    };
    let recording = Recording::read(&path, &ReadOptions::default()).unwrap();
    let discovery = discover(&[recording], &Request::new(9.79871)).unwrap();
    // The rate's z mean goes 9.7, 11.4, 9.1 mrad/s over the recording and comes back; its g-sensitivity in x is -3e-5 to -4e-5.
    assert_eq!(
        claims(&discovery),
        ["gyro_g_sensitivity", "undersampled_motion 0"]
    );
    let xx = &discovery.findings.effects[0].parameters[0];
    assert!((-4.5e-5..-2e-5).contains(&xx.value), "{xx:?}");
}
