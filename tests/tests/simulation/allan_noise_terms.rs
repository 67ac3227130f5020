//! Noise terms of simulated sensors, found again.

use calib::noise::{AllanCurve, NoiseTerm, identify, settling_time};
use stillpoint_tests::noise_source::Coefficients;

/// Sampling interval, s.
const STEP: f64 = 0.02;
/// Half an hour.
const SAMPLES: usize = 90_000;

const SENSOR: Coefficients = Coefficients {
    quantisation: 3e-6,
    white: 1e-4,
    flicker: 5e-5,
    walk: 3e-6,
    ramp: 0.0,
};

/// The study with 100 seeds and more sensors is the binary `allan_coverage`.
#[test]
fn all_five_intervals_hold_the_truth_in_at_least_eighteen_of_twenty_recordings() {
    let held = (0..20).filter(|&seed| {
        let terms = identify(&AllanCurve::of(SENSOR.simulate(SAMPLES, STEP, seed), STEP)).unwrap();
        terms
            .estimates
            .iter()
            .zip(SENSOR.in_order())
            .all(|(e, truth)| e.interval.holds(truth))
    });
    assert!(held.count() >= 18);
}

#[test]
fn terms_that_dominate_a_part_of_the_curve_are_seen_and_a_missing_one_is_not() {
    let terms = identify(&AllanCurve::of(SENSOR.simulate(SAMPLES, STEP, 1), STEP)).unwrap();
    for term in [
        NoiseTerm::Quantisation,
        NoiseTerm::WhiteNoise,
        NoiseTerm::BiasInstability,
    ] {
        assert!(terms.get(term).is_seen(), "{:?}", terms.get(term));
    }
    assert!(!terms.get(NoiseTerm::Ramp).is_seen());
    // One per cent: the white noise of 90 000 samples is known to 0.7 %.
    assert!((terms.get(NoiseTerm::WhiteNoise).value / SENSOR.white - 1.0).abs() < 0.01);
}

/// `N²/τ` falls to 21 % (1.1² − 1) of the flicker floor `(2 ln 2/π) B²` at
/// `τ = N²/(0.21 · 0.4413 B²)`.
#[test]
fn the_deviation_turns_flat_where_white_noise_falls_below_the_flicker_floor() {
    let sensor = Coefficients {
        quantisation: 0.0,
        flicker: 1e-4,
        walk: 0.0,
        ..SENSOR
    };
    let terms = identify(&AllanCurve::of(sensor.simulate(SAMPLES, STEP, 2), STEP)).unwrap();
    let expected = (sensor.white / sensor.flicker).powi(2) / (0.21 * 0.4413);
    let found = settling_time(&terms, STEP).unwrap();
    // The floor of half an hour is known to a quarter, and its square enters.
    assert!(
        found > 0.5 * expected && found < 2.0 * expected,
        "{found} {expected}"
    );
}

#[test]
fn a_recording_too_short_to_turn_flat_gives_no_time() {
    let white = Coefficients {
        quantisation: 0.0,
        flicker: 0.0,
        walk: 0.0,
        ..SENSOR
    };
    let terms = identify(&AllanCurve::of(white.simulate(5000, STEP, 3), STEP)).unwrap();
    assert_eq!(settling_time(&terms, STEP), None);
}

#[test]
fn a_signal_that_never_changes_and_one_too_short_have_no_noise_terms() {
    assert!(identify(&AllanCurve::of(vec![1.0; 10_000], STEP)).is_none());
    assert!(identify(&AllanCurve::of(SENSOR.simulate(100, STEP, 4), STEP)).is_none());
}
