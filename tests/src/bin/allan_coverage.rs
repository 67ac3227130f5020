//! How often the stated intervals of the Allan noise terms hold the simulated truth.
//!
//! ```text
//! cargo run -p stillpoint-tests --bin allan_coverage -- [SEEDS] [HOURS]
//! ```
//!
//! Four sensors are simulated with seeds `0..SEEDS` (100) for `HOURS` hours (1) at 50 Hz. Printed are,
//! per sensor and term, the truth, how many intervals hold it, how often the term is seen at all,
//! and the median relative half-width where the interval is bounded; last, in how many
//! seeds all five intervals hold at once, and how many fits failed the test of fit at 1 %.

use calib::noise::{AllanCurve, NoiseTerm, NoiseTerms, identify};
use stillpoint_tests::noise_source::Coefficients;

/// Sampling interval, s.
const STEP: f64 = 0.02;

fn main() {
    let number = |k: usize, default: f64| {
        std::env::args()
            .nth(k)
            .and_then(|a| a.parse().ok())
            .unwrap_or(default)
    };
    let (seeds, hours) = (number(1, 100.0) as u64, number(2, 1.0));
    let samples = (hours * 3600.0 / STEP) as usize;
    for (name, truth) in SENSORS {
        let fits: Vec<NoiseTerms> = (0..seeds)
            .filter_map(|seed| identify(&AllanCurve::of(truth.simulate(samples, STEP, seed), STEP)))
            .collect();
        println!("{name}: {} fits of {hours} h", fits.len());
        for (term, value) in NoiseTerm::ALL.into_iter().zip(truth.in_order()) {
            print_term(term, value, &fits);
        }
        let holds = |fit: &&NoiseTerms| {
            fit.estimates
                .iter()
                .zip(truth.in_order())
                .all(|(e, v)| e.interval.holds(v))
        };
        let missed = fits.iter().filter(|fit| fit.model_error > 0.0).count();
        println!(
            "  all five: {}   misfits: {missed}
",
            fits.iter().filter(holds).count()
        );
    }
}

fn print_term(term: NoiseTerm, value: f64, fits: &[NoiseTerms]) {
    let estimates: Vec<_> = fits.iter().map(|fit| fit.get(term)).collect();
    let held = estimates.iter().filter(|e| e.interval.holds(value)).count();
    let seen = estimates.iter().filter(|e| e.is_seen()).count();
    let mut widths: Vec<f64> = estimates
        .iter()
        .map(|e| 0.5 * (e.interval.upper - e.interval.lower) / value)
        .collect();
    widths.sort_by(f64::total_cmp);
    let width = widths.get(widths.len() / 2).copied().unwrap_or(f64::NAN);
    println!("  {term:?}: {value:.2e}  held {held}  seen {seen}  half-width {width:.3}");
}

/// Coefficients in SI units of a rate.
const SENSORS: [(&str, Coefficients); 4] = [
    (
        "all five terms",
        Coefficients {
            quantisation: 3e-6,
            white: 1e-4,
            flicker: 5e-5,
            walk: 3e-6,
            ramp: 1e-7,
        },
    ),
    (
        "consumer gyroscope",
        Coefficients {
            quantisation: 0.0,
            white: 1e-4,
            flicker: 3e-5,
            walk: 2e-6,
            ramp: 0.0,
        },
    ),
    (
        "white noise alone",
        Coefficients {
            quantisation: 0.0,
            white: 1e-4,
            flicker: 0.0,
            walk: 0.0,
            ramp: 0.0,
        },
    ),
    (
        "strong random walk",
        Coefficients {
            quantisation: 0.0,
            white: 1e-4,
            flicker: 0.0,
            walk: 3e-5,
            ramp: 0.0,
        },
    ),
];
